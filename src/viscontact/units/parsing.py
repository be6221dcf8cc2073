"""Parse quantities with units, such as '5 mm', to SI numbers."""

from __future__ import annotations

import difflib
import functools
import math
import re
from contextlib import suppress
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from viscontact.units.common_units import COMMON_UNITS
from viscontact.units.dimensions import DIMENSIONS, OTHER_DIMENSIONS, Dimension
from viscontact.units.formatting import quoted
from viscontact.units.temperatures import ZERO_CELSIUS

# Degrees have an offset, other units are factors only; C is a degree here, not a coulomb.
_DEGREES = {
    **dict.fromkeys(("k", "kelvin", "degk", "°k"), (1.0, 0.0)),
    **dict.fromkeys(("c", "celsius", "degc", "°c", "℃"), (1.0, ZERO_CELSIUS)),
    **dict.fromkeys(("f", "fahrenheit", "degf", "°f", "℉"), (5 / 9, 459.67 * 5 / 9)),
}

#: Beginnings of units that only differences of temperatures have.
_DIFFERENCES = ("delta", "Δ".lower(), "∆")

_OFFSET = " above another zero"

#: Units of a plain ratio.
_NO_UNIT = ("", "1", "dimensionless")

#: Units that an unknown one may have been meant to be.
_SUGGESTED_UNITS = (
    *("nm", "um", "µm", "mm", "cm", "m", "in"),
    *("us", "ms", "s", "min", "h", "d"),
    *("uN", "mN", "N", "kN", "MN", "lbf"),
    *("Pa", "kPa", "MPa", "GPa", "psi", "bar"),
    *("urad", "mrad", "rad", "deg"),
    *("Hz", "rad/s", "K", "degC", "degF", "kJ/mol"),
)

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_QUANTITY = re.compile(rf"(?P<number>{_NUMBER})\s*(?P<unit>.*)", re.DOTALL)
# Stricter than pint, which skips unknown characters and would take unlimited time for
# the powers of "9**9**9": words, each with a small power, joined by products and quotients.
_UNIT = re.compile(
    r"(?:1\s*)?[\s/*·×()]*{word}(?:[\s/*·×()]+{word})*\)*".format(
        word=r"[A-Za-zµμΩ°%_]+(?:\s*(?:\^|\*\*)\s*-?\d|[⁻]?[¹²³⁴])?"
    )
)
#: Place of the power sign that is left out in "mm2".
_PLAIN_POWER = re.compile(r"(?<=[A-Za-zµμ])(?=[234](?!\d))")
_NOT_FINITE = re.compile(r"\s*[+-]?\.?(?:nan|inf|infinity)\b.*", re.IGNORECASE | re.DOTALL)


@dataclass(frozen=True)
class UnitScale:
    """Conversion of a unit to SI: SI value = factor * number + offset."""

    factor: float
    offset: float = 0.0

    def si(self, number: str) -> float:
        """Return the SI value of a number, given by its digits; inf beyond all floats."""
        # In decimals, so that 9.565 mm is 0.009565 m to the last digit; 9.565 * 0.001 is not.
        plain = float(number)
        if not math.isfinite(plain):
            return math.inf
        if plain == 0.0:  # or too small for a float, perhaps also for a decimal
            return self.offset
        if self.factor == 1.0 and self.offset == 0.0:
            return plain
        return float(Decimal(number) * Decimal(repr(self.factor)) + Decimal(repr(self.offset)))


def parse_quantity(text: str, dimension: str) -> float:
    """Parse ``"5 mm"``, of a dimension of `DIMENSIONS`, to SI; ValueError for another text."""
    wanted = DIMENSIONS[dimension]
    number, unit = _split_unit(text, wanted)
    value = _scale(unit, text, dimension).si(number)
    if not math.isfinite(value):
        raise ValueError(f"{quoted(text)} is not a finite number; write e.g. {wanted.example!r}")
    return value


def parse_any_quantity(text: str) -> tuple[float, str]:
    """Parse a quantity of any dimension, or a ratio, to SI number and unit; ValueError else."""
    match = _QUANTITY.fullmatch(text.strip())
    if match is None:
        raise ValueError(f"cannot read {quoted(text)} as a number with a unit")
    scale, unit = _any_scale(match["unit"])
    return scale.si(match["number"]), unit


@functools.lru_cache(maxsize=64)
def _any_scale(unit: str) -> tuple[UnitScale, str]:
    """Conversion of a unit of any known dimension to SI, and the SI unit."""
    if unit in ("", "%"):
        return UnitScale(0.01 if unit else 1.0), "1"
    for name, dimension in DIMENSIONS.items():
        with suppress(ValueError):
            return _scale(unit, unit, name), dimension.unit
    raise ValueError(f"{quoted(unit)} is no unit of {', '.join(DIMENSIONS)}")


def split_quantity(text: str) -> tuple[str, str]:
    """Number and unit (may be empty) of a quantity; ValueError without a number in front."""
    match = _QUANTITY.fullmatch(text.strip())
    if match is None or match["unit"].startswith(","):
        raise ValueError(f"{quoted(text)} is not a number with a unit; write e.g. '5.5 kN'")
    return match["number"], match["unit"]


