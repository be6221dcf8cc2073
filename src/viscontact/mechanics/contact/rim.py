"""Rim of a contact, located between cell centres.

An area by counting cells is a jagged function of time. Just outside a smooth rim the gap opens as
distance^(3/2), whatever the law and whether the contact grows or shrinks; on cells it opens in a
way that `straight_edge` computes. The first open cells of a grid line locate the rim. Polygons
through these crossings enclose the contact. Where the body ends in that cell, the rim is its
outline.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.body_edge import Outline
from viscontact.mechanics.contact.rim_crossings import MARGIN, Recession, locate_rim, places

#: Area between a curved rim and the chords through its crossings, in cells per quarter turn. A
#: chord of a row is dy/cos φ long, with the direction φ of its normal, where the rim crosses rows
#: rather than columns; chords of length c lose c²/12 dφ, in a whole turn 8 dx dy/12.
SEGMENTS = 1 / 6

#: Error of crossings by the gap around few cells, as a part of these segments over the mean chord
#: in cells, and the least part that is left of them: balls and spots of rough surfaces.
SEGMENT_LOSS, LEAST_SEGMENTS = 2.1, 0.1


class Extent(NamedTuple):
    """Extent of a contact, and the lines of cells that it touches."""

    segment: float  # area between the rim and its chords per quarter turn [cells]
    squares: float  # area between the crossings, in squares between four neighbouring centres
    along_x: float  # [cells]
    along_y: float
    rows: int
    columns: int


@dataclass(frozen=True, eq=False)
class Rim:
    """Cells in contact, and crossings of the rim with the lines between cell centres."""

    # The fields cover a block around the contact. Along a periodic axis it may cross the border;
    # where the contact does so all around, the block ends with the row that it begins with.

    grid: Grid
    contact: Bools  # cells under pressure in the block
    #: Distance from the inner centre, in cells, as in `Outline`; negative where that centre lies
    #: just outside, and of any size on a chord that crosses the line outside the cells.
    along_x: Floats
    along_y: Floats
    rows: Integers  # position of the block in the grid
    columns: Integers
    extent: Extent

    @property
    def area(self) -> float:
        """Area enclosed by the polygons through the crossings [m²]."""
        return self.grid.cell_area * self.extent.squares

    @cached_property
    def length(self) -> float:
        """Extent of the contact along x, at most a period where that is finite [m]."""
        if len(self.rows) > self.grid.shape[0]:
            return self.grid.size[0]
        return min(self.extent.along_x * self.grid.cell_size[0], self.grid.size[0])

    @cached_property
    def width(self) -> float:
        """Extent of the contact along y, at most a period where that is finite [m]."""
        if len(self.columns) > self.grid.shape[1]:
            return self.grid.size[1]
        return min(self.extent.along_y * self.grid.cell_size[1], self.grid.size[1])

    @cached_property
    def breadth(self) -> float:
        """Shorter extent; one through a whole period does not count if there is another [m]."""
        extents = (self.length, self.width)
        ended = [own for own, whole in zip(extents, self.grid.size, strict=True) if own < whole]
        return min(ended or extents)

    @property
    def cells_across(self) -> int:
        """Rows or columns of cells that have contact, the fewer of the two."""
        # An axis along which the contact continues through the whole period does not count; without
        # any other, it is the number of cells of the grid.
        lines, counts = (self.rows, self.columns), self.grid.shape
        touched = self.extent.rows, self.extent.columns
        ends = [k for k in (0, 1) if len(lines[k]) <= counts[k]]
        return min(touched[k] for k in ends) if ends else max(counts)

    def cut(self, field: Numbers) -> Numbers:
        """The block's part of a field on the grid."""
        if any(self.grid.periodic):
            return field[np.ix_(self.rows, self.columns)]
        both = (self.rows, self.columns)
        rows, columns = (slice(int(lines[0]), int(lines[-1]) + 1) for lines in both)
        return field[rows, columns]


def mean_chords(contact: Bools, *, periodic: Sequence[bool] = (False, False)) -> Floats:
    """Mean numbers of consecutive cells in contact along x and y, also across a period's border."""
    begun = []
    for lines, repeats in zip((contact, contact.T), periodic, strict=True):
        first = lines[0] > lines[-1] if repeats else lines[0]
        begun.append(np.count_nonzero(first) + np.count_nonzero(lines[1:] > lines[:-1]))
    return np.asarray(np.count_nonzero(contact) / np.maximum(begun, 1))


