"""Times of the tables of loads and temperatures."""

from __future__ import annotations

from viscontact import tables
from viscontact.units.formatting import format_quantity


def refuse_decrease(table: tables.Table) -> None:
    """Raise ValueError where the times of a table decrease, or begin before 0, with the line."""
    before = 0.0
    for line, now in zip(table.lines.tolist(), table["time"].tolist(), strict=True):
        if now < before:
            raise ValueError(
                f"{table.source.name}:{line}: time must not decrease, got "
                f"{format_quantity(before, 's', 6)} followed by {format_quantity(now, 's', 6)}"
            )
        before = now
