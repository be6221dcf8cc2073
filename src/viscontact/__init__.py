"""Contact of creeping bodies: viscoelastic half-space contact mechanics, over time.

Names are loaded when first used, so that ``import viscontact`` stays fast.
"""

import lazy_loader as _lazy

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = _lazy.attach(
    __name__,
    submodules=["reference", "verify"],
    submod_attrs={
        "errors": ["AccuracyWarning", "ConvergenceError", "DomainError"],
        "grid": ["Grid"],
        "indenters": [
            "Chamfer",
            "Cone",
            "CylindricalProfile",
            "FlatPunch",
            "FullCrown",
            "HeightMap",
            "Indenter",
            "LogarithmicProfile",
            "Paraboloid",
            "PartialCrown",
            "Profile",
            "Roller",
            "Sphere",
            "TabulatedProfile",
            "TwoRadiiCrown",
        ],
        "laws": [
            "WLF",
            "Arrhenius",
            "TabulatedShift",
            "BesideSpring",
            "Burgers",
            "CreepSeries",
            "Elastic",
            "FractionalMaxwell",
            "FractionalZener",
            "Law",
            "Maxwell",
            "PowerLaw",
            "RelaxationSeries",
            "TabulatedCreep",
            "TabulatedRelaxation",
            "Zener",
        ],
        "material": ["Material"],
        "case": ["shipped_material"],
        "tables": ["Table", "read_table"],
        "cards": ["Card", "read_abaqus", "read_ansys", "write_abaqus", "write_ansys"],
        "identification": [
            "IndentationRecord",
            "Isotherm",
            "build_master_curve",
            "fit_creep",
            "fit_dynamic",
            "fit_indentation",
            "fit_master_curve",
            "fit_relaxation",
        ],
        "load": [
            "ApproachHistory",
            "ForceHistory",
            "LoadHistory",
            "harmonic",
            "ramp",
            "step",
            "triangle",
        ],
        "stepping": ["adaptive_times", "log_times", "uniform_times"],
        "extent": ["auto_grid"],
        "state": ["ContactState", "Outcome"],
        "marching": ["march"],
        "dataset": ["simulate"],
        "results": ["open_results", "save"],
        "stresses": ["section_stresses"],
    },
)
__all__ += ["__version__"]
