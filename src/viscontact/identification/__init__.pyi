from .adhesion import fit_adhesion
from .adhesion_fit import AdhesionFit
from .contact_point import ContactPoint, find_contact
from .curve_batch import CurveFits, fit_each
from .fitted_contact import FittedContact
from .fitted_curve import FittedCurve
from .force_curve import ForceCurve
from .force_map import ForceMap, count_force_curves, read_force_map
from .indentation import fit_indentation
from .indentation_fit import IndentationFit
from .instrument_curves import read_force_curve
from .isotherm import Isotherm
from .master_curve import MasterCurve, build_master_curve, fit_master_curve
from .record import Cantilever, IndentationRecord
from .section import adhesive_sections, material_section
from .series_fits import Fit, FoundShift, Misfit, Reason, fit_creep, fit_dynamic, fit_relaxation
from .shift_fit import ShiftFit, fit_arrhenius, fit_wlf
from .shift_uncertainty import ShiftUncertainty

__all__ = [
    "AdhesionFit",
    "Cantilever",
    "ContactPoint",
    "CurveFits",
    "Fit",
    "FittedContact",
    "FittedCurve",
    "ForceCurve",
    "ForceMap",
    "FoundShift",
    "IndentationFit",
    "IndentationRecord",
    "Isotherm",
    "MasterCurve",
    "Misfit",
    "Reason",
    "ShiftFit",
    "ShiftUncertainty",
    "adhesive_sections",
    "build_master_curve",
    "count_force_curves",
    "find_contact",
    "fit_adhesion",
    "fit_arrhenius",
    "fit_creep",
    "fit_dynamic",
    "fit_each",
    "fit_indentation",
    "fit_master_curve",
    "fit_relaxation",
    "fit_wlf",
    "material_section",
    "read_force_curve",
    "read_force_map",
]
