from . import (
    end_certificate,
    ended_stress,
    free_end,
    layer_end,
    periodic_ends,
    plane_strip,
    smooth_kernel,
    strip,
    strip_basis,
)
from .end_correction import EndCorrection, MovingEndCorrection, end_basis, ends_error
from .periodic_influence import periodic_influence_coefficient
from .strip_influence import strip_coefficient

__all__ = [
    "EndCorrection",
    "MovingEndCorrection",
    "end_basis",
    "end_certificate",
    "ended_stress",
    "ends_error",
    "free_end",
    "layer_end",
    "periodic_ends",
    "periodic_influence_coefficient",
    "plane_strip",
    "smooth_kernel",
    "strip",
    "strip_basis",
    "strip_coefficient",
]
