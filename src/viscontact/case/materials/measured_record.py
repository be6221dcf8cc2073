"""Table of a law as plain data, in the quantities that were measured."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from viscontact import tables
from viscontact.tables.names import QUANTITIES, meaning
from viscontact.units.dimensions import DIMENSIONS

#: Most rows that are kept; of more, as many with equal distances between them.
MOST_ROWS = 200
#: Quantities that laws are made from, and those over which they are measured.
_KEPT = (
    *("time", "angular_frequency", "creep_compliance", "relaxation_modulus"),
    *("storage_modulus", "loss_modulus", "loss_tangent"),
)


def measured_record(table: tables.Table, data: str) -> dict[str, Any]:
    """Return file, kind of test, number of rows, and columns in SI units."""
    # A creep modulus, which a table holds as its inverse, is a modulus again. The strain of a creep
    # test is the compliance, strain over stress.
    rows = np.unique(np.linspace(0, len(table) - 1, min(len(table), MOST_ROWS)).round().astype(int))
    columns = [_column(table, name, rows) for name in table.columns if name in _KEPT]
    return {"file": table.source.name, "data": data, "rows": len(table), "columns": columns}


def _column(table: tables.Table, quantity: str, rows: Any) -> dict[str, Any]:
    heading, values = table.headings[quantity], table[quantity][rows]
    stated = meaning(re.split(r"[\[(,]", heading)[0].strip())
    if quantity == "creep_compliance" and stated and stated.quantity == "creep_modulus":
        quantity, values = "creep_modulus", 1 / values
    dimension = QUANTITIES[quantity]
    units = "1" if dimension is None else DIMENSIONS[dimension].unit
    return {"quantity": quantity, "heading": heading, "units": units, "values": values.tolist()}
