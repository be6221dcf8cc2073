"""Tangential load from a table."""

from __future__ import annotations

from pathlib import Path

from viscontact import tables
from viscontact.bodies.loads.tangential import UNITS
from viscontact.case.ordered_times import refuse_decrease
from viscontact.tables.heading_cells import heading_cell


def read_tangential(path: Path, columns: str | None) -> dict[str, list[float]]:
    """Times and forces or motions of a table by name [SI]."""
    table = tables.read_table(path, columns)
    if columns is None:
        # Names that are headings of tangential loads only.
        named = {each: heading_cell(each, 0).name.strip().lower() for each in table.left_out}
        meant: dict[str, str | None] = {
            heading: name for heading, name in named.items() if name in UNITS
        }
        table = tables.read_table(path, meant) if meant else table
    _require_columns(table)
    refuse_decrease(table)
    return {name: column.tolist() for name, column in table.columns.items()}


def _require_columns(table: tables.Table) -> None:
    name, known = table.source.name, ("time", *UNITS)
    # An ignored column could be a load that is not applied.
    others = [table.headings[column] for column in table.columns if column not in known]
    for unknown in (*table.left_out, *others):
        raise ValueError(
            f"{name}: cannot read the column name {unknown!r}; names are {', '.join(known)}, each "
            "with its unit, as 'force_x [N]'"
        )
    if "time" not in table:
        raise ValueError(f"{name}: the column time is missing")
    if not any(column in table for column in UNITS):
        raise ValueError(f"{name}: has no load; columns are {', '.join(UNITS)}")
