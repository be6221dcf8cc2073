"""Motion of the base of a cantilever: its corners, its phases, and the part that is fitted."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass

_STRAIGHT = 3e-3  # of the extent: a phase deviates less from a straight line
_RETRACTED = 0.2  # of the rise: a smaller fall is no retraction
_FALLEN = 0.25  # of the rise, or fall, next to the hold that is looked at for its end
_NODES, _FEWEST, _MOST = 180, 12, 80  # of a march: in all, and in a phase


@dataclass(frozen=True, eq=False)
class Stroke:
    """Position [m] over times [s], in rows."""

    times: Floats
    position: Floats

    @cached_property
    def corners(self) -> Integers:
        """Rows at which the rate changes, with the first and the last one (Douglas, Peucker)."""
        allowed = _STRAIGHT * float(np.ptp(self.position))
        kept, spans = {0, self.times.size - 1}, [(0, self.times.size - 1)]
        while spans:
            begin, end = spans.pop()
            if end - begin < 2:
                continue
            rows = np.arange(begin + 1, end)
            line = np.interp(
                self.times[rows], self.times[[begin, end]], self.position[[begin, end]]
            )
            away = np.abs(self.position[rows] - line)
            farthest = int(np.argmax(away))
            if away[farthest] > allowed:
                kept.add(int(rows[farthest]))
                spans += [(begin, int(rows[farthest])), (int(rows[farthest]), end)]
        return np.array(sorted(kept))

    @cached_property
    def rates(self) -> Floats:
        """Rate of each row, constant within a phase [m/s]."""
        rates = np.zeros(self.times.size)
        for begin, end in zip(self.corners[:-1], self.corners[1:], strict=True):
            duration = self.times[end] - self.times[begin]
            if duration > 0:
                way = self.position[end] - self.position[begin]
                rates[begin : end + 1] = way / duration
        return rates

    @cached_property
    def hold_end(self) -> int:
        """Row at which the retraction begins; the last one if there is none."""
        peak = self._peak
        after = self.position[peak : self._end_of_first]
        fall = self.position[peak] - after.min()
        if fall < _RETRACTED * np.ptp(self.position[: peak + 1]):
            return self._end_of_first - 1
        fallen = int(np.argmax(after < self.position[peak] - _FALLEN * fall))
        return self._farthest_above(peak, peak + fallen, peak)

    @cached_property
    def loading_end(self) -> int:
        """Row at which the approach ends."""
        # A hold may rise, where a force is kept, or fall, where the indentation is.
        peak = self._peak
        start, top = self.position[0], self.position[peak]
        risen = int(np.argmax(self.position >= top - _FALLEN * (top - start)))
        return self._farthest_above(risen, self.hold_end, min(peak, self.hold_end))

    def _farthest_above(self, begin: int, end: int, otherwise: int) -> int:
        """Row farthest above the chord between two rows; another one if none is far above."""
        if end - begin < 2:
            return otherwise
        ends = [begin, end]
        chord = np.interp(self.times[begin:end], self.times[ends], self.position[ends])
        above = self.position[begin:end] - chord
        farthest = int(np.argmax(above))
        extent = float(np.ptp(self.position))
        return begin + farthest if above[farthest] > _STRAIGHT * extent else otherwise

    @cached_property
    def second_approach(self) -> int | None:
        """Row of the turn from retraction to a second approach; None if there is none."""
        extent = float(np.ptp(self.position))
        fallen = np.maximum.accumulate(self.position) - self.position > _RETRACTED * extent
        if not fallen.any():
            return None
        begin = int(np.argmax(fallen))
        after = self.position[begin:]
        again = np.flatnonzero(after - np.minimum.accumulate(after) > _RETRACTED * extent)
        return begin + int(np.argmin(after[: again[0] + 1])) if again.size else None

    @property
    def _end_of_first(self) -> int:
        """Number of rows up to a second approach."""
        return self.times.size if self.second_approach is None else self.second_approach + 1

    @cached_property
    def _peak(self) -> int:
        """Row of the largest position of the first approach."""
        return int(np.argmax(self.position[: self._end_of_first]))

    def touch(self, contact: float) -> float:
        """Instant at which the position first exceeds the contact point; inf if never [s]."""
        beyond = self.position > contact
        if not beyond.any():
            return float("inf")
        row = int(np.argmax(beyond))
        return self._crossing(row - 1, row, contact) if row else float(self.times[0])

    def nodes(self, contact: float, finer: int = 1) -> Floats:
        """Instants of a march from first contact until the base is back there, or the end [s]."""
        begin, end = self.touch(contact), float(self.times[-1])
        back = np.flatnonzero(self.position[self.hold_end :] <= contact)
        if back.size:
            row = self.hold_end + int(back[0])
            end = self._crossing(row - 1, row, contact)
        least = 1e-6 * (end - begin)
        inside = self.times[self.corners]
        inside = inside[(inside > begin + least) & (inside < end - least)]
        ends = np.concatenate([[begin], inside, [end]])
        ends = ends[np.append(True, np.diff(ends) > least)]
        count = finer * int(np.clip(_NODES // max(ends.size - 1, 1), _FEWEST, _MOST))
        x = np.arange(1, count + 1) / count
        placed = x * x * (3 - 2 * x)  # close to corners, where bending changes fast
        between = ends[:-1, None] + np.diff(ends)[:, None] * placed
        return np.append(begin, between.ravel())

    def at(self, times: Floats) -> Floats:
        """Position at instants [m]."""
        return np.interp(times, self.times, self.position)

    def _crossing(self, before: int, after: int, level: float) -> float:
        low, high = self.position[before], self.position[after]
        share = (level - low) / (high - low) if high != low else 1.0
        return float(self.times[before] + share * (self.times[after] - self.times[before]))
