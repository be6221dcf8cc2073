"""Roller profiles with sharp ends or circular crowns."""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.arc import arc_drop
from viscontact.bodies.indenters.profile import Profile
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import check_fields, real_array


@dataclass(frozen=True)
class CylindricalProfile(Profile):
    """A straight profile with sharp ends.

    The roller's half length is half of the whole.

    Examples
    --------
    >>> CylindricalProfile().drop([0.9, 1.1], half_length=1.0).tolist()
    [0.0, inf]
    """

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return zero on the line and +inf beyond; see `Profile.drop`."""
        return np.where(np.abs(real_array("x", x, "m")) <= half_length, 0.0, np.inf)

    def end(self, half_length: float) -> float:
        """Return the half length [m]."""
        return half_length


@dataclass(frozen=True)
class FullCrown(Profile):
    """One circular arc over the whole length, ending sharply.

    The roller's half length is half of the whole.

    Parameters
    ----------
    crown_radius : float
        Radius of the arc [m].

    Raises
    ------
    ValueError
        If the radius is not a positive, finite number.

    Examples
    --------
    >>> FullCrown(crown_radius=13.0).drop([5.0, 7.0], half_length=6.0).tolist()
    [1.0, inf]
    """

    crown_radius: float = field(metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "crown_radius")

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the drop of the arc; see `Profile.drop`."""
        distance = np.abs(real_array("x", x, "m"))
        return np.where(distance <= half_length, arc_drop(distance, self.crown_radius), np.inf)

    def end(self, half_length: float) -> float:
        """Return the half length, or where the arc ends before [m]."""
        return min(half_length, self.crown_radius)

    def curvature(self, half_length: float) -> float:
        """Return the curvature of the arc [1/m]."""
        return 1 / self.crown_radius


@dataclass(frozen=True)
class PartialCrown(Profile):
    """A straight line, continued at either end by a circular arc tangent to it.

    The roller's half length is half of the straight part.

    Parameters
    ----------
    crown_radius : float
        Radius of the arcs [m].
    end_length : float, optional
        Distance of the sharp end from the middle [m]; that of the end of the arc when left out.

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, or the roller would end on the straight
        part.

    Notes
    -----
    Spinu & Cerlinca (2018), eq. 13, with L for the half length:
    drop(x) = R_c - sqrt(R_c² - (|x| - L)²) for |x| > L.

    Examples
    --------
    >>> PartialCrown(crown_radius=13.0).drop([10.0, 15.0], half_length=10.0).tolist()
    [0.0, 1.0]
    """

    crown_radius: float = field(metadata={"unit": "m"})
    end_length: float | None = field(default=None, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "crown_radius", "end_length")

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the drop of the arc beyond the straight part; see `Profile.drop`."""
        distance = np.abs(real_array("x", x, "m"))
        drop = arc_drop(np.maximum(distance - half_length, 0.0), self.crown_radius)
        return np.where(distance <= self.end(half_length), drop, np.inf)

    def end(self, half_length: float) -> float:
        """Return where the roller or its arc ends [m]."""
        of_arc = half_length + self.crown_radius
        return of_arc if self.end_length is None else min(of_arc, self.end_length)

    def require_fit(self, half_length: float) -> None:
        """Raise ValueError if the roller would end on its straight part."""
        _require_beyond("PartialCrown", "end_length", self.end_length, half_length)


@dataclass(frozen=True)
class TwoRadiiCrown(Profile):
    """A straight line, continued by two circular arcs, each tangent to what comes before.

    The roller's half length is half of the straight part.

    Parameters
    ----------
    crown_radius : float
        Radius of the first arc, the flatter one as a rule [m].
    crown_length : float
        Length of the first arc along x [m].
    end_radius : float
        Radius of the second arc, which continues the first [m].
    end_length : float, optional
        Distance of the sharp end from the middle [m]; that of the end of the second arc when
        left out.

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, or the first arc ends before its length.

    Notes
    -----
    With s the distance from the straight part and φ the slope's angle, s = R_1 sin φ on the first
    arc. From s_1 on, sin φ = sin φ_1 + (s - s_1) / R_2 and the drop grows by
    R_2 (cos φ_1 - cos φ), computed as (s - s_1) (sin φ_1 + sin φ) / (cos φ_1 + cos φ).

    Examples
    --------
    >>> two = TwoRadiiCrown(crown_radius=13.0, crown_length=5.0, end_radius=6.5)
    >>> two.drop([1.0, 6.0, 9.5], half_length=1.0).round(12).tolist()
    [0.0, 1.0, 4.5]
    """

    crown_radius: float = field(metadata={"unit": "m"})
    crown_length: float = field(metadata={"unit": "m"})
    end_radius: float = field(metadata={"unit": "m"})
    end_length: float | None = field(default=None, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "crown_radius", "crown_length", "end_radius", "end_length")
        if self.crown_length >= self.crown_radius:
            raise ValueError(
                "TwoRadiiCrown: crown_length must be smaller than crown_radius, where the arc "
                f"ends, got {format_quantity(self.crown_length, 'm', 9)} and "
                f"{format_quantity(self.crown_radius, 'm', 9)}"
            )

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the sum of the arcs' drops; see `Profile.drop`."""
        distance = np.abs(real_array("x", x, "m"))
        beyond = np.maximum(distance - half_length, 0.0)
        on_second = np.maximum(beyond - self.crown_length, 0.0)
        sine_1 = self.crown_length / self.crown_radius
        sine = np.minimum(sine_1 + on_second / self.end_radius, 1.0)
        cosines = math.sqrt(1 - sine_1**2) + np.sqrt((1 - sine) * (1 + sine))
        drop = arc_drop(np.minimum(beyond, self.crown_length), self.crown_radius)
        drop = drop + on_second * (sine_1 + sine) / cosines
        return np.where(distance <= self.end(half_length), drop, np.inf)

    def end(self, half_length: float) -> float:
        """Return where the roller or its second arc ends [m]."""
        sine_1 = self.crown_length / self.crown_radius
        of_arc = half_length + self.crown_length + self.end_radius * (1 - sine_1)
        return of_arc if self.end_length is None else min(of_arc, self.end_length)

    def require_fit(self, half_length: float) -> None:
        """Raise ValueError if the roller would end on its straight part."""
        _require_beyond("TwoRadiiCrown", "end_length", self.end_length, half_length)


def _require_beyond(owner: str, name: str, end: float | None, half_length: float) -> None:
    if end is not None and end < half_length:
        raise ValueError(
            f"{owner}: {name} must be at least the half length of the straight part, "
            f"{format_quantity(half_length, 'm', 9)}, got {format_quantity(end, 'm', 9)}"
        )
