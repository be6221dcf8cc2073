"""Height maps and line scans from tables with a row for each point."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.bodies.surfaces.markers import LENGTH_UNITS, NOT_MEASURED, without_markers
from viscontact.bodies.surfaces.surface import Surface
from viscontact.tables import Row, Table, read_source, read_table
from viscontact.units.formatting import format_quantity

_NAMES = {"x": "x", "y": "y", "z": "height", "height": "height"}
#: Positions agree if they are as close as this part of the spacing.
_CLOSE = 1e-3


# Positions, and the largest rounding in parts of the last digit, that are taken for an even mesh.
_LEAST_ROUNDED, _HALF_DIGIT = 20, 0.55


def names_a_coordinate(cell: str) -> bool:
    """True for the heading of a position or a height."""
    return _quantity(cell) is not None


def stated_columns(header: Row) -> dict[str, str | None]:
    """Columns of positions and height; others are left out. Empty if they are neither map nor line.

    A height over x alone is a line scan; so is y over x, as profilers call it.
    """
    stated: dict[str, str | None] = {}
    for cell in filter(None, header.cells):
        quantity = _quantity(cell)
        stated[cell] = None if quantity in stated.values() else quantity
    found = {quantity: cell for cell, quantity in stated.items() if quantity is not None}
    if "x" not in found or len(found) < 2:
        return {}
    if "height" not in found:
        stated[found["y"]] = "height"
    return stated


def heading_of_points(path: Path) -> Row:
    """Row that names positions and heights, or looks most like it."""
    source = read_source(path, names_a_coordinate, lambda t: bool(stated_columns(t.rows[0])))
    return source.found.rows[0]


def read_points(path: Path) -> Surface:
    """Read a map or a line scan whose heading names x, y and the height, or x and the height."""
    header = heading_of_points(path)
    columns = stated_columns(header)
    if not columns:
        found = ", ".join(repr(cell) for cell in header.cells if cell) or "none"
        raise ValueError(
            f"{path.name}: a map is rows of bare heights, or columns 'x [um], y [um], height [nm]' "
            f"(a line scan: 'x [um], height [nm]'), got {found}"
        )
    table = read_table(path, columns, gaps={"height": NOT_MEASURED})
    y = table["y"] if "y" in table else np.zeros(len(table))
    heights, notes = without_markers(table["height"], LENGTH_UNITS)
    return on_mesh(table.source.name, (table["x"], y), heights, table, notes)


def _quantity(cell: str) -> str | None:
    found = re.match(r"[^\W_]+", cell.lower())
    return _NAMES.get(found[0]) if found else None


def on_mesh(
    name: str,
    positions: tuple[Floats, Floats],
    heights: Floats,
    table: Table | None = None,
    notes: tuple[str, ...] = (),
) -> Surface:
    """Surface of heights [m] at positions along x and y [m], in any order."""
    places, spacing = [], []
    for axis, position in zip(("x", "y"), positions, strict=True):
        index, step = places_on_mesh(name, axis, position)
        places.append(index)
        spacing.append(step)
    steps = [step or next((s for s in spacing if s), 1.0) for step in spacing]
    shape = tuple(int(index.max()) + 1 for index in places)
    if shape[0] * shape[1] > 4 * heights.size + 1000:
        raise ValueError(
            f"{name}: its {heights.size} points lie scattered on a mesh of {shape[0]} x "
            f"{shape[1]}; bring them to an even mesh first"
        )
    taken = np.zeros(shape, dtype=np.intp)
    np.add.at(taken, tuple(places), 1)
    if (taken > 1).any():
        i, j = np.argwhere(taken > 1)[0]
        row = int(np.flatnonzero((places[0] == i) & (places[1] == j))[1])
        line = "" if table is None else f":{table.lines[row]}"
        raise ValueError(f"{name}{line}: this point is given twice")
    found = np.full(shape, np.nan)
    found[tuple(places)] = heights
    return Surface(found, (steps[0], steps[1]), name=name, notes=notes)


def _is_rounded(lines: Floats) -> bool:
    """True if increasing positions are even but for the rounding of their last decimal."""
    steps = np.diff(lines)
    digit = float(steps.min())
    decimal = digit / 10.0 ** round(math.log10(digit))
    if lines.size < _LEAST_ROUNDED or abs(decimal - 1) > _CLOSE:
        return False
    if np.abs(steps / digit - np.rint(steps / digit)).max() > 10 * _CLOSE:
        return False
    number = np.arange(lines.size)
    even = np.polynomial.Polynomial.fit(number, lines, 1)(number)
    return float(np.abs(lines - even).max()) <= _HALF_DIGIT * digit


def places_on_mesh(
    name: str, axis: str, position: Floats, unit: str = "m"
) -> tuple[Integers, float]:
    """Index of each position on an even mesh, and its spacing; 0 for a single line."""
    lines = np.unique(position)
    extent = float(lines[-1] - lines[0])
    if extent == 0:
        return np.zeros(position.shape, dtype=np.intp), 0.0
    # Positions are rounded in files: much smaller steps than the median are rounding.
    steps = np.diff(lines)
    steps = steps[steps > _CLOSE * steps.max()]
    # The mean of the steps without a gap has less of their rounding than the median.
    count = max(round(extent / float(np.mean(steps[steps <= 1.5 * np.median(steps)]))), 1)
    step = extent / count
    index = (position - lines[0]) / step
    if np.abs(index - np.rint(index)).max() > 50 * _CLOSE and _is_rounded(lines):
        step = extent / (lines.size - 1)
        return np.searchsorted(lines, position).astype(np.intp), step
    if np.abs(index - np.rint(index)).max() > 50 * _CLOSE:
        worst = int(np.abs(index - np.rint(index)).argmax())
        place, apart = (
            format_quantity(each, unit, 6) if unit else f"{each:.6g}"
            for each in (position[worst], step)
        )
        raise ValueError(
            f"{name}: its points are unevenly spaced: {axis} = {place} lies on no even mesh of "
            f"{apart} steps; bring them to an even mesh first"
        )
    return np.rint(index).astype(np.intp), step
