"""Rim of a contact in the cells of its run, and errors of the rim that all grids share."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.simulation.accuracy.coarser_results import History
from viscontact.simulation.transient.setup import RunSetup

#: Least error of the crests of a rim that waves along a period, in its height over half a cell.
CREST_PART = 2.0

#: Relative rounding of the area of a whole period.
ROUNDING = 1e-9

#: Where cells are long against the thickness of a layer, the pressure falls to the rim as on
#: springs or less steeply, not as on a half-space. Least error of the rim in cells over that ratio,
#: and at most: cylinders on layers of 0.4 to 3 thicknesses per cell err by 0.05 to 0.5 cells.
THIN_RIM_CELLS, MOST_THIN_RIM = 0.12, 0.5

#: Least part of a rectangle around a contact that one round spot fills; an ellipse fills 0.79.
ROUND_SPOT = 0.6

#: Least part of that rectangle that a single strip fills.
ONE_STRIP = 0.98

#: Extents of the contact along x and y.
EXTENTS = ("contact_length", "contact_width")


def tip_curvature(run: RunSetup, history: History) -> Floats:
    """Logarithm of the cells along x, y over the radius of a slender contact's tip; (2, times)."""
    # The contact counts as an ellipse, whose tip at the end of its half axis a has the radius b²/a.
    # It is smaller along an axis along which the contact is shorter. A strip through a whole period
    # has no tip.
    extents = np.array([np.nan_to_num(history[name]) for name in EXTENTS])
    strip = fills_period(run, history).any(axis=0)
    touching = (history["contact_area"] > 0) & (extents > 0).all(axis=0) & ~strip
    longest = np.where(touching, extents.max(axis=0), 1.0)
    breadth = np.where(touching, history["contact_area"] / (np.pi * longest / 2), 1.0)
    cells = np.array(run.grid.cell_size)[:, None] * longest / 2 / breadth**2
    return np.asarray(np.where(touching, np.log1p(2 * cells) * (extents / longest) ** 2, 0.0))


def least_extent_of_area(history: History, area_bars: Floats) -> Floats:
    """Error of both extents of one round contact whose rim is as uncertain as its area [m]."""
    # If both extents are too large by e, the area is by e (1/length + 1/width) of itself.
    length, width = (np.nan_to_num(history[name]) for name in EXTENTS)
    box, area = length * width, history["contact_area"]
    is_round = (area > ROUND_SPOT * box) & (box > 0)
    shares = np.where(is_round, np.nan_to_num(area_bars), 0.0) / np.where(is_round, area, 1.0)
    return np.asarray(shares * box / np.where(is_round, length + width, 1.0))


def recedes(history: History) -> Bools:
    """Times at which the contact is smaller than at the time before."""
    area = history["contact_area"]
    return np.asarray((np.diff(area, prepend=area[:1]) < 0) & (area > 0))


def crest_cells(run: RunSetup, history: History, axis: int) -> Floats:
    """Least error of the crests of a rim that waves along the only period of a grid, in cells."""
    # A crest may lie half a cell beside the lines of cells. The rim counts as one cosine.
    grid, along = run.grid, 1 - axis
    if grid.has_datum or grid.periodic[axis]:
        return np.zeros(len(history["time"]))
    extents = [np.nan_to_num(history[name]) for name in EXTENTS]
    length = np.maximum(extents[along], grid.cell_size[along])
    wave = extents[axis] - history["contact_area"] / length
    wave = np.where(wave > ROUNDING * extents[axis], wave, 0.0)
    heights = wave * (1 - np.cos(np.pi * grid.cell_size[along] / length))
    return np.asarray(CREST_PART * heights / grid.cell_size[axis])


def cells_over_thickness(run: RunSetup, axis: int) -> float:
    """Length of a cell over the thickness of the thinnest layer; 0 on a half-space."""
    thinnest = min(term.response.length for term in run.problem.surface.terms)
    return run.grid.cell_size[axis] / thinnest


def thin_rim_cells(run: RunSetup, axis: int) -> float:
    """Least error of the rim on thin layers, in cells."""
    return min(THIN_RIM_CELLS * cells_over_thickness(run, axis), MOST_THIN_RIM)


def fills_period(run: RunSetup, history: History) -> Bools:
    """Times at which the contact fills the only period of a grid, along x, y; (2, times)."""
    fills = [
        not run.grid.has_datum and repeats and np.nan_to_num(history[name]) >= size
        for name, repeats, size in zip(EXTENTS, run.grid.periodic, run.grid.size, strict=True)
    ]
    return np.array(np.broadcast_arrays(*fills), dtype=bool)


def in_several_strips(run: RunSetup, history: History) -> Bools:
    """Times at which strips with gaps reach through one whole period, and not through two."""
    extents = np.array([np.nan_to_num(history[name]) for name in EXTENTS])
    sizes = np.array(run.grid.size)[:, None]
    spans = (extents >= (1 - ROUNDING) * sizes) & np.array(run.grid.periodic)[:, None]
    gaps = history["contact_area"] < ONE_STRIP * extents.prod(axis=0)
    return np.asarray(spans.any(axis=0) & ~spans.all(axis=0) & gaps)


def cells_across(run: RunSetup, history: History) -> Floats:
    """Cells across the contact, infinite where a whole period is in contact: it has no rim."""
    covered = history["contact_area"] > (1 - ROUNDING) * run.grid.area
    return np.where(all(run.grid.periodic) & covered, np.inf, history["cells_across"])


def cells_of_breadth(run: RunSetup, history: History) -> Floats:
    """Cells across the breadth of a contact that may be slender and turned, as of an ellipse."""
    # Its half axes a, b have a² + b² = x² + y² by its half extents, and a b by its area.
    halves = [np.nan_to_num(history[name]) / 2 for name in EXTENTS]
    squares, product = halves[0] ** 2 + halves[1] ** 2, history["contact_area"] / np.pi
    root = np.sqrt(np.maximum(squares**2 - 4 * product**2, 0.0))
    breadth = 2 * np.sqrt(np.maximum((squares - root) / 2, 0.0))
    cells = breadth / min(run.grid.cell_size)
    return np.where(cells > 0, np.minimum(cells, history["cells_across"]), history["cells_across"])


def cells_along(run: RunSetup, history: History) -> Floats:
    """Cells on the longer extent of the contact, at least 1."""
    along = (np.nan_to_num(history[EXTENTS[k]]) / run.grid.cell_size[k] for k in (0, 1))
    return np.maximum(np.fmax(*along), 1.0)


def slenderness(history: History) -> Floats:
    """Logarithm of the contact's longer extent over its shorter one; 0 without contact."""
    length, width = (np.nan_to_num(history[name]) for name in EXTENTS)
    touching = (length > 0) & (width > 0)
    ratio = np.divide(length, width, out=np.ones_like(length), where=touching)
    return np.abs(np.log(ratio))
