"""Relief of the pressure, smooth up to the rim of the contact."""

from __future__ import annotations

import math

import numpy as np
import scipy

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.relief import Relief, relief
from viscontact.drawing.content.rim import beyond_period
from viscontact.drawing.content.squared_pressure import squared_pressure
from viscontact.drawing.content.window import Window
from viscontact.results.snapshots import Snapshot
from viscontact.units.formatting import ReadableUnit

#: Largest number of cells drawn along each axis; of more, blocks are drawn by their largest value.
_MOST = 180
# The square of the pressure is interpolated linearly between the cells: it is smooth up to the rim.
# Largest number of points along each axis, and of parts of a cell.
_POINTS, _FINEST = 200, 4
# Largest distance over which the rim is extrapolated from a point [points].
_TRUSTED = 1.5


def pressure_relief(snapshot: Snapshot, window: Window, unit: ReadableUnit) -> Relief:
    """Relief of the pressure in contact, with points between cells and at the rim."""
    thin = thinned(beyond_period(snapshot).with_border(1), _cells_in_one(snapshot))
    squared, x, y = _around_contact(_with_corners(squared_pressure(thin)), thin.x, thin.y)
    parts = max(1, min(_FINEST, _POINTS // max(squared.shape)))
    squared, x, y = (
        _interpolate_rows(_interpolate_rows(squared, parts).T, parts).T,
        _interpolate_rows(x, parts),
        _interpolate_rows(y, parts),
    )
    pressed = squared > 0
    points = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    moved = points + _to_rim(squared) * (x[1] - x[0], y[1] - y[0])
    points = np.where(pressed[..., None], points, moved)
    inside = pressed | _neighbouring(pressed)
    if any(snapshot.periodic):
        x_low, x_high, y_low, y_high = snapshot.borders()
        inside &= ((x_low <= x) & (x <= x_high))[:, None] & (y_low <= y) & (y <= y_high)
    height = unit(np.sqrt(np.maximum(squared, 0.0)))
    drawn = window.unit(points)
    surface = relief(drawn[..., 0], drawn[..., 1], height, height, inside)
    raised = surface.values > 0
    return Relief(surface.corners[raised], surface.values[raised])


def _around_contact(squared: Floats, x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
    """Part with contact, and one cell more on each side."""
    i, j = (np.flatnonzero((squared > 0).any(axis=axis)) for axis in (1, 0))
    rows, columns = slice(max(i[0] - 1, 0), i[-1] + 2), slice(max(j[0] - 1, 0), j[-1] + 2)
    return squared[rows, columns], x[rows], y[columns]


def _with_corners(squared: Floats) -> Floats:
    """Continue the square linearly to cells that share only a corner with the contact."""
    total, count = np.zeros_like(squared), np.zeros_like(squared)
    for i, j in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        inner = np.roll(squared, (i, j), (0, 1))
        neighbours = np.roll(squared, i, 0), np.roll(squared, j, 1)
        known = (squared == 0) & (inner > 0) & (neighbours[0] < 0) & (neighbours[1] < 0)
        total += np.where(known, neighbours[0] + neighbours[1] - inner, 0.0)
        count += known
    return np.where(count > 0, total / np.maximum(count, 1), squared)


def _interpolate_rows(values: Floats, parts: int) -> Floats:
    """Interpolate along the first axis, with `parts` points per interval."""
    at = np.arange((len(values) - 1) * parts + 1) / parts
    lower = np.minimum(at.astype(int), len(values) - 2)
    share = (at - lower).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray((1 - share) * values[lower] + share * values[lower + 1])


def _to_rim(squared: Floats) -> Floats:
    """Distance from each point to the zero of the square by its slope [points]."""
    slope = np.stack([np.gradient(squared, axis=axis) for axis in (0, 1)], axis=-1)
    steepness = np.square(slope).sum(axis=-1, keepdims=True)
    way = -squared[..., None] * slope / np.where(steepness > 0, steepness, np.inf)
    far = np.linalg.norm(way, axis=-1, keepdims=True) > _TRUSTED
    return np.where(far, 0.0, way)


def _cells_in_one(snapshot: Snapshot) -> tuple[int, int]:
    """Number of cells in a drawn one, along x and y."""
    x_low, x_high, y_low, y_high = snapshot.extent()
    dx, dy = snapshot.cell_size
    along, across = (x_high - x_low) / dx, (y_high - y_low) / dy
    return math.ceil(along / _MOST - 1e-9), math.ceil(across / _MOST - 1e-9)


def thinned(snapshot: Snapshot, count: tuple[int, int]) -> Snapshot:
    """Snapshot of blocks of cells, with the largest pressure and the least gap of each."""
    if count == (1, 1):
        return snapshot
    (i, j), (nx, ny) = count, (n // c for n, c in zip(snapshot.pressure.shape, count, strict=True))
    x, y = snapshot.x[: nx * i].reshape(nx, i).mean(1), snapshot.y[: ny * j].reshape(ny, j).mean(1)
    blocks = (
        field[: nx * i, : ny * j].reshape(nx, i, ny, j)
        for field in (snapshot.pressure, snapshot.gap, snapshot.in_contact)
    )
    pressure, gap, touched = blocks
    return Snapshot(
        snapshot.time, x, y, pressure.max((1, 3)), gap.min((1, 3)), np.any(touched, axis=(1, 3))
    )


def _neighbouring(contact: Bools) -> Bools:
    """Mask of the cells that share an edge or a corner with one in contact."""
    return np.asarray(
        scipy.ndimage.binary_dilation(contact, np.ones((3, 3), dtype=np.bool_)), dtype=np.bool_
    )
