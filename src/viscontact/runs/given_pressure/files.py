"""Pressure maps from tables with a row for each point."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Integers
from viscontact.bodies.surfaces.point_tables import places_on_mesh
from viscontact.tables import Row, Table, read_source, read_table

#: Quantities of the columns, by the first word of their headings.
_NAMES = {"x": "x", "y": "y", "pressure": "pressure", "p": "pressure", "time": "time", "t": "time"}

#: Endings of tables; others are results.
TABLES = (".csv", ".txt", ".dat", ".tsv", ".xlsx", ".xls", ".ods")


def read_pressure(path: Path) -> xr.DataArray:
    """Read the pressure at points x, y of an even mesh, at one instant or several, in SI units."""
    source = read_source(path, _is_named, lambda found: bool(_columns(found.rows[0])))
    columns = _columns(source.found.rows[0])
    if not columns:
        named = ", ".join(repr(cell) for cell in source.found.rows[0].cells if cell) or "none"
        raise ValueError(
            f"{path.name}: a pressure is columns 'x [mm], y [mm], pressure [MPa]', and perhaps "
            f"'time [s]', with a row for each point, got {named}"
        )
    table = read_table(path, columns)
    (i, dx), (j, dy) = (places_on_mesh(path.name, axis, table[axis]) for axis in "xy")
    if not (dx and dy):
        raise ValueError(f"{path.name}: its points lie on one line; a map needs several")
    times, k = np.unique(
        table["time"] if "time" in table else np.zeros(i.size), return_inverse=True
    )
    shape = (times.size, int(i.max()) + 1, int(j.max()) + 1)
    maps, count = np.zeros(shape), np.zeros(shape, dtype=int)
    np.add.at(count, (k, i, j), 1)
    maps[k, i, j] = table["pressure"]
    _require_whole(path, table, count, (k, i, j))
    along, across = (
        float(table[axis].min()) + step * np.arange(cells)
        for axis, step, cells in zip("xy", (dx, dy), shape[1:], strict=True)
    )
    found = xr.DataArray(
        maps, dims=("time", "x", "y"), coords={"time": times, "x": along, "y": across}
    )
    return found if "time" in table else found.isel(time=0, drop=True)


def _require_whole(path: Path, table: Table, count: Integers, at: tuple[Integers, ...]) -> None:
    """Refuse points that are given twice, or are missing."""
    twice = count[at] > 1
    for row in np.flatnonzero(twice)[1:2]:
        raise ValueError(f"{path.name}:{table.lines[row]}: this point is given twice")
    missing = int((count == 0).sum())
    if missing:
        raise ValueError(
            f"{path.name}: {missing} of the {count.size} points of its mesh are missing; give all "
            "of them, with 0 where nothing presses"
        )


def _columns(header: Row) -> dict[str, str | None]:
    """Quantities of the columns by their headings; empty without x, y and the pressure."""
    found: dict[str, str | None] = {}
    for cell in filter(None, header.cells):
        quantity = _quantity(cell)
        found[cell] = None if quantity in found.values() else quantity
    return found if {"x", "y", "pressure"} <= set(found.values()) else {}


def _is_named(cell: str) -> bool:
    return _quantity(cell) is not None


def _quantity(cell: str) -> str | None:
    found = re.match(r"[^\W_]+", cell.lower())
    return _NAMES.get(found[0]) if found else None
