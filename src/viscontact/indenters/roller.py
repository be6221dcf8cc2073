"""A roller lying along x: straight, with sharp ends or with a crown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.indenters.arc import arc_drop
from viscontact.indenters.indenter import Indenter
from viscontact.indenters.lengths import positions, positive_length

NAMED_PROFILES = ("cylindrical", "full", "partial", "logarithmic", "chamfer")


@dataclass(frozen=True)
class Roller(Indenter):
    """A roller lying along x, with a straight part in the middle.

    Parameters
    ----------
    radius : float
        Radius R of the straight part [m].
    half_length : float
        Half the length L of the straight part, |x| <= L [m].
    crown_radius : float, optional
        Radius R_c of the circular profile that continues the straight part at either end,
        tangent to it, until the crown or the section ends [m]. Without it the roller ends
        sharply at |x| = L.
    profile : None
        Named profiles and tables of (x, drop) are not built yet.

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, or a profile is asked for.

    Notes
    -----
    The gap is R - sqrt(R(x)² - y²) with R(x) = R for |x| <= L and
    R(x) = R - R_c + sqrt(R_c² - (|x| - L)²) beyond. It is computed as the sum of two drops
    of an arc, that of the crown, R - R(x), and that of the section, R(x) - sqrt(R(x)² - y²),
    each without cancellation.

    Examples
    --------
    >>> roller = Roller(radius=5.0, half_length=10.0, crown_radius=13.0)
    >>> roller.gap([0.0, 0.0, 15.0], [0.0, 3.0, 0.0]).tolist()
    [0.0, 1.0, 1.0]
    """

    radius: float
    half_length: float
    crown_radius: float | None = None
    profile: None = None

    def __post_init__(self) -> None:
        if self.profile is not None:
            raise ValueError(_refusal(self.profile))
        for name in ("radius", "half_length", "crown_radius"):
            value = getattr(self, name)
            if name == "crown_radius" and value is None:
                continue
            object.__setattr__(self, name, positive_length(f"Roller: {name}", value))

    def gap(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Return R - sqrt(R(x)² - y²), +inf outside the roller; see `Indenter.gap`."""
        x, y = positions(x, y)
        crown_drop = self._crown_drop(x)
        section_radius = self.radius - crown_drop
        return crown_drop + arc_drop(np.abs(y), section_radius)

    def _crown_drop(self, x: ArrayLike) -> NDArray[np.float64]:
        """R - R(x): how far the generating line has receded [m]."""
        beyond = np.maximum(np.abs(x) - self.half_length, 0.0)
        if self.crown_radius is None:
            return np.where(beyond > 0, np.inf, 0.0)
        return arc_drop(beyond, self.crown_radius)

    @property
    def curvatures(self) -> tuple[float, float]:
        """No curvature along the straight part, 1/R across it [1/m]."""
        return 0.0, 1 / self.radius


def _refusal(profile: object) -> str:
    remedy = (
        "use crown_radius= for a circular crown tangent to the straight part, or leave both "
        "out for sharp ends"
    )
    if not isinstance(profile, str):
        return f"roller profile as a table is not built yet, got {profile!r:.60}; {remedy}"
    if profile not in NAMED_PROFILES:
        names = ", ".join(map(repr, NAMED_PROFILES))
        return (
            f"roller profile {profile!r} is unknown; the names are {names}, none of them built "
            f"yet; {remedy}"
        )
    return f"roller profile {profile!r} is not built yet; {remedy}"
