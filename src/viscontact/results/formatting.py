"""Format values with their error bars."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import MESH_DEPENDENT, SCALARS
from viscontact.units.formatting import ReadableUnit, format_number, format_quantity, readable_unit

if TYPE_CHECKING:
    from viscontact.results.stored_result import Result

#: Significant digits of an error that are worth printing (GUM, 7.2.6); of a number in a table;
#: and of any number, whatever its error.
_ERROR_DIGITS, _DIGITS, _MOST_DIGITS = 2, 4, 7
#: Least bars are parts of a cell, such as 3.75 µm: rounding errors must not decide on the digit.
_TIES_UP = 1 + 1e-9
#: Errors of a smaller part of the value are left out.
NEGLIGIBLE = 1e-4
#: In a table in place of a number whose error is larger than every number of its kind.
UNKNOWN = "?"
#: In a table in place of the error of a number that depends on the mesh.
MESH_MARK = "mesh"


def format_with_error(value: float, error: float, units: str) -> str:
    """Format a value with its error, both in SI, and its unit; NaN unknown, inf mesh-dependent."""
    if math.isinf(error):
        return f"{format_bounded(value, error, units)} ({MESH_DEPENDENT})"
    if not error > NEGLIGIBLE * abs(value):
        return format_quantity(value, units)
    unit = readable_unit(units, value)
    return f"{format_with_error_in(unit, value, error)} {unit.symbol}".rstrip()


def format_bounded(value: float, error: float, units: str) -> str:
    """Format a value without its error, with ``>`` in front if it depends on the mesh; in SI."""
    number = format_quantity(value, units)
    return f">{number}" if math.isinf(error) else number


def format_with_error_in(
    unit: ReadableUnit, value: float, error: float, largest: float = math.inf
) -> str:
    """Format a value with its error, both in SI, in the unit of a table with a largest value."""
    number, half_width = value / unit.factor, error / unit.factor
    if math.isinf(error):
        return format_supported(number, half_width)
    if not error > NEGLIGIBLE * abs(value):
        return format_number(number)
    bar = format_error(half_width).replace("±", "± ")
    supported = format_supported(number, half_width, _MOST_DIGITS, largest / unit.factor)
    return f"{supported} {bar}"


def format_scalar(ds: Result, name: str, index: int) -> str:
    """Format a scalar of a result at an instant, with its error and unit."""
    error = float(errors_of(ds, name)[index])
    return format_with_error(float(ds[name][index]), error, SCALARS[name].units)


def format_supported(
    value: float, error: float, digits: int = _DIGITS, largest: float = math.inf
) -> str:
    """Format a number down to the second digit of its error, in the same unit.

    A question mark stands for one whose error is larger than the largest of all such numbers.
    """
    if math.isnan(value) or math.isnan(error) or error <= 0:
        return format_number(value, digits)
    if math.isinf(error):
        return f">{format_number(value, digits)}"
    if error > largest and value != 0:
        return UNKNOWN
    last = _leading(error) + 1 - _ERROR_DIGITS
    rounded = round(value / 10.0**last) * 10.0**last
    if rounded == 0:
        return "0"
    return format_number(rounded, min(max(_leading(rounded) - last + 1, 1), digits))


def format_error(error: float) -> str:
    """Format the half width of an error bar with two significant digits."""
    if not math.isfinite(error):
        return "±?" if math.isnan(error) else MESH_MARK
    return "±0" if error == 0 else f"±{format_number(_round(error), _ERROR_DIGITS)}"


def format_percent(part: float) -> str:
    """Format a part of a whole [-] in per cent, with two significant digits."""
    if math.isinf(part):
        return MESH_MARK
    percent = 100 * part
    if 0 < percent < 0.01:
        return "<0.01 %"
    return f"{percent:.0f} %" if percent >= 9.95 else f"{format_number(percent, 2)} %"


def format_bound(part: float) -> str:
    """Format an upper bound on a part of a whole [-] in per cent."""
    percent = format_percent(part)
    return f"below {percent[1:]}" if percent.startswith("<") else f"at most {percent}"


def _round(value: float) -> float:
    return float(f"{abs(value) * _TIES_UP:.{_ERROR_DIGITS - 1}e}")


def _leading(value: float) -> int:
    """Place of the first digit once the number is rounded to two: 0 for ones, -1 for tenths."""
    return math.floor(math.log10(_round(value)))
