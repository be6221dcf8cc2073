"""Rim of the contact as smooth polygons."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias

import numpy as np
import scipy

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.mechanics.contact.body_edge import Outline
from viscontact.results.snapshots import Snapshot

# Cells beyond the border of a period: a corner of the rim is up to one and a half cells from its
# traced position, depends on the gap one cell around, and is smoothed with the next corners.
_BEYOND = 4
# Criterion of a smooth rim: mean distance of the curve from the corners [cells], and largest number
# of its pieces, in total and per corner: Hertz's ellipses and contacts of rollers need 7 to 35,
# rough contacts and pyramids three times the limit.
_LOOSE, _PIECES = 0.05, (8, 0.1)
# Mean and largest distance of the drawn curve from the corners [cells], its pieces per corner, and
# the least number of corners.
_CLOSE, _STRAY, _FINER, _ENOUGH = 0.02, 0.2, 6, 16

#: Steps to the four neighbours of a cell, anticlockwise.
_WAYS = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])

#: Points on the mesh of cells, shape (n, 2).
Corners: TypeAlias = Floats


def rim_polygons(snapshot: Snapshot) -> list[Floats]:
    """Closed polygons of the rim, shape (n, 2) [m]: one per spot, and per hole in a spot."""
    # Just outside a smooth rim the gap opens as distance^(3/2) for every law, so gap^(2/3) is
    # linear there and points to the rim. Every open cell next to the contact gives one corner: the
    # foot of its steepest descent to zero. Following the gradient keeps the polygon smooth where
    # the rim runs almost along a grid line. Where the body ends, the corner is its end, or half-way
    # between the cells if that is not known.
    return [first + cell * _close(_spread(found)) for found, _, first, cell in _polygons(snapshot)]


def rim_curves(snapshot: Snapshot) -> list[Floats]:
    """Closed curves of the rim, shape (n, 2) [m]: splines where it is smooth, else the polygons."""
    # Smoothing spline of FITPACK (Dierckx, Curve and Surface Fitting with Splines, 1993) with the
    # least number of knots for a mean-square distance of part of a cell from the corners. The
    # corners of Hertz's ellipses are off by 0.02 to 0.05 cells, to both sides, while the polygon
    # lies inside. A rim with corners, or a rough one, needs many knots: it remains a polygon.
    return [
        first + cell * (_spline(found) if steady else _close(_spread(found)))
        for found, steady, first, cell in _polygons(snapshot)
    ]


def _polygons(snapshot: Snapshot) -> Iterator[tuple[Corners, bool, Corners, Corners]]:
    """Corners of each polygon [cells], whether the gap gives all, and the mesh's place [m]."""
    # A border of open cells closes every polygon of a grid that is not periodic.
    snapshot = beyond_period(snapshot).with_border(1)
    contact = snapshot.in_contact
    offsets = offsets_from_rim(contact, snapshot.gap)
    first = np.array([snapshot.x[0], snapshot.y[0]])
    cell = np.array([snapshot.x[1], snapshot.y[1]]) - first
    for inner, outer in _borders(contact):
        yield (*_corners_on_rim(inner, outer, offsets, snapshot.body_end), first, cell)


def _borders(contact: Bools) -> Iterator[tuple[Integers, Integers]]:
    """Cells inside and outside along each closed border, anticlockwise around a spot."""
    beyond = [np.roll(contact, tuple(-way), (0, 1)) for way in _WAYS]
    side, i, j = np.nonzero(contact & ~np.array(beyond))
    inner, outwards, ahead = np.stack([i, j], axis=1), _WAYS[side], _WAYS[(side + 1) % 4]
    # In the order of the meshes, between four cells each, that the border enters.
    entered = inner + np.minimum(outwards, 0) + np.minimum(ahead, 0)
    order = np.lexsort(entered.T)
    side, inner, outwards, ahead = (each[order] for each in (side, inner, outwards, ahead))
    number = np.full((4, *contact.shape), -1)
    number[side, *inner.T] = np.arange(side.size)
    at_left, at_right = inner + ahead, inner + ahead + outwards
    turned_right = number[(side - 1) % 4, *at_right.T]
    # Spots that share a corner only are separate.
    straight = np.where(contact[*at_right.T], turned_right, number[side, *at_left.T])
    following = np.where(contact[*at_left.T], straight, number[(side + 1) % 4, *inner.T]).tolist()
    unused = [True] * side.size
    for start in range(side.size):
        border, at = [], start
        while unused[at]:
            unused[at] = False
            border.append(at)
            at = following[at]
        if border:
            yield inner[border], (inner + outwards)[border]


