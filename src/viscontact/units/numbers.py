"""Validation of numeric arguments, in their units."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import Field, fields
from decimal import Decimal
from numbers import Real
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from viscontact.units.formatting import format_quantity
from viscontact.units.parsing import unit_factor

Array: TypeAlias = NDArray[np.float64]


#: Upper limit on extents and spacings [m].
_LONGEST = 1e6

#: Types of the numbers of a list that are plain floats.
_PLAIN = {float, int, np.float64}


def real_array(name: str, given: object, unit: str = "1", ndim: int | None = None) -> Array:
    """Return numbers of any shape, or `ndim` axes, as floats in an SI unit; ValueError for others.

    Every array that a user gives passes here, or `finite_array`. What has a unit (of pint, or as
    the attribute of an xarray) is converted. NaN and inf are numbers; masked values, dates, complex
    numbers, truth values and texts are not. An array of floats is returned as it is.
    """
    array = given
    if type(array) is not np.ndarray or array.dtype != np.float64:
        try:
            array = _as_floats(given, unit)
        except (TypeError, ValueError, OverflowError) as error:
            raise ValueError(f"{name} must be numbers{_in(unit)}, got {error}") from None
    if ndim is not None and array.ndim != ndim:
        wanted = {1: "a list", 2: "a map [x, y]"}[ndim]
        raise ValueError(f"{name} must be {wanted} of numbers{_in(unit)}, got shape {array.shape}")
    return array


def finite_array(name: str, given: object, unit: str = "1", ndim: int | None = None) -> Array:
    """Return finite numbers as `real_array`, in a read-only copy."""
    array = np.array(real_array(name, given, unit, ndim))
    for wrong in array[~np.isfinite(array)][:1]:
        raise ValueError(f"{name} must be finite, got {wrong}")
    array.flags.writeable = False
    return array


def both_lengths(name: str, given: object) -> tuple[float, float]:
    """Return a positive length, or one along x and one along y, as these two; else ValueError."""
    lengths = real_array(name, given, "m")
    if lengths.shape not in ((), (2,)) or not ((lengths > 0) & (lengths < _LONGEST)).all():
        raise ValueError(
            f"{name} must be a length in m, or one along x and one along y, got {given!r}"
        )
    along, across = np.broadcast_to(lengths, 2).tolist()
    return along, across


def as_real(value: object, unit: str = "1") -> float | None:
    """Real number or array without axes as a float, inf beyond floats; None for others."""
    try:
        number = _as_floats(value, unit)
    except OverflowError:
        return math.inf
    except (TypeError, ValueError):
        return None
    return float(number) if number.ndim == 0 else None


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
    number = as_real(value, unit)
    is_finite = number is not None and math.isfinite(number)
    return format_quantity(number or 0.0, unit, 9) if is_finite else _as_written(value)


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
    number = as_real(value, unit)
    if number is None or not accepts(number):
        is_finite = number is not None and math.isfinite(number)
        of_unit = "" if is_finite else _in(unit)
        raise ValueError(f"{name} must be {wanted}{of_unit}, got {shown(value, unit)}")
    return number


def _as_floats(given: Any, unit: str) -> Array:
    """Numbers as floats in an SI unit; the message of the error is what was given instead."""
    if type(given) in _PLAIN:
        return np.array(given, dtype=np.float64)
    numbers, factor = _without_unit(given, unit)
    # Imported by whoever masks values; else not, as that takes 4 ms.
    if "numpy.ma" in sys.modules and np.ma.is_masked(numbers):
        raise ValueError("masked values; leave them out, or fill them with numbers")
    array = np.asarray(None if isinstance(numbers, list | tuple) else numbers)
    if array.dtype.kind == "O" and array.ndim:
        numbers = array.tolist()
    if isinstance(numbers, list | tuple):
        is_plain = _PLAIN.issuperset(map(type, numbers))
        rows = numbers if is_plain else list(_each_as_floats(numbers, unit))
        if not is_plain and len({row.shape for row in rows}) > 1:
            raise ValueError("rows of unequal length")
        array = np.array(rows, dtype=np.float64)
    elif array.dtype.kind == "O" and isinstance(numbers, Real | Decimal):
        array = np.array(float(numbers))
    if array.dtype.kind in "mM":
        raise ValueError("dates or durations; seconds are (t - t[0]) / np.timedelta64(1, 's')")
    if array.dtype.kind not in "iuf":
        raise ValueError(_as_written(given))
    return np.asarray(array.astype(np.float64) * factor)


def _each_as_floats(items: Sequence[object], unit: str) -> Iterator[Array]:
    for index, item in enumerate(items):
        try:
            yield _as_floats(item, unit)
        except ValueError as error:
            raise ValueError(f"{error} at [{index}]") from None


def _without_unit(given: Any, unit: str) -> tuple[Any, float]:
    """Numbers without a unit of their own, and its factor to `unit`."""
    inner = getattr(given, "data", given) if hasattr(given, "attrs") else given
    places = ((of, name) for of in (inner, given) for name in ("units", "unit"))
    units = next((found for of, name in places if (found := getattr(of, name, None))), None)
    if units is None:
        return given, 1.0
    text = f"{units:~D}" if hasattr(inner, "magnitude") else str(units)
    return getattr(inner, "magnitude", given), unit_factor(text, unit)


def _in(unit: str) -> str:
    return "" if unit == "1" else f" in {unit}"


def _as_written(value: object) -> str:
    """Refused value as Python writes it, in a line."""
    return " ".join(repr(value).split())
