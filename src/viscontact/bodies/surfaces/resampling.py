"""Resampling of a measured surface to another mesh, with a stated filter."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.bodies.surfaces.surface import Surface
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import both_lengths, real

Filter = Literal["mean", "gaussian", "spline"]

#: ISO 16610-21: a wave of the cutoff wavelength is transmitted at half its height.
ALPHA = math.sqrt(math.log(2) / math.pi)

#: Cutoff of the Gaussian filter in cells: of waves of two cells, the shortest that the new mesh
#: can hold, 6 % are left.
CUTOFF_CELLS = 4.0

#: Weights below this part of the largest are left out.
_NEGLIGIBLE = 1e-12

#: Upper limit on the points of a mesh.
_MOST_POINTS = 2**26


def resampled(
    surface: Surface,
    cell: float | tuple[float, float],
    filter: Filter = "mean",
    *,
    cutoff: float | None = None,
) -> Surface:
    """Resample a surface to another spacing.

    Parameters
    ----------
    surface : Surface
        The surface.
    cell : float or pair of float
        New spacing, along x and y [m].
    filter : {"mean", "gaussian", "spline"}, optional
        ``"mean"``: each new height is the mean over its cell, for coarser meshes;
        ``"gaussian"``: the weighted mean of ISO 16610 around the new point, for coarser meshes;
        ``"spline"``: cubic splines through the points, for finer meshes.
    cutoff : float, optional
        Wavelength of which the Gaussian filter passes half the height; four cells when left
        out [m].

    Returns
    -------
    Surface
        Around the same middle; as many whole cells as the map holds. A new point is missing if
        more than half of the weight of its mean is missing.

    Raises
    ------
    ValueError
        If a filter is not for that spacing, less than two cells fit, points are missing under
        a spline, or a periodic map is no whole number of cells.

    Notes
    -----
    The Gaussian passes exp(-ln 2 (cutoff/wavelength)²) of a wave's height. Near the border
    it is normalised by the weights within the map.

    Examples
    --------
    >>> steps = Surface([[0.0, 0.0], [2.0, 2.0], [4.0, 4.0], [6.0, 6.0]], 1.0)
    >>> resampled(steps, (2.0, 1.0)).heights[:, 0].tolist()
    [1.0, 5.0]
    """
    cells = both_lengths("cell", cell)
    if filter == "spline":
        return _through(surface, cells)
    if filter == "mean":
        weights: tuple[Callable[[Floats], Floats], ...] = tuple(
            _overlap(old, new) for old, new in zip(surface.spacing, cells, strict=True)
        )
        reach = [(old + new) / 2 for old, new in zip(surface.spacing, cells, strict=True)]
    elif filter == "gaussian":
        wave = None if cutoff is None else real("cutoff", cutoff, "m")
        waves = [CUTOFF_CELLS * each if wave is None else wave for each in cells]
        _require_wide(surface, waves)
        weights = tuple(_bell(wave) for wave in waves)
        reach = [ALPHA * wave * math.sqrt(-math.log(_NEGLIGIBLE) / math.pi) for wave in waves]
    else:
        raise ValueError(f"filter must be 'mean', 'gaussian' or 'spline', got {filter!r}")
    _require_coarser(surface, cells, filter)
    along = [_matrix(surface, axis, cells[axis], weights[axis], reach[axis]) for axis in (0, 1)]
    known = (~surface.missing).astype(np.float64)
    total = _both_ways(along, np.ones(surface.shape))
    share = _both_ways(along, known)
    reference = float(np.nanmean(surface.heights))
    sums = _both_ways(along, np.where(surface.missing, 0.0, surface.heights - reference))
    is_known = share >= total / 2
    heights = np.full(share.shape, np.nan)
    heights[is_known] = sums[is_known] / share[is_known] + reference
    return Surface(heights, cells, name=surface.name, periodic=surface.periodic)


def _require_coarser(surface: Surface, cells: tuple[float, float], filter: str) -> None:
    finer = [c < s * (1 - 1e-9) for c, s in zip(cells, surface.spacing, strict=True)]
    if any(finer):
        axis = finer.index(True)
        raise ValueError(
            f"resample: cells of {format_quantity(cells[axis], 'm')} are finer than the points, "
            f"{format_quantity(surface.spacing[axis], 'm')} apart, and the filter {filter!r} is "
            "for coarser meshes; use filter: spline"
        )


def _require_wide(surface: Surface, waves: list[float]) -> None:
    for wave, spacing, size in zip(waves, surface.spacing, surface.size, strict=True):
        # Sampled more coarsely, the Gaussian does not have the stated transmission.
        if not 4 * spacing * (1 - 1e-9) <= wave <= size:
            raise ValueError(
                "cutoff must be from four times the distance of the points to the size of the "
                f"map, {format_quantity(4 * spacing, 'm')} to {format_quantity(size, 'm')}, got "
                f"{format_quantity(wave, 'm', 6)}"
            )


def _overlap(old: float, new: float) -> Callable[[Floats], Floats]:
    """Weight of a mean filter: overlap of a new cell and an old one by distance [m]."""

    def weight(distance: Floats) -> Floats:
        return np.clip((old + new) / 2 - np.abs(distance), 0.0, min(old, new))

    return weight


def _bell(wave: float) -> Callable[[Floats], Floats]:
    def weight(distance: Floats) -> Floats:
        return np.asarray(np.exp(-np.pi * (distance / (ALPHA * wave)) ** 2))

    return weight


def _matrix(
    surface: Surface, axis: int, cell: float, weight: Callable[[Floats], Floats], reach: float
) -> scipy.sparse.csr_matrix:
    """Weights of the old points along an axis, a row for each new one."""
    old, spacing = surface.shape[axis], surface.spacing[axis]
    new = _count(surface, axis, cell)
    middle = (old - 1) / 2 + (np.arange(new) - (new - 1) / 2) * (cell / spacing)
    wide = math.ceil(reach / spacing) + 1
    points = np.rint(middle).astype(np.intp)[:, np.newaxis] + np.arange(-wide, wide + 1)
    values = weight((points - middle[:, np.newaxis]) * spacing)
    # Without rounding residuals of cells that only touch.
    within = values > _NEGLIGIBLE * values.max()
    within &= True if surface.periodic else (points >= 0) & (points < old)
    rows = np.broadcast_to(np.arange(new)[:, np.newaxis], points.shape)
    entries = (values[within], (rows[within], points[within] % old))
    return scipy.sparse.coo_matrix(entries, shape=(new, old)).tocsr()


def _count(surface: Surface, axis: int, cell: float) -> int:
    """Number of whole cells along an axis of the map."""
    size = surface.size[axis]
    count = math.floor(size / cell * (1 + 1e-9))
    if not 2 <= count <= _MOST_POINTS:
        raise ValueError(
            f"resample: {count} cells of {format_quantity(cell, 'm')} fit on the "
            f"{format_quantity(size, 'm')} of {surface.name} along {'xy'[axis]}; choose cells of "
            "half that length or less"
        )
    if surface.periodic and not math.isclose(count * cell, size, rel_tol=1e-9):
        raise ValueError(
            f"resample: {surface.name} is periodic over {format_quantity(size, 'm', 6)} along "
            f"{'xy'[axis]}, which are no whole number of cells of {format_quantity(cell, 'm', 6)}; "
            f"use {format_quantity(size / count, 'm', 6)}"
        )
    return count


def _both_ways(along: list[scipy.sparse.csr_matrix], field: Floats) -> Floats:
    return np.asarray((along[1] @ (along[0] @ field).T).T)


def _through(surface: Surface, cells: tuple[float, float]) -> Surface:
    """Interpolate by cubic splines, between the outermost points."""
    if surface.missing.any():
        raise ValueError(
            f"missing: a spline needs all points, and {surface.missing_share:.2%} of "
            f"{surface.name} are missing; fill them first"
        )
    places = []
    for axis, cell in enumerate(cells):
        old, spacing = surface.shape[axis], surface.spacing[axis]
        if surface.periodic:
            new = _count(surface, axis, cell)
        else:
            new = math.floor((old - 1) * spacing / cell * (1 + 1e-9)) + 1
        if new < 2 or cell > spacing * (1 + 1e-9):
            raise ValueError(
                f"resample: cells of {format_quantity(cell, 'm')} are no finer than the points, "
                f"{format_quantity(spacing, 'm')} apart, and the filter 'spline' is for finer "
                "meshes; use filter: mean or gaussian"
            )
        if new > _MOST_POINTS:
            raise ValueError(f"resample: {new} points along {'xy'[axis]} are too many")
        places.append((old - 1) / 2 + (np.arange(new) - (new - 1) / 2) * (cell / spacing))
    if places[0].size * places[1].size > _MOST_POINTS:
        raise ValueError(
            f"resample: {places[0].size} x {places[1].size} points are more than any grid holds; "
            "choose larger cells, or crop the map"
        )
    mode = "grid-wrap" if surface.periodic else "mirror"
    mesh = np.meshgrid(*places, indexing="ij")
    heights = scipy.ndimage.map_coordinates(surface.heights, mesh, order=3, mode=mode)
    return Surface(heights, cells, name=surface.name, periodic=surface.periodic)
