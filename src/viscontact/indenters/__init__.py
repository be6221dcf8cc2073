"""Indenter shapes: each gives its initial gap to a plane."""

from viscontact.indenters.chamfer import Chamfer
from viscontact.indenters.crowns import CylindricalProfile, FullCrown, PartialCrown, TwoRadiiCrown
from viscontact.indenters.ellipsoid import Ellipsoid
from viscontact.indenters.faceted import Pyramid, Wedge
from viscontact.indenters.flat_punch import FlatPunch
from viscontact.indenters.height_map import HeightMap
from viscontact.indenters.indenter import CombinedIndenter, Indenter, PlacedIndenter
from viscontact.indenters.logarithmic import LogarithmicProfile
from viscontact.indenters.named_profiles import PROFILES
from viscontact.indenters.point_bodies import Revolved, Swept
from viscontact.indenters.profile import Profile
from viscontact.indenters.roller import Roller
from viscontact.indenters.sphere_cone import Cone, Paraboloid, Sphere
from viscontact.indenters.tabulated import TabulatedProfile
from viscontact.indenters.textures import Dimples, Waviness
from viscontact.indenters.torus import Torus

__all__ = [
    "PROFILES",
    "Chamfer",
    "CombinedIndenter",
    "Cone",
    "CylindricalProfile",
    "Dimples",
    "Ellipsoid",
    "FlatPunch",
    "FullCrown",
    "HeightMap",
    "Indenter",
    "LogarithmicProfile",
    "Paraboloid",
    "PartialCrown",
    "PlacedIndenter",
    "Profile",
    "Pyramid",
    "Revolved",
    "Roller",
    "Sphere",
    "Swept",
    "TabulatedProfile",
    "Torus",
    "TwoRadiiCrown",
    "Waviness",
    "Wedge",
]
