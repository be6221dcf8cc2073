"""Displacement that cells of uniform pressure lack near by, against a pressure that varies in them.

From a distance cells act as the pressure does, by the carriers of its multipoles (`cell_series`).
Near by the difference is added, of the series, or of the patches of a cell where that is crossed by
an edge. It dies out over a few cells, so that all surfaces are half-spaces here.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

import numpy as np
import scipy

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.influence import influence_coefficient
from viscontact.mechanics.halfspace.polygon_influence import edge_integrals
from viscontact.runs.given_pressure.cell_series import (
    CARRIERS,
    MULTIPOLES,
    ORDERS,
    legendre_to,
    stencils,
)
from viscontact.runs.given_pressure.patches import Patches, rectangle_edges
from viscontact.runs.given_pressure.periodic_cells import as_samples, factor_of_cells

#: Longer edges of a cell to each side of it that are near to it, and those over which its patches
#: count one by one.
REACH, CLOSE = 8, 1

#: Parts along an axis of a cell in which the terms of a series are taken as linear.
PARTS = 32

#: Pressure of a carrier that is rounding.
NONE = 1e-12

#: Length over width of a cell of a strip, along which nothing varies.
LENGTH = 2000.0


@dataclass(frozen=True)
class NearField:
    """Cells around a cell of a grid, and what it does to them."""

    grid: Grid
    most: int = REACH  # longer edges of a cell that are near

    @property
    def varies(self) -> tuple[bool, bool]:
        """True along an axis, but for one along which a cell repeats: a strip."""
        along, across = (count > 1 for count in self.grid.shape)
        return along, across

    @cached_property
    def size(self) -> tuple[float, float]:
        """Edges of a cell; a strip is one of a great length [m]."""
        (along, across), (in_x, in_y) = self.grid.cell_size, self.varies
        if not in_x:
            return LENGTH * across, across
        return along, (across if in_y else LENGTH * along)

    @property
    def reach(self) -> tuple[int, int]:
        """Near cells on each side along x and y."""
        return self._cells_within(self.most)

    def _cells_within(self, edges: int) -> tuple[int, int]:
        """Cells along x and y within so many of their longer edges."""
        each = list(zip(self.grid.cell_size, self.varies, strict=True))
        longer = max((size for size, varies in each if varies), default=0.0)
        along, across = (math.ceil(edges * longer / size) if varies else 0 for size, varies in each)
        return along, across

    @property
    def padded(self) -> Grid:
        """The grid with room for the carriers of its outer cells."""
        (nx, ny), (along, across) = self.grid.shape, self._margin
        shape = nx + 2 * along, ny + 2 * across
        size = shape[0] * self.grid.cell_size[0], shape[1] * self.grid.cell_size[1]
        return replace(self.grid, shape=shape, size=size)

    @property
    def _margin(self) -> tuple[int, int]:
        along, across = (0 if periodic else CARRIERS for periodic in self.grid.periodic)
        return along, across

    def inner(self, field: Floats) -> Floats:
        """Values of the grid's own cells, of those of the padded one in the last dimensions."""
        (nx, ny), (along, across) = self.grid.shape, self._margin
        return np.asarray(field[..., along : along + nx, across : across + ny])

    def carriers(self, series: Floats) -> Floats:
        """Pressure of cells that acts as a series does from a distance, on the padded grid [Pa]."""
        margins = [(each, each) for each in self._margin]
        found = np.zeros(self.padded.shape)
        for stencil, field in zip(self._stencils, series, strict=False):
            if field.any():  # not those across a strip, along which nothing varies
                found += self._spread(np.pad(field, margins), stencil)
        return as_samples(found, self._factor) if all(self.grid.periodic) else found

    def _spread(self, field: Floats, table: Floats) -> Floats:
        """Sum of a table around each cell times the value of the cell."""
        beyond = [
            (n // 2, n // 2) if periodic else (0, 0)
            for n, periodic in zip(table.shape, self.grid.periodic, strict=True)
        ]
        found = scipy.ndimage.convolve(np.pad(field, beyond, mode="wrap"), table, mode="constant")
        (along, _), (across, _) = beyond
        (nx, ny) = field.shape
        return np.asarray(found[along : along + nx, across : across + ny])

    @cached_property
    def _factor(self) -> Floats:
        return factor_of_cells(self.grid)

    @cached_property
    def _stencils(self) -> Floats:
        return stencils()

    @cached_property
    def of_carriers(self) -> Floats:
        """Displacement of near cells by the carriers of each multipole, per 1/E* of 1 Pa [m]."""
        reach = np.array(self.reach)
        count = 2 * reach + 1
        x, y = (np.arange(-n, n + 1) * d for n, d in zip(reach + CARRIERS, self.size, strict=True))
        of_cell = influence_coefficient(x[:, None], y, self.size)
        found = np.zeros((len(MULTIPOLES), *count))
        for total, stencil in zip(found, self._stencils, strict=True):
            for i, j in np.argwhere(np.abs(stencil) > NONE):
                k, m = 2 * CARRIERS - i, 2 * CARRIERS - j
                total += stencil[i, j] * of_cell[k : k + count[0], m : m + count[1]]
        return found

    @cached_property
    def of_series(self) -> Floats:
        """Displacement that near cells lack by the terms of a series, per 1/E* of 1 Pa [m].

        Shape (orders, near cells along x, along y).
        """
        edges, terms = self._parts()
        along, across = self.reach
        found = np.zeros((len(ORDERS), 2 * along + 1, 2 * across + 1))
        for i, j in np.ndindex(along + 1, across + 1):
            each = edge_integrals(i * self.size[0], j * self.size[1], edges)
            for row, term, (a, b) in zip(found, terms, ORDERS, strict=True):
                value = float((term * each.reshape(3, -1, 4).sum(axis=2)).sum())
                for x, y in {(i, j), (-i, j), (i, -j), (-i, -j)}:
                    sign = (-1) ** (a * (x < 0) + b * (y < 0))
                    row[along + x, across + y] = sign * value
        found[: len(MULTIPOLES)] -= self.of_carriers
        return found

    def _parts(self) -> tuple[Floats, Floats]:
        """Edges of parts of a cell, and the terms of a series on them as linear pressures.

        The terms are uniform parts and slopes of each, shape (orders, 3, parts).
        """
        rows, places, halves = [], [], []
        nodes, weights = np.polynomial.legendre.leggauss(4)
        for size, reach in zip(self.size, self.reach, strict=True):
            count = PARTS if reach else 1
            place = (2 * np.arange(count) + 1.0) / count - 1
            inside = place[:, None] + nodes / count
            values = legendre_to(6, inside)
            slope = values @ (3 * nodes * weights / 2) * (2 * count / size)
            rows.append(np.array([values @ (weights / 2), slope]))  # shape (2, orders, parts)
            places.append(place * size / 2)
            halves.append(size / (2 * count))
        x, y = (each.ravel() for each in np.meshgrid(*places, indexing="ij"))
        terms = []
        for a, b in ORDERS:
            (mean_x, slope_x), (mean_y, slope_y) = rows[0][:, a], rows[1][:, b]
            mean = np.outer(mean_x, mean_y).ravel()
            along, across = np.outer(slope_x, mean_y).ravel(), np.outer(mean_x, slope_y).ravel()
            terms.append([mean - along * x - across * y, along, across])
        return rectangle_edges(x, y, np.tile(halves, (x.size, 1))), np.array(terms)

    def of_cells(self, series: Floats) -> Floats:
        """What series in the cells, (orders, nx, ny), add near by, per 1/E* [Pa m]; (nx, ny)."""
        found = np.zeros(self.grid.shape)
        for field, table in zip(series[1:], self.of_series[1:], strict=False):
            if field.any():
                found += self._spread(field, table)
        return found

    def of_patches(self, patches: Patches, cells: Bools) -> Floats:
        """What the patches of some cells add near by, per 1/E* [Pa m]; (nx, ny).

        Beyond the close cells the series over each cell takes their place.
        """
        x, y = np.nonzero(cells)
        series = patches.series(self.size, x.size, ORDERS)
        found = np.zeros(self.grid.shape)
        along, across = self.reach
        close = self._cells_within(CLOSE)
        for i, j in np.ndindex(2 * along + 1, 2 * across + 1):
            way = i - along, j - across
            if abs(way[0]) <= close[0] and abs(way[1]) <= close[1]:
                place = way[0] * self.size[0], way[1] * self.size[1]
                by_carriers = self.of_carriers[:, i, j] @ series[: len(MULTIPOLES)]
                each = patches.displacement(*place, x.size) - by_carriers
            else:
                each = self.of_series[:, i, j] @ series
            self._add(found, (x + way[0], y + way[1]), each)
        return found

    def _add(self, field: Floats, place: tuple[Integers, Integers], values: Floats) -> None:
        """Add values at cells, those beyond a border left out, or a period further."""
        kept = np.ones(values.size, dtype=bool)
        places = []
        for each, count, periodic in zip(place, self.grid.shape, self.grid.periodic, strict=True):
            places.append(each % count)
            kept &= periodic | ((each >= 0) & (each < count))
        np.add.at(field, (places[0][kept], places[1][kept]), values[kept])
