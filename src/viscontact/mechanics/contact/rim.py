"""Rim of a contact, located between cell centres.

An area by counting cells is a jagged function of time. Just outside a smooth rim the gap opens as
distance^(3/2), whatever the law and whether the contact grows or shrinks; on cells it opens in a
way that `straight_edge` computes. The first open cells of a grid line locate the rim. Polygons
through these crossings enclose the contact. Where the body ends in that cell, the rim is its
outline.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.body_edge import Outline
from viscontact.mechanics.contact.rim_crossings import MARGIN, Recession, RimFields
from viscontact.mechanics.contact.rim_extent import (
    Extent,
    extent_of,
    mean_chords,
    segment_by_chords,
    segment_of,
)


@dataclass(frozen=True, eq=False)
class Rim:
    """Cells in contact, and their extent by the crossings of the rim between cell centres."""

    # The fields cover a block around the contact. Along a periodic axis it may cross the border;
    # where the contact does so all around, the block ends with the row that it begins with.

    grid: Grid
    contact: Bools  # cells under pressure in the block
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
    segment = segment_of(contact, gap, team)
    fields, whole = RimFields(contact, gap, recession, ends), (slice(None), slice(None))
    extent = extent_of(grid, fields, whole, segment, team, mirrored)
    first, second = (
        np.arange(block.start, block.start + count)
        for block, count in zip((rows, columns), contact.shape, strict=True)
    )
    return Rim(grid, contact, first, second, extent)


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
    segment = segment_by_chords(mean_chords(contact, periodic=grid.periodic), contact, gap)
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
    extent = extent_of(grid, RimFields(contact, gap, recession, ends), inner, segment, team)
    return Rim(grid, contact[inner], rows, columns, extent)


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
