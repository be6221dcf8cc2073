"""Crossings of the rim with the lines between cell centres."""

from __future__ import annotations

from functools import lru_cache
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.straight_edge import EdgeLaw, edge_laws

#: Open cells beside the contact from which its rim is extrapolated.
MARGIN = 3

#: Cells in contact behind the first one from which pressures locate the rim.
LEAST_CHORD = 4

#: Lines of cells around a block, outside the body: two cells are read beyond an open one.
PADDING = 2

#: Least descent of a chord from line to line, in cells.
LEAST_DESCENT = 1e-6


class Recession(NamedTuple):
    """Where a contact on a creeping body recedes: gaps open beside it, and pressures fall within.

    There the surface that it leaves is almost closed, so that its gap does not show the rim. Where
    the contact grows over such a surface, the gap does, and the pressure less well. Until the
    contact has left a cell, both show the rim too far outside: the gap the more so, the pressure
    the less so, the further the contact has receded.
    """

    pressure: Floats  # [Pa]
    falls: Bools
    opens: Bools
    left: Bools  # cells that have been in contact

    def within(self, block: Any) -> Recession:
        """Return the part of a block of cells."""
        return Recession(*(field[block] for field in self))


class RimFields(NamedTuple):
    """Fields of a block of cells around a contact from which its rim is located."""

    contact: Bools
    gap: Floats  # [m]
    recession: Recession | None
    ends: tuple[Floats, Floats] | None  # distances to the body's outline along x and y, in cells


@dataclass(frozen=True, eq=False)
class _Intervals:
    """Intervals between neighbouring centres in which contact changes, along x, then along y."""

    count_along_x: int
    start: Integers  # cell before the interval
    inner: Integers  # cell in contact
    outwards: Integers  # step to the open cell
    across: Integers  # step to the next line

    @property
    def outer(self) -> Integers:
        """Open cells."""
        return self.inner + self.outwards

    def some(self, chosen: Integers) -> _Intervals:
        """Some of the intervals, in their order."""
        each = (cells[chosen] for cells in (self.start, self.inner, self.outwards, self.across))
        return _Intervals(int(np.searchsorted(chosen, self.count_along_x)), *each)


def locate_rim(grid: Grid, fields: RimFields) -> tuple[Floats, Floats]:
    """Distances from inner centres to the rim along x, shape (nx - 1, ny), and y, in cells."""
    contact, gap, recession, ends = fields
    laws = [_laws(grid.cell_size, side, periodic=all(grid.periodic)) for side in (0, 1)]
    intervals = _changes(contact)
    touches, gaps = _pad(contact, outside=False).ravel(), _pad(gap, outside=np.inf)
    located, slope = _by_gaps(laws[0], intervals, touches, gaps.ravel())
    if recession is not None:
        at, *by_pressures = _where_receding(laws[1], intervals, recession, located)
        located[at], slope[at] = by_pressures
    at_end = np.flatnonzero(np.isinf(gaps.ravel()[intervals.outer]))
    if ends is not None and at_end.size:
        located[at_end] = _body_ends(ends, intervals.some(at_end), gaps.shape[1])
    found = np.full((2, gaps.size), np.nan)
    # A line that the rim crosses at a small angle does not locate it well.
    oblique = np.abs(slope) > 1
    _write_intervals(found, intervals, np.where(oblique, np.nan, located))
    chosen = np.flatnonzero(oblique)
    if chosen.size:
        lines = intervals.some(chosen)
        chords = _by_chords(found, lines, touches, slope[chosen] > 0)
        _write_intervals(found, lines, np.where(np.isnan(chords), located[chosen], chords))
    inside = slice(PADDING, -PADDING)
    along_x, along_y = found.reshape(2, *gaps.shape)[:, inside, inside]
    return along_x[:-1], along_y[:, :-1]


