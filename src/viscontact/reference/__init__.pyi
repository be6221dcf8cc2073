from .adhesion import AdhesiveSphere, AdhesiveState, jkr_sphere, maugis_dugdale, tabor_number
from .axisymmetric_contact import AxisymmetricContact
from .friction import PartialSlip, cattaneo_mindlin
from .hertz import EllipticalContact, SphereContact, hertz_elliptical, hertz_sphere
from .indentation import ResolutionError, clustered_times, press_axisymmetric, resolution_error
from .layer import LayerContact, layer_cone, layer_punch, layer_sphere
from .lee_radok import lee_radok_ramp, lee_radok_step
from .lee_radok_contact import LeeRadokContact
from .line import LineContact, hertz_line
from .line_adhesion import (
    AdhesiveLine,
    AdhesiveLineState,
    adhesive_line,
    adhesive_punch,
    adhesive_wave_pressure,
    edge_energy,
)
from .profiles import ConeProfile, PunchProfile, SphereProfile
from .punch import ConeContact, FlatPunchContact, cone, flat_punch
from .punch_history import (
    PunchOscillation,
    punch_harmonic,
    punch_harmonic_start,
    punch_staircase,
    series_complex_compliance,
)
from .round_loads import circle_displacement, hertz_displacement
from .steady_motion import (
    MovingCylinder,
    fast_sphere_friction_coefficient,
    moving_cylinder,
    moving_wave_resistance,
    slow_friction_coefficient,
)
from .surface_loads import (
    point_load,
    rectangle_displacement,
    rectangle_stress,
    strip_on_layer,
    strip_stresses,
)
from .ting import TingHump, ting_hump
from .ting_force_press import TingForceTriangle, ting_force_triangle
from .ting_press import TingTriangle, ting_triangle
from .ting_repeated import TingCycles, ting_cycles
from .torsion import layer_torsion
from .wavy import WavyContact, full_contact_pressure, westergaard

__all__ = [
    "AdhesiveLine",
    "AdhesiveLineState",
    "AdhesiveSphere",
    "AdhesiveState",
    "AxisymmetricContact",
    "ConeContact",
    "ConeProfile",
    "EllipticalContact",
    "FlatPunchContact",
    "LayerContact",
    "LeeRadokContact",
    "LineContact",
    "MovingCylinder",
    "PartialSlip",
    "PunchOscillation",
    "PunchProfile",
    "ResolutionError",
    "SphereContact",
    "SphereProfile",
    "TingCycles",
    "TingForceTriangle",
    "TingHump",
    "TingTriangle",
    "WavyContact",
    "adhesive_line",
    "adhesive_punch",
    "adhesive_wave_pressure",
    "cattaneo_mindlin",
    "circle_displacement",
    "clustered_times",
    "cone",
    "edge_energy",
    "fast_sphere_friction_coefficient",
    "flat_punch",
    "full_contact_pressure",
    "hertz_displacement",
    "hertz_elliptical",
    "hertz_line",
    "hertz_sphere",
    "jkr_sphere",
    "layer_cone",
    "layer_punch",
    "layer_sphere",
    "layer_torsion",
    "lee_radok_ramp",
    "lee_radok_step",
    "maugis_dugdale",
    "moving_cylinder",
    "moving_wave_resistance",
    "point_load",
    "press_axisymmetric",
    "punch_harmonic",
    "punch_harmonic_start",
    "punch_staircase",
    "rectangle_displacement",
    "rectangle_stress",
    "resolution_error",
    "series_complex_compliance",
    "slow_friction_coefficient",
    "strip_on_layer",
    "strip_stresses",
    "tabor_number",
    "ting_cycles",
    "ting_force_triangle",
    "ting_hump",
    "ting_triangle",
    "westergaard",
]
