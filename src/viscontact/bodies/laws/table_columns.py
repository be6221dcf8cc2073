"""Checks of the columns of a measured law; errors name the row and the column."""

from __future__ import annotations

import math
from collections.abc import Sequence

from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite, real_array, store, unit_of


def check_columns(law: object, column: str, trend: int) -> None:
    """Check and store times [s] and a field that may not fall (`trend` +1) or grow (-1)."""
    owner, unit = type(law).__name__, unit_of(type(law), column) or "1"
    t, v = _column(law, "times"), _column(law, column)
    if len(t) != len(v):
        raise ValueError(
            f"{owner}: times and {column} must have equal lengths, got {len(t)} times and "
            f"{len(v)} values"
        )
    if sum(time > 0 for time in t) < 2:
        raise ValueError(
            f"{owner}: at least 2 rows at times above 0 s are needed, got {len(t)} rows"
        )
    _check_times(owner, t)
    _check_values(owner, column, t, v, unit, trend)
    store(law, **{"times": t, column: v})


def check_left(owner: str, compliance: Sequence[float], volumetric: float) -> None:
    """Check that a tensile compliance exceeds its volumetric part 1/(9K) [1/Pa]."""
    for row, value in enumerate(compliance):
        if volumetric > 0 and value <= volumetric:
            raise ValueError(
                f"{owner}.compliance, row {row}: bulk_modulus "
                f"{format_quantity(1 / (9 * volumetric), 'Pa', 6)} is too small for a tensile "
                f"compliance of {format_quantity(value, '1/Pa', 6)}: it must be above 1/(9 D)"
            )


def _column(law: object, name: str) -> tuple[float, ...]:
    place, unit = f"{type(law).__name__}.{name}", unit_of(type(law), name) or "1"
    items = real_array(place, getattr(law, name), unit, 1).tolist()
    return tuple(finite(f"{place}, row {i}:", value, unit) for i, value in enumerate(items))


def _check_times(owner: str, t: tuple[float, ...]) -> None:
    for row, time in enumerate(t):
        if time < 0:
            raise ValueError(f"{owner}.times, row {row}: must be >= 0 s, got {time!r} s")
        # Times one rounding apart have equal logarithms, which cannot be distinguished.
        if row and (time <= t[row - 1] or (t[row - 1] > 0 and math.log(time / t[row - 1]) == 0)):
            raise ValueError(
                f"{owner}.times, row {row}: must be after row {row - 1}, got {time!r} s after "
                f"{t[row - 1]!r} s; sort the rows by time and average those of one time"
            )


def _check_values(
    owner: str, column: str, t: tuple[float, ...], v: tuple[float, ...], unit: str, trend: int
) -> None:
    for row, value in enumerate(v):
        # A compliance may start at 0; a modulus of 0 is not allowed.
        if value < 0 or (value == 0 and not (trend > 0 and t[row] == 0)):
            raise ValueError(f"{owner}.{column}, row {row}: must be positive, got {value!r} {unit}")
        if row and trend * (value - v[row - 1]) < 0:
            wrong = "fall: a body under constant load creeps on"
            if trend < 0:
                wrong = "grow: a body under constant strain relaxes"
            raise ValueError(
                f"{owner}.{column}, row {row}: must not {wrong}; got {value!r} {unit} after "
                f"{v[row - 1]!r} {unit}; smooth out the noise"
            )
