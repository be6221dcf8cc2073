from .chamfer import Chamfer
from .crowns import (
    CylindricalProfile,
    FullCrown,
    PartialCrown,
    TwoRadiiCrown,
)
from .ellipsoid import Ellipsoid
from .faceted import Pyramid, Wedge
from .flat_punch import FlatPunch
from .height_map import HeightMap
from .indenter import CombinedIndenter, Indenter, PlacedIndenter
from .logarithmic import LogarithmicProfile
from .named_profiles import PROFILES
from .point_bodies import Revolved, Swept
from .profile import Profile
from .roller import Roller
from .sphere_cone import Cone, Paraboloid, Sphere
from .tabulated import TabulatedProfile
from .textures import Dimples, Waviness
from .torus import Torus

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
