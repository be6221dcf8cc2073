"""Exact solutions to check against: everything in SI units, nothing of the solver inside.

The elastic ones take the contact modulus E* [Pa], the viscoelastic ones a creep compliance
J(t) [1/Pa] and its convolution inverse M(t) [Pa] as callables.
"""

from viscontact.reference.hertz import (
    EllipticalContact,
    LineContact,
    SphereContact,
    hertz_elliptical,
    hertz_line,
    hertz_sphere,
)
from viscontact.reference.lee_radok import LeeRadokContact, lee_radok_ramp, lee_radok_step
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
