"""Singular pressure: at the end of a body, and at its points and ridges."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.mechanics.contact.body_edge import END_DEPTH, end_cells

#: Words by which the warning of a singular peak is recognised.
DEPENDS_ON_MESH = "the peak pressure depends on the mesh"

#: Samples in one cell, in a quarter of one and in three. A change of slope counts as a corner if
#: this part of the change within three cells lies within a quarter of one; under even curvature a
#: twelfth does, and a third at the facets of a map, each a cell long.
SAMPLES, QUARTER, AROUND = 16, 4, 48
CORNER_SHARE = 0.5

#: Smallest angle of a corner that counts, as a part of the strain of the pressure. Halving the
#: cells then adds E* angle ln(2)/(2 pi), or 1 %, to a peak of 2/pi E* strain.
MIN_ANGLE = 0.06

#: Deviation of an exponent from 2 by two and four cells, over that by one and two, from which a
#: body counts as smooth: 4 where it is, at most 2 at an apex beside a centre.
SMOOTH_DEVIATION = 3.0

#: Exponent of a gap less the part of its bend on one side that the other side has: at most 1.26 at
#: an apex up to 0.6 cells beside a centre, where both sides bend; at least 1.5 at the parabolic
#: edge of a flat body, where one does.
ONE_SIDED = 1.35


@dataclass(frozen=True, eq=False)
class EndCells:
    """Cells next to the end of a body, and those farther than END_DEPTH cells from it."""

    beside: Bools
    inner: Bools

    def pressures(self, pressure: Floats) -> tuple[float, float]:
        """Largest pressures in both [Pa]."""
        at_end, farther = (pressure[cells].max(initial=0.0) for cells in (self.beside, self.inner))
        return float(at_end), float(farther)


def cells_at_end(open_gap: Floats) -> EndCells:
    """Cells at the end of a body whose open gap is +inf outside it [m]."""
    beside, near = (
        np.logical_or.reduce(end_cells(open_gap, depth), axis=0) for depth in (1, END_DEPTH)
    )
    return EndCells(beside, ~near)


def bend_at(open_gap: Floats, grid: Grid, place: tuple[int, int], reach: int = 2) -> float:
    """Largest change of the gap's slope from cell to cell, up to `reach` cells from one [rad]."""
    # A corner of the angle alpha raises the pressure by E* alpha/(2 pi) whenever the cells shrink
    # by a factor e, whatever its shape within a cell is (Johnson 1985, Contact Mechanics, section
    # 5.2).
    lines = [np.arange(middle - reach, middle + reach + 1) for middle in place]
    lines = [
        line % count if repeats else line[(line >= 0) & (line < count)]
        for line, count, repeats in zip(lines, grid.shape, grid.periodic, strict=True)
    ]
    around = np.where(np.isinf(open_gap[np.ix_(*lines)]), np.nan, open_gap[np.ix_(*lines)])
    bends = [np.abs(np.diff(around, 2, axis=axis)) / grid.cell_size[axis] for axis in (0, 1)]
    return max(float(np.nanmax(bend, initial=0.0)) for bend in bends)


def apex_exponent(open_gap: Floats, grid: Grid, place: tuple[int, int]) -> float:
    """Exponent n < 2 of a gap that grows as r^n around a cell, by four cells; 2 where smooth."""
    # The sum of both sides has no tilt.
    exponents = [2.0]
    for axis, (middle, count) in enumerate(zip(place, grid.shape, strict=True)):
        line = np.take(open_gap, place[1 - axis], axis=1 - axis)
        cells = middle + np.array([[-1, 1], [-2, 2], [-4, 4]])
        if grid.periodic[axis]:
            cells = cells % count
        elif cells.min() < 0 or cells.max() >= count:
            continue
        near, far, farther = line[cells].sum(axis=1) - 2 * line[middle]
        if not 0 < near < far < farther < np.inf:
            continue
        inner, outer = np.log2([far / near, farther / far]).tolist()
        # A smooth body deviates from r^2 with the square of the distance, an apex does near by.
        is_smooth = 2 - outer >= SMOOTH_DEVIATION * (2 - inner)
        bends = line[middle] - 2 * line[cells[1]] + line[cells[2]]
        is_edge = bends.min() < (outer - ONE_SIDED) * bends.max()
        if not is_smooth and not is_edge:
            exponents.append(outer)
    return max(min(exponents), 1.0)


def is_sharp(
    indenter: Indenter,
    place: tuple[float, float],
    reach: tuple[float, float],
    cell: tuple[float, float],
    strain: float,
) -> bool:
    """True if a body has a point, ridge or corner within `reach` of `place` along x and y [m]."""
    # Under a wedge or a cone of slope s the pressure goes as E* s log(a/r) (Johnson 1985, Contact
    # Mechanics, sections 5.2 and 5.3). A rounding within a quarter of a cell counts as sharp.
    # Angles are compared with the strain [-].
    return sharpest_angle(indenter, place, reach, cell) > MIN_ANGLE * strain


def sharpest_angle(
    indenter: Indenter,
    place: tuple[float, float],
    reach: tuple[float, float],
    cell: tuple[float, float],
) -> float:
    """Angle of the sharpest corner near a place, 0 where round [rad]; see `is_sharp`."""
    x, y = (_samples(*each) for each in zip(place, reach, cell, strict=True))
    gap = indenter.gap(x[:, None], y[None, :])
    gap = np.where(np.isinf(gap), np.nan, gap)  # where the body ends, nothing bends
    return max(_angle(gap, axis, cell[axis] / SAMPLES) for axis in (0, 1))


def strain_of(peak_pressure: float, compliance: float) -> float:
    """Strain δ/a that belongs to a peak pressure by Hertz, p0 = (2/π) E* δ/a [-]."""
    return np.pi / 2 * peak_pressure * compliance


def _samples(place: float, reach: float, cell: float) -> Floats:
    """Positions on an axis around a place, wide enough to compare slopes all over the reach [m]."""
    count = int(np.ceil(reach / cell * SAMPLES)) + AROUND // 2
    return np.asarray(place + np.arange(-count, count + 1) * cell / SAMPLES)


def _angle(gap: Floats, axis: int, step: float) -> float:
    """Angle of the sharpest corner on lines along an axis, 0 if all are round [rad]."""
    slopes = np.diff(np.moveaxis(gap, axis, 0), axis=0) / step
    aside = (AROUND - QUARTER) // 2
    around = slopes[AROUND:] - slopes[:-AROUND]
    close = (slopes[QUARTER:] - slopes[:-QUARTER])[aside : aside + len(around)]
    is_corner = np.isfinite(around) & (close > CORNER_SHARE * around)
    return float(close[is_corner].max(initial=0.0))
