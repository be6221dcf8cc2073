"""Rows of cells of a half-space that ends, with what its free ends add to them."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.ended_response import EndedLayers, EndedResponse
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.layered_influence import (
    periodic_layered_coefficient,
    periodic_layered_table,
)
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, moving_influence_table
from viscontact.mechanics.halfspace.periodic_influence import smooth_periodic_table
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE

if TYPE_CHECKING:
    from viscontact.mechanics.halfspace.end_correction import EndBasis
    from viscontact.mechanics.halfspace.periodic_ends import PeriodicBasis


#: Most cells of a domain whose rows are kept beyond it.
KEPT_CELLS = 50_000


@dataclass(frozen=True, eq=False)
class EndedRows:
    """Rows of cells between planes across x, with what all blocks of them share."""

    borders: tuple[int | None, int | None]  # planes in rows from the first row of the domain
    coefficients: Floats  # [m], of the period of two lengths, or empty for one plane
    bases: tuple[EndBasis, ...]  # of the free ends, over the rows within the body
    first: int  # first row of the domain within the body
    #: Under a load that moves along y; coefficients are at signed offsets then, for one plane, too.
    moving: MovingCompliance | None = None
    repeats: bool = False  # the columns are a period along y
    periodic: tuple[PeriodicBasis, ...] = ()  # in place of `bases` then

    def mirrored_coefficients(
        self, shape: tuple[int, int], cell_size: tuple[float, float]
    ) -> Floats:
        """Coefficients of the mirrored half-space over a shape of cells with its image [m]."""
        rows, columns = shape
        if self.moving is not None:
            middle = self.coefficients.shape[1] // 2
            return self.coefficients[:rows, middle - columns + 1 : middle + columns]
        if self.repeats:
            return self.coefficients[:rows]
        if None not in self.borders:
            return self.coefficients[:, :columns]
        return influence_table(shape, cell_size)


def ended_rows(
    response: EndedResponse,
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    borders: tuple[int | None, int | None],
    moving: MovingCompliance | None = None,
    *,
    periodic: bool = False,
) -> EndedRows:
    """Rows of a domain of a shape that has all columns, with planes at borders of its rows.

    With `periodic`, the columns are a period along y.
    """
    few = moving is None and shape[0] * shape[1] <= KEPT_CELLS
    if periodic:
        return (_kept_period if few else _rows_of_period)(response, shape, cell_size, borders)
    return (_kept_rows if few else _rows)(response, shape, cell_size, borders, moving)


def _rows(
    response: EndedResponse,
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    borders: tuple[int | None, int | None],
    moving: MovingCompliance | None,
) -> EndedRows:
    """The same, computed."""
    before, after = borders
    begin = max(before or 0, 0)
    end = shape[0] if after is None else min(after, shape[0])
    width = shape[1] * cell_size[1]
    longest = 0.0
    if moving is not None:
        # Of material that returns, up to half of its way.
        reach = np.where(np.isinf(moving.periods), moving.lengths, moving.periods / 2)
        longest = float(reach.max(initial=0.0))
    shared = (cell_size, width, longest)
    bases = _bases_of_ends(response, range(begin, end), borders, *shared)
    stack = response.stack if isinstance(response, EndedLayers) else None
    if moving is not None:
        part = (end if after is None else after - (before or 0), shape[1])
        if stack is not None:
            table = _moving_table_of_layers(part, cell_size, moving, stack)
        else:
            table = _moving_table(part, cell_size, moving, periodic=None not in borders)
        return EndedRows(borders, table, bases, begin, moving)
    for basis in bases:
        basis.table(shape[1], cell_size[1])  # of all columns at once
    if before is None or after is None:
        return EndedRows(borders, np.empty((0, 0)), bases, begin)
    cells = 2 * (after - before), shape[1]
    # With the datum of a grid that is periodic.
    if stack is None:
        return EndedRows(borders, smooth_periodic_table(cells, cell_size, width), bases, begin)
    table = periodic_layered_table(cells, cell_size, stack, width)
    return EndedRows(borders, table, bases, begin)


def _rows_of_period(
    response: EndedResponse,
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    borders: tuple[int | None, int | None],
) -> EndedRows:
    """The same where the columns are a period along y."""
    before, after = borders
    begin = max(before or 0, 0)
    rows = range(begin, shape[0] if after is None else min(after, shape[0]))
    bases = halfspace.periodic_ends.bases_of_period(response, rows, borders, cell_size, shape[1])
    table = np.empty((0, 0))
    if before is None or after is None:
        count = shape[0] - (before or 0) if after is None else after - begin
        turned = (shape[1], 2 * count), cell_size[::-1]
        # Line loads displace nothing at the distance of the grid's length.
        datum = shape[0] * cell_size[0]
        table = periodic_layered_table(*turned, HALF_SPACE, datum).T
    return EndedRows(borders, table, (), begin, repeats=True, periodic=bases)


#: Kept rows of small grids: an automatic grid is found by several solutions on each of some grids.
_kept_rows = lru_cache(maxsize=8)(_rows)
_kept_period = lru_cache(maxsize=8)(_rows_of_period)


def _moving_table(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    moving: MovingCompliance,
    *,
    periodic: bool,
) -> Floats:
    """Coefficients of a load that moves along y, for rows from a plane on, or between two."""
    if not periodic:
        return moving_influence_table((2 * shape[0], shape[1]), cell_size, moving, 1)
    period, datum = 2 * shape[0] * cell_size[0], shape[1] * cell_size[1]

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        near = np.minimum(across, period - across)
        return halfspace.periodic_influence_coefficient(near, along, cell[::-1], period, datum)

    half = moving_influence_table((shape[0] + 1, shape[1]), cell_size, moving, 1, with_images)
    offsets = np.arange(2 * shape[0])
    return np.asarray(half[np.minimum(offsets, 2 * shape[0] - offsets)])


def _moving_table_of_layers(
    shape: tuple[int, int],
    cell_size: tuple[float, float],
    moving: MovingCompliance,
    stack: ElasticStack,
) -> Floats:
    """The same for layers, for rows between two planes."""
    count, datum = 2 * shape[0], shape[1] * cell_size[1]

    def with_images(along: Floats, across: Floats, cell: tuple[float, float]) -> Floats:
        places = np.abs(along[:, 0])
        return periodic_layered_coefficient(count, places, cell[::-1], stack, datum).T

    half = moving_influence_table((shape[0] + 1, shape[1]), cell_size, moving, 1, with_images)
    offsets = np.arange(count)
    return np.asarray(half[np.minimum(offsets, count - offsets)])


def _bases_of_ends(
    response: EndedResponse,
    rows: range,
    borders: tuple[int | None, int | None],
    cell_size: tuple[float, float],
    width: float,
    longest: float,
) -> tuple[EndBasis, ...]:
    """Low-rank forms of what the free ends add on rows of a domain."""
    before, after = borders
    ratio, free = response.poisson_ratio, response.free
    if not rows or not any(free):
        return ()
    if before is not None and after is not None:
        stack = response.stack if isinstance(response, EndedLayers) else None
        strip = halfspace.strip_basis.StripRows(after - before, free, response.even, stack)
        inside = range(rows.start - before, rows.stop - before)
        shared = (ratio, strip, inside, cell_size, width)
        return tuple(
            halfspace.strip_basis.strip_basis(*shared, odd=odd, longest=longest)
            for odd in strip.kinds
        )
    if before is not None:
        inside = range(rows.start - before, rows.stop - before)
        return (halfspace.end_basis(ratio, inside, cell_size, longest),)
    assert after is not None  # at least one plane is given
    inside = range(after - rows.stop, after - rows.start)
    return (halfspace.end_basis(ratio, inside, cell_size, longest).turned(),)
