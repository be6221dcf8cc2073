"""Storage and loss modulus of oscillation tests that are given as magnitude and phase."""

from __future__ import annotations

import numpy as np

from viscontact.tables.table import Table, read_only

#: What storage and loss are computed from.
_SOURCES = ("complex_modulus", "phase_angle")


def with_moduli(table: Table) -> Table:
    """Return a table with storage and loss modulus in place of |G*| and the phase angle."""
    if not any(name in table for name in _SOURCES):
        return table
    columns = {name: values for name, values in table.columns.items() if name not in _SOURCES}
    headings = {name: text for name, text in table.headings.items() if name not in _SOURCES}
    if "phase_angle" in table:
        _require_phase(table)
        tangent = np.tan(table["phase_angle"])
    else:
        tangent = table["loss_tangent"]
        del columns["loss_tangent"], headings["loss_tangent"]
    if "complex_modulus" in table:
        storage = table["complex_modulus"] / np.hypot(1.0, tangent)
        headings["storage_modulus"] = table.headings["complex_modulus"]
    else:
        storage = table["storage_modulus"]
    columns |= {"storage_modulus": read_only(storage), "loss_modulus": read_only(storage * tangent)}
    headings["loss_modulus"] = table.headings.get("phase_angle") or table.headings["loss_tangent"]
    return Table(table.source, columns, table.data, headings, table.lines, table.left_out)


def _require_phase(table: Table) -> None:
    """Refuse phase angles that no solid or fluid has, as they are in another unit."""
    angles = table["phase_angle"]
    for row in np.flatnonzero(~((angles >= 0) & (angles < np.pi / 2)))[:1]:
        raise ValueError(
            f"{table.source.name}:{table.lines[row]}: column {table.headings['phase_angle']!r}: a "
            f"phase angle lies between 0 and 90 degrees, got {np.degrees(angles[row]):.6g} degrees"
        )