@lru_cache(maxsize=64)
def compiled_laws(dx: float, dy: float, core: ModuleType, *, periodic: bool) -> tuple[Any, ...]:
    """Laws of the gaps along x and y, and of the pressures, for the compiled core."""
    laws = (law for side in (0, 1) for law in _laws((dx, dy), side, periodic=periodic))
    return tuple(core.EdgeLaw(law.threshold, law.growth, law.slopes, law.offsets) for law in laws)


def places(where: Bools) -> tuple[Integers, Integers]:
    """Rows and columns of the true entries; `np.nonzero` takes eight times as long."""
    return np.divmod(np.flatnonzero(where), where.shape[1])


def _pad(field: Numbers, outside: float) -> Numbers:
    """Field of a block with a value around it; `np.pad` takes several times as long."""
    padded = np.full([count + 2 * PADDING for count in field.shape], outside, field.dtype)
    padded[PADDING:-PADDING, PADDING:-PADDING] = field
    return padded


def _write_intervals(fields: Floats, intervals: _Intervals, values: Floats) -> None:
    """Write values of intervals to the fields along x and along y."""
    split = intervals.count_along_x
    fields[0, intervals.start[:split]] = values[:split]
    fields[1, intervals.start[split:]] = values[split:]


def _changes(contact: Bools) -> _Intervals:
    """Intervals in which contact changes."""
    rows, columns = zip(
        places(contact[1:] != contact[:-1]), places(contact[:, 1:] != contact[:, :-1]), strict=True
    )
    row, column = np.concatenate(rows), np.concatenate(columns)
    count_along_x, width = len(rows[0]), contact.shape[1] + 2 * PADDING
    start = (row + PADDING) * width + (column + PADDING)
    step = np.ones(len(start), np.intp)
    step[:count_along_x] = width
    begins_inside = contact[row, column]
    inner = start + np.where(begins_inside, 0, step)
    outwards = np.where(begins_inside, step, -step)
    return _Intervals(count_along_x, start, inner, outwards, width + 1 - step)


def _laws(cell_size: tuple[float, float], side: int, *, periodic: bool) -> tuple[EdgeLaw, EdgeLaw]:
    """Laws of the gaps (side 0) or the pressures (side 1) on lines along x and along y."""
    # Ratios that differ by rounding share a law.
    dx, dy = cell_size
    ratios = (round(ratio, 6 if ratio > 1e-3 else 15) for ratio in (dy / dx, dx / dy))
    along_x, along_y = (edge_laws(each, periodic=periodic)[side] for each in ratios)
    return along_x, along_y


def _by_gaps(
    laws: tuple[EdgeLaw, EdgeLaw], intervals: _Intervals, contact: Bools, gap: Floats
) -> tuple[Floats, Floats]:
    """Distances from the inner centres by the gaps further out, and slopes of the rim."""
    # The middle, if the second gap is not wider (a groove of one cell, the body's end).
    outer, outwards = intervals.outer, intervals.outwards
    second = outer + outwards
    near, far, farther = np.maximum(gap[outer], 0.0), gap[second], gap[second + outwards]
    known = np.isfinite(far) & (far > near) & ~contact[second]
    near, far = np.where(known, near, 0.0), np.where(known, far, 1.0)
    # Unknown where the body or the grid ends; less than the second in a groove of two cells.
    farther = np.where(np.isfinite(farther), farther, np.nan)
    # gap^(2/3) on the lines beside, where neither body nor block ends there.
    behind, before = gap[second + intervals.across], gap[second - intervals.across]
    both = known & np.isfinite(behind) & np.isfinite(before)
    gaps = np.array([np.where(both, behind, 0.0), np.where(both, before, 0.0), far, near])
    # Of ratios, so that no unit of length changes the rounding.
    slope = _slope(np.cbrt(np.square(gaps / far)))
    distance = _distance(laws, intervals, (near, far, farther), slope)
    return np.where(known, np.maximum(1 - distance, -0.5), 0.5), slope


