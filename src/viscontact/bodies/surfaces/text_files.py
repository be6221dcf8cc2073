"""Height maps from CSV files and spreadsheets: bare numbers, or a row for each point."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from viscontact.backend.arrays import Floats, Integers
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.units import Units
from viscontact.tables import Row, Table, decimal_number, looks_like_number, read_rows, read_table
from viscontact.units.formatting import format_quantity

_NAMES = {"x": "x", "y": "y", "z": "height", "height": "height"}

_NOT_MEASURED = ("", "nan", "na", "n/a", "-", "bad", "***")

#: Positions agree if they are as close as this part of the spacing.
_CLOSE = 1e-3


def read_text_map(path: Path, units: Units, channel: str | None) -> Surface:
    """Read a map from a CSV file or a spreadsheet; points without a row are missing."""
    # Rows of bare heights are scan lines along x; a header such as ``x [um], y [um], height [nm]``
    # is followed by a row for each point, in any order.
    if channel is not None:
        raise ValueError(f"channel: {path.name} is a table and has none; leave it out")
    rows = read_rows(path)
    if all(len(row.cells) == 1 for row in rows):  # blanks between numbers, as NumPy writes them
        rows = [Row(row.line, tuple(row.cells[0].split())) for row in rows]
    if all(_is_height(cell) for cell in rows[0].cells):
        heights = _matrix(path.name, rows)
        return Surface(heights * units.height_scale, units.steps, name=path.name)
    units.require_none()
    return _from_points(read_table(path, _columns(path.name, rows[0])))


def _columns(name: str, header: Row) -> dict[str, str | None]:
    """Columns of position and height; others are left out."""
    stated: dict[str, str | None] = {}
    for cell in filter(None, header.cells):
        found = re.match(r"\w+", cell.lower())
        quantity = _NAMES.get(found[0]) if found else None
        stated[cell] = None if quantity in stated.values() else quantity
    absent = [each for each in ("x", "y", "height") if each not in stated.values()]
    if absent:
        raise ValueError(
            f"{name}: the column {absent[0]} is missing; a map is rows of bare heights, or columns "
            f"'x [um], y [um], height [nm]', got {', '.join(map(repr, stated)) or 'none'}"
        )
    return stated


def _is_height(cell: str) -> bool:
    return cell.lower() in _NOT_MEASURED or looks_like_number(cell)


def _matrix(name: str, rows: list[Row]) -> Floats:
    """Heights [x, y] of rows that run along x."""
    width = len(rows[0].cells)
    comma = any("," in cell for row in rows for cell in row.cells)
    heights = np.full((width, len(rows)), np.nan)
    for j, row in enumerate(rows):
        if len(row.cells) != width:
            raise ValueError(
                f"{name}:{row.line} has {len(row.cells)} heights, the first row {width}; write "
                "nan where none was measured"
            )
        for i, cell in enumerate(row.cells):
            if cell.lower() in _NOT_MEASURED:
                continue
            try:
                heights[i, j] = float(decimal_number(cell, "," if comma else "."))
            except ValueError as error:
                raise ValueError(f"{name}:{row.line}: height {i + 1}: {error}") from None
    return heights


def _from_points(table: Table) -> Surface:
    name = table.source.name
    places, spacing = [], []
    for axis in ("x", "y"):
        index, step = _on_mesh(name, axis, table[axis])
        places.append(index)
        spacing.append(step)
    steps = [step or next((s for s in spacing if s), 1.0) for step in spacing]
    shape = tuple(int(index.max()) + 1 for index in places)
    if shape[0] * shape[1] > 4 * len(table) + 1000:
        raise ValueError(
            f"{name}: its {len(table)} points lie scattered on a mesh of {shape[0]} x {shape[1]}; "
            "bring them to an even mesh first"
        )
    heights = np.full(shape, np.nan)
    taken = np.zeros(shape, dtype=np.intp)
    np.add.at(taken, tuple(places), 1)
    if (taken > 1).any():
        i, j = np.argwhere(taken > 1)[0]
        row = int(np.flatnonzero((places[0] == i) & (places[1] == j))[1])
        raise ValueError(f"{name}:{table.lines[row]}: this point is given twice")
    heights[tuple(places)] = table["height"]
    return Surface(heights, (steps[0], steps[1]), name=name)


def _on_mesh(name: str, axis: str, position: Floats) -> tuple[Integers, float]:
    """Index of each position on an even mesh, and its spacing [m]; 0 for a single line."""
    lines = np.unique(position)
    extent = float(lines[-1] - lines[0])
    if extent == 0:
        return np.zeros(position.shape, dtype=np.intp), 0.0
    # Positions are rounded in files: much smaller steps than the median are rounding.
    steps = np.diff(lines)
    count = max(round(extent / float(np.median(steps[steps > _CLOSE * steps.max()]))), 1)
    step = extent / count
    index = (position - lines[0]) / step
    if np.abs(index - np.rint(index)).max() > 50 * _CLOSE:
        worst = int(np.abs(index - np.rint(index)).argmax())
        raise ValueError(
            f"{name}: {axis} = {format_quantity(position[worst], 'm', 6)} lies on no even mesh of "
            f"{format_quantity(step, 'm', 6)} steps; bring the points to an even mesh first"
        )
    return np.rint(index).astype(np.intp), step
