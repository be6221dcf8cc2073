"""Curve through points: monotone cubics with kinks where given, or straight lines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import Literal, get_args

import numpy as np
import scipy
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array

#: Interpolation between points.
Interpolation = Literal["smooth", "linear"]
INTERPOLATIONS: tuple[Interpolation, ...] = get_args(Interpolation)

#: Largest length of a body [m]; a larger one has a wrong unit.
_LARGEST = 1e30


@dataclass(frozen=True)
class TableLine:
    """Curve through points (position, drop) [m], +inf outside them; `name` is for messages.

    Positions increase; one given twice, with the same drop, is a kink. ``"smooth"`` interpolation
    uses the monotone cubics of Fritsch & Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300-304:
    between two points they stay between their drops, so the lowest drop is at a point.
    ``"linear"`` is straight.
    """

    name: str
    position: tuple[float, ...]
    drop: tuple[float, ...]
    interpolation: Interpolation

    def __post_init__(self) -> None:
        if self.interpolation not in INTERPOLATIONS:
            raise ValueError(
                f"{self.name}: interpolation must be {' or '.join(map(repr, INTERPOLATIONS))}, "
                f"got {self.interpolation!r}"
            )
        if len(self.position) != len(self.drop):
            raise ValueError(
                f"{self.name}: there must be a drop at every position, got {len(self.drop)} drops "
                f"at {len(self.position)} positions"
            )
        self._require_line()

    def _require_line(self) -> None:
        steps = np.diff(self.position)
        for i in np.flatnonzero(steps <= 0).tolist():
            here, next_one = self.position[i], self.position[i + 1]
            if here > next_one:
                raise ValueError(
                    f"{self.name}: positions must increase, got {format_quantity(here, 'm', 9)} "
                    f"followed by {format_quantity(next_one, 'm', 9)} at point {i + 2}; sort the "
                    "points"
                )
            if self.drop[i] != self.drop[i + 1]:
                raise ValueError(
                    f"{self.name}: the drop jumps at {format_quantity(here, 'm', 9)}, from "
                    f"{format_quantity(self.drop[i], 'm', 9)} to "
                    f"{format_quantity(self.drop[i + 1], 'm', 9)}; give a steep piece in place of "
                    "a wall"
                )
        if np.count_nonzero(steps > 0) < 1:
            raise ValueError(f"{self.name}: a line needs at least two positions, got {len(self)}")

    def __len__(self) -> int:
        return len(self.position)

    @cached_property
    def _pieces(self) -> tuple[scipy.interpolate.PchipInterpolator, ...]:
        return tuple(scipy.interpolate.PchipInterpolator(*piece) for piece in self._smooth_pieces())

    def _smooth_pieces(self) -> Iterator[tuple[Floats, Floats]]:
        position, drop = np.array(self.position), np.array(self.drop)
        kinks = np.flatnonzero(np.diff(position) == 0) + 1
        for x, z in zip(np.split(position, kinks), np.split(drop, kinks), strict=True):
            if len(x) > 1:
                yield x, z

    def __call__(self, position: ArrayLike) -> Floats:
        """Return the drop at positions, +inf outside the points [m]."""
        x = real_array("position", position, "m")
        first, last = self.position[0], self.position[-1]
        within = (x >= first) & (x <= last)
        if self.interpolation == "linear":
            return np.where(within, np.interp(x, self.position, self.drop), np.inf)
        drop = np.full(x.shape, np.inf)
        for piece in self._pieces:
            here = (x >= piece.x[0]) & (x <= piece.x[-1])
            drop[here] = piece(x[here])
        return drop

    def lowest(self, start: float, stop: float) -> float:
        """Return the lowest drop between two positions [m]."""
        x = np.array(self.position)
        ends = self([start, stop])
        inner = np.array(self.drop)[(x >= start) & (x <= stop)]
        return float(min(ends.min(), inner.min(initial=math.inf)))


def mirrored(
    position: tuple[float, ...], drop: tuple[float, ...]
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Complete a symmetric curve given from position 0 on [m]; a 0 given twice is a tip."""
    left = tuple(-each for each in reversed(position[1:]))
    # A middle given once is not doubled, so there is no kink.
    start = 0 if position[1] > 0 else 1
    return (*left, *position[start:]), (*reversed(drop[1:]), *drop[start:])


def numbers(name: str, values: ArrayLike) -> tuple[float, ...]:
    """Return a one-dimensional column of finite lengths [m] as floats, or raise ValueError."""
    column = real_array(name, values, "m", 1)
    for i in np.flatnonzero(~(np.abs(column) <= _LARGEST))[:1]:
        raise ValueError(f"{name} must hold finite lengths in m, got {column[i]} at point {i + 1}")
    return tuple(column.tolist())
