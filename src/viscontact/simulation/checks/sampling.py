"""Warnings about what a grid misses of a body: peaks between its points, and parts beyond it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.textures import CELLS_OF_A_WAVE
from viscontact.mechanics.contact.cell_fields import height_over_neighbours
from viscontact.mechanics.contact.rim import Rim
from viscontact.units.formatting import format_quantity

#: Largest height between neighbouring points that is not reported, as a slope over the mean strain
#: of the contact (approach / half width). Flattening a wave of amplitude h and length l takes a
#: pressure of pi h / (l J) (Johnson 1985, Contact Mechanics, eq. 13.7); waves of two cells count. A
#: sphere on 10 cells across is below it.
MISSED_PEAK = 0.1


#: Sample points beyond the grid, in sizes of the grid: even near it, then geometrically spaced.
NEAR, FAR = np.linspace(0.0, 1.5, 25), np.geomspace(1.6, 30.0, 32)

#: Distance from the centre of a cell, in cells, within which a point of a map lies at it.
AT_A_CENTRE = 1e-6

#: Rings that the points beyond the grid are grouped in; a ring that cannot touch is skipped.
RINGS = 16

Points = tuple[Floats, Floats]


@dataclass(frozen=True, eq=False)
class Sampling:
    """A body, and its gap at the points of a grid."""

    indenter: Indenter
    open_gap: Floats  # initial gap, +inf outside the outline [m]
    grid: Grid

    @cached_property
    def beyond(self) -> tuple[Floats, Floats, Floats]:
        """Points of the body outside the grid: x, y and gap [m]."""
        found = [_points_outside(self.grid, *points) for points in self._sampled_points()]
        x, y = (np.concatenate(coordinates) for coordinates in zip(*found, strict=True))
        gap = self.indenter.gap(x, y)
        solid = np.isfinite(gap)
        return x[solid], y[solid], gap[solid]

    @cached_property
    def _rings(self) -> Floats:
        """Largest distances along x and y and least gap of rings of points beyond the grid [m]."""
        x, y, gap = self.beyond
        distances = np.abs([x, y])  # from the pivot of the tilts, the origin
        outwards = np.argsort(np.maximum(*_from_middle(self.grid, x, y)))
        rings = [ring for ring in np.array_split(outwards, RINGS) if ring.size]
        found = [[*distances[:, ring].max(axis=1), gap[ring].min()] for ring in rings]
        return np.reshape(found, (-1, 3)).T

    @cached_property
    def _bounds(self) -> tuple[float, float, float]:
        """Largest distances along x and y, and least gap, of all points beyond the grid [m]."""
        far_x, far_y, least = self._rings
        return (
            float(far_x.max(initial=0.0)),
            float(far_y.max(initial=0.0)),
            float(least.min(initial=math.inf)),
        )

    def reaches_beyond(self, motion: Floats, depth: float) -> bool:
        """True if the moved body lies deeper than a depth [m] at a point outside the grid."""
        # Called at every step; nearly always no ring comes close, and no point at all.
        along_x, along_y, least_gap = self._bounds
        approach, tilt_x, tilt_y = motion.tolist()
        if approach + abs(tilt_x) * along_x + abs(tilt_y) * along_y - least_gap <= depth:
            return False
        far_x, far_y, least = self._rings
        deepest = motion[0] + abs(motion[1]) * far_x + abs(motion[2]) * far_y - least
        if (deepest <= depth).all():
            return False
        x, y, gap = self.beyond
        return bool((motion[0] + motion[1] * x + motion[2] * y - gap > depth).any())

    @cached_property
    def missed(self) -> Floats:
        """Height of a map's points over the interpolated grid, or over neighbouring points [m]."""
        # As the amplitude of a wave of two cells; 0 for other bodies, whose tips and edges are
        # meant.
        x, y = self.indenter.sample_points
        if not x.size:
            return np.broadcast_to(0.0, self.grid.shape)
        missed = np.maximum(*(height_over_neighbours(self.open_gap, axis) for axis in (0, 1)))
        places = [
            (along - lines[0]) / cell
            for along, lines, cell in zip(
                (x, y), (self.grid.x, self.grid.y), self.grid.cell_size, strict=True
            )
        ]
        # Nothing is missed at a centre of the grid.
        aside = np.logical_or(*(np.abs(each - np.rint(each)) > AT_A_CENTRE for each in places))
        x, y, places = x[aside], y[aside], [each[aside] for each in places]
        # Unknown outside the grid, and next to the end of the body.
        seen = scipy.ndimage.map_coordinates(
            np.nan_to_num(self.open_gap, posinf=np.nan), places, order=1, cval=np.nan
        )
        known = np.isfinite(seen)
        cells = tuple(np.rint(place[known]).astype(np.intp) for place in places)
        np.maximum.at(missed, cells, seen[known] - self.indenter.gap(x[known], y[known]))
        return missed

    @cached_property
    def texture(self) -> dict[str, str]:
        """Warnings of waves with too few cells."""
        return texture_warnings(self.indenter, self.grid)

    @cached_property
    def sees_all(self) -> bool:
        """True if nothing is missed anywhere."""
        return not self.missed.any()

    def _sampled_points(self) -> Iterator[Points]:
        """Points near and far from the grid, and those of a height map."""
        (lx, ly), (middle_x, middle_y) = self.grid.size, self.grid.centre
        one_side = np.concatenate([NEAR, FAR])
        part = np.concatenate([-one_side[:0:-1], one_side])
        yield _mesh(middle_x + lx * part, middle_y + ly * part)
        yield self.indenter.sample_points


