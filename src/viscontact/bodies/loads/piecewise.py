"""Piecewise linear load histories with jumps."""

from __future__ import annotations

import itertools
from abc import abstractmethod
from bisect import bisect_left, bisect_right
from dataclasses import fields
from functools import cached_property
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import history_points
from viscontact.bodies.loads.history import Cycle, LoadHistory, LoadInstant, LoadPoint
from viscontact.units.numbers import finite

#: Deviation from a straight line, over the largest value, that is rounding.
ROUNDING = 4 * float(np.finfo(np.float64).eps)


@dataclass(frozen=True, eq=False, init=False)
class PiecewiseHistory(LoadHistory):
    """A history by points; a time given twice is a jump, from the first value to the second."""

    times: Floats

    def at(self, time: float, *, side: str = "right") -> LoadPoint:
        """Return the prescribed load at an instant.

        Parameters
        ----------
        time : float
            The instant [s].
        side : {"right", "left"}
            Which value to take at a jump: the one just after it or the one just before.

        Returns
        -------
        LoadPoint
            Force or approach, eccentricities and tilts; before the first point the force is 0 and
            eccentricities and tilts have their first values.

        Raises
        ------
        ValueError
            If the time is not a finite number, or the side is neither of the two.

        Examples
        --------
        >>> from viscontact.bodies.loads import ApproachHistory, ForceHistory
        >>> point = ForceHistory([0, 2], [0, 10], eccentricity_x=0.003).at(1.0)
        >>> point.force, point.eccentricity_x, point.tilt_x
        (5.0, 0.003, None)
        >>> ApproachHistory([0, 2], [0, 1e-5]).at(1.0).approach
        5e-06
        """
        instant = finite("time", time, "s")
        at = history_points.side_of_jump(side)
        return self._held if instant > self._instants[-1] else self._point(instant, at)

    @cached_property
    def _held(self) -> LoadPoint:
        """Load after the last point."""
        return self._point(self._instants[-1], "right")

    def _point(self, instant: float, side: str) -> LoadPoint:
        """Load at an instant [s]."""
        values: dict[str, Any] = {"force": None, self.control: self._level(instant, side)}
        for name in history_points.TAIL:
            of = getattr(self, name)
            values[name] = None if of is None else self._value_at(of, instant, side)
        return LoadPoint(**values)

    @abstractmethod
    def _level(self, time: float, side: str) -> float:
        """Force [N] or approach [m] at one instant [s], as of `level_at`, which takes longer."""

    @cached_property
    def kinks(self) -> Floats:
        """Kinks and jumps, the first and last instant [s]; not points on a straight line."""
        instants = np.unique(self.times)
        straight = np.zeros(len(instants), dtype=bool)
        straight[1:-1] = True
        names = [name for name in history_points.TAIL if getattr(self, name) is not None]
        for values in (getattr(self, name) for name in (self.control, *names)):
            straight[1:-1] &= self._is_straight(values, instants)
        return instants[~straight]

    def _is_straight(self, values: float | Floats, instants: Floats) -> Bools:
        """True at inner instants whose values lie between their neighbours', up to rounding."""
        before, after = (self._interpolate(values, instants, side) for side in ("left", "right"))
        begin, middle, end = instants[:-2], instants[1:-1], instants[2:]
        part = (middle - begin) / (end - begin)
        line = after[:-2] + part * (before[2:] - after[:-2])
        off = np.maximum(np.abs(before[1:-1] - line), np.abs(after[1:-1] - line))
        return np.asarray(off <= ROUNDING * np.abs(values).max(initial=0.0))

    @cached_property
    def jumps(self) -> Floats:
        """Instants where, under load, force, approach, eccentricity or tilt jumps [s].

        A history that starts with a force has its first jump there.
        """
        kinks = self.kinks
        before, after = self.level_at(kinks, side="left"), self.level_at(kinks)
        changed = before != after
        for name in history_points.TAIL:
            of = getattr(self, name)
            if of is not None:
                left, right = (self._interpolate(of, kinks, side) for side in ("left", "right"))
                changed |= left != right
        loaded = self._loaded_at(kinks, "left") | self._loaded_at(kinks, "right")
        return np.asarray(kinks[changed & loaded])

    def _loaded_at(self, times: Floats, side: str) -> Bools:
        """True where contact is possible: under a force, or with an approach above 0 or a tilt."""
        level = self.level_at(times, side=side)
        if self.control == "force":
            return np.asarray(level != 0)
        tilts = [
            of for of in (getattr(self, name) for name in history_points.TILTS) if of is not None
        ]
        tilted = [self._interpolate(of, times, side) != 0 for of in tilts]
        return np.asarray(np.logical_or.reduce([level > 0, *tilted]))

    @cached_property
    def load_cycles(self) -> tuple[Cycle, ...]:
        """From valley to valley of one level: a first rise begins them, a fall ends each."""
        valleys = self._valleys()
        same = 1e-9 * max(self.largest_level, 0.0)
        return tuple(
            (begin, end)
            for (low, begin), (back, end) in itertools.pairwise(valleys)
            if abs(back - low) <= same
        )

    def _valleys(self) -> list[tuple[float, LoadInstant]]:
        """Levels and instants of the first rise's begin and of the end of each fall."""
        plateaus = self._plateaus()
        levels = [level for level, _, _ in plateaus]
        rises = [k for k in range(len(levels) - 1) if levels[k + 1] > levels[k]]
        if not rises:
            return []
        begins = set(rises)
        falls = [
            (level, first)
            for k, (level, first, _) in enumerate(plateaus)
            if k > rises[0] and level < levels[k - 1] and (k + 1 == len(levels) or k in begins)
        ]
        return [(levels[rises[0]], plateaus[rises[0]][2]), *falls]

    def _plateaus(self) -> list[tuple[float, LoadInstant, LoadInstant]]:
        """Successive different levels at the points, each with its first and last instant."""
        plateaus: list[tuple[float, LoadInstant, LoadInstant]] = []
        # However far a stage is withdrawn, apart is apart.
        levels = [np.maximum(self.level_at(self.kinks, side=s), 0.0) for s in ("left", "right")]
        for time, *both in zip(self.kinks.tolist(), *(of.tolist() for of in levels), strict=True):
            for level, side in zip(both, ("left", "right"), strict=True):
                moment = (time, side)
                if plateaus and plateaus[-1][0] == level:
                    plateaus[-1] = (level, plateaus[-1][1], moment)
                else:
                    plateaus.append((level, moment, moment))
        return plateaus

    def _interpolate(self, values: float | Floats, times: Floats, side: str) -> Floats:
        """Values at `times`, held before the first and after the last point."""
        if isinstance(values, float):
            return np.full(times.shape, values)
        if times.ndim == 0:
            return np.asarray(self._value_at(values, float(times), side))
        reached = np.searchsorted(self.times, times, side=history_points.side_of_jump(side))
        i, j = np.maximum(reached - 1, 0), np.minimum(reached, self.times.size - 1)
        span = self.times[j] - self.times[i]
        part = np.divide(times - self.times[i], span, out=np.zeros(times.shape), where=span > 0)
        # Counted from the nearer point, so that either point's value comes out exactly.
        first_half = part < 0.5
        nearer, offset = np.where(first_half, i, j), np.where(first_half, part, part - 1)
        return np.asarray(values[nearer] + (values[j] - values[i]) * offset)

    def _value_at(self, values: float | Floats, time: float, side: str) -> float:
        """A value at one time, as of `_interpolate`, in plain numbers."""
        if isinstance(values, float):
            return values
        reached = self._reached(time, side)
        i, j = max(reached - 1, 0), min(reached, self.times.size - 1)
        begin, end = self._instants[i], self._instants[j]
        part = (time - begin) / (end - begin) if end > begin else 0.0
        first, last = float(values[i]), float(values[j])
        nearer, offset = (first, part) if part < 0.5 else (last, part - 1)
        return nearer + (last - first) * offset

    def _reached(self, time: float, side: str) -> int:
        """Number of points up to a time, those of a jump at it by its side."""
        right = history_points.side_of_jump(side) == "right"
        return (bisect_right if right else bisect_left)(self._instants, time)

    @cached_property
    def _instants(self) -> list[float]:
        found: list[float] = self.times.tolist()
        return found

    def _begun(self, times: Floats, side: str) -> Bools:
        if times.ndim == 0:
            return np.asarray(self._reached(float(times), side) > 0)
        return np.asarray(
            np.searchsorted(self.times, times, side=history_points.side_of_jump(side)) > 0
        )

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in fields(self)]
        return all(np.array_equal(getattr(self, n), getattr(other, n)) for n in names)

    def __hash__(self) -> int:
        return hash((type(self).__name__, self.times.size, float(self.times[-1])))
