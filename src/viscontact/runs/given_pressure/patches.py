"""Patches of cells: polygons under a pressure that is linear in x and y."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.polygon_influence import edge_integrals
from viscontact.runs.given_pressure.cell_series import legendre_to

#: Corners of a rectangle, counter-clockwise, in half edges from its middle.
CORNERS = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])

#: Points along both sides of a triangle at which a polynomial of the seventh order is integrated.
RULES = np.polynomial.legendre.leggauss(5), np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True, eq=False)
class Patches:
    """Polygons in cells; places are counted from the middle of their cell."""

    edges: Floats  # counter-clockwise, from x, y to x, y, shape (edges, 4) [m]
    patch: Integers  # number of the patch of each edge
    cell: Integers  # number of the cell of each patch
    pressure: Floats  # in the middle of the cell [Pa], and slopes along x, y, (patches, 3) [Pa/m]

    def displacement(self, x: float, y: float, cells: int) -> Floats:
        """Displacement at a place by the patches of each cell per 1/E* [Pa m], shape (cells,)."""
        each = (edge_integrals(x, y, self.edges) * self.pressure.T[:, self.patch]).sum(axis=0)
        return np.asarray(np.bincount(self.cell[self.patch], each, cells))

    def sums(self, size: tuple[float, float], orders: Sequence[tuple[int, int]]) -> Floats:
        """∫ p P_a(ξ) P_b(η) dA of each patch, over the area of a cell; (orders, patches) [Pa].

        A polygon is the sum of triangles, of either sign, of its edges and the middle of the cell.
        """
        scale = np.tile(np.array(size) / 2, 2)
        start, end = np.split((self.edges / scale).T, 2)
        area = (start[0] * end[1] - start[1] * end[0]) / 4  # of the triangle twice, over the cell
        level, *slopes = self.pressure[self.patch].T
        along, across = (each * half for each, half in zip(slopes, scale, strict=False))
        total = np.zeros((len(orders), area.size))
        highest = max(map(max, orders))
        outward, sideways = ((nodes / 2 + 0.5, weights / 2) for nodes, weights in RULES)
        for out, weight in zip(*outward, strict=True):
            for side, share in zip(*sideways, strict=True):
                x, y = out * (start + side * (end - start))
                value = weight * share * out * area * (level + along * x + across * y)
                in_x, in_y = (legendre_to(highest, each) for each in (x, y))
                in_x *= value
                for row, (a, b) in zip(total, orders, strict=True):
                    row += in_x[a] * in_y[b]
        return np.array([np.bincount(self.patch, row, len(self.cell)) for row in total])

    def series(
        self, size: tuple[float, float], cells: int, orders: Sequence[tuple[int, int]]
    ) -> Floats:
        """Legendre's series of the pressure over each cell, shape (orders, cells) [Pa]."""
        factors = np.array([(2 * a + 1) * (2 * b + 1) for a, b in orders])
        sums = self.sums(size, orders)
        of_cells = np.array([np.bincount(self.cell, each, cells) for each in sums])
        return np.asarray(factors[:, None] * of_cells)


def rectangle_edges(x: Floats, y: Floats, half: Floats) -> Floats:
    """Edges of rectangles around x, y, of half edges (rectangles, 2); shape (4 rectangles, 4)."""
    corners = np.stack([x, y], axis=1)[:, None] + CORNERS * half[:, None]
    return np.concatenate([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 4)


def together(parts: Sequence[Patches]) -> Patches:
    """Patches of all parts, without those under no pressure, and edges of no length."""
    before = np.cumsum([0, *(len(each.cell) for each in parts)])
    patch = np.concatenate([each.patch + n for each, n in zip(parts, before, strict=False)])
    edges = np.concatenate([each.edges for each in parts])
    pressure = np.concatenate([each.pressure for each in parts])
    kept = (edges[:, :2] != edges[:, 2:]).any(axis=1) & (pressure != 0).any(axis=1)[patch]
    cell = np.concatenate([each.cell for each in parts])
    return Patches(edges[kept], patch[kept], cell, pressure)