def _where_receding(
    laws: tuple[EdgeLaw, EdgeLaw], intervals: _Intervals, recession: Recession, by_gaps: Floats
) -> tuple[Integers, Floats, Floats]:
    """Intervals where the pressure locates a receding rim, distances by it and slopes there."""
    pressure, falls, opens, left = (_pad(each, outside=0).ravel() for each in recession)
    at = np.flatnonzero(opens[intervals.outer] & falls[intervals.inner])
    distance, slope = _by_pressures(laws, intervals.some(at), pressure)
    known = left[(intervals.outer + intervals.outwards)[at]] | (distance < by_gaps[at])
    known &= ~np.isnan(distance)
    return at[known], distance[known], slope[known]


def _by_pressures(
    laws: tuple[EdgeLaw, EdgeLaw], intervals: _Intervals, pressure: Floats
) -> tuple[Floats, Floats]:
    """Distances from the inner centres by the pressures further in, NaN if unknown, and slopes."""
    inner, inwards = intervals.inner, -intervals.outwards
    second = inner + inwards
    near, far, farther = pressure[inner], pressure[second], pressure[second + inwards]
    # A few cells between two rims do not tell them apart.
    beyond = np.take(pressure, inner + LEAST_CHORD * inwards, mode="clip")
    known = (near > 0) & (far > near) & (farther > 0) & (beyond > 0)
    near, far = np.where(known, near, 0.0), np.where(known, far, 1.0)
    # Squares of pressures, also on the lines beside.
    behind, before = pressure[second + intervals.across], pressure[second - intervals.across]
    slope = -_slope(np.square(np.array([behind, before, far, near]) / far))
    distance = _distance(laws, intervals, (near, far, farther), slope)
    return np.where(known, np.minimum(distance, 1.5), np.nan), slope


def _slope(values: Floats) -> Floats:
    """Slope of the rim by values behind, before, far and near, linear in the distance from it."""
    behind, before, far, near = values
    return np.asarray((behind - before) / (2 * (far - near)))


def _distance(
    laws: tuple[EdgeLaw, EdgeLaw],
    intervals: _Intervals,
    values: tuple[Floats, Floats, Floats],
    slope: Floats,
) -> Floats:
    """Distances of the rim from the first of three centres on lines across it, in cells."""
    split = intervals.count_along_x
    parts = [
        law.distance(*(each[part] for each in values)) - law.offset(slope[part])
        for law, part in zip(laws, (slice(split), slice(split, None)), strict=True)
    ]
    return np.concatenate(parts)


def _body_ends(ends: tuple[Floats, Floats], intervals: _Intervals, width: int) -> Floats:
    """Distances to the body's outline, the middle where it is not known."""
    row, column = (each - PADDING for each in np.divmod(intervals.start, width))
    split = intervals.count_along_x
    along_x, along_y = ends
    found = np.concatenate(
        [along_x[row[:split], column[:split]], along_y[row[split:], column[split:]]]
    )
    return np.where(np.isnan(found), 0.5, found)


def _by_chords(fields: Floats, intervals: _Intervals, contact: Bools, opens: Bools) -> Floats:
    """Distances of chords between the nearest crossings along the other axis, NaN without both."""
    # The gap increases towards the next line where it `opens`, else towards the line before.
    across, inner, outer = intervals.across, intervals.inner, intervals.outer
    up = np.where(opens, across, -across)
    crossed = contact[inner - up] & contact[outer - up] & ~contact[inner + up]
    crossed &= ~contact[outer + up]
    # From the line of centres up to the chord at the inner cell, down to it at the outer one.
    split = intervals.count_along_x
    height, depth = (
        np.concatenate([fields[1, cell[:split]], fields[0, cell[split:]]])
        for cell in (np.where(opens, inner, inner - across), np.where(opens, outer - across, outer))
    )
    descent = height + 1 - depth
    descent = np.where(np.abs(descent) < LEAST_DESCENT, LEAST_DESCENT, descent)
    return np.where(crossed, height / descent, np.nan)
