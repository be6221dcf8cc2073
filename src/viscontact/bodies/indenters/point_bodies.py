"""Bodies defined by points: bodies of revolution and prismatic bodies."""

from __future__ import annotations

from dataclasses import field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.point_line import Interpolation, TableLine, mirrored, numbers
from viscontact.bodies.indenters.position_checks import positions
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive


@dataclass(frozen=True, init=False)
class Revolved(Indenter):
    """A body of revolution about z, by points of its half section.

    Parameters
    ----------
    r : array_like
        Distances from the axis, increasing, not negative; a body that begins away from the axis
        is hollow. A point given twice is a kink, on the axis a tip [m].
    drops : array_like
        Depth of the surface below any level; its highest point becomes zero [m].
    interpolation : str, optional
        ``"smooth"`` (cubics without overshoot) or ``"linear"``.

    Raises
    ------
    ValueError
        If the points are no line, or a distance is negative.

    Examples
    --------
    >>> pin = Revolved(r=[0, 1e-3, 2e-3], drops=[0, 0, 1e-4], interpolation="linear")
    >>> (1e6 * pin.gap([0.0, 0.9e-3, 0.0, 3e-3], [0.0, 1.2e-3, 2e-3, 0.0])).round(9).tolist()
    [0.0, 50.0, 100.0, inf]
    """

    r: tuple[float, ...] = field(metadata={"unit": "m"})
    drops: tuple[float, ...] = field(metadata={"unit": "m"})
    interpolation: Interpolation

    def __init__(
        self, r: ArrayLike, drops: ArrayLike, interpolation: Interpolation = "smooth"
    ) -> None:
        # Written out, so that arrays are accepted and comparable numbers are stored.
        object.__setattr__(self, "r", numbers("Revolved: r", r))
        object.__setattr__(self, "drops", numbers("Revolved: drops", drops))
        object.__setattr__(self, "interpolation", interpolation)
        if self.r and self.r[0] < 0:
            raise ValueError(
                f"Revolved: r must not be negative, got {format_quantity(self.r[0], 'm', 9)} first"
            )
        TableLine("Revolved", self.r, self.drops, interpolation)

    @cached_property
    def _line(self) -> TableLine:
        r, drops = (self.r, self.drops) if self.r[0] > 0 else mirrored(self.r, self.drops)
        return TableLine("Revolved", r, drops, self.interpolation)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the drop at the distance from the axis; see `Indenter.gap`."""
        return np.maximum(self._line(np.hypot(*positions(x, y))) - min(self.drops), 0.0)


@dataclass(frozen=True, init=False)
class Swept(Indenter):
    """A section across, by points, drawn along x.

    Parameters
    ----------
    y : array_like
        Positions across, increasing; if none is negative they are one half of a symmetric
        section, from the middle on. A point given twice is a kink, in the middle a tip [m].
    drops : array_like
        Depth of the surface below any level; its highest point becomes zero [m].
    half_length : float, optional
        Distance of the sharp ends along x from the middle [m]; without end when left out.
    interpolation : str, optional
        ``"smooth"`` (cubics without overshoot) or ``"linear"``.

    Raises
    ------
    ValueError
        If the points are no line, a half does not begin in the middle, or the half length
        is not a positive finite number.

    Examples
    --------
    >>> rail = Swept(y=[0, 1.0, 3.0], drops=[0, 0, 2.0], half_length=5.0, interpolation="linear")
    >>> rail.gap([0.0, 4.0, 6.0], [0.5, -2.0, 0.0]).tolist()
    [0.0, 1.0, inf]
    """

    y: tuple[float, ...] = field(metadata={"unit": "m"})
    drops: tuple[float, ...] = field(metadata={"unit": "m"})
    half_length: float | None = field(metadata={"unit": "m"})
    interpolation: Interpolation

    def __init__(
        self,
        y: ArrayLike,
        drops: ArrayLike,
        half_length: float | None = None,
        interpolation: Interpolation = "smooth",
    ) -> None:
        # Written out, so that arrays are accepted and comparable numbers are stored.
        object.__setattr__(self, "y", numbers("Swept: y", y))
        object.__setattr__(self, "drops", numbers("Swept: drops", drops))
        length = None if half_length is None else positive("Swept: half_length", half_length, "m")
        object.__setattr__(self, "half_length", length)
        object.__setattr__(self, "interpolation", interpolation)
        if self.y and self.y[0] > 0:
            raise ValueError(
                "Swept: y must begin with 0 (half a symmetric section) or below it (the whole), "
                f"got {format_quantity(self.y[0], 'm', 9)} first"
            )
        TableLine("Swept", self.y, self.drops, interpolation)

    @cached_property
    def _line(self) -> TableLine:
        y, drops = (self.y, self.drops) if self.y[0] < 0 else mirrored(self.y, self.drops)
        return TableLine("Swept", y, drops, self.interpolation)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the drop of the section, +inf beyond the ends; see `Indenter.gap`."""
        x, y = positions(x, y)
        # The mirrored half gives the same bits.
        across = np.abs(y) if self.y[0] == 0 else y
        drop = np.maximum(self._line(across) - min(self.drops), 0.0)
        end = np.inf if self.half_length is None else self.half_length
        return np.where(np.abs(x) <= end, drop, np.inf)

    @property
    def endless(self) -> tuple[bool, bool]:
        """Along x if no half length is given."""
        return self.half_length is None, False
