"""Region of a grid that tractions act on, with its operators."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.transforms import Transforms
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.friction.problem import ShearBlock
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift
from viscontact.mechanics.halfspace.halved_shear import (
    halved_shear_convolution,
    halved_shear_preconditioner,
)
from viscontact.mechanics.halfspace.layered_shear import LayeredShear
from viscontact.mechanics.halfspace.layered_shear_influence import shear_correction
from viscontact.mechanics.halfspace.mirrored_shear import (
    Evenness,
    mirrored_shear_convolution,
    mirrored_shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_filter import (
    InPlane,
    PairFilter,
    Parts,
    periodic_shear_convolution,
    shear_convolution,
    shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_influence import ShearTables, shear_tables

#: Cells around a contact, and numbers of cells that extents are a multiple of, so that a contact
#: that grows slowly keeps its region.
MARGIN, MULTIPLE = 1, 8

#: Wave numbers between which the preconditioner of layers is interpolated.
TABLED_WAVES = 100

#: Growth of a region for which coefficients are computed in advance.
GROWTH = 1.25


@dataclass(frozen=True)
class Region:
    """Rows and columns of a grid."""

    rows: tuple[int, int]
    columns: tuple[int, int]

    @property
    def cut(self) -> tuple[slice, slice]:
        """Index of its part of a field."""
        return slice(*self.rows), slice(*self.columns)

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and columns."""
        return self.rows[1] - self.rows[0], self.columns[1] - self.columns[0]

    def within(self, larger: Region) -> tuple[slice, slice]:
        """Index of its part of a field of a larger region."""
        rows, columns = (
            slice(low - first, high - first)
            for (low, high), (first, _) in (
                (self.rows, larger.rows),
                (self.columns, larger.columns),
            )
        )
        return rows, columns


@dataclass(frozen=True)
class ShearSymmetry:
    """Symmetry of tractions across x = 0, y = 0 or both."""

    mirrored: tuple[bool, bool]  # True along x and along y where there is a mirror plane
    even: Evenness  # along x and y if the component x is even there; y is odd where it is even
    modes: tuple[bool, bool, bool]  # True for motions and resultants that are not zero

    @classmethod
    def of_load(cls, mode: int) -> ShearSymmetry:
        """Symmetry under one force, along x (0) or y (1), or a torque (2), of a pressure."""
        even, both = (mode != 1, mode == 0), (True, True)
        return cls(both, even, (mode == 0, mode == 1, mode == 2))

    @classmethod
    def of_pressure(cls, mirrored: tuple[bool, bool]) -> ShearSymmetry:
        """Symmetry of tractions that the pressure makes, and a force along a plane of it."""
        return cls(mirrored, (False, True), (not mirrored[0], not mirrored[1], False))

    @property
    def halved(self) -> int | None:
        """The only axis that is mirrored; None if both are."""
        return None if all(self.mirrored) else self.mirrored.index(True)

    def whole(self, shape: tuple[int, int]) -> tuple[int, int]:
        """Numbers of cells of a block, with their mirror images."""
        nx, ny = (count * (1 + twice) for count, twice in zip(shape, self.mirrored, strict=True))
        return nx, ny


