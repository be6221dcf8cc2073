"""Cropping, flipping and sweeping of measured surfaces."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.surfaces.surface import Surface
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import positive, real_array

#: Upper limit on the points of a swept line scan across its direction.
_MOST_ACROSS = 4096


def cropped(
    surface: Surface,
    x: tuple[float, float] | None = None,
    y: tuple[float, float] | None = None,
) -> Surface:
    """Return the part of a surface between two distances from its first corner.

    Parameters
    ----------
    surface : Surface
        The surface.
    x, y : pair of float, optional
        From where to where, counted from the corner of the first point; all when left out [m].

    Returns
    -------
    Surface
        The points within, centred at the origin, and not periodic.

    Raises
    ------
    ValueError
        If a range is no range within the map, or fewer than two points lie in it.

    Examples
    --------
    >>> cropped(Surface(np.zeros((10, 10)), 1e-6), x=(2e-6, 7e-6)).shape
    (5, 10)
    """
    if x is None and y is None:
        return surface
    rows, columns = (_points_within(surface, axis, part) for axis, part in enumerate((x, y)))
    return Surface(surface.heights[rows, columns], surface.spacing, name=surface.name)


def _points_within(surface: Surface, axis: int, part: tuple[float, float] | None) -> slice:
    """Slice of the points whose cells lie within a range [m] by more than half."""
    if part is None:
        return slice(None)
    name, size, spacing = "xy"[axis], surface.size[axis], surface.spacing[axis]
    limits = real_array(f"crop: {name}", part, "m", 1).tolist()
    if len(limits) != 2 or not 0 <= limits[0] < limits[1] <= size * (1 + 1e-9):
        raise ValueError(
            f"crop: {name} must go from a distance to a larger one within the map's "
            f"{format_quantity(size, 'm', 6)}, counted from its first corner, got "
            f"{' to '.join(format_quantity(each, 'm', 6) for each in limits)}"
        )
    first, last = (round(each / spacing) for each in limits)
    if last - first < 2:
        raise ValueError(
            f"crop: {name} keeps {last - first} points, {format_quantity(spacing, 'm')} apart; at "
            "least 2 are needed"
        )
    return slice(first, last)


def flipped(surface: Surface) -> Surface:
    """Return a surface turned upside down: for heights stored as depths, or a replica.

    Parameters
    ----------
    surface : Surface
        The surface.

    Returns
    -------
    Surface
        With the signs of its heights changed.

    Examples
    --------
    >>> flipped(Surface([[0.0, 1e-6], [0.0, 0.0]], 1e-6)).heights[0].tolist()
    [-0.0, -1e-06]
    """
    return surface.with_heights(-surface.heights)


def swept(surface: Surface, width: float) -> Surface:
    """Extend a line scan across its direction, as ridges of a ground surface with its lay along y.

    Parameters
    ----------
    surface : Surface
        With a single point along x or along y.
    width : float
        Width of the ridges [m].

    Returns
    -------
    Surface
        The same line over and over, along x; as fine across as along, or of 4096 points.

    Raises
    ------
    ValueError
        If it is no line scan, or the width is no length.

    Examples
    --------
    >>> swept(Surface([[0.0], [1e-6], [0.0]], 1e-6), width=2e-6).shape
    (3, 2)
    """
    if min(surface.shape) != 1:
        raise ValueError(
            f"width: is for line scans, and {surface.name} is a map of {surface.shape[0]} x "
            f"{surface.shape[1]} points; leave it out"
        )
    wide = positive("width", width, "m")
    line = surface.heights.ravel()
    step = surface.spacing[0 if surface.shape[0] > 1 else 1]
    across = min(max(2, round(wide / step)), _MOST_ACROSS)
    heights = np.repeat(line[:, np.newaxis], across, axis=1)
    return Surface(heights, (step, wide / across), name=surface.name, notes=surface.notes)
