"""What material laws accept as arguments: numbers, series, and how a body gives in volume."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscontact.units.numbers import unit_of


def positive(name: str, value: float, unit: str) -> float:
    """Return `value` as a float; ValueError unless it is positive and finite."""
    number = one_number(name, value, unit)
    if not (math.isfinite(number) and number > 0):
        raise ValueError(f"{name}: must be a positive finite number, got {value!r} {unit}")
    return number


def non_negative(name: str, value: float, unit: str) -> float:
    """Return `value` as a float; ValueError unless it is finite and at least 0."""
    number = one_number(name, value, unit)
    if not (math.isfinite(number) and number >= 0):
        raise ValueError(f"{name}: must be a finite number >= 0, got {value!r} {unit}")
    return number


def exponent(name: str, value: float) -> float:
    """Return the power of a spring-pot as a float; ValueError unless above 0 and up to 1."""
    number = one_number(name, value, "")
    if not 0 < number <= 1:
        raise ValueError(
            f"{name}: must lie above 0 (a spring) and not above 1 (a dashpot), got {value!r}"
        )
    return number


def one_of(name: str, word: str, words: tuple[str, ...]) -> None:
    """Check that a named rule is known; ValueError otherwise."""
    if word not in words:
        raise ValueError(f"{name}: must be one of {', '.join(map(repr, words))}, got {word!r}")


def make_positive(noun: object, *fields: str) -> None:
    """Check fields of a frozen `noun` with `positive`, in their units, and store them as floats."""
    for field in fields:
        name, unit = f"{type(noun).__name__}.{field}", unit_of(type(noun), field) or ""
        store(noun, **{field: positive(name, getattr(noun, field), unit)})


def store(noun: object, **values: object) -> None:
    """Put checked values into a frozen `noun` while it is being made."""
    for field, value in values.items():
        object.__setattr__(noun, field, value)


def series(
    owner: str, name: str, strengths: Sequence[float], times: Sequence[float], unit: str
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return strengths (each >= 0) and times (each > 0) of a series as tuples of one length."""
    strengths, times = _sequence(f"{owner}.{name}", strengths), _sequence(f"{owner}.times", times)
    if len(strengths) != len(times):
        raise ValueError(
            f"{owner}: {name} and times must have equal lengths, got {len(strengths)} {name} "
            f"and {len(times)} times; give one time for each term"
        )
    return (
        tuple(non_negative(f"{owner}.{name}[{i}]", v, unit) for i, v in enumerate(strengths)),
        tuple(positive(f"{owner}.times[{i}]", v, "s") for i, v in enumerate(times)),
    )


def compressibility(
    owner: str, poisson_ratio: float | None, bulk_modulus: float | None
) -> tuple[float | None, float | None]:
    """Return the one of Poisson's ratio and bulk modulus [Pa] that is given, checked."""
    if (poisson_ratio is None) == (bulk_modulus is None):
        raise ValueError(
            f"{owner}: give exactly one of poisson_ratio and bulk_modulus, "
            f"got poisson_ratio={poisson_ratio!r} and bulk_modulus={bulk_modulus!r}"
        )
    if poisson_ratio is None:
        assert bulk_modulus is not None  # exactly one is given
        return None, positive(f"{owner}: bulk_modulus", bulk_modulus, "Pa")
    ratio = one_number(f"{owner}: poisson_ratio", poisson_ratio, "")
    if not -1 < ratio <= 0.5:
        raise ValueError(
            f"{owner}: poisson_ratio must lie above -1 and not above 0.5, got {poisson_ratio!r}; "
            "0.5 is incompressible"
        )
    return ratio, None


def one_number(name: str, value: float, unit: str) -> float:
    """Return `value` as a float; ValueError unless it is one number."""
    try:
        if isinstance(value, bool | str | bytes):  # True is not 1 Pa, "1e9" is no number
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        wanted = f"one number in {unit}" if unit else "one number"
        raise ValueError(f"{name}: must be {wanted}, got {value!r}") from None


def _sequence(name: str, values: Sequence[float]) -> list[float]:
    array = np.asarray(values, dtype=object)
    if array.ndim != 1:
        raise ValueError(f"{name}: must be a sequence of numbers, got {values!r}")
    return list(array)
