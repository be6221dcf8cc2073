"""Indenter shapes: each gives its initial gap to a plane."""

from viscontact.bodies.indenters.chamfer import Chamfer
from viscontact.bodies.indenters.crowns import (
    CylindricalProfile,
    FullCrown,
    PartialCrown,
    TwoRadiiCrown,
)
from viscontact.bodies.indenters.ellipsoid import Ellipsoid
from viscontact.bodies.indenters.faceted import Pyramid, Wedge
from viscontact.bodies.indenters.flat_punch import FlatPunch
from viscontact.bodies.indenters.height_map import HeightMap
from viscontact.bodies.indenters.indenter import CombinedIndenter, Indenter, PlacedIndenter
from viscontact.bodies.indenters.logarithmic import LogarithmicProfile
from viscontact.bodies.indenters.named_profiles import PROFILES
from viscontact.bodies.indenters.point_bodies import Revolved, Swept
from viscontact.bodies.indenters.profile import Profile
from viscontact.bodies.indenters.roller import Roller
from viscontact.bodies.indenters.sphere_cone import Cone, Paraboloid, Sphere
from viscontact.bodies.indenters.tabulated import TabulatedProfile
from viscontact.bodies.indenters.textures import Dimples, Waviness
from viscontact.bodies.indenters.torus import Torus

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
