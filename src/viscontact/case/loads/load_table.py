"""Load histories from CSV files with columns and units in the header."""

from __future__ import annotations

from pathlib import Path

from viscontact.tables import Table, read_table
from viscontact.units.formatting import format_quantity

_COLUMNS = ("time", "force", "approach", "eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")


def read_load_table(path: Path) -> dict[str, list[float]]:
    """Read a load history from a CSV file."""
    try:
        table = read_table(path)
        _require_columns(table)
        _refuse_decrease(table)
    except ValueError as error:
        raise ValueError(f"file: {error}") from error
    values = {name: column.tolist() for name, column in table.columns.items()}
    values["times"] = values.pop("time")
    return values


def _require_columns(table: Table) -> None:
    name = table.source.name
    # An ignored column could be a load that is not applied.
    others = [table.headings[column] for column in table.columns if column not in _COLUMNS]
    for unknown in (*table.left_out, *others):
        raise ValueError(
            f"{name}: cannot read the column name {unknown!r}; "
            f"names are {', '.join(_COLUMNS)}, each with its unit, as 'force [kN]'"
        )
    if "time" not in table:
        raise ValueError(f"{name}: the column time is missing")
    if "force" in table and "approach" in table:
        raise ValueError(
            f"{name}: the columns force and approach exclude each other; only one of them can be "
            "prescribed"
        )
    if "force" not in table and "approach" not in table:
        raise ValueError(f"{name}: the column force is missing, or approach in its place")


def _refuse_decrease(table: Table) -> None:
    before = 0.0
    for line, now in zip(table.lines.tolist(), table["time"].tolist(), strict=True):
        if now < before:
            raise ValueError(
                f"{table.source.name}:{line}: time must not decrease, got "
                f"{format_quantity(before, 's', 6)} followed by {format_quantity(now, 's', 6)}"
            )
        before = now
