"""A body that repeats itself with the period of a grid, and its height maps across the borders."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters.height_map import HeightMap
from viscontact.bodies.indenters.indenter import CombinedIndenter, Indenter, PlacedIndenter
from viscontact.bodies.indenters.position_checks import positions


@dataclass(frozen=True)
class PeriodicBody(Indenter):
    """A body that repeats itself along the periodic axes of a grid."""

    body: Indenter
    grid: Grid

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the gap of the body in the period of each position; see `Indenter.gap`."""
        along_x, along_y = (
            _wrapped(along, middle, period) if repeats else along
            for along, middle, period, repeats in zip(
                positions(x, y), self.grid.centre, self.grid.size, self.grid.periodic, strict=True
            )
        )
        return self._continued.gap(along_x, along_y)

    @cached_property
    def _continued(self) -> Indenter:
        return continued(self.body, self.grid)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures of the body [1/m]."""
        return self.body.curvatures

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """Spacing of the samples of the body [m]."""
        return self.body.sample_spacing

    @property
    def sample_points(self) -> tuple[Floats, Floats]:
        """Points of the body, in one period [m]."""
        return self.body.sample_points


def _wrapped(along: Floats, middle: float, period: float) -> Floats:
    """Positions moved by whole periods to within half a period of the middle [m]."""
    offset = along - middle
    periods = np.where(np.abs(offset) > period / 2, np.round(offset / period), 0.0)
    # Those within it keep their bits.
    return np.asarray(np.where(periods == 0, along, middle + (offset - period * periods)))


def continued(body: Indenter, grid: Grid) -> Indenter:
    """The body, whose height maps go on to the borders of a grid's period and meet there.

    A map of one period has no point at its end, where the next period begins; its last cell lies
    between the last point and the first one of the next period.
    """
    if isinstance(body, CombinedIndenter):
        return CombinedIndenter(tuple(continued(part, grid) for part in body.parts))
    if isinstance(body, PlacedIndenter):
        turned = _seen_by(body, grid)
        return body if turned is None else replace(body, body=continued(body.body, turned))
    return _continued_map(body, grid) if isinstance(body, HeightMap) else body


def _seen_by(body: PlacedIndenter, grid: Grid) -> Grid | None:
    """The grid from a body that is moved, and turned by right angles; None for other angles."""
    quarters = body.angle / (math.pi / 2)
    if quarters != round(quarters):
        return None
    x, y = (middle - moved for middle, moved in zip(grid.centre, (body.x, body.y), strict=True))
    seen = replace(grid, centre=(x, y))
    for _ in range(round(quarters) % 4):  # a quarter turn of the body is one back of the grid
        (nx, ny), (lx, ly), (x, y), (along, across) = (
            *(seen.shape, seen.size, seen.centre),
            tuple(seen.periodic),
        )
        seen = Grid((ny, nx), (ly, lx), centre=(y, -x), periodic=(across, along))
    return seen


def _continued_map(body: HeightMap, grid: Grid) -> HeightMap:
    lines, height = [body.x, body.y], body.height
    for axis in (0, 1):
        if grid.periodic[axis]:
            period, middle = grid.size[axis], grid.centre[axis]
            lines[axis], chosen = _continued_lines(lines[axis], period, middle)
            height = np.take(height, chosen, axis)
    return HeightMap(lines[0], lines[1], height, holes=body.holes)


def _continued_lines(lines: Floats, period: float, middle: float) -> tuple[Floats, Integers]:
    """Lines that cover a period about its middle, and the index of each among those given."""
    count, index = lines.size, np.arange(lines.size)
    # One line is enough for both ends of a period that the map holds with them.
    own = count - 1 if math.isclose(lines[-1] - lines[0], period, rel_tol=1e-6) else count
    before, after = index[:own], index[count - own :]
    every = np.concatenate([lines[before] - period, lines, lines[after] + period])
    places = np.concatenate([before, index, after])
    low = min(int(np.searchsorted(every, middle - period / 2, side="right")) - 1, own)
    high = max(int(np.searchsorted(every, middle + period / 2)) + 1, own + count)
    kept = slice(max(low, 0), high)
    return every[kept], places[kept]