def trace_rim(
    grid: Grid,
    contact: Bools,
    gap: Floats,
    outline: Outline | None = None,
    recession: Recession | None = None,
    team: Team | None = None,
    mirrored: tuple[bool, bool] = (False, False),
) -> Rim:
    """Locate the rim of a contact between cell centres; the area is of second order.

    The gap is +inf outside the body [m]; where the body ends, the rim is its outline, or the
    middle. The square root of the pressure inside a smooth rim belongs to an opening of
    distance^(3/2) outside (Johnson 1985, eq. 5.9), on cells to that of `EdgeLaw`, for any creep
    law. Where the contact recedes, the pressure locates the rim. A `team` has the compiled passes,
    which work on one half of a contact that is `mirrored` along an axis.
    """
    team = team or Team()
    if any(grid.periodic):
        return _trace_around(grid, contact, gap, outline, recession, team)
    spans = team.spans(contact) or (slice(-1, -1),) * 2
    rows, columns = _with_open_lines(spans[0]), _with_open_lines(spans[1])
    contact, gap = contact[rows, columns], gap[rows, columns]
    recession = None if recession is None else recession.within((rows, columns))
    ends = None
    if outline is not None and np.isinf(gap).any():
        end_x = outline.along_x[rows, columns][: len(contact) - 1]
        ends = end_x, outline.along_y[rows, columns][:, : contact.shape[1] - 1]
    along_x, along_y = locate_rim(grid, contact, gap, recession, ends, team, mirrored)
    first, second = (
        np.arange(block.start, block.start + count)
        for block, count in zip((rows, columns), contact.shape, strict=True)
    )
    if team.core is not None:
        segment = team.core.segment(contact, gap, (SEGMENTS, SEGMENT_LOSS, LEAST_SEGMENTS))
    else:
        segment = _segment_of(mean_chords(contact), contact, gap)
    extent = _extent_of(contact, (along_x, along_y), segment, team)
    return Rim(grid, contact, along_x, along_y, first, second, extent)


def _with_open_lines(span: slice) -> slice:
    """A contact's span along an axis, and the open cells on both sides; some without contact."""
    if span.stop < 0:
        return slice(0, 2)
    return slice(max(span.start - MARGIN, 0), span.stop + MARGIN)


def _trace_around(
    grid: Grid,
    contact: Bools,
    gap: Floats,
    outline: Outline | None,
    recession: Recession | None,
    team: Team,
) -> Rim:
    """Trace the rim of a contact that continues across the border of its period."""
    segment = _segment_of(mean_chords(contact, periodic=grid.periodic), contact, gap)
    (rows, wide_rows, inner_rows), (columns, wide_columns, inner_columns) = (
        _lines_around(contact, axis, repeats=grid.periodic[axis]) for axis in (0, 1)
    )
    wide = np.ix_(wide_rows, wide_columns)
    contact, gap = contact[wide], gap[wide]
    recession = None if recession is None else recession.within(wide)
    ends = None
    if outline is not None:
        # A body that reaches the border ends there, in the middle between two centres.
        end_x = np.pad(outline.along_x, ((0, 1), (0, 0)), constant_values=np.nan)[wide][:-1]
        end_y = np.pad(outline.along_y, ((0, 0), (0, 1)), constant_values=np.nan)[wide][:, :-1]
        ends = end_x, end_y
    inner = inner_rows, inner_columns
    along_x, along_y = locate_rim(grid, contact, gap, recession, ends, team)
    crossings = along_x[inner], along_y[inner]
    extent = _extent_of(contact[inner], crossings, segment, team)
    return Rim(grid, contact[inner], *crossings, rows, columns, extent)


def _lines_around(contact: Bools, axis: int, *, repeats: bool) -> tuple[Integers, Integers, slice]:
    """Lines of the block, more of a period from which its rim is extrapolated, and its place."""
    if not repeats:
        touched = np.flatnonzero(contact.any(axis=1 - axis))
        span = slice(int(touched[0]), int(touched[-1]) + 1) if touched.size else slice(-1, -1)
        lines = np.arange(contact.shape[axis])[_with_open_lines(span)]
        return lines, lines, slice(None)
    lines = _turn(contact, axis)
    return lines, _with_margin(lines, contact.shape[axis]), slice(MARGIN, -MARGIN)


def _turn(contact: Bools, axis: int) -> Integers:
    """Lines of a contact, and an open one on both sides unless it fills the period."""
    touched = np.flatnonzero(contact.any(axis=1 - axis))
    count = contact.shape[axis]
    if len(touched) == 0:
        return np.zeros(2, dtype=np.intp) if count == 1 else np.arange(2)
    if len(touched) == count:
        return np.append(np.arange(count), 0)
    # The contact begins behind the widest opening.
    begins = np.diff(touched, prepend=touched[-1] - count).argmax()
    extent = (int(touched[begins - 1]) - int(touched[begins])) % count
    return np.asarray((np.arange(-1, extent + 2) + touched[begins]) % count)


