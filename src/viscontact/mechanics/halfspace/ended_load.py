"""Pressures on a body that ends along x, their images about its ends, and its free faces."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.ended_response import EndedResponse


@dataclass(frozen=True, eq=False)
class EndedLoad:
    """Pressures on a body that ends."""

    response: EndedResponse
    fields: Floats  # shape (fields, nx, ny) [Pa]
    grid: Grid

    @cached_property
    def borders(self) -> tuple[int | None, int | None]:
        """Planes of the ends in rows from the first one of the grid."""
        begin, edge = self.grid.centre[0] - self.grid.size[0] / 2, self.grid.cell_size[0]
        before, after = (
            None if plane is None else round((plane - begin) / edge)
            for plane in self.response.planes
        )
        return before, after

    @cached_property
    def rows(self) -> slice:
        """Rows of the grid within the body."""
        before, after = self.borders
        count = self.grid.shape[0]
        first, last = max(before or 0, 0), count if after is None else min(after, count)
        return slice(first, max(first, last))

    @cached_property
    def mirrored(self) -> tuple[Floats, Grid, slice]:
        """Pressures with their images, on their grid, of which the rows of the body are a part."""
        (before, after), rows = self.borders, self.rows
        (_, ny), (edge, _) = self.grid.shape, self.grid.cell_size
        turned = before is None
        border = after if before is None else before
        assert border is not None  # at least one plane is given
        far = border if turned else rows.stop if after is None else after
        count = border - rows.start if turned else far - border
        start = 0 if turned else count + rows.start - border
        own = slice(start, start + rows.stop - rows.start)
        fields = np.zeros((len(self.fields), 2 * count, ny))
        fields[:, own] = self.fields[:, rows]
        fields += fields[:, ::-1]
        plane = self.grid.centre[0] - self.grid.size[0] / 2 + border * edge
        grid = Grid(
            (2 * count, ny),
            (2 * count * edge, self.grid.size[1]),
            (before is not None and after is not None, False),
            centre=(plane, self.grid.centre[1]),
        )
        return fields, grid, own

    @cached_property
    def faces(self) -> list[Face]:
        """Free faces, that at -x first."""
        begin, edge = self.grid.centre[0] - self.grid.size[0] / 2, self.grid.cell_size[0]
        edges = np.arange(self.rows.start, self.rows.stop + 1, dtype=np.float64)
        found = []
        for side, border, free in zip((1, -1), self.borders, self.response.free, strict=True):
            if border is None or not free:
                continue
            inside = self.fields[:, self.rows][:, ::side]
            distances = np.abs(edges - border)[::side] * edge
            found.append(Face(begin + border * edge, side, distances, inside))
        return found

    @property
    def half_length(self) -> float:
        """Distance from a free face to the plane about which pressures are even or odd [m]."""
        before, after = self.borders
        if before is None or after is None:
            return math.inf
        return (after - before) * self.grid.cell_size[0] / len(self.faces)


@dataclass(frozen=True, eq=False)
class Face:
    """Free face of a body, and the rows of cells beside it."""

    place: float  # [m]
    side: int  # 1 at -x, -1 at +x
    borders: Floats  # of the rows, distances from the face [m]
    fields: Floats  # pressure, shape (fields, rows, ny) [Pa]

    def distances(self, x: Floats) -> Floats:
        """Distances of places from the face [m]."""
        return np.maximum(self.side * (x - self.place), 0.0)
