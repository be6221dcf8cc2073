from .fit import Fit
from .found_shift import FoundShift
from .prony import FitOptions, fit_creep, fit_dynamic, fit_relaxation
from .quality import Misfit, Reason
from .table_fit import fit_measured, is_oscillation, loss_note, measured_columns

__all__ = [
    "Fit",
    "FitOptions",
    "FoundShift",
    "Misfit",
    "Reason",
    "fit_creep",
    "fit_dynamic",
    "fit_measured",
    "fit_relaxation",
    "is_oscillation",
    "loss_note",
    "measured_columns",
]
