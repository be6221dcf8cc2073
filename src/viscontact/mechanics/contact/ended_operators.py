"""Operators of bodies that end, on blocks of cells of a domain."""

from __future__ import annotations

from dataclasses import replace

from viscontact.backend.team import Team
from viscontact.backend.transforms import Transforms
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.ended_half_space import (
    EndedConvolution,
    EndedResponse,
    EndedRows,
    ended_rows,
    parts_of,
)
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.surface_response import SurfaceResponse


class EndedOperators:
    """Operators of half-spaces that end, over the independent part of a grid."""

    def __init__(
        self, grid: Grid, mirrored: tuple[bool, bool], transforms: Transforms, team: Team
    ) -> None:
        self._grid, self._mirrored, self._transforms, self._team = grid, mirrored, transforms, team
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
                replace(response, free=kinds),
                shape,
                self._grid.cell_size,
                self._borders_of(response),
                moving,
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
