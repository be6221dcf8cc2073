"""Load histories from CSV files whose header names columns and units."""

from __future__ import annotations

import csv
import re
from pathlib import Path

from viscontact.units import parse_unit

_DIMENSIONS = {
    "time": "time",
    "force": "force",
    "eccentricity_x": "length",
    "eccentricity_y": "length",
    "tilt_x": "angle",
    "tilt_y": "angle",
}
_HEADER = re.compile(r"\s*(?P<name>\w+)\s*\[(?P<unit>[^\]]+)\]\s*")


def read_load_table(path: Path) -> dict[str, list[float]]:
    """Read a load history from a CSV file.

    Parameters
    ----------
    path : Path
        The file; its first line names columns and units, as ``time [s], force [kN]``.

    Returns
    -------
    dict
        Arguments of `viscontact.ForceHistory`, in SI units.

    Raises
    ------
    ValueError
        If the file cannot be read, a column is unknown or missing, or an entry is no number.
    """
    rows = _rows(path)
    if not rows:
        raise ValueError(f"file: {path.name} is empty; it begins with e.g. 'time [s], force [kN]'")
    factors = _columns(path.name, rows[0][1])
    values: dict[str, list[float]] = {name: [] for name in factors}
    for number, row in rows[1:]:
        if len(row) != len(factors):
            raise ValueError(
                f"file: {path.name}:{number} has {len(row)} entries, the header {len(factors)}"
            )
        for (name, factor), entry in zip(factors.items(), row, strict=True):
            values[name].append(factor * _number(path.name, number, entry))
    values["times"] = values.pop("time")
    return values


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """Rows that are neither empty nor comments, with their line numbers."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as lines:
            numbered = list(enumerate(csv.reader(lines), start=1))
    except FileNotFoundError as error:
        raise ValueError(f"file: no such file {path}") from error
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"file: cannot read {path} as CSV: {error}") from error
    return [(n, row) for n, row in numbered if any(row) and not row[0].startswith("#")]


def _columns(name: str, header: list[str]) -> dict[str, float]:
    """Factor to SI of each column, in order."""
    factors: dict[str, float] = {}
    for cell in header:
        match = _HEADER.fullmatch(cell)
        if match is None or match["name"] not in _DIMENSIONS:
            raise ValueError(
                f"file: {name}: cannot read the column name {cell.strip()!r}; "
                f"names are {', '.join(_DIMENSIONS)}, each with its unit, as 'force [kN]'"
            )
        if match["name"] in factors:
            raise ValueError(f"file: {name}: two columns are called {match['name']}")
        factors[match["name"]] = parse_unit(match["unit"], _DIMENSIONS[match["name"]])
    if missing := [wanted for wanted in ("time", "force") if wanted not in factors]:
        raise ValueError(f"file: {name}: the column {missing[0]} is missing")
    return factors


def _number(name: str, line: int, entry: str) -> float:
    try:
        return float(entry)
    except ValueError:
        raise ValueError(f"file: {name}:{line}: {entry.strip()!r} is not a number") from None
