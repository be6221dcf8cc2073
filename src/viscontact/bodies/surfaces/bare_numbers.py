"""Height maps and line scans from rows of numbers without a heading."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.surfaces.markers import NOT_MEASURED, without_markers
from viscontact.bodies.surfaces.point_tables import on_mesh, places_on_mesh
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.units import Units
from viscontact.tables import Row, decimal_number, looks_like_number

#: Fewer rows of two or three numbers are a small map, not points.
_LEAST_POINTS = 4
# Steps of a list in its own unit agree so far with the given ones, in their ratio.
_SAME_RATIO = 1e-2


def is_bare(rows: list[Row]) -> bool:
    """True if the first row has heights alone."""
    return all(cell.lower() in NOT_MEASURED or looks_like_number(cell) for cell in rows[0].cells)


def surface_of_numbers(name: str, rows: list[Row], units: Units) -> Surface:
    """Surface of bare rows: scan lines along x, or points x, y, height or x, height.

    Three columns are points if the first two are places on a mesh, and two if the first increases.
    """
    numbers = _numbers(name, rows)
    if numbers.shape[0] == 3 and _is_list_of_points(name, numbers):
        return surface_of_places(name, (numbers[0], numbers[1]), numbers[2], units)
    if numbers.shape[0] == 2 and _increases(numbers[0]):
        return surface_of_places(name, (numbers[0], np.zeros_like(numbers[0])), numbers[1], units)
    if numbers.shape[0] == 1:
        numbers = numbers.T
    heights, notes = without_markers(numbers)
    return Surface(heights * units.height_scale, units.steps, name=name, notes=notes)


def _numbers(name: str, rows: list[Row]) -> Floats:
    """Numbers [column, row]; NaN where there is none."""
    width = len(rows[0].cells)
    comma = any("," in cell for row in rows for cell in row.cells)
    numbers = np.full((width, len(rows)), np.nan)
    for j, row in enumerate(rows):
        if len(row.cells) != width:
            raise ValueError(
                f"{name}:{row.line} has {len(row.cells)} heights, the first row {width}; write "
                "nan where none was measured"
            )
        for i, cell in enumerate(row.cells):
            if cell.lower() in NOT_MEASURED:
                continue
            try:
                numbers[i, j] = float(decimal_number(cell, "," if comma else "."))
            except ValueError as error:
                raise ValueError(f"{name}:{row.line}: height {i + 1}: {error}") from None
    return numbers


def _is_list_of_points(name: str, numbers: Floats) -> bool:
    """True if the first two columns are places on an even mesh, each taken once, most of it."""
    x, y = numbers[0], numbers[1]
    if x.size < _LEAST_POINTS or np.isnan(numbers[:2]).any() or np.ptp(x) == 0 or np.ptp(y) == 0:
        return False
    try:
        (i, _), (j, _) = places_on_mesh(name, "x", x), places_on_mesh(name, "y", y)
    except ValueError:
        return False
    across = int(j.max()) + 1
    is_once = np.unique(i * across + j).size == x.size
    return is_once and (int(i.max()) + 1) * across <= 2 * int(x.size)


def _increases(positions: Floats) -> bool:
    return positions.size >= _LEAST_POINTS and bool(np.all(np.diff(positions) > 0))


def surface_of_places(
    name: str, positions: tuple[Floats, Floats], values: Floats, units: Units
) -> Surface:
    """Surface of points whose positions have no unit of their own: their spacing is the given."""
    axes = zip("xy", positions, strict=True)
    own = [places_on_mesh(name, axis, each, unit="")[1] for axis, each in axes]
    scale = units.height_scale
    shown = " and ".join(f"{step:.6g}" for step in own if step)
    if units.spacing is None:
        raise ValueError(
            f"spacing is missing: the points of {name} lie {shown} apart in a unit that it does "
            "not state; give their distance with its unit"
        )
    given = np.broadcast_to(np.asarray(units.spacing, dtype=np.float64), 2)
    ratios = [stated / step for stated, step in zip(given.tolist(), own, strict=True) if step]
    if max(ratios) > (1 + _SAME_RATIO) * min(ratios):
        raise ValueError(
            f"spacing: the points of {name} lie {shown} apart along x and y in its own unit; give "
            "two distances in this ratio"
        )
    heights, notes = without_markers(values)
    scaled = [each * ratios[0] for each in positions]
    return on_mesh(name, (scaled[0], scaled[1]), heights * scale, notes=notes)
