"""Roller profile through measured or designed points."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.point_line import Interpolation, TableLine, mirrored, numbers
from viscontact.bodies.indenters.profile import Profile
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array


@dataclass(frozen=True, init=False)
class TabulatedProfile(Profile):
    """A generating line through points.

    The roller's half length is where it ends, at the last point or before.

    Parameters
    ----------
    x : array_like
        Positions along the roller, from its middle, increasing [m]. If none is negative they are
        one half of a symmetric profile, from the middle on. A point given twice is a kink.
    drops : array_like
        Depth of the line below any level; the highest point on the roller becomes zero [m].
    interpolation : str, optional
        ``"smooth"`` (cubics without overshoot; the slope is continuous but at kinks) or
        ``"linear"``. At every kink the contact's pressure has a peak that depends on the mesh.

    Raises
    ------
    ValueError
        If the points are no line, or a half does not begin in the middle.

    Examples
    --------
    >>> line = TabulatedProfile(x=[0, 4e-3, 5e-3], drops=[0, 0, 10e-6], interpolation="linear")
    >>> (1e6 * line.drop([-4.5e-3, 2e-3, 6e-3], half_length=5e-3)).round(9).tolist()
    [5.0, 0.0, inf]
    """

    x: tuple[float, ...] = field(metadata={"unit": "m"})
    drops: tuple[float, ...] = field(metadata={"unit": "m"})
    interpolation: Interpolation = "smooth"

    def __init__(
        self, x: ArrayLike, drops: ArrayLike, interpolation: Interpolation = "smooth"
    ) -> None:
        # Written out, so that arrays are accepted and comparable numbers are stored.
        object.__setattr__(self, "x", numbers("TabulatedProfile: x", x))
        object.__setattr__(self, "drops", numbers("TabulatedProfile: drops", drops))
        object.__setattr__(self, "interpolation", interpolation)
        if self.x and self.x[0] > 0:
            raise ValueError(
                "TabulatedProfile: x must begin with 0 (half a symmetric profile) or below it "
                f"(the whole), got {format_quantity(self.x[0], 'm', 9)} first"
            )
        # Checked now and as given, not when first used and mirrored.
        TableLine("TabulatedProfile", self.x, self.drops, interpolation)

    @property
    def _is_half(self) -> bool:
        return self.x[:1] == (0.0,)

    @cached_property
    def _line(self) -> TableLine:
        x, drops = self.x, self.drops
        if self._is_half:
            x, drops = mirrored(x, drops)
        return TableLine("TabulatedProfile", x, drops, self.interpolation)

    def drop(self, x: ArrayLike, half_length: float) -> Floats:
        """Return the drop below the highest point; see `Profile.drop`."""
        x = real_array("x", x, "m")
        left, right = self._ends(half_length)
        # The mirrored half gives the same bits.
        drop = self._line(np.abs(x) if self._is_half else x) - self._line.lowest(left, right)
        return np.where((x >= left) & (x <= right), np.maximum(drop, 0.0), np.inf)

    def end(self, half_length: float) -> float:
        """Return the half length, or where the points end before [m]."""
        left, right = self._ends(half_length)
        return max(-left, right)

    def require_fit(self, half_length: float) -> None:
        """Raise ValueError if the points end before the roller does."""
        for reach in (-self._line.position[0], self._line.position[-1]):
            if reach < half_length * (1 - 1e-9):
                raise ValueError(
                    f"TabulatedProfile: x ends at {format_quantity(reach, 'm', 9)} from the "
                    f"middle, before the half length of {format_quantity(half_length, 'm', 9)}; "
                    "give points up to there, or a shorter roller"
                )

    def _ends(self, half_length: float) -> tuple[float, float]:
        first, last = self._line.position[0], self._line.position[-1]
        return max(first, -half_length), min(last, half_length)