class ShearDomain:
    """Half-spaces under shear on a grid, with operators on regions, which are kept.

    With a symmetry, regions are of the cells with positive coordinates along mirrored axes.
    """

    def __init__(
        self,
        grid: Grid,
        transforms: Transforms,
        symmetry: ShearSymmetry | None = None,
        layers: Sequence[LayeredShear] = (),
        *,
        shapes: int = 1,
    ) -> None:
        self._shapes = shapes  # of regions whose parts are kept
        self.grid, self._transforms, self._symmetry = grid, transforms, symmetry
        self._layers = tuple(layers)
        self._parts: dict[tuple[int, int], Parts] = {}
        self._table: ShearTables | None = None
        self._blocks: dict[tuple[Any, ...], ShearBlock] = {}
        self._axis = 0.0, 0.0  # of rotations [m]

    def move_axis(self, position: tuple[float, float]) -> None:
        """Count torques and rotations about another position [m]."""
        self._axis = position

    def region_of(self, cells: Bools) -> Region:
        """Region that holds cells, all of the grid along its periods."""
        spans = [
            (0, count) if repeats else _span(np.any(cells, axis=1 - axis))
            for axis, (count, repeats) in enumerate(
                zip(self.grid.shape, self.grid.periodic, strict=True)
            )
        ]
        if self._symmetry is None:
            return Region(*spans)
        rows, columns = (
            (count // 2, max(span[1], count - span[0])) if mirrored else span
            for count, span, mirrored in zip(
                self.grid.shape, spans, self._symmetry.mirrored, strict=True
            )
        )
        return Region(rows, columns)

    def along(self, region: Region, axes: tuple[bool, bool]) -> Region:
        """Region with all cells of the grid along axes."""
        rows, columns = (
            (0, count) if whole else span
            for count, whole, span in zip(
                self.grid.shape, axes, (region.rows, region.columns), strict=True
            )
        )
        return Region(rows, columns)

    def spread(self, region: Region, fields: Numbers) -> Numbers:
        """Fields of a region on the whole grid, 0 elsewhere; components x and y, or a scalar."""
        rows, columns = self.with_images(region)
        whole = np.zeros((*fields.shape[:-2], *self.grid.shape), fields.dtype)
        whole[..., rows, columns] = self._with_images(fields)
        return whole

    def with_images(self, region: Region) -> tuple[slice, slice]:
        """Index of a region and its mirror images in a field of the grid."""
        if self._symmetry is None:
            return region.cut
        rows, columns = (
            slice(count - span[1] if mirrored else span[0], span[1])
            for count, span, mirrored in zip(
                self.grid.shape,
                (region.rows, region.columns),
                self._symmetry.mirrored,
                strict=True,
            )
        )
        return rows, columns

    def _with_images(self, fields: Numbers) -> Numbers:
        """Fields of a region with those of its mirror images."""
        for axis in (-2, -1):
            if self._symmetry is None or not self._symmetry.mirrored[axis]:
                continue
            mirror = np.flip(fields, axis)
            if fields.ndim == 3:
                signs = (1, -1) if self._symmetry.even[axis] else (-1, 1)
                mirror = mirror * np.array(signs)[:, None, None]
            fields = np.concatenate([mirror, fields], axis)
        return fields

    def parts(self, region: Region) -> Parts:
        """Parts of the response on a region."""
        if region.shape not in self._parts:
            latest = list(self._parts.items())[: self._shapes - 1]
            self._parts = {region.shape: self._made(region.shape), **dict(latest)}
        return self._parts[region.shape]

    def block(self, region: Region, kappa: float, layers: tuple[float, ...] = ()) -> ShearBlock:
        """Operators on a region, of the response K + κ (its second part) + that of layers."""
        key = region.shape, kappa, layers
        if key not in self._blocks:
            parts, cell_size = self.parts(region), self.grid.cell_size
            self._blocks = {
                key: ShearBlock(
                    parts.sum_of(1.0, kappa, layers),
                    parts.sum_of(1.0, kappa, layers, single=True),
                    self._preconditioner(region.shape, kappa, layers),
                    self.shift(region),
                    max(cell_size) if min(self.grid.shape) > 1 else min(cell_size),
                )
            }
        return replace(self._blocks[key], shift=self.shift(region))

    def in_plane(self, kappa: float, layers: tuple[float, ...]) -> InPlane:
        """Ratios of waves along and across their wave vector, interpolated.

        Longer waves than that of twice the grid count as that one, and shorter ones than a cell.
        """
        q = np.geomspace(np.pi / max(self.grid.size), self.shortest_wave, TABLED_WAVES)
        along, across = np.ones(q.size), np.full(q.size, 1 + kappa)
        for weight, response in zip(layers, self._layers, strict=True):
            found, short = response.ratios(q), response.short_waves
            along += weight * (found.along - short.along)
            across += weight * (found.across - short.across)
        logarithm = np.log(q)

        def ratios(wave_number: Floats) -> tuple[Floats, Floats]:
            place = np.log(wave_number)
            return np.interp(place, logarithm, along), np.interp(place, logarithm, across)

        return ratios

    @property
    def shortest_wave(self) -> float:
        """Largest wave number of waves on the grid [1/m]."""
        cells = zip(self.grid.cell_size, self.grid.shape, strict=True)
        return 2 * np.pi / min(edge for edge, count in cells if count > 1)

    def shift(self, region: Region) -> RigidShift:
        """Rigid motions over a region, about the axis."""
        rows, columns = region.cut
        x = self.grid.x[rows, None] - self._axis[0]
        y = self.grid.y[None, columns] - self._axis[1]
        if self._symmetry is None:
            return RigidShift(x, y, self.grid.cell_area)
        images = 2 ** sum(self._symmetry.mirrored)
        return RigidShift(x, y, images * self.grid.cell_area, self._symmetry.modes)

    def _preconditioner(
        self, shape: tuple[int, int], kappa: float, layers: tuple[float, ...]
    ) -> PairFilter:
        options: Any = {"transforms": self._transforms}
        if layers:
            options |= {"layers": self.in_plane(kappa, layers)}
        if self._symmetry is None:
            return shear_preconditioner(shape, self.grid.cell_size, kappa, **options)
        even, halved = self._symmetry.even, self._symmetry.halved
        if halved is not None:
            options |= {"even": even[halved]}
            return halved_shear_preconditioner(shape, self.grid.cell_size, kappa, halved, **options)
        return mirrored_shear_preconditioner(shape, self.grid.cell_size, kappa, even, **options)

    def _made(self, shape: tuple[int, int]) -> Parts:
        grid, options = self.grid, {"transforms": self._transforms}
        if self._symmetry is not None:
            shape = self._symmetry.whole(shape)
        if all(grid.periodic):
            return periodic_shear_convolution(shape, grid.cell_size, self._layers, **options)
        repeats = any(grid.periodic)
        tables = self._periodic_tables.within(shape) if repeats else self._table_for(shape)
        periodic = grid.periodic[0], grid.periodic[1]
        if self._symmetry is None:
            return shear_convolution(tables, periodic, **options)
        even, halved = self._symmetry.even, self._symmetry.halved
        if halved is None:
            return mirrored_shear_convolution(tables, even, **options)
        return halved_shear_convolution(tables, periodic, halved, even=even[halved], **options)

    @cached_property
    def _periodic_tables(self) -> ShearTables:
        return self._tables_on(self.grid)

    def _tables_on(self, grid: Grid) -> ShearTables:
        corrections = tuple(shear_correction(grid, each) for each in self._layers)
        return replace(shear_tables(grid), corrections=corrections)

    def _table_for(self, shape: tuple[int, int]) -> ShearTables:
        """Coefficients of a block, out of those of a larger one that it may grow to."""
        # The larger one follows from the block alone, so that a resumed run has the same bits.
        counts = [
            max(count, min(_rounded_up(count), most))
            for count, most in zip(shape, self.grid.shape, strict=True)
        ]
        larger = counts[0], counts[1]
        if self._table is None or self._table.direct.shape != larger:
            (nx, ny), (dx, dy) = larger, self.grid.cell_size
            self._table = self._tables_on(Grid(larger, (nx * dx, ny * dy)))
        return self._table.within(shape)


def _rounded_up(count: int) -> int:
    """Next power of GROWTH."""
    return math.ceil(GROWTH ** math.ceil(math.log(count, GROWTH)))


def _span(lines: Bools) -> tuple[int, int]:
    """First and last lines around the occupied ones, a multiple of lines if there are as many."""
    occupied, count = np.flatnonzero(lines), len(lines)
    if not occupied.size:
        return 0, min(MULTIPLE, count)
    low = max(int(occupied[0]) - MARGIN, 0)
    high = min(int(occupied[-1]) + 1 + MARGIN, count)
    wanted = min(-(-(high - low) // MULTIPLE) * MULTIPLE, count)
    low = max(low - (wanted - (high - low)) // 2, 0)
    low = min(low, count - wanted)
    return low, low + wanted
