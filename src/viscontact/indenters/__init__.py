"""Shapes that press: each knows its initial gap to a plane, and nothing else."""

from viscontact.indenters.flat_punch import FlatPunch
from viscontact.indenters.height_map import HeightMap
from viscontact.indenters.indenter import CombinedIndenter, Indenter
from viscontact.indenters.pointed import Cone, Paraboloid, Sphere
from viscontact.indenters.roller import Roller

__all__ = [
    "CombinedIndenter",
    "Cone",
    "FlatPunch",
    "HeightMap",
    "Indenter",
    "Paraboloid",
    "Roller",
    "Sphere",
]
