"""The rim of the contact as smooth polygons."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from contourpy import LineType, contour_generator
from matplotlib.path import Path
from numpy.typing import NDArray

from viscontact.outline import Outline
from viscontact.plot.snapshots import Snapshot

# Cells beyond the border of a period: a corner of the rim lies up to one and a half cells from
# where it is traced, is found from the gap a cell around and smoothed with the next corners.
_BEYOND = 4


def rim_polygons(snapshot: Snapshot) -> list[NDArray[np.float64]]:
    """Trace the rim of the contact at one instant, between the cells.

    Parameters
    ----------
    snapshot : Snapshot
        Pressure and gap.

    Returns
    -------
    list of ndarray
        One closed polygon for each spot, and each hole in a spot, shape (n, 2) [m]. Contact that
        crosses the border of a period is followed some cells beyond it and closed there.

    Notes
    -----
    Just outside a smooth rim the gap opens as distance^(3/2), whatever the law, so gap^(2/3)
    is linear there and points back at the rim. Every open cell next to the contact gives one
    corner: the foot of its steepest descent to zero. Following the gradient keeps the polygon
    smooth where the rim runs almost along a grid line. Where the body ends, the corner is where
    it does, or half-way between the cells if that is not known.

    Examples
    --------
    A circular rim of radius 9.3, on cells of size 1:

    >>> x = np.arange(-12.5, 13.0)
    >>> outside = np.hypot(x[:, None], x) - 9.3
    >>> gap = np.maximum(outside, 0.0) ** 1.5
    >>> polygon, = rim_polygons(Snapshot(0.0, x, x, 1.0 * (outside < 0), gap))
    >>> float(np.abs(np.hypot(*polygon.T) - 9.3).max().round(2))
    0.04
    """
    # Open cells all around close every polygon, at the border of a grid that is not periodic.
    snapshot = beyond_period(snapshot).with_border(1)
    contact = snapshot.pressure > 0
    offsets = offsets_from_rim(contact, snapshot.gap)
    end = snapshot.body_end
    tracer = contour_generator(
        z=contact.T.astype(np.float64), line_type=LineType.Separate, name="serial"
    )
    first = np.array([snapshot.x[0], snapshot.y[0]])
    cell = np.array([snapshot.x[1], snapshot.y[1]]) - first
    # The contour of 1 inside and 0 outside runs half-way between the cells, in order.
    return [
        first + cell * _moved(np.asarray(corners), contact, offsets, end)
        for corners in tracer.lines(0.5)
    ]


def beyond_period(snapshot: Snapshot) -> Snapshot:
    """Continue periodic fields as far as the rim and contours at the border depend on.

    Parameters
    ----------
    snapshot : Snapshot
        Pressure and gap.

    Returns
    -------
    Snapshot
        With some cells of the next periods around; as given if it is not periodic.
    """
    return snapshot.with_border(_BEYOND) if snapshot.periodic else snapshot


def offsets_from_rim(contact: NDArray[np.bool_], gap: NDArray[np.float64]) -> NDArray[np.float64]:
    """Find the way to each open cell from the rim, as its gap and its neighbours' tell.

    Parameters
    ----------
    contact : ndarray of bool
        Cells in contact, shape (nx, ny).
    gap : ndarray
        Distance between the bodies, shape (nx, ny) [m].

    Returns
    -------
    ndarray
        Shape (nx, ny, 2) [cells]: from where gap^(2/3), taken as linear around the cell, is
        zero, to the cell's centre; NaN in contact and where the gap tells nothing.
    """
    usable = ~contact & np.isfinite(gap)
    opening = np.where(usable, np.cbrt(np.maximum(np.where(usable, gap, 0.0), 0.0)) ** 2, np.nan)
    slopes = np.stack([_slope(opening), _slope(opening.T).T], axis=-1)
    steepness = np.square(slopes).sum(axis=-1, keepdims=True)
    steepness[steepness == 0] = np.nan
    offsets: NDArray[np.float64] = opening[..., None] * slopes / steepness
    return offsets


def rim_path(polygons: Iterable[NDArray[np.float64]]) -> Path:
    """Make one closed path of all polygons of a rim.

    Parameters
    ----------
    polygons : iterable of ndarray
        What `rim_polygons` returned, in the axes' unit.

    Returns
    -------
    matplotlib.path.Path
        Spots, with the holes in them left out.
    """
    return Path.make_compound_path(*(Path(polygon, closed=True) for polygon in polygons))


def _slope(opening: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean of the forward and backward differences that exist along the first axis."""
    outside = np.full((1, opening.shape[1]), np.nan)
    steps = np.diff(np.vstack([outside, opening, outside]), axis=0)
    both = np.stack([steps[:-1], steps[1:]])
    count = np.isfinite(both).sum(axis=0)
    mean: NDArray[np.float64] = np.nansum(both, axis=0) / np.maximum(count, 1)
    return mean


def _moved(
    corners: NDArray[np.float64],
    contact: NDArray[np.bool_],
    offsets: NDArray[np.float64],
    body_end: Outline | None,
) -> NDArray[np.float64]:
    """Corners half-way between cells moved onto the rim, once for each open cell [cells]."""
    before, after = np.floor(corners).astype(int), np.ceil(corners).astype(int)
    starts_inside = contact[tuple(before.T)][:, None]
    inner, outer = np.where(starts_inside, before, after), np.where(starts_inside, after, before)
    offset = offsets[tuple(outer.T)]
    # More than a cell and a half away is no rim but a gap that does not open steadily.
    trusted = np.linalg.norm(offset, axis=1) <= 1.5
    on_line = inner + _share_to_end(before, after, body_end)[:, None] * (outer - inner)
    moved = np.where(trusted[:, None], outer - offset, on_line)
    polygon = moved[np.any(moved != np.roll(moved, 1, axis=0), axis=1)]
    # What is left of the staircase, under a tenth of a cell, is spread over the neighbours.
    smooth = (np.roll(polygon, 1, axis=0) + 2 * polygon + np.roll(polygon, -1, axis=0)) / 4
    return np.vstack([smooth, smooth[:1]])


def _share_to_end(
    before: NDArray[np.int_], after: NDArray[np.int_], body_end: Outline | None
) -> NDArray[np.float64]:
    """How far from the inner to the outer cell the body reaches, a half if not known."""
    share = np.full(len(before), 0.5)
    if body_end is not None:
        along_x = after[:, 0] > before[:, 0]
        share[along_x] = body_end.along_x[tuple(before[along_x].T)]
        share[~along_x] = body_end.along_y[tuple(before[~along_x].T)]
    return np.where(np.isfinite(share), share, 0.5)
