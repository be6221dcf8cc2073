"""Elastic force of a tip over its indentation, on a half-space or on a film on a rigid base."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TypeVar

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Cone, FlatPunch, Indenter, Paraboloid, Pyramid, Sphere
from viscontact.reference import (
    ConeProfile,
    PunchProfile,
    SphereProfile,
    layer_cone,
    layer_punch,
    layer_sphere,
)

#: Force of a pyramid over E* tan(half angle) d², by its number of faces [-]: of contacts on
#: half-spaces of up to 512² cells, which change them by less than 1e-4 from 384² on. Bilodeau
#: (1992, J. Appl. Mech. 59, 519) approximates that of four faces by 0.7453.
PYRAMIDS = {3: 0.8824, 4: 0.7376}

_SPHERE, _CONE, _PUNCH = 1.5, 2.0, 1.0  # exponents of the indentation in the force
#: Largest contact radius over the thickness of a film, on it: that of the last row of its table.
WIDEST = 8.0
#: Contact radii over the thickness, of the table of a film: close where it is thick.
_RATIOS = WIDEST * np.linspace(0.0, 1.0, 25)[1:] ** 2
_PLACES = 4000  # of the table between them: linear interpolation to 1e-7

DepthT = TypeVar("DepthT", float, Floats)


@dataclass(frozen=True)
class Film:
    """Bonded film on a rigid base, instead of a half-space.

    Parameters
    ----------
    thickness : float
        Thickness [m].
    poisson_ratio : float
        Poisson's ratio [-].

    Examples
    --------
    >>> Film(20e-6, 0.5).thickness
    2e-05
    """

    thickness: float
    poisson_ratio: float


@dataclass(frozen=True, eq=False)
class ElasticIndentation:
    """Force factor d^exponent of a tip on an elastic half-space of contact modulus E* = 1 Pa.

    On a film it is larger, by a factor that depends on the contact radius that the tip would have
    on a half-space at the same indentation, over the thickness, and on Poisson's ratio.
    """

    factor: float  # force at an indentation of 1 m [N]
    exponent: float
    film: Film | None = None
    width: float = 0.0  # contact radius on a half-space at an indentation of 1 m [m]

    @property
    def grows(self) -> bool:
        """True if the contact grows with the indentation, as that of a punch does not."""
        return self.exponent > 1

    def force(self, depth: DepthT) -> DepthT:
        """Force at indentations >= 0 [N]."""
        return self.force_and_slope(depth)[0]

    def force_and_slope(self, depth: DepthT) -> tuple[DepthT, DepthT]:
        """Force [N] at indentations >= 0, and its derivative [N/m]."""
        slope = self.factor * depth ** (self.exponent - 1)
        if self.film is None:
            return slope * depth, self.exponent * slope
        ratio = self.width * depth ** (self.exponent - 1) / self.film.thickness
        table = _stiffening(self.exponent, self.film.poisson_ratio)
        x = np.log1p(ratio)
        rise = np.interp(x, table.places, table.slopes)
        beyond = np.maximum(x - table.places[-1], 0.0)
        slope = slope * np.exp(np.interp(x, table.places, table.logarithms) + rise * beyond)
        growth = rise * ratio / (1 + ratio) * (self.exponent - 1)
        return slope * depth, slope * (self.exponent + growth)

    def is_within_table(self, depth: float) -> bool:
        """False for a contact wider than those of the table of a film."""
        if self.film is None or not self.grows:
            return self.contact_ratio(depth) <= WIDEST
        table = _stiffening(self.exponent, self.film.poisson_ratio)
        return math.log1p(self.contact_ratio(depth)) <= float(table.places[-1])

    def contact_ratio(self, depth: float) -> float:
        """Contact radius over thickness at an indentation, as on a half-space; 0 without film."""
        if self.film is None:
            return 0.0
        return float(self.width * depth ** (self.exponent - 1) / self.film.thickness)


def elastic_indentation(indenter: Indenter, film: Film | None = None) -> ElasticIndentation:
    """Elastic force of an indenter; ValueError for one without a closed form."""
    if film is not None and isinstance(indenter, Pyramid):
        raise ValueError(
            "thickness: goes with spheres, cones and round punches; the contacts of a pyramid on a "
            "film are not similar: take a cone of the same area over the depth, or fit through the "
            "simulator"
        )
    match indenter_profile(indenter):
        case SphereProfile(radius=radius):
            return ElasticIndentation(4 / 3 * math.sqrt(radius), _SPHERE, film, math.sqrt(radius))
        case ConeProfile(half_angle=half_angle):
            width = 2 / math.pi * math.tan(half_angle)
            return ElasticIndentation(width, _CONE, film, width)
        case PunchProfile(radius=radius):
            return ElasticIndentation(2 * radius, _PUNCH, film, radius)


def indenter_profile(indenter: Indenter) -> SphereProfile | ConeProfile | PunchProfile:
    """Profile of the exact solution for an indenter; ValueError for one without.

    The contacts of a pyramid are all similar, as those of a cone are. Force and approach are those
    of the cone of equal force therefore, on a body that creeps, too (Graham 1967).
    """
    match indenter:
        case Sphere(radius=radius):
            return SphereProfile(radius)
        case Paraboloid(radius_x=radius, radius_y=other) if radius == other:
            return SphereProfile(radius)
        case Cone(half_angle=half_angle):
            return ConeProfile(half_angle)
        case Pyramid(half_angle=half_angle, faces=faces) if faces in PYRAMIDS:
            return ConeProfile(math.atan(math.pi / 2 * PYRAMIDS[faces] * math.tan(half_angle)))
        case FlatPunch(radius=radius) if radius is not None:
            return PunchProfile(radius)
    raise ValueError(
        "IndentationRecord.indenter: must be a Sphere, a Cone, a Pyramid with 3 or 4 faces, or a "
        f"round FlatPunch(radius), got {indenter!r}"
    )


@dataclass(frozen=True, eq=False)
class _Stiffening:
    """Table of the logarithm of a film's force over a half-space's at the same indentation.

    Its places are logarithms of 1 + the contact ratio that a half-space would have. Contacts of one
    shape are similar: a table serves for all sizes and thicknesses.
    """

    places: Floats
    logarithms: Floats
    slopes: Floats


@lru_cache(maxsize=16)
def _stiffening(exponent: float, poisson_ratio: float) -> _Stiffening:
    """Table for a shape of indenter and a Poisson's ratio."""
    rows = [_stiffened(exponent, float(ratio), poisson_ratio) for ratio in _RATIOS]
    x, logarithms = np.array([(0.0, 0.0), *rows]).T
    spline, places = scipy.interpolate.CubicSpline(x, logarithms), np.linspace(0.0, x[-1], _PLACES)
    return _Stiffening(places, spline(places), spline(places, 1))


def _stiffened(exponent: float, ratio: float, poisson_ratio: float) -> tuple[float, float]:
    """Row of the table for a contact radius over the thickness."""
    modulus = (1 - poisson_ratio) / 2  # E* = 1 Pa
    indenter: Indenter
    if exponent == _SPHERE:
        indenter = Sphere(1.0)
        contact = layer_sphere(ratio, 1.0, 1.0, shear_modulus=modulus, poisson_ratio=poisson_ratio)
    elif exponent == _CONE:
        indenter, angle = Cone(math.pi / 4), math.pi / 4
        contact = layer_cone(ratio, angle, 1.0, shear_modulus=modulus, poisson_ratio=poisson_ratio)
    else:
        indenter = FlatPunch(ratio)
        contact = layer_punch(ratio, 1.0, 1.0, shear_modulus=modulus, poisson_ratio=poisson_ratio)
    body, depth = elastic_indentation(indenter), contact.approach
    half_space = body.force(depth)
    width = body.width * depth ** (exponent - 1)
    return math.log1p(width), math.log(contact.force / half_space)
