"""Checks of measured columns; messages name the row, counted from 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import real_array


def positive_column(
    owner: str, name: str, values: ArrayLike, unit: str, *, zero: bool = False
) -> Floats:
    """Return a column of positive (or zero) finite numbers as floats, shape (n,)."""
    column = np.array(real_array(f"{owner}: {name}", values, unit, 1))
    right = np.isfinite(column) & (column >= 0 if zero else column > 0)
    for row in np.flatnonzero(~right)[:1]:
        least = f"of at least 0 {unit}" if zero else f"above 0 {unit}".removesuffix(" 1")
        raise ValueError(
            f"{owner}: {name}, row {row}: must be a finite number {least}, "
            f"got {float(column[row])!r}" + _remedy(float(column[row]))
        )
    return column


def _remedy(value: float) -> str:
    """Remedy for a measured value below 0."""
    return "; a negative one is noise or a wrong zero: leave its row out" if value < 0 else ""


def columns_over_time(owner: str, least: int, **given: tuple[ArrayLike, str]) -> dict[str, Floats]:
    """Columns of finite (values, unit), `least` rows or more, whose `times` never fall."""
    columns = {}
    for name, (values, unit) in given.items():
        column = columns[name] = np.array(real_array(f"{owner}: {name}", values, unit, 1))
        for row in np.flatnonzero(~np.isfinite(column))[:1]:
            raise ValueError(f"{owner}: {name}, row {row}: must be finite, got {column[row]}")
    require_rows(owner, least, **columns)
    times = columns["times"]
    for row in np.flatnonzero(np.diff(times) < 0)[:1] + 1:
        raise ValueError(
            f"{owner}: times, row {row}: must not be before the row above, got "
            f"{format_quantity(times[row], 's', 6)} after {format_quantity(times[row - 1], 's', 6)}"
        )
    return columns


def require_rows(owner: str, least: int, **columns: Floats) -> None:
    """Refuse columns of different lengths, or with fewer than `least` rows."""
    lengths = {name: column.size for name, column in columns.items()}
    if len(set(lengths.values())) > 1:
        found = ", ".join(f"{count} {name}" for name, count in lengths.items())
        raise ValueError(f"{owner}: all columns must have one value in each row, got {found}")
    rows = next(iter(lengths.values()))
    if rows < least:
        raise ValueError(f"{owner}: needs at least {least} rows, got {rows}")


def require_trend(owner: str, name: str, points: Floats, values: Floats, rises: bool) -> None:
    """Refuse a curve that as a whole rises where it can only fall, or the reverse."""
    # It does if the median of its last third is a tenth or more on the wrong side of that of its
    # first.
    ordered = values[np.argsort(points, kind="stable")]
    third = max(1, ordered.size // 3)
    first, last = float(np.median(ordered[:third])), float(np.median(ordered[-third:]))
    if (last < 0.9 * first) if rises else (last > first / 0.9):
        way, wanted = ("falls", "rise") if rises else ("rises", "fall")
        raise ValueError(
            f"{owner}: {name} {way} from about {first:.4g} to about {last:.4g}, where it can only "
            f"{wanted}; is this another quantity, or are the columns exchanged?"
        )
