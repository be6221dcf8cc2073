from .body import Body
from .hardness import HardnessEstimate, modulus_from_shore
from .layers import Layer, Layered
from .material import Material
from .measured_range import MeasuredRange

__all__ = [
    "Body",
    "HardnessEstimate",
    "Layer",
    "Layered",
    "Material",
    "MeasuredRange",
    "modulus_from_shore",
]
