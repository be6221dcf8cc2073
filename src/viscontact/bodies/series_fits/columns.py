"""Checks of measured columns; messages name the row, counted from 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats


def positive_column(
    owner: str, name: str, values: ArrayLike, unit: str, *, zero: bool = False
) -> Floats:
    """Return a column of positive (or zero) finite numbers as floats, shape (n,)."""
    try:
        column = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError(
            f"{owner}: {name} must be a column of numbers in {unit}, got {values!r}"
        ) from None
    if column.ndim != 1:
        raise ValueError(f"{owner}: {name} must be one column, got shape {column.shape}")
    wrong = ~(np.isfinite(column) & (column >= 0 if zero else column > 0))
    if wrong.any():
        row = int(np.argmax(wrong))
        least = f"of at least 0 {unit}" if zero else f"above 0 {unit}"
        raise ValueError(
            f"{owner}: {name}, row {row}: must be a finite number {least}, "
            f"got {float(column[row])!r}"
        )
    return column


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
