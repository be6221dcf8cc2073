"""Shapes that press: each knows its initial gap to a plane, and nothing else."""

from viscontact.indenters.chamfer import Chamfer
from viscontact.indenters.crowns import CylindricalProfile, FullCrown, PartialCrown, TwoRadiiCrown
from viscontact.indenters.flat_punch import FlatPunch
from viscontact.indenters.height_map import HeightMap
from viscontact.indenters.indenter import CombinedIndenter, Indenter
from viscontact.indenters.logarithmic import LogarithmicProfile
from viscontact.indenters.named_profiles import PROFILES
from viscontact.indenters.pointed import Cone, Paraboloid, Sphere
from viscontact.indenters.profile import Profile
from viscontact.indenters.roller import Roller
from viscontact.indenters.tabulated import TabulatedProfile

__all__ = [
    "PROFILES",
    "Chamfer",
    "CombinedIndenter",
    "Cone",
    "CylindricalProfile",
    "FlatPunch",
    "FullCrown",
    "HeightMap",
    "Indenter",
    "LogarithmicProfile",
    "Paraboloid",
    "PartialCrown",
    "Profile",
    "Roller",
    "Sphere",
    "TabulatedProfile",
    "TwoRadiiCrown",
]
