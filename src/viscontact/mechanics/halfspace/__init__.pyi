from . import smooth_kernel, strip_basis
from .end_correction import EndCorrection, MovingEndCorrection, end_basis, ends_error
from .periodic_influence import periodic_influence_coefficient
from .strip_influence import strip_coefficient

__all__ = [
    "EndCorrection",
    "MovingEndCorrection",
    "end_basis",
    "ends_error",
    "periodic_influence_coefficient",
    "smooth_kernel",
    "strip_basis",
    "strip_coefficient",
]