def _with_margin(lines: Integers, count: int) -> Integers:
    """Given lines, and more before and behind them."""
    return np.asarray((np.arange(-MARGIN, len(lines) + MARGIN) + lines[0]) % count)


def _segment_of(chords: Floats, contact: Bools, gap: Floats) -> float:
    """Area between the rim and its chords per quarter turn, less the error of the crossings."""
    along_x, along_y = chords.tolist()
    if not along_x:
        return SEGMENTS
    by_gap, beyond = 1.0, np.isinf(gap)
    if beyond.any():
        # Crossings at the body's outline have no such error.
        lines = (contact, beyond), (contact.T, beyond.T)
        pairs = [pair for c, b in lines for pair in ((c[1:], b[:-1]), (c[:-1], b[1:]))]
        at_end = sum(np.count_nonzero(inner & outer) for inner, outer in pairs)
        all_ends = 2 * np.count_nonzero(contact) * (1 / along_x + 1 / along_y)
        by_gap = max(1 - at_end / all_ends, 0.0)
    loss = SEGMENT_LOSS / max(math.sqrt(along_x * along_y), 1.0)
    return SEGMENTS * (1 - by_gap * min(loss, 1 - LEAST_SEGMENTS))


def _extent_of(
    contact: Bools, crossings: tuple[Floats, Floats], segment: float, team: Team
) -> Extent:
    """Extent of a contact by the crossings of its rim along x and y."""
    if team.core is not None:
        return Extent(segment, *team.core.measure_rim(contact, *crossings, segment))
    rows, columns = (np.flatnonzero(contact.any(axis=axis)) for axis in (1, 0))
    along_x = _along_first(rows, contact, crossings[0])
    along_y = _along_first(columns, contact.T, crossings[1].T)
    squares = _enclosed_squares(contact, crossings, segment)
    return Extent(segment, squares, along_x, along_y, len(rows), len(columns))


def _enclosed_squares(inside: Bools, crossings: tuple[Floats, Floats], segment: float) -> float:
    """Squares between four neighbouring centres, each counted by its enclosed part."""
    pairs = inside[1:].view(np.int8) + inside[:-1].view(np.int8)
    count = pairs[:, 1:] + pairs[:, :-1]
    i, j = places((count & 3) != 0)  # neither none nor all four
    along_x, along_y = crossings
    edges = np.array([along_x[i, j], along_x[i, j + 1], along_y[i, j], along_y[i + 1, j]])
    edges[np.isnan(edges)] = 0.0  # no crossing
    u, v = edges[0] + edges[1], edges[2] + edges[3]
    # One corner inside: a triangle. Two neighbours: a trapezium between the crossings of the two
    # edges that leave their side. Three: the square without a triangle. Signed areas where a
    # crossing lies beyond the square: their sum is that of the polygons.
    corners = count[i, j]
    triangle, rest = u * v / 2 + segment, 1 - (1 - u) * (1 - v) / 2 - segment
    enclosed = np.choose(corners - 1, [triangle, (u + v) / 2, rest])
    # Opposite corners inside: two separate triangles.
    first = inside[i, j]
    apart = np.flatnonzero((corners == 2) & (first == inside[i + 1, j + 1]))
    if apart.size:
        left, right, lower, upper = edges[:, apart]
        ends = np.where(first[apart], left * lower + right * upper, left * upper + right * lower)
        enclosed[apart] = ends / 2 + 2 * segment
    return float(np.count_nonzero(count == 4) + enclosed.sum())


def _along_first(touched: Integers, contact: Bools, crossings: Floats) -> float:
    """Extent along the first axis, in cells: the farthest crossings both ways of touched rows."""
    if not touched.size:
        return 0.0
    # A crossing lies between half a cell inside and one outside of its inner centre: two rows
    # contain the extreme ones. A chord may cross its line elsewhere.
    (from_first, first), (from_last, last) = (
        (max(int(row) - 1, 0), min(int(row) + 1, len(crossings))) for row in touched[[0, -1]]
    )
    near, far = (
        np.where(np.abs(each) <= 1, each, np.nan)
        for each in (crossings[from_first:first], crossings[from_last:last])
    )
    starts = np.arange(from_first, first)[:, None] + 1 - near
    ends = np.arange(from_last, last)[:, None] + far
    upper, lower = contact[from_last:last], contact[from_first + 1 : first + 1]
    end = np.fmax.reduce(ends[upper], initial=0.0)
    return float(end - np.fmin.reduce(starts[lower], initial=len(contact) - 1.0))
