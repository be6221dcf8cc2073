from .fit import Fit
from .prony import FitOptions
from .table_fit import fit_measured, is_oscillation, loss_note, measured_columns

__all__ = [
    "Fit",
    "FitOptions",
    "fit_measured",
    "is_oscillation",
    "loss_note",
    "measured_columns",
]
