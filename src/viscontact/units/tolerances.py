"""Parse numbers with a tolerance, such as '12 mm ± 0.02 mm'."""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import Decimal

from viscontact.units.formatting import quoted
from viscontact.units.parsing import parse_any_quantity, parse_scale, split_quantity

_TOLERANCED = re.compile(r"\s*(?P<nominal>[+-]?[\d.][^±]*?)?\s*(?:±|\+/-|\+-)\s*(?P<deviation>.*)")
#: Digits of bounds whose deviation has another unit.
_DIGITS = 12


@dataclass(frozen=True)
class Toleranced:
    """Number with a tolerance: its nominal value, the deviation and the bounds, in one unit."""

    nominal: str
    deviation: str
    low: str
    high: str


def read_toleranced(text: str) -> Toleranced | None:
    """Read a number with a tolerance, as on drawings; None for others, ValueError if faulty."""
    match = _TOLERANCED.fullmatch(text)
    if match is None:
        return None
    try:
        amount, other = split_quantity(match["deviation"])
        number, unit = split_quantity(match["nominal"] or f"0 {other}")
        unit = unit or ("" if other == "%" else other)
        deviation = _in_unit(Decimal(amount), other or unit, Decimal(number), unit)
    except ValueError as error:
        raise ValueError(f"cannot read the tolerance in {quoted(text)}: {error}") from None
    if not deviation > 0:
        raise ValueError(f"the tolerance in {quoted(text)} must be more than zero")
    middle = Decimal(number)
    low, high = (_tolerance_text(each, unit) for each in (middle - deviation, middle + deviation))
    return Toleranced(f"{number} {unit}".rstrip(), _tolerance_text(deviation, unit), low, high)


def _in_unit(deviation: Decimal, given: str, nominal: Decimal, unit: str) -> Decimal:
    """Deviation in the unit of the nominal value; ValueError if its own unit does not fit."""
    if given == unit:
        return deviation
    if given == "%":
        return abs(nominal) * deviation / 100
    (own, base), (one, same) = (parse_any_quantity(f"1 {each}") for each in (given, unit))
    if base != same:
        raise ValueError(f"the unit of {deviation} {given} does not fit {nominal} {unit}")
    if base == "K":  # degrees have an offset, which a deviation has not
        own, one = (parse_scale(each, "temperature difference").factor for each in (given, unit))
    return deviation * Decimal(f"{own / one:.{_DIGITS}g}")


def _tolerance_text(number: Decimal, unit: str) -> str:
    return f"{float(number):.{_DIGITS}g} {unit}".rstrip()
