"""Creep tests as datasheets give them: strain at a stress, of one stress or of several."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.tables.table import Table, read_only
from viscontact.units.formatting import format_quantity
from viscontact.units.parsing import parse_quantity

#: Units of a strain, in parts of 1.
STRAIN_UNITS = {
    "%": 1e-2,
    "‰": 1e-3,
    "1": 1.0,
    "-": 1.0,
    "mm/mm": 1.0,
    "m/m": 1.0,
    "mm/m": 1e-3,
    "µm/m": 1e-6,
    "um/m": 1e-6,
    "µε": 1e-6,
}

# "strain at 5 MPa", "ε @ 5 MPa", "Dehnung bei 5 N/mm²", "strain (σ = 5 MPa)"
_AT_STRESS = re.compile(
    r"(?P<name>.+?)\s*(?:\bat\b|\bbei\b|@|\()\s*(?:(?:stress|σ)\s*=?\s*)?"
    r"(?P<stress>\d[\d.,]*\s*[^\d\s()][^()]*?)\s*\)?"
)
# Stresses of one test: as far apart as an instrument keeps them.
_SAME_STRESS = 0.02


def split_stress(heading: str) -> tuple[str, float | None]:
    """Name and stress [Pa] of a heading; None if it states none."""
    match = _AT_STRESS.fullmatch(heading.strip())
    if match is None:
        return heading, None
    try:
        return match["name"], parse_quantity(match["stress"].replace(",", "."), "pressure")
    except ValueError:
        return heading, None


def same_stress(one: float, other: float) -> bool:
    """True for stresses [Pa] that are one in a test."""
    return abs(one - other) <= _SAME_STRESS * max(abs(one), abs(other))


def chosen_level(source: str, levels: Sequence[float], stress: float | None) -> float:
    """Return the one of the stresses of a file that is meant [Pa]."""
    found = [level for level in levels if stress is None or same_stress(level, stress)]
    if len(found) == 1:
        return found[0]
    listed = ", ".join(format_quantity(level, "Pa") for level in levels)
    if stress is None:
        raise ValueError(
            f"{source}: holds tests at {listed}; choose one (--stress '5 MPa' on the command line, "
            "stress: 5 MPa in a case); the lowest is nearest to linear behaviour"
        )
    raise ValueError(f"{source}: no test at {format_quantity(stress, 'Pa')}; there are {listed}")


def with_creep_compliance(table: Table, stress: float | None) -> Table:
    """Return a table with strain over `stress` [Pa], that of a heading or of the caller."""
    source = table.source.name
    if "stress" in table:
        table = _at_level(table, chosen_level(source, _levels(source, table["stress"]), stress))
        stresses: Floats | float | None = table["stress"]
    else:
        stresses = stress
    columns = {n: v for n, v in table.columns.items() if n not in ("strain", "stress")}
    headings = {n: h for n, h in table.headings.items() if n not in ("strain", "stress")}
    if "strain" in table:
        if stresses is None:
            raise ValueError(
                f"{source}: the column {table.headings['strain']!r} needs the stress of the test: "
                "a column 'stress [MPa]', a heading like 'strain at 5 MPa [%]', --stress '5 MPa' "
                "on the command line, or stress: 5 MPa in a case"
            )
        columns["creep_compliance"] = read_only(table["strain"] / stresses)
        headings["creep_compliance"] = table.headings["strain"]
    return Table(table.source, columns, table.data, headings, table.lines, table.left_out)


def _levels(source: str, stresses: Floats) -> list[float]:
    """Mean stresses of the tests in a column [Pa], increasing."""
    if not (np.abs(stresses) > 0).all():
        raise ValueError(f"{source}: the column of stresses has a 0; leave rows without a load out")
    ordered = np.sort(stresses)
    apart = np.flatnonzero(np.diff(ordered) > _SAME_STRESS * np.abs(ordered[1:])) + 1
    return [float(np.mean(level)) for level in np.split(ordered, apart)]


def _at_level(table: Table, level: float) -> Table:
    """Rows of a table at a stress [Pa]."""
    kept = np.array([same_stress(level, each) for each in table["stress"].tolist()])
    columns = {name: read_only(values[kept]) for name, values in table.columns.items()}
    return Table(
        table.source, columns, table.data, table.headings, table.lines[kept], table.left_out
    )
