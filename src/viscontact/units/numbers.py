"""Validation of numeric arguments, in their units."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import Field, fields
from decimal import Decimal
from numbers import Real
from typing import Any

from viscontact.units.formatting import format_quantity


def as_real(value: object) -> float | None:
    """Real number or array without dimensions as a float, inf beyond floats; None for others."""
    if getattr(value, "shape", None) == () and hasattr(value, "item"):
        value = value.item()
    if isinstance(value, bool) or not isinstance(value, Real | Decimal):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf


def real(name: str, value: object, unit: str = "1") -> float:
    """Return `value` as a float, NaN and inf included, or raise ValueError."""
    return _check_number(name, value, unit, "a number", lambda number: True)


def finite(name: str, value: object, unit: str = "1") -> float:
    """Return a finite `value` as a float, or raise ValueError."""
    return _check_number(name, value, unit, "a finite number", math.isfinite)


def positive(name: str, value: object, unit: str = "1") -> float:
    """Return a positive finite `value` as a float, or raise ValueError."""
    return _check_number(name, value, unit, "a positive finite number", lambda x: 0 < x < math.inf)


def non_negative(name: str, value: object, unit: str = "1") -> float:
    """Return a finite `value` of at least 0 as a float, or raise ValueError."""
    return _check_number(name, value, unit, "a finite number >= 0", lambda x: 0 <= x < math.inf)


def whole(name: str, value: object, least: int, most: int | None = None) -> int:
    """Return a whole number between bounds as an int, or raise ValueError."""
    number = as_real(value)
    top = math.inf if most is None else most
    if number is None or not (number.is_integer() and least <= number <= top):
        bounds = f">= {least}" if most is None else f"from {least} to {most}"
        raise ValueError(f"{name} must be a whole number {bounds}, got {value!r}")
    return int(number)


def shown(value: object, unit: str = "1") -> str:
    """Write a refused value: a finite number in readable units, anything else as Python does."""
    number = as_real(value)
    is_finite = number is not None and math.isfinite(number)
    return format_quantity(number or 0.0, unit, 9) if is_finite else repr(value)


def check_fields(
    instance: object, *names: str, check: Callable[[str, object, str], float] = positive
) -> None:
    """Check fields of a frozen dataclass in their units and store them as floats or None."""
    owner = type(instance)
    for name in names:
        value = getattr(instance, name)
        if value is not None or _fields(owner)[name].default is not None:
            unit = unit_of(owner, name) or "1"
            store(instance, **{name: check(f"{owner.__name__}: {name}", value, unit)})


def store(instance: object, **values: object) -> None:
    """Set fields of a frozen dataclass during its construction."""
    for name, value in values.items():
        object.__setattr__(instance, name, value)


def unit_of(owner: type, argument: str, control: str = "") -> str | None:
    """Unit of a dataclass field by its metadata; "1" without dimension, None for names."""
    # A unit that depends on the field `control` (force or approach) is a mapping in the metadata.
    unit: str | Mapping[str, str] | None = _fields(owner)[argument].metadata.get("unit")
    return unit[control] if isinstance(unit, Mapping) else unit


def _fields(owner: type) -> dict[str, Field[Any]]:
    return {field.name: field for field in fields(owner)}


def _check_number(
    name: str, value: object, unit: str, wanted: str, accepts: Callable[[float], bool]
) -> float:
    number = as_real(value)
    if number is None or not accepts(number):
        is_finite = number is not None and math.isfinite(number)
        of_unit = "" if is_finite or unit == "1" else f" in {unit}"
        raise ValueError(f"{name} must be {wanted}{of_unit}, got {shown(value, unit)}")
    return number
