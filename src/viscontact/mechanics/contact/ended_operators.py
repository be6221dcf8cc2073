"""Operators of bodies that end, on blocks of cells of a domain."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from viscontact.backend.team import Team, Workspace
from viscontact.backend.transforms import Field, Transforms
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.ended_convolution import EndedConvolution
from viscontact.mechanics.halfspace.ended_response import EndedLayers, EndedResponse, parts_of
from viscontact.mechanics.halfspace.ended_rows import EndedRows, ended_rows
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse


class EndedPreconditioner(Preconditioner):
    """Preconditioner of a block in which all bodies that touch end at common planes.

    Between them, and to the edge of the block where there is one only, waves are even, as under the
    pressure with its images. Beyond a plane nothing is done.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        inside: slice,
        cell_size: tuple[float, float],
        **options: Any,
    ) -> None:
        """Take the rows within the bodies; `options` are those of a preconditioner."""
        super().__init__((inside.stop - inside.start, shape[1]), cell_size, **options)
        self._block, self._inside = shape, inside

    @property
    def compiled(self) -> tuple[None, None]:
        """None: the core has no filters of a part of the block."""
        return None, None

    def apply(self, displacement: Field, into: Field | None = None) -> Field:
        """Pressure times contact compliance [-] for about this displacement [m]; zero mean."""
        return self._within(super().apply, displacement, into)

    def stiffness_of(self, cells: Field, into: Field | None = None) -> Field:
        """Stiffness where some cells are displaced by 1, others by 0 [1/m]."""
        return self._within(super().stiffness_of, cells, into)

    def _within(
        self, compute: Callable[[Field, Field], Field], field: Field, into: Field | None
    ) -> Field:
        """Result on the rows within the bodies, and zero beyond."""
        result = np.empty(self._block, np.float32) if into is None else into
        compute(field[self._inside], result[self._inside])
        result[: self._inside.start] = result[self._inside.stop :] = 0.0
        return result


class EndedOperators:
    """Operators of half-spaces that end, over the independent part of a grid."""

    def __init__(
        self,
        grid: Grid,
        mirrored: tuple[bool, bool],
        transforms: Transforms,
        team: Team,
        *,
        even: bool,
    ) -> None:
        """Take a grid, of which `mirrored` keeps halves; `even` are pressures across x = 0."""
        self._grid, self._mirrored, self._transforms, self._team = grid, mirrored, transforms, team
        self._even = even
        self._first_row = grid.shape[0] // 2 if mirrored[0] else 0
        self._rows: dict[tuple[EndedResponse, MovingCompliance | None], EndedRows] = {}

    def operator(
        self,
        response: EndedResponse,
        shape: tuple[int, int],
        start: int,
        *,
        single: bool,
        moving: MovingCompliance | None = None,
    ) -> EndedConvolution:
        """Operator over a block of cells from a row of the domain on.

        Under a load that moves along y it has the compliance of the waves.
        """
        return EndedConvolution(
            self._rows_of(response, moving),
            (slice(start, start + shape[0]), slice(0, shape[1])),
            self._grid.cell_size,
            mirrored=self._mirrored[1],
            single=single,
            transforms=self._transforms,
            team=self._team,
        )

    def preconditioner(
        self,
        response: SurfaceResponse,
        shape: tuple[int, int],
        start: int,
        workspace: Workspace,
    ) -> Preconditioner | None:
        """Preconditioner over a block of cells, if all bodies end at common planes."""
        parts = [part for part, _ in parts_of(response)]
        borders = {
            self._borders_of(part) if isinstance(part, EndedResponse) else None for part in parts
        }
        if len(borders) > 1 or any(isinstance(part, EndedLayers) for part in parts):
            return None
        before, after = borders.pop() or (None, None)
        first = max((before or 0) - start, 0)
        last = shape[0] if after is None else min(after - start, shape[0])
        if last - first < 2:
            return None
        return EndedPreconditioner(
            shape,
            slice(first, last),
            self._grid.cell_size,
            mirrored=(True, self._mirrored[1]),
            transforms=self._transforms,
            workspace=workspace,
            team=self._team,
        )

    def middle_row(self, response: EndedResponse) -> int:
        """Row of the domain in the middle between two planes, or the nearest one."""
        before, after = self._borders_of(response)
        count = self._grid.shape[0] - self._first_row
        return min(max(((before or 0) + (after or count)) // 2, 0), count - 1)

    def can_be_halved(self, response: SurfaceResponse) -> bool:
        """True if the bodies also end at borders of cells that are twice as long."""
        ended = (part for part, _ in parts_of(response) if isinstance(part, EndedResponse))
        borders = (border for part in ended for border in self._borders_of(part))
        return not any(border is not None and border % 2 for border in borders)

    def _rows_of(self, response: EndedResponse, moving: MovingCompliance | None) -> EndedRows:
        """Rows of the domain between the planes of a response, kept."""
        if (response, moving) not in self._rows:
            shape = self._grid.shape[0] - self._first_row, self._grid.shape[1]
            # The plane x = 0 of a mirrored domain is one of symmetry, as a wall is.
            kinds = (response.free[0] and not self._mirrored[0], response.free[1])
            self._rows[response, moving] = ended_rows(
                replace(response, free=kinds, even=self._even),
                shape,
                self._grid.cell_size,
                self._borders_of(response),
                moving,
                periodic=self._grid.periodic[1],
            )
        return self._rows[response, moving]

    def _borders_of(self, response: EndedResponse) -> tuple[int | None, int | None]:
        """Planes in rows from the first one of the domain."""
        begin = self._grid.centre[0] - self._grid.size[0] / 2
        before, after = (
            None
            if plane is None
            else round((plane - begin) / self._grid.cell_size[0]) - self._first_row
            for plane in response.planes
        )
        return (0 if self._mirrored[0] else before), after