def beyond_period(snapshot: Snapshot) -> Snapshot:
    """Periodic fields with the cells of the next periods that the rim depends on."""
    return snapshot.with_border(_BEYOND) if any(snapshot.periodic) else snapshot


def offsets_from_rim(contact: Bools, gap: Floats) -> Floats:
    """Offset of each open cell's centre from the rim [cells], (nx, ny, 2); NaN if unknown."""
    usable = ~contact & np.isfinite(gap)
    opening = np.where(usable, np.cbrt(np.maximum(np.where(usable, gap, 0.0), 0.0)) ** 2, np.nan)
    slopes = np.stack([_slope(opening), _slope(opening.T).T], axis=-1)
    steepness = np.square(slopes).sum(axis=-1, keepdims=True)
    steepness[steepness == 0] = np.nan
    offsets: Floats = opening[..., None] * slopes / steepness
    return offsets


def _slope(opening: Floats) -> Floats:
    """Mean of the forward and backward differences that exist along the first axis."""
    outside = np.full((1, opening.shape[1]), np.nan)
    steps = np.diff(np.vstack([outside, opening, outside]), axis=0)
    both = np.stack([steps[:-1], steps[1:]])
    count = np.isfinite(both).sum(axis=0)
    mean: Floats = np.nansum(both, axis=0) / np.maximum(count, 1)
    return mean


def _corners_on_rim(
    inner: Integers, outer: Integers, offsets: Floats, body_end: Outline | None
) -> tuple[Corners, bool]:
    """Corners half-way between cells, moved onto the rim, once for each open cell [cells]."""
    before, after = np.minimum(inner, outer), np.maximum(inner, outer)
    offset = offsets[tuple(outer.T)]
    # Beyond a cell and a half there is no rim, but a gap that does not open monotonically.
    trusted = np.linalg.norm(offset, axis=1) <= 1.5
    on_line = inner + _share_to_end(before, after, body_end)[:, None] * (outer - inner)
    moved = np.where(trusted[:, None], outer - offset, on_line)
    polygon = moved[np.any(moved != np.roll(moved, 1, axis=0), axis=1)]
    return polygon, bool(trusted.all())


def _spread(polygon: Corners) -> Corners:
    """Smooth the remaining steps, below a tenth of a cell, over neighbouring corners."""
    smooth: Corners = (np.roll(polygon, 1, axis=0) + 2 * polygon + np.roll(polygon, -1, axis=0)) / 4
    return smooth


def _close(polygon: Corners) -> Corners:
    return np.vstack([polygon, polygon[:1]])


def _spline(polygon: Corners) -> Corners:
    """Smooth closed curve past the corners, or the polygon if there is none [cells]."""
    if len(polygon) >= _ENOUGH:
        corners = _close(polygon)
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(corners, axis=0).T)))
        loose, curve = (_fit_spline(corners, along, scatter) for scatter in (_LOOSE, _CLOSE))
        strays = np.hypot(*(np.transpose(scipy.interpolate.splev(along, curve)) - corners).T)
        pieces = len(loose[0]) - 7  # three knots more at either end of a cubic
        if pieces <= _PIECES[0] + _PIECES[1] * len(polygon) and strays.max() <= _STRAY:
            finer = np.linspace(0.0, along[-1], _FINER * len(polygon) + 1)
            return np.transpose(scipy.interpolate.splev(finer, curve))
    return _close(_spread(polygon))


def _fit_spline(corners: Corners, along: Floats, scatter: float) -> Any:
    """Periodic spline with a given mean-square distance from the corners [cells]."""
    left = len(corners) * scatter**2
    (spline, _), *_ = scipy.interpolate.splprep(
        corners.T, u=along, per=1, s=left, full_output=1, quiet=2
    )
    return spline


def _share_to_end(before: Integers, after: Integers, body_end: Outline | None) -> Floats:
    """Position of the end of the body between the inner and outer cell, 0.5 if unknown."""
    share = np.full(len(before), 0.5)
    if body_end is not None:
        along_x = after[:, 0] > before[:, 0]
        share[along_x] = body_end.along_x[tuple(before[along_x].T)]
        share[~along_x] = body_end.along_y[tuple(before[~along_x].T)]
    return np.where(np.isfinite(share), share, 0.5)
