"""A flat-ended punch, round or rectangular."""

from __future__ import annotations

from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import positions
from viscontact.units.numbers import check_fields


@dataclass(frozen=True)
class FlatPunch(Indenter):
    """A punch with a flat end and a sharp edge: round, or rectangular.

    Parameters
    ----------
    radius : float, optional
        Radius of a round punch [m].
    half_length, half_width : float, optional
        Half the edges of a rectangular punch along x and along y [m].

    Raises
    ------
    ValueError
        If neither or both shapes are described, half of a rectangle is missing, or a length
        is not a positive, finite number.

    Examples
    --------
    >>> FlatPunch(radius=0.01).gap([0.0, 0.009, 0.011], 0.0).tolist()
    [0.0, 0.0, inf]
    >>> FlatPunch(half_length=0.02, half_width=0.01).gap(0.015, [0.0, 0.015]).tolist()
    [0.0, inf]
    """

    radius: float | None = field(default=None, metadata={"unit": "m"})
    half_length: float | None = field(default=None, kw_only=True, metadata={"unit": "m"})
    half_width: float | None = field(default=None, kw_only=True, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        rectangle = (self.half_length is not None, self.half_width is not None)
        is_round = self.radius is not None and not any(rectangle)
        is_rectangular = self.radius is None and all(rectangle)
        if not (is_round or is_rectangular):
            raise ValueError(
                "FlatPunch: give either radius= (a round punch), or half_length= and "
                f"half_width= (a rectangular one), got radius={self.radius!r}, "
                f"half_length={self.half_length!r}, half_width={self.half_width!r}"
            )
        check_fields(self, "radius", "half_length", "half_width")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return zero on the punch, edge included, and +inf outside; see `Indenter.gap`."""
        return np.where(self._covers(*positions(x, y)), 0.0, np.inf)

    def _covers(self, x: ArrayLike, y: ArrayLike) -> Bools:
        if self.half_length is None or self.half_width is None:
            return np.asarray(np.hypot(x, y) <= self.radius)
        return np.asarray((np.abs(x) <= self.half_length) & (np.abs(y) <= self.half_width))