def parse_unit(text: str, dimension: str) -> float:
    """Factor of a unit such as ``"kN"`` to SI by a key of `DIMENSIONS`; else ValueError."""
    return _factor(text.strip(), text, DIMENSIONS[dimension])


def parse_scale(text: str, dimension: str) -> UnitScale:
    """Return the conversion of a unit to SI, as `parse_unit`; temperatures may have an offset."""
    return _scale(text.strip(), text, dimension)


def unit_factor(unit: str, wanted: str) -> float:
    """Factor of a unit to an SI unit, "1" for ratios; ValueError with the dimension it has."""
    bases = []
    for each in (unit, wanted):
        try:
            bases.append((1.0, "dimensionless") if each in _NO_UNIT else _conversion(each))
        except Exception as error:  # as in `_factor`
            raise ValueError(f"the unknown unit {quoted(each)}") from error
    (factor, base), (_, target) = bases
    if base != target:
        raise ValueError(f"{_dimension_name(base)} in {unit}")
    return factor


def _scale(unit: str, text: str, dimension: str) -> UnitScale:
    wanted = DIMENSIONS[dimension]
    if dimension.startswith("temperature"):
        degrees = _DEGREES.get(unit.lower())
        if degrees is not None:
            return UnitScale(degrees[0], degrees[1] if dimension == "temperature" else 0.0)
        if dimension == "temperature" and unit.lower().startswith(_DIFFERENCES):
            raise ValueError(
                f"cannot read {quoted(text)} as {wanted.name}: {quoted(unit)} is a unit of "
                f"differences; write e.g. {wanted.example!r}"
            )
    return UnitScale(_factor(unit, text, wanted))


def _split_unit(text: str, wanted: Dimension) -> tuple[str, str]:
    hint = f"write e.g. {wanted.example!r}"
    if _NOT_FINITE.fullmatch(text):
        raise ValueError(f"{quoted(text)} is not a finite number; {hint}")
    if re.match(r"\s*[+-]?\d+,\d", text):
        raise ValueError(f"cannot read {quoted(text)}: write a decimal point, not a comma; {hint}")
    # Blanks at the ends are stripped first: a pattern for them would retry every run of blanks.
    match = _QUANTITY.fullmatch(text.strip())
    if match is None:
        raise ValueError(f"cannot read {quoted(text)} as {wanted.name}: no number in front; {hint}")
    if not match["unit"]:
        bare = quoted(text.strip())[1:-1]
        raise ValueError(f"{bare} has no unit; {wanted.name} is expected; {hint}")
    return match["number"], match["unit"]


def _factor(unit: str, text: str, wanted: Dimension) -> float:
    try:
        factor, base = _conversion(unit)
    except Exception as error:  # pint raises many kinds, of its tokenizer and parser too
        raise ValueError(
            f"cannot read {quoted(text)} as {wanted.name}: unknown unit {quoted(unit)}"
            f"{_nearest_unit(unit)}; write e.g. {wanted.example!r}"
        ) from error
    if base != _conversion(wanted.unit)[1]:
        raise ValueError(
            f"cannot read {quoted(text)} as {wanted.name} (got {_dimension_name(base)}); "
            f"write e.g. {wanted.example!r}"
        )
    return factor


@functools.lru_cache(maxsize=256)
def _conversion(unit: str) -> tuple[float, str]:
    """Factor of a unit to SI base units, and these."""
    unit = _PLAIN_POWER.sub("^", unit)
    if unit in COMMON_UNITS:
        return COMMON_UNITS[unit]
    plain = re.sub(r"[·×]", "*", unit)
    if plain.startswith("/"):
        plain = "1" + plain
    if len(unit) > 60 or not _UNIT.fullmatch(unit):
        raise ValueError("characters that do not occur in units")
    return _in_base_units(_registry().parse_units(plain))


def _nearest_unit(unit: str) -> str:
    by_lower_case = {known.lower(): known for known in _SUGGESTED_UNITS}
    near = difflib.get_close_matches(unit.lower(), by_lower_case, n=1)
    return f" (did you mean {by_lower_case[near[0]]!r}?)" if near else ""


def _in_base_units(unit: Any) -> tuple[float, str]:
    # The string of the base units distinguishes an angle (radian) from a ratio; the
    # dimensionality does not.
    try:
        zero, one = (_registry().Quantity(n, unit).to_base_units() for n in (0.0, 1.0))
    except Exception:  # a unit without a fixed factor, such as a product of degrees Celsius
        return math.nan, str(unit)
    offset = "" if zero.magnitude == 0.0 else _OFFSET
    return float(one.magnitude), f"{one.units}{offset}"


def _dimension_name(base: str) -> str:
    base = base.removesuffix(_OFFSET)
    known = {_conversion(each.unit)[1]: each.name for each in DIMENSIONS.values()}
    known |= {_conversion(unit)[1]: name for unit, name in OTHER_DIMENSIONS.items()}
    return known.get(base, f"a quantity in {base}" if base != "dimensionless" else "a plain ratio")


@functools.lru_cache(maxsize=1)
def _registry() -> Any:
    # Half a second of unit definitions, for units that are not common.
    import pint

    return pint.UnitRegistry(cache_folder=None)
