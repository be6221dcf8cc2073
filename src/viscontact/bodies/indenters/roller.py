"""Roller or wheel along x: any profile, circular or parabolic across it."""

from __future__ import annotations

import math
from dataclasses import field
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.arc import arc_drop
from viscontact.bodies.indenters.crowns import CylindricalProfile, PartialCrown
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.named_profiles import named_profile, profile_from_table
from viscontact.bodies.indenters.position_checks import positions
from viscontact.bodies.indenters.profile import Profile
from viscontact.units.numbers import positive

CrossSection = Literal["circle", "parabola"]
CROSS_SECTIONS: tuple[CrossSection, ...] = get_args(CrossSection)


@dataclass(frozen=True, init=False)
class Roller(Indenter):
    """A roller lying along x, with a profile along it and a round section across it.

    Parameters
    ----------
    radius : float
        Radius R where the roller is thickest [m].
    half_length : float
        Half the length L: of the straight part of a roller with a circular crown beyond it
        (``crown_radius``, ``"partial"``, ``"two-radii"``), of the whole roller otherwise [m].
    crown_radius : float, optional
        Radius R_c of the circular profile that continues the straight part at either end,
        tangent to it, until the crown or the section ends [m]. Without it and without a profile
        the roller ends sharply at |x| = L.
    profile : str, Profile or array_like, optional
        The generating line: a name with its arguments behind (``"cylindrical"``, ``"full"``,
        ``"partial"``, ``"two-radii"``, ``"chamfer"``, ``"logarithmic"``, ``"lundberg"``,
        ``"johns-gohar"``, ``"fujiwara-kawase"``, ``"iso-16281"``, ``"table"``), a profile such
        as `LogarithmicProfile`, or rows of (x, drop) [m].
    cross_section : str, optional
        ``"circle"``, or ``"parabola"``: y²/(2R), the one of Hertz's theory, without outline.
    **arguments
        Those of the named profile, such as ``amplitude=`` or ``end_drop=``.

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, the profile is not known or does not fit
        the roller, or an argument is missing or not the profile's.

    Notes
    -----
    With the drop d(x) of the profile the radius is R(x) = R - d(x), and the gap is
    R - sqrt(R(x)² - y²). It is computed as the sum of two drops, d(x) and that of the section,
    R(x) - sqrt(R(x)² - y²), each without cancellation; it ends where the profile or the section
    does. A parabolic section adds y²/(2R) everywhere.

    With ``crown_radius`` this is eq. 13 of Spinu & Cerlinca (2018).

    Examples
    --------
    >>> roller = Roller(radius=5.0, half_length=10.0, crown_radius=13.0)
    >>> roller.gap([0.0, 0.0, 15.0], [0.0, 3.0, 0.0]).tolist()
    [0.0, 1.0, 1.0]
    >>> bearing = Roller(5e-3, 6e-3, profile="iso-16281")
    >>> round(1e6 * float(bearing.gap(5e-3, 0.0)), 3), bearing.end
    (4.15, 0.006)
    """

    radius: float = field(metadata={"unit": "m"})
    half_length: float = field(metadata={"unit": "m"})
    crown_radius: float | None = field(metadata={"unit": "m"})
    profile: Profile | None
    cross_section: CrossSection

    def __init__(
        self,
        radius: float,
        half_length: float,
        crown_radius: float | None = None,
        profile: Profile | str | ArrayLike | None = None,
        *,
        cross_section: CrossSection = "circle",
        **arguments: Any,
    ) -> None:
        # Written out, so that a profile may be named, with arguments of its own.
        values: dict[str, Any] = {
            "radius": positive("Roller: radius", radius, "m"),
            "half_length": positive("Roller: half_length", half_length, "m"),
            "crown_radius": crown_radius
            if crown_radius is None
            else positive("Roller: crown_radius", crown_radius, "m"),
        }
        made = _profile(profile, values, arguments)
        if made is not None:
            made.require_fit(values["half_length"])
            values["crown_radius"] = None
        for name, value in values.items():
            object.__setattr__(self, name, value)
        object.__setattr__(self, "profile", made)
        object.__setattr__(self, "cross_section", _known_section(cross_section))

    @property
    def line(self) -> Profile:
        """The generating line, whichever way it was given."""
        if self.profile is not None:
            return self.profile
        return PartialCrown(self.crown_radius) if self.crown_radius else CylindricalProfile()

    @property
    def end(self) -> float:
        """Distance from the middle where the profile or the section ends on the axis [m]."""
        end = self.line.end(self.half_length)
        # A line that falls without end does so there.
        if self.cross_section == "parabola" or self.drop((1 - 1e-9) * end) <= self.radius:
            return end
        inside, outside = 0.0, end
        while (middle := (inside + outside) / 2) not in (inside, outside):
            ended = self.drop(middle) > self.radius
            inside, outside = (inside, middle) if ended else (middle, outside)
        return inside

    @property
    def total_length(self) -> float:
        """Length from end to end [m]; inf where a crown continues until the section ends.

        Examples
        --------
        >>> Roller(5e-3, 6e-3).total_length, Roller(5e-3, 6e-3, crown_radius=1.0).total_length
        (0.012, inf)
        """
        end = self.line.end(self.half_length)
        return 2 * end if self.end == end else math.inf

    def drop(self, x: ArrayLike) -> Floats:
        """Return how far the generating line has receded, +inf beyond its end [m]."""
        return self.line.drop(x, self.half_length)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return R - sqrt(R(x)² - y²), +inf outside the roller; see `Indenter.gap`."""
        x, y = positions(x, y)
        drop = self.drop(x)
        if self.cross_section == "parabola":
            return np.asarray(drop + y * y / (2 * self.radius))
        return drop + arc_drop(np.abs(y), self.radius - drop)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvature of the profile in the middle, zero on a straight part, and 1/R across [1/m]."""
        return self.line.curvature(self.half_length), 1 / self.radius


def _profile(given: object, lengths: dict[str, Any], arguments: dict[str, Any]) -> Profile | None:
    """The given profile, None where the roller's own arguments determine it."""
    if not isinstance(given, str) and arguments:
        raise TypeError(
            f"Roller got an unexpected argument {next(iter(arguments))!r}; arguments of a profile "
            "go with its name, as in profile='logarithmic', amplitude=1e-6"
        )
    if given is None:
        return None
    if isinstance(given, str):
        return _of_name(given, lengths, arguments)
    if lengths["crown_radius"] is not None:
        raise ValueError(
            "Roller: crown_radius and a profile exclude each other; the crown is a profile itself"
        )
    return given if isinstance(given, Profile) else profile_from_table(given)


def _of_name(name: str, lengths: dict[str, Any], arguments: dict[str, Any]) -> Profile | None:
    profile = named_profile(name, lengths, arguments)
    if lengths["crown_radius"] is not None and not hasattr(profile, "crown_radius"):
        raise ValueError(f"Roller: crown_radius means nothing with the profile {name!r}")
    # What the roller's own arguments say as well is kept as they do.
    if profile == CylindricalProfile():
        return None
    if isinstance(profile, PartialCrown) and profile == PartialCrown(lengths["crown_radius"] or 1):
        return None
    return profile


def _known_section(given: object) -> str:
    if given not in CROSS_SECTIONS:
        raise ValueError(
            f"Roller: cross_section must be {' or '.join(map(repr, CROSS_SECTIONS))}, got {given!r}"
        )
    return str(given)