def local_approach(grid: Grid, motion: Floats) -> float:
    """Approach in the middle of a grid, which may be far from the pivot of the tilts [m]."""
    x, y = grid.centre
    return float(motion[0] + motion[1] * x + motion[2] * y)


def map_warnings(missed: float, cell: float, strain: float) -> dict[str, str]:
    """Warn of a height map that is finer than the grid, by `missed` [m], at a strain [-]."""
    if missed <= 0 or math.pi / 2 * missed <= MISSED_PEAK * strain * cell:
        return {}
    return {
        "map": (
            "between neighbouring points of the grid the height map rises by "
            f"{format_quantity(missed, 'm', 3)}: peaks of pressure there depend on the mesh; use "
            "smaller cells, and a map that is smooth over several of them"
        )
    }


def sampling_warnings(
    sampling: Sampling,
    rim: Rim,
    motion: Floats,
    displacement: Floats,
) -> dict[str, str]:
    """Warn of parts of the body under load that the grid does not represent [m, rad]."""
    missed = 0.0
    if not sampling.sees_all:
        missed = float(rim.cut(sampling.missed).max(where=rim.contact, initial=0.0))
    extent = rim.breadth
    strain = 2 * local_approach(sampling.grid, motion) / extent if extent > 0 else math.inf
    cell = max(sampling.grid.cell_size)
    warnings = map_warnings(missed, cell, strain) | sampling.texture
    free = [axis for axis, repeats in enumerate(sampling.grid.periodic) if not repeats]
    if not free:
        return warnings  # the neighbour is the next period, not the body
    # All pressure lies within the grid, so the displacement falls outwards from the grid's rim.
    rim_displacement = max(float(_border(displacement, axis).max()) for axis in free)
    if sampling.reaches_beyond(motion, rim_displacement * (1 + 1e-9)):
        warnings["beyond"] = (
            "the body would touch outside the grid, too, where nothing is computed: the contact "
            "carries a part of the load only; enlarge grid.size"
        )
    return warnings


def _border(field: Floats, axis: int) -> Floats:
    """First and last line of a field across an axis, in its memory."""
    ends = slice(None, None, max(field.shape[axis] - 1, 1))
    return field[ends] if axis == 0 else field[:, ends]


def texture_warnings(indenter: Indenter, grid: Grid) -> dict[str, str]:
    """Warn of waves or dimples with too few cells in a period, along an axis where they vary."""
    cells, period, axis = min(
        (period / cell, period, axis)
        for period, cell, axis in zip(indenter.periods, grid.cell_size, "xy", strict=True)
    )
    # Exactly ten cells are enough in spite of rounding.
    if cells > CELLS_OF_A_WAVE - 1e-6:
        return {}
    return {
        "texture": (
            f"the body repeats itself over {format_quantity(period, 'm', 3)} along {axis}, which "
            f"are {cells:.2g} of the grid's cells; {CELLS_OF_A_WAVE} or more are wanted, or what "
            "lies between its points is missed: use smaller cells"
        )
    }


def _points_outside(grid: Grid, x: Floats, y: Floats) -> Points:
    """The points that lie outside a grid, within the period along an axis that has one."""
    beyond = np.array(_from_middle(grid, x, y)) > 0.5
    repeats = np.array(grid.periodic)
    outside = beyond[~repeats].any(axis=0) & ~beyond[repeats].any(axis=0)
    return x[outside], y[outside]


def _from_middle(grid: Grid, x: Floats, y: Floats) -> Points:
    """Distances of points from the grid's middle along x and y, in sizes of the grid."""
    (lx, ly), (middle_x, middle_y) = grid.size, grid.centre
    return np.abs(x - middle_x) / lx, np.abs(y - middle_y) / ly


def _mesh(x: Floats, y: Floats) -> Points:
    """All points of a mesh, as flat arrays."""
    along, across = np.meshgrid(x, y, indexing="ij")
    return along.ravel(), across.ravel()
