"""Crossings of the rim with the lines between cell centres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.straight_edge import edge_law
from viscontact.grid import Grid

Array = NDArray[np.float64]

#: Rows and columns of some cells, or steps between cells, shape (2, count).
Cells = NDArray[np.intp]

#: Open cells beside the contact from which its rim is extrapolated.
MARGIN = 3

#: Least descent of a chord from line to line, in cells.
LEAST_DESCENT = 1e-6


@dataclass(frozen=True, eq=False)
class _Intervals:
    """Intervals between neighbouring centres in which contact changes, along x, then along y."""

    axis: NDArray[np.intp]
    start: Cells  # cell before the interval
    inner: Cells  # cell in contact
    outer: Cells  # open cell

    @property
    def across(self) -> Cells:
        """Step to the next line."""
        return np.array([self.axis, 1 - self.axis])

    def some(self, chosen: NDArray[np.intp]) -> _Intervals:
        """Some of the intervals."""
        each = (cells[:, chosen] for cells in (self.start, self.inner, self.outer))
        return _Intervals(self.axis[chosen], *each)


def locate_rim(
    grid: Grid, contact: NDArray[np.bool_], gap: Array, ends: tuple[Array, Array] | None
) -> tuple[Array, Array]:
    """Distances from the inner centres, in cells, where contact changes along x and along y.

    `ends` are the distances to the body's outline; NaN, or none at all, is the middle.
    """
    intervals = _changes(contact)
    located, slope = _by_gaps(grid, intervals, contact, gap)
    at_end = np.flatnonzero(np.isinf(gap[*intervals.outer]))
    if ends is not None and at_end.size:
        located[at_end] = _body_ends(ends, intervals.some(at_end))
    fields = np.full((2, *contact.shape), np.nan)
    # A line that the rim crosses at a small angle does not locate it well.
    oblique = np.abs(slope) > 1
    fields[intervals.axis, *intervals.start] = np.where(oblique, np.nan, located)
    chosen = np.flatnonzero(oblique)
    if chosen.size:
        lines = intervals.some(chosen)
        chords = _by_chords(fields, lines, contact, slope[chosen] > 0)
        found = np.where(np.isnan(chords), located[chosen], chords)
        fields[lines.axis, *lines.start] = found
    return fields[0, :-1], fields[1, :, :-1]


def places(where: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns of the true entries; `np.nonzero` takes eight times as long."""
    return np.divmod(np.flatnonzero(where), where.shape[1])


def _changes(contact: NDArray[np.bool_]) -> _Intervals:
    """Intervals in which contact changes."""
    along_x = places(contact[1:] != contact[:-1])
    along_y = places(contact[:, 1:] != contact[:, :-1])
    axis = np.repeat([0, 1], [len(along_x[0]), len(along_y[0])])
    start = np.concatenate([along_x, along_y], axis=1)
    end = start + np.array([1 - axis, axis])
    inside = contact[*start]
    return _Intervals(axis, start, np.where(inside, start, end), np.where(inside, end, start))


def _by_gaps(
    grid: Grid, intervals: _Intervals, contact: NDArray[np.bool_], gap: Array
) -> tuple[Array, Array]:
    """Distances from the inner centres by the gaps further out, and slopes of the rim.

    The middle, if the second gap is not wider (a groove of one cell, the body's end).
    """
    outwards = intervals.outer - intervals.inner
    second, third = (_within(contact, intervals.outer + k * outwards) for k in (1, 2))
    near, far, farther = np.maximum(gap[*intervals.outer], 0.0), gap[*second], gap[*third]
    known = np.isfinite(far) & (far > near) & ~contact[*second]
    near, far = np.where(known, near, 0.0), np.where(known, far, 1.0)
    # Unknown where the body or the grid ends; less than the second in a groove of two cells.
    clear = np.isfinite(farther) & (third != second).any(axis=0)
    # gap^(2/3) on the lines beside, where the body does not end there.
    behind, before = (gap[*_within(gap, second + by * intervals.across)] for by in (1, -1))
    both = known & np.isfinite(behind) & np.isfinite(before)
    gaps = np.array([np.where(both, behind, 0.0), np.where(both, before, 0.0), far, near])
    # Of ratios, so that no unit of length changes the rounding.
    behind, before, rise, base = np.cbrt(np.square(gaps / far))
    slope = (behind - before) / (2 * (rise - base))
    # Ratios that differ by rounding share a law.
    dx, dy = grid.cell_size
    laws = [edge_law(round(ratio, 6), periodic=all(grid.periodic)) for ratio in (dy / dx, dx / dy)]
    offset = np.where(intervals.axis == 0, laws[0].offset(slope), laws[1].offset(slope))
    distance = laws[0].distance(near, far, np.where(clear, farther, np.nan)) - offset
    return np.where(known, np.maximum(1 - distance, -0.5), 0.5), slope


def _body_ends(ends: tuple[Array, Array], intervals: _Intervals) -> Array:
    """Distances to the body's outline, the middle where it is not known."""
    found = np.full(len(intervals.axis), 0.5)
    for axis in (0, 1):
        along = np.flatnonzero(intervals.axis == axis)
        found[along] = ends[axis][*intervals.start[:, along]]
    return np.where(np.isnan(found), 0.5, found)


def _by_chords(
    fields: Array, intervals: _Intervals, contact: NDArray[np.bool_], opens: NDArray[np.bool_]
) -> Array:
    """Distances of chords between the nearest crossings along the other axis, NaN without both.

    The gap increases towards the next line where it `opens`, else towards the line before.
    """
    across, inner, outer = intervals.across, intervals.inner, intervals.outer
    up = np.where(opens, across, -across)
    is_open = [~contact[*_within(contact, cell + up)] for cell in (inner, outer)]
    is_closed = [contact[*_within(contact, cell - up)] for cell in (inner, outer)]
    crossed = is_open[0] & is_open[1] & is_closed[0] & is_closed[1]
    # From the line of centres up to the chord at the inner cell, down to it at the outer one.
    height, depth = (
        fields[1 - intervals.axis, *_within(contact, np.where(side, cell, cell - across))]
        for cell, side in ((inner, opens), (outer, ~opens))
    )
    descent = height + 1 - depth
    descent = np.where(np.abs(descent) < LEAST_DESCENT, LEAST_DESCENT, descent)
    return np.where(crossed, height / descent, np.nan)


def _within(field: NDArray[Any], cells: Cells) -> Cells:
    """The cells of a field that are nearest to given places."""
    last = np.array(field.shape)[:, None] - 1
    return np.asarray(np.minimum(np.maximum(cells, 0), last))
