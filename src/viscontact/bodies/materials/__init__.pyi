from .body import Body
from .layers import Layer, Layered
from .material import Material
from .measured_range import MeasuredRange

__all__ = ["Body", "Layer", "Layered", "Material", "MeasuredRange"]
