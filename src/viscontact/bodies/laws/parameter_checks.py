"""Checks of the arguments of material laws."""

from __future__ import annotations

from collections.abc import Callable

from viscontact.units.numbers import non_negative, positive, real, real_array, store, unit_of


def exponent(name: str, value: object, unit: str = "1") -> float:
    """Return the power of a spring-pot as a float; ValueError unless above 0 and up to 1."""
    number = real(name, value, unit)
    if not 0 < number <= 1:
        raise ValueError(
            f"{name} must lie above 0 (a spring) and not above 1 (a dashpot), got {value!r}"
        )
    return number


def one_of(name: str, word: str, words: tuple[str, ...]) -> None:
    """Check that a named rule is known; ValueError otherwise."""
    if word not in words:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, words))}, got {word!r}")


def check_series(instance: object, name: str) -> None:
    """Check the strengths `name` (each >= 0) and the times (each > 0) of a series, as tuples."""
    strengths, times = check_items(instance, name, non_negative), check_items(instance, "times")
    if len(strengths) != len(times):
        raise ValueError(
            f"{type(instance).__name__}: {name} and times must have equal lengths, got "
            f"{len(strengths)} {name} and {len(times)} times; give one time for each term"
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


def check_items(
    instance: object, name: str, check: Callable[[str, object, str], float] = positive
) -> tuple[float, ...]:
    """Check each item of a field of a frozen dataclass, and store them as a tuple of floats."""
    place, unit = f"{type(instance).__name__}: {name}", unit_of(type(instance), name) or "1"
    items = real_array(place, getattr(instance, name), unit, 1).tolist()
    checked = tuple(check(f"{place}[{i}]", item, unit) for i, item in enumerate(items))
    store(instance, **{name: checked})
    return checked
