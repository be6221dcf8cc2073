"""Extent of a contact by the crossings of its rim: area, length, width."""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import ModuleType
from typing import NamedTuple

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.team import Team
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.rim_crossings import (
    RimFields,
    compiled_laws,
    locate_rim,
    places,
)

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


def mean_chords(contact: Bools, *, periodic: Sequence[bool] = (False, False)) -> Floats:
    """Mean numbers of consecutive cells in contact along x and y, also across a period's border."""
    begun = []
    for lines, repeats in zip((contact, contact.T), periodic, strict=True):
        first = lines[0] > lines[-1] if repeats else lines[0]
        begun.append(np.count_nonzero(first) + np.count_nonzero(lines[1:] > lines[:-1]))
    return np.asarray(np.count_nonzero(contact) / np.maximum(begun, 1))


def segment_of(contact: Bools, gap: Floats, team: Team) -> float:
    """Area between the rim of a contact that no period continues and its chords [cells]."""
    if team.core is not None:
        of = SEGMENTS, SEGMENT_LOSS, LEAST_SEGMENTS
        return float(team.core.segment(contact, gap, of))
    return segment_by_chords(mean_chords(contact), contact, gap)


def segment_by_chords(chords: Floats, contact: Bools, gap: Floats) -> float:
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


def extent_of(
    grid: Grid,
    fields: RimFields,
    inner: tuple[slice, slice],
    segment: float,
    team: Team,
    mirrored: tuple[bool, bool] = (False, False),
) -> Extent:
    """Extent of a contact in an inner block, by the crossings of its rim."""
    if team.core is not None:
        return _compiled_extent(grid, fields, inner, segment, team.core, mirrored)
    along_x, along_y = locate_rim(grid, fields)
    crossings, contact = (along_x[inner], along_y[inner]), fields.contact[inner]
    rows, columns = (np.flatnonzero(contact.any(axis=axis)) for axis in (1, 0))
    extents = (
        _along_first(rows, contact, crossings[0]),
        _along_first(columns, contact.T, crossings[1].T),
    )
    squares = _enclosed_squares(contact, crossings, segment)
    return Extent(segment, squares, *extents, len(rows), len(columns))


def _compiled_extent(
    grid: Grid,
    fields: RimFields,
    inner: tuple[slice, slice],
    segment: float,
    core: ModuleType,
    mirrored: tuple[bool, bool],
) -> Extent:
    """The same by the compiled core."""
    contact, gap, recession, ends = fields
    laws = compiled_laws(*grid.cell_size, core, periodic=all(grid.periodic))
    receding = None if recession is None else tuple(recession)
    outline = None
    if ends is not None:
        outline = np.ascontiguousarray(ends[0]), np.ascontiguousarray(ends[1])
    (first_row, last_row, _), (first_column, last_column, _) = (
        lines.indices(count) for lines, count in zip(inner, contact.shape, strict=True)
    )
    block = first_row, last_row, first_column, last_column
    others = receding, outline, mirrored, block, segment
    return Extent(segment, *core.trace_rim(contact, gap, *laws, *others))


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
