"""Identification of laws from creep, relaxation, oscillation and indentation measurements."""

from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.found_shift import FoundShift
from viscontact.bodies.series_fits.prony import fit_creep, fit_dynamic, fit_relaxation
from viscontact.bodies.series_fits.quality import Misfit, Reason
from viscontact.identification.adhesion import fit_adhesion
from viscontact.identification.adhesion_fit import AdhesionFit
from viscontact.identification.contact_point import ContactPoint, find_contact
from viscontact.identification.curve_batch import CurveFits, fit_each
from viscontact.identification.fitted_contact import FittedContact
from viscontact.identification.fitted_curve import FittedCurve
from viscontact.identification.force_curve import ForceCurve
from viscontact.identification.force_map import ForceMap, count_force_curves, read_force_map
from viscontact.identification.indentation import fit_indentation
from viscontact.identification.indentation_fit import IndentationFit
from viscontact.identification.instrument_curves import read_force_curve
from viscontact.identification.isotherm import Isotherm
from viscontact.identification.master_curve import (
    MasterCurve,
    build_master_curve,
    fit_master_curve,
)
from viscontact.identification.record import Cantilever, IndentationRecord
from viscontact.identification.section import adhesive_sections, material_section
from viscontact.identification.shift_fit import ShiftFit, fit_arrhenius, fit_wlf
from viscontact.identification.shift_uncertainty import ShiftUncertainty

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
