"""Load histories from CSV files whose header names columns and units."""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path

from viscontact.units import parse_unit

_DIMENSIONS = {
    "time": "time",
    "force": "force",
    "approach": "length",
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
        The file; its first line names columns and units, as ``time [s], force [kN]`` or
        ``time [s]; approach [um]``. Columns are parted by commas, or by semicolons, and
        numbers then may have decimal commas.

    Returns
    -------
    dict
        Arguments of `viscontact.ForceHistory` or `viscontact.ApproachHistory`, in SI units.

    Raises
    ------
    ValueError
        If the file cannot be read, a column is unknown or missing, an entry is no number, or
        the times decrease; with the row and the column.
    """
    separator, rows = _rows(path)
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
            place = f"{path.name}:{number}: {name}"
            values[name].append(factor * _number(place, entry, separator))
        _refuse_decrease(f"{path.name}:{number}", values["time"])
    if not values["time"]:
        raise ValueError(f"file: {path.name} has a header and no rows")
    values["times"] = values.pop("time")
    return values


def _rows(path: Path) -> tuple[str, list[tuple[int, list[str]]]]:
    """What parts the columns; rows that are neither empty nor comments, by line number."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as lines:
            text = list(lines)
        told = [line for line in text if line.strip() and not line.startswith("#")]
        separator = ";" if told and ";" in told[0] else ","
        numbered = list(enumerate(csv.reader(text, delimiter=separator), start=1))
    except FileNotFoundError as error:
        raise ValueError(f"file: no such file {path}") from error
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"file: cannot read {path} as CSV: {error}") from error
    return separator, [(n, row) for n, row in numbered if any(row) and not row[0].startswith("#")]


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
    if "time" not in factors:
        raise ValueError(f"file: {name}: the column time is missing")
    if "force" in factors and "approach" in factors:
        raise ValueError(
            f"file: {name}: the columns force and approach exclude each other; only one of them "
            "can be prescribed"
        )
    if not factors.keys() & {"force", "approach"}:
        raise ValueError(f"file: {name}: the column force is missing, or approach in its place")
    return factors


def _number(place: str, entry: str, separator: str) -> float:
    try:
        value = float(entry.replace(",", ".") if separator == ";" else entry)
    except ValueError:
        raise ValueError(f"file: {place}: {entry.strip()!r} is not a number") from None
    if not math.isfinite(value):
        raise ValueError(f"file: {place} must be finite, got {entry.strip()!r}")
    return value


def _refuse_decrease(place: str, times: list[float]) -> None:
    before, now = times[-2:] if len(times) > 1 else (0.0, times[-1])
    if now < before:
        raise ValueError(
            f"file: {place}: time must not decrease, got {before:g} s followed by {now:g} s"
        )
