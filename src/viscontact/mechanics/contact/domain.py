"""Half-space operators on a grid: on all cells, on one symmetric part, and on patches."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Field, Floats
from viscontact.backend.compiled import core_by, fastest_inner_loops
from viscontact.backend.team import Team, Workspace
from viscontact.backend.transforms import Transforms, fast_length, fastest_transforms, transforms_by
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.ended_operators import EndedOperators
from viscontact.mechanics.contact.passes.choice import passes_over
from viscontact.mechanics.contact.patch import Patch, PatchOperators
from viscontact.mechanics.contact.response_parts import Operator, PartOperators
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.ended_response import EndedResponse, has_ends, parts_of
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.layered_influence import (
    layered_influence_table,
    periodic_layered_table,
)
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.spectral import PeriodicConvolution
from viscontact.mechanics.halfspace.surface_response import (
    HALF_SPACE,
    SummedResponse,
    SurfaceResponse,
)

#: Margin around a contact in its patch, as a part of the contact's extent.
PATCH_MARGIN = 0.06

#: Fewest cells of a coarser domain along each axis.
MIN_CELLS = 64

#: A patch of more than this part of the grid saves no time.
MAX_PATCH_SHARE = 0.8


class ContactDomain:
    """Half-space under a grid, with operators on all cells and on patches around contacts.

    The search for the pressure runs on the contact's patch, by changes convolved in single
    precision; its result is convolved and checked on the whole grid in double precision
    (`convolution`). The last patch is kept, since a creeping contact stays in it for many steps.

    A problem that is even across x = 0 or y = 0 (`mirrored`) needs the cells beyond only: see
    `reduce_by_symmetry` and `reduced_constraints`. With `even_rows` alone pressures are even across
    x = 0 on all cells, of an odd number of rows. Along a periodic axis a grid is not mirrored,
    patches are as long as the period, and nothing is padded. On a grid periodic along both axes the
    preconditioner is the exact inverse; along one, displacement counts from that of a line load at
    the distance of the grid's size.
    """

    whole: Patch  # all cells of the domain
    convolution: Operator  # pressure to unit displacement on all cells, in double precision
    team: Team  # threads that share the rows of fields out

    def __init__(
        self,
        grid: Grid,
        *,
        response: SurfaceResponse = HALF_SPACE,
        mirrored: tuple[bool, bool] = (False, False),
        even_rows: bool = False,
        transforms: Transforms | None = None,
        inner_loops: str | None = None,
    ) -> None:
        odd = [count % 2 for count in grid.shape]
        if np.any(np.logical_and(mirrored, odd)):
            raise ValueError(f"a mirrored grid needs an even number of cells, got {grid.shape}")
        if np.any(np.logical_and(mirrored, grid.centre)):
            raise ValueError(f"a mirrored grid is centred on the origin, not on {grid.centre}")
        if np.any(np.logical_and(mirrored, grid.periodic)):
            raise ValueError("along a period a grid is worked with as a whole, not mirrored")
        self.grid, self.response = grid, response
        #: Parts of a response that changes, with their weights; tables, and operators on blocks.
        self._parts: dict[SurfaceResponse, float] = {}
        self._tables: dict[SurfaceResponse, Floats] = {}
        self._of_blocks: dict[tuple[tuple[int, int], int], PartOperators] = {}
        self._axis = (0.0, 0.0)
        self.mirrored = mirrored
        self._transforms = transforms or transforms_by(fastest_transforms())
        self._inner_loops, self._workspace = inner_loops or fastest_inner_loops(), Workspace()
        self.team = Team(self._transforms.threads, core_by(self._inner_loops))
        self._first_row, self._first_column = (
            count // 2 if even else 0 for count, even in zip(grid.shape, mirrored, strict=True)
        )
        self.shape = (grid.shape[0] - self._first_row, grid.shape[1] - self._first_column)
        self._ended = EndedOperators(
            grid, mirrored, self._transforms, self.team, even=even_rows or mirrored[0]
        )
        self._build_operators()
        self._last = self._found = self.whole
        self._spans: tuple[slice, slice] | None = None  # of the cells that the last one is around

    def _build_operators(self) -> None:
        self._coefficients = self._influence_table()
        self.convolution = self._operator(self.shape, 0, single=False)
        self.whole = self._patch(slice(0, self.shape[0]), slice(0, self.shape[1]))

    def set_response(self, parts: tuple[SurfaceResponse, ...], weights: tuple[float, ...]) -> None:
        """Set the surface's response to a weighted sum of parts, whose operators are kept."""
        response = SummedResponse(parts, weights)
        if response == self.response:
            return
        self.response, self._parts = response, dict(zip(parts, weights, strict=True))
        last = self._last
        self._build_operators()
        is_whole = (last.rows, last.columns) == (self.whole.rows, self.whole.columns)
        self._last = self.whole if is_whole else self._patch(last.rows, last.columns)

    def unit_displacement(self, pressure: Floats, response: SurfaceResponse) -> Floats:
        """Displacement per unit compliance [Pa m] under a part of the response, of all cells."""
        return self._on_block(self.shape, 0).operator(response).apply(pressure)

    def coarser(self) -> ContactDomain | None:
        """Same region in cells twice as long and wide; None if their number is odd or too small."""
        if any(cells % 2 or cells < 2 * MIN_CELLS for cells in self.shape):
            return None
        if not self._ended.can_be_halved(self.response):
            return None
        nx, ny = self.grid.shape
        halved = replace(self.grid, shape=(nx // 2, ny // 2))
        domain = ContactDomain(
            halved,
            response=self.response,
            mirrored=self.mirrored,
            transforms=self._transforms,
            inner_loops=self._inner_loops,
        )
        domain.move_axis(self._axis)
        return domain

    def move_axis(self, axis: tuple[float, float]) -> None:
        """Set the body's axis (x, y), about which rigid planes and moments are taken [m]."""
        if axis == self._axis:
            return
        self._axis = axis
        whole_is_last = self._last is self.whole
        self.whole = self._turned(self.whole)
        self._last = self.whole if whole_is_last else self._turned(self._last)

    def _turned(self, patch: Patch) -> Patch:
        """A patch with planes about the body's present axis."""
        plane = self._plane(patch.rows, patch.columns)
        return replace(patch, plane=plane, passes=passes_over(plane))

    def reduce_by_symmetry(self, field: Floats) -> Floats:
        """The independent part of a field on the grid."""
        return np.ascontiguousarray(field[self._first_row :, self._first_column :])

    def expand_by_symmetry(self, field: Field) -> Field:
        """The field on the whole grid of its independent part, in the same memory if it is all."""
        return self.team.unfold(field, self.mirrored)

    @property
    def periodic(self) -> tuple[bool, bool]:
        """True for x and for y along which the surface repeats."""
        return self.grid.periodic[0], self.grid.periodic[1]

    @property
    def symmetry_count(self) -> int:
        """Number of mirror images that make up the whole grid."""
        return (1 + self.mirrored[0]) * (1 + self.mirrored[1])

    def reduced_constraints(self, constraints: Constraints) -> Constraints:
        """The body's constraints on the independent part of the grid."""
        return _reduced(constraints, self.periodic, self.mirrored)

    def patch_around(self, cells: Bools) -> Patch:
        """Last patch if it fits the given cells, else one with room to grow, or the grid."""
        spans = None if all(self.grid.periodic) else self.team.spans(cells)
        if spans is None:
            return self.whole
        # The contact of most steps lies in the lines of the last one.
        if spans != self._spans or (
            self._found is not self._last and self._found is not self.whole
        ):
            self._spans, self._found = spans, self._patch_over(*spans, cells.size)
        return self._found

    def _patch_over(self, row_span: slice, column_span: slice, cells: int) -> Patch:
        """Last patch if it fits the spans of a contact, else one with room to grow, or the grid."""
        rows, columns = self._lines(row_span, 0), self._lines(column_span, 1)
        roomy = (
            _widen(rows, self.shape[0], one_sided=self.mirrored[0]),
            _widen(columns, self.shape[1], one_sided=self.mirrored[1]),
        )
        if _size(*roomy) > MAX_PATCH_SHARE * cells:
            return self.whole
        fits = self._last.holds(_with_border(rows), _with_border(columns))
        if not fits or _size(self._last.rows, self._last.columns) > 1.3 * _size(*roomy):
            self._last = self._patch(*roomy)
        return self._last

    def _lines(self, span: slice, axis: int) -> slice:
        """Lines of cells that a patch must hold: up to the mirror, and all of a period."""
        if self.grid.periodic[axis]:
            return slice(0, self.shape[axis])
        return slice(0, span.stop) if self.mirrored[axis] else span

    @property
    def kept_patch(self) -> tuple[int, int, int, int]:
        """First and last rows and columns of the kept patch, for `keep_patch`."""
        rows, columns = self._last.rows, self._last.columns
        return rows.start, rows.stop, columns.start, columns.stop

    def keep_patch(self, span: tuple[int, int, int, int]) -> None:
        """Keep the patch that another domain over the same grid had kept."""
        if span == self.kept_patch:
            return
        rows, columns, self._spans = slice(*span[:2]), slice(*span[2:]), None
        is_whole = (rows, columns) == (self.whole.rows, self.whole.columns)
        self._last = self.whole if is_whole else self._patch(rows, columns)

    def _patch(self, rows: slice, columns: slice) -> Patch:
        """Patch on rows and columns of the domain."""
        grid = self.grid
        shape = (rows.stop - rows.start, columns.stop - columns.start)
        plane = self._plane(rows, columns)
        return Patch(
            rows,
            columns,
            grid.cell_area,
            _arm(shape, grid),
            PatchOperators(
                shape,
                lambda: self._operator(shape, rows.start, single=True),
                lambda: self._preconditioner(shape, rows.start),
            ),
            plane,
            passes_over(plane),
        )

    def _influence_table(self) -> Floats:
        """Influence coefficients between all cells of the grid."""
        # Empty for a periodic one, and for a half-space, where those of each block are soon
        # computed.
        if all(self.grid.periodic) or self._parts or self._is_plain(self.response):
            return np.empty((0, 0))
        if has_ends(self.response):  # its operators have tables of their own
            return np.empty((0, 0))
        if not isinstance(self.response, SummedResponse):
            return self._table_of(self.response)
        pairs = zip(self.response.weights, self.response.parts, strict=True)
        return np.asarray(sum(weight * self._table_of(part) for weight, part in pairs))

    def _table_of(self, response: SurfaceResponse) -> Floats:
        """Influence table of a response, kept."""
        if response not in self._tables:
            self._tables[response] = _coefficients(self.grid, response)
        return self._tables[response]

    def _is_plain(self, response: SurfaceResponse) -> bool:
        """True of a half-space without a period, whose coefficients have a closed form."""
        return response is HALF_SPACE and not any(self.grid.periodic)

    def _preconditioner(self, shape: tuple[int, int], start: int) -> Preconditioner:
        """Approximate inverse of the convolution over a block of cells from a row on."""
        if self._parts:
            return self._on_block(shape, start).preconditioner(self._parts)
        found = None
        if has_ends(self.response):
            found = self._ended.preconditioner(self.response, shape, start, self._workspace)
        return self._preconditioner_of(self.response, shape) if found is None else found

    def _preconditioner_of(
        self, response: SurfaceResponse, shape: tuple[int, int]
    ) -> Preconditioner:
        options: Any = {"mirrored": self.mirrored, "workspace": self._workspace}
        options |= {"transforms": self._transforms, "team": self.team}
        return Preconditioner(shape, self.grid.cell_size, response=response, **options)

    def _plane(self, rows: slice, columns: slice) -> RigidPlane:
        """Rigid motions over rows and columns of the domain, about the body's axis."""
        x, y = self.grid.x[self._first_row :][rows], self.grid.y[self._first_column :][columns]
        along = x - self._axis[0], y - self._axis[1]
        return RigidPlane(*along, self.grid.cell_size, self.mirrored, self.team)

    def _operator(self, shape: tuple[int, int], start: int, *, single: bool) -> Operator:
        """Convolution over a block of cells from a row on, or over the whole period."""
        if has_ends(self.response):
            parts = dict(parts_of(self.response))
            return self._on_block(shape, start).sum_of(parts, single=single)
        if self._parts:
            return self._on_block(shape, start).sum_of(self._parts, single=single)
        return self._operator_of(self.response, self._coefficients, shape, single=single)

    def _part_operator(
        self, part: SurfaceResponse, shape: tuple[int, int], start: int, *, single: bool
    ) -> Operator:
        """Operator of a response over a block of cells from a row on."""
        if isinstance(part, EndedResponse):
            return self._ended.operator(part, shape, start, single=single)
        if has_ends(part):
            return self._on_block(shape, start).sum_of(dict(parts_of(part)), single=single)
        table = np.empty((0, 0)) if all(self.grid.periodic) else self._table_of(part)
        return self._operator_of(part, table, shape, single=single)

    def _operator_of(
        self,
        response: SurfaceResponse,
        coefficients: Floats,
        shape: tuple[int, int],
        *,
        single: bool,
    ) -> Operator:
        options: Any = {"transforms": self._transforms, "workspace": self._workspace}
        if all(self.grid.periodic):
            cell_size = self.grid.cell_size
            options["team"] = self.team
            return PeriodicConvolution(shape, cell_size, response, single=single, **options)
        nx, ny = (cells * (1 + even) for cells, even in zip(shape, self.mirrored, strict=True))
        if not coefficients.size:
            coefficients = influence_table((nx, ny), self.grid.cell_size, self.team)
        # Whole grids are convolved a few times a step only: their memory comes from the system
        # then, since the search, which has none of it, needs the most.
        if not single and shape == self.shape:
            del options["workspace"]
        return Convolution(
            coefficients[:nx, :ny],
            mirrored=self.mirrored,
            periodic=(self.grid.periodic[0], self.grid.periodic[1]),
            single=single,
            team=self.team,
            **options,
        )

    def _on_block(self, shape: tuple[int, int], start: int) -> PartOperators:
        """Operators of parts of the response over a block of cells; the last blocks' are kept."""
        block = shape, start if has_ends(self.response) else 0
        if block not in self._of_blocks:
            self._of_blocks = {
                each: kept
                for each, kept in self._of_blocks.items()
                if each[0] in (self.shape, self._last.shape)
            }
            self._of_blocks[block] = PartOperators(
                lambda part, single: self._part_operator(part, shape, start, single=single),
                lambda: self._preconditioner_of(HALF_SPACE, shape),
            )
        return self._of_blocks[block]


def _coefficients(grid: Grid, response: SurfaceResponse) -> Floats:
    """Influence coefficients of a grid that is not periodic along both axes [m]."""
    if not any(grid.periodic):
        return layered_influence_table(grid.shape, grid.cell_size, response)
    if grid.periodic[0]:
        return periodic_layered_table(grid.shape, grid.cell_size, response, grid.size[1])
    turned = grid.shape[::-1], grid.cell_size[::-1]
    return periodic_layered_table(*turned, response, grid.size[0]).T


def _arm(shape: tuple[int, int], grid: Grid) -> float:
    """Longest edge of a block along an axis without period, if there is one [m]."""
    extents = np.multiply(shape, grid.cell_size)
    free = [extent for extent, repeats in zip(extents, grid.periodic, strict=True) if not repeats]
    return float(max(free or extents))


@lru_cache(maxsize=16)  # the same object again while a load is held, with what it has cached
def _reduced(
    constraints: Constraints, periodic: tuple[bool, bool], mirrored: tuple[bool, bool]
) -> Constraints:
    """Constraints on the independent part of a grid."""
    for axis in (0, 1):
        if periodic[axis]:
            constraints = constraints.level(axis)
        if mirrored[axis]:
            constraints = constraints.halved(axis)
    return constraints


def _widen(span: slice, cells: int, *, one_sided: bool) -> slice:
    """Slice with a margin at its free ends, of a length that is fast to transform, in the grid."""
    extent = span.stop - span.start
    margin = max(3, int(np.ceil(PATCH_MARGIN * extent)))
    wanted = extent + (1 if one_sided else 2) * margin
    length = min(fast_length(wanted), cells)
    start = 0 if one_sided else (span.start + span.stop - length) // 2
    start = min(max(start, 0), cells - length)
    return slice(start, start + length)


def _with_border(span: slice) -> slice:
    """Slice with one more line on both sides."""
    return slice(max(span.start - 1, 0), span.stop + 1)


def _size(rows: slice, columns: slice) -> int:
    """Number of cells of a block."""
    return int((rows.stop - rows.start) * (columns.stop - columns.start))
