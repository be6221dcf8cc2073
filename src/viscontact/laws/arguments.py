"""Checks of the arguments of material laws."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.units.numbers import non_negative, positive, real


def exponent(name: str, value: float) -> float:
    """Return the power of a spring-pot as a float; ValueError unless above 0 and up to 1."""
    number = real(name, value)
    if not 0 < number <= 1:
        raise ValueError(
            f"{name} must lie above 0 (a spring) and not above 1 (a dashpot), got {value!r}"
        )
    return number


def one_of(name: str, word: str, words: tuple[str, ...]) -> None:
    """Check that a named rule is known; ValueError otherwise."""
    if word not in words:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, words))}, got {word!r}")


def series(
    owner: str, name: str, strengths: Sequence[float], times: Sequence[float], unit: str
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return strengths (each >= 0) and times (each > 0) of a series as tuples of one length."""
    strengths, times = _sequence(f"{owner}: {name}", strengths), _sequence(f"{owner}: times", times)
    if len(strengths) != len(times):
        raise ValueError(
            f"{owner}: {name} and times must have equal lengths, got {len(strengths)} {name} "
            f"and {len(times)} times; give one time for each term"
        )
    return (
        tuple(non_negative(f"{owner}: {name}[{i}]", v, unit) for i, v in enumerate(strengths)),
        tuple(positive(f"{owner}: times[{i}]", v, "s") for i, v in enumerate(times)),
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
    ratio = real(f"{owner}: poisson_ratio", poisson_ratio)
    if not -1 < ratio <= 0.5:
        raise ValueError(
            f"{owner}: poisson_ratio must lie above -1 and not above 0.5, got {poisson_ratio!r}; "
            "0.5 is incompressible"
        )
    return ratio, None


def _sequence(name: str, values: Sequence[float]) -> list[float]:
    array = np.asarray(values, dtype=object)
    if array.ndim != 1:
        raise ValueError(f"{name} must be a sequence of numbers, got {values!r}")
    return list(array)
