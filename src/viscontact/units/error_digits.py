"""Numbers with as many digits as their error bars bear."""

from __future__ import annotations

import math

from viscontact.units.formatting import in_digits

#: Digits of an error that are worth printing (GUM, 7.2.6), and those of any number in a table.
_ERROR_DIGITS, _DIGITS = 2, 4


def in_supported_digits(value: float, error: float, digits: int = _DIGITS) -> str:
    """Write a number with no more digits than its error supports.

    Parameters
    ----------
    value : float
        The number.
    error : float
        Half width of its error bar, in the same unit; NaN where it is not known, inf where the
        value depends on the mesh.
    digits : int
        Significant digits at most.

    Returns
    -------
    str
        The number, down to the second digit of its error; behind ``>`` if the error is infinite.

    Examples
    --------
    >>> in_supported_digits(152.234, 4.6), in_supported_digits(152.234, 46.0)
    ('152.2', '152')
    >>> in_supported_digits(152.234, math.inf), in_supported_digits(0.3, 20.0)
    ('>152.2', '0')
    """
    if math.isnan(value) or math.isnan(error) or error <= 0:
        return in_digits(value, digits)
    if math.isinf(error):
        return f">{in_digits(value, digits)}"
    last = _leading(error) + 1 - _ERROR_DIGITS
    rounded = round(value / 10.0**last) * 10.0**last
    if rounded == 0:
        return "0"
    return in_digits(rounded, min(max(_leading(rounded) - last + 1, 1), digits))


def in_error_digits(error: float) -> str:
    """Write an error with two significant digits.

    Parameters
    ----------
    error : float
        Half width of an error bar; NaN where it is not known.

    Returns
    -------
    str
        With a plus-minus sign in front.

    Examples
    --------
    >>> in_error_digits(0.4567), in_error_digits(107.0), in_error_digits(math.nan)
    ('±0.46', '±110', '±?')
    """
    if math.isnan(error):
        return "±?"
    return "±0" if error == 0 else f"±{in_digits(_rounded(error), _ERROR_DIGITS)}"


def in_percent(part: float) -> str:
    """Write a part of a whole in per cent, with two significant digits.

    Parameters
    ----------
    part : float
        The part [-].

    Returns
    -------
    str
        Below a hundredth of a per cent only that it is.

    Examples
    --------
    >>> in_percent(0.00312), in_percent(0.127), in_percent(1e-7), in_percent(2.0)
    ('0.31 %', '13 %', '<0.01 %', '200 %')
    """
    percent = 100 * part
    if 0 < percent < 0.01:
        return "<0.01 %"
    return f"{percent:.0f} %" if percent >= 9.95 else f"{in_digits(percent, 2)} %"


def _rounded(value: float) -> float:
    return float(f"{abs(value):.{_ERROR_DIGITS - 1}e}")


def _leading(value: float) -> int:
    """Place of the first digit once the number is rounded to two: 0 for ones, -1 for tenths."""
    return math.floor(math.log10(_rounded(value)))


def at_most(part: float) -> str:
    """Write a bound on a part of a whole in per cent, in words.

    Parameters
    ----------
    part : float
        The part [-].

    Returns
    -------
    str
        "at most", or "below" where it is too small to be told.

    Examples
    --------
    >>> at_most(0.0031), at_most(1e-9)
    ('at most 0.31 %', 'below 0.01 %')
    """
    told = in_percent(part)
    return f"below {told[1:]}" if told.startswith("<") else f"at most {told}"
