"""Exact solutions to check against: everything in SI units, nothing of the solver inside.

The elastic ones take the contact modulus E* [Pa], the viscoelastic ones a creep compliance
J(t) [1/Pa] and its convolution inverse M(t) [Pa] as callables.
"""

from viscontact.reference.hertz import (
    EllipticalContact,
    SphereContact,
    hertz_elliptical,
    hertz_sphere,
)
from viscontact.reference.lee_radok import lee_radok_ramp, lee_radok_step
from viscontact.reference.lee_radok_contact import LeeRadokContact
from viscontact.reference.line import LineContact, hertz_line
from viscontact.reference.punch import ConeContact, FlatPunchContact, cone, flat_punch

__all__ = [
    "ConeContact",
    "EllipticalContact",
    "FlatPunchContact",
    "LeeRadokContact",
    "LineContact",
    "SphereContact",
    "cone",
    "flat_punch",
    "hertz_elliptical",
    "hertz_line",
    "hertz_sphere",
    "lee_radok_ramp",
    "lee_radok_step",
]
