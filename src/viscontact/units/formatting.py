"""SI numbers become readable words."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class ReadableUnit:
    """A unit to print in: its symbol, and how many SI units it is."""

    symbol: str
    factor: float


_PREFIXES = (
    *((1e-18, "a"), (1e-15, "f"), (1e-12, "p"), (1e-9, "n"), (1e-6, "µ"), (1e-3, "m")),
    *((1.0, ""), (1e3, "k"), (1e6, "M"), (1e9, "G")),
)
_LONG_TIMES = ((1e4, 3600.0, "h"), (2.6e5, 86400.0, "d"))
_SYMBOLS = {"m2": "m²", "m^2": "m²", "m**2": "m²", "1": ""}


def readable_unit(largest: float, unit: str) -> ReadableUnit:
    """Choose the unit in which a number reads best.

    Parameters
    ----------
    largest : float
        The largest magnitude to be printed, in `unit`.
    unit : str
        The SI unit: ``"m"``, ``"m2"``, ``"s"``, ``"N"``, ``"Pa"``, ``"1/Pa"``, ``"Pa s"``,
        ``"rad"``, ``"J"``, ``"J/mol"`` or ``"1"``.

    Returns
    -------
    ReadableUnit
        Divide by its `factor`, print its `symbol`.

    Examples
    --------
    >>> readable_unit(1.05e-4, "m2")
    ReadableUnit(symbol='mm²', factor=1e-06)
    >>> readable_unit(1.5e8, "Pa").symbol
    'MPa'
    >>> readable_unit(2.6e-17, "J").symbol
    'aJ'
    >>> readable_unit(5.5e-10, "1/Pa").symbol
    '1/GPa'
    """
    symbol = _SYMBOLS.get(unit, unit)
    size = abs(largest)
    if not symbol or not math.isfinite(size) or size == 0.0:
        return ReadableUnit(symbol, 1.0)
    if symbol == "1/Pa":
        # The largest prefix that leaves the compliance below a thousand.
        modulus = readable_unit(999 / size, "Pa")
        return ReadableUnit(f"1/{modulus.symbol}", 1 / modulus.factor)
    if symbol == "s":
        for above, factor, name in reversed(_LONG_TIMES):
            if size > above:
                return ReadableUnit(name, factor)
    return _prefixed(size, symbol)


def _prefixed(size: float, symbol: str) -> ReadableUnit:
    # Kilometres, kiloseconds and kiloradians are nobody's daily unit, nor are picometres; the
    # forces and works of a sharp tip are small enough for all prefixes.
    top = 1.0 if symbol in ("m", "m²", "s", "rad") else math.inf
    bottom = 0.0 if symbol in ("N", "J") else 1e-9
    # An area passes for its unit down to a hundredth: 0.7 mm² reads better than 700000 µm².
    power, least = (2, 0.01) if symbol == "m²" else (1, 1.0)
    usable = [(p**power, name) for p, name in _PREFIXES if bottom <= p <= top]
    # One in a thousand of slack: 0.9999 mm stays in millimetres.
    fitting = [entry for entry in usable if least * entry[0] <= size * 1.001] or usable[:1]
    factor, prefix = fitting[-1]
    return ReadableUnit(prefix + symbol, factor)


def in_words(value: float, unit: str, digits: int = 4) -> str:
    """Write a number with the unit in which it reads best.

    Parameters
    ----------
    value : float
        The number, in `unit`.
    unit : str
        Its SI unit, as in `readable_unit`.
    digits : int
        How many significant digits to print.

    Returns
    -------
    str
        The number and its unit.

    Examples
    --------
    >>> in_words(0.009565, "m")
    '9.565 mm'
    >>> in_words(152.23e6, "Pa")
    '152.2 MPa'
    """
    readable = readable_unit(value, unit)
    number = in_digits(value / readable.factor, digits)
    if "." in number and "e" not in number:  # alone, no column asks for idle zeros
        number = number.rstrip("0").rstrip(".")
    return f"{number} {readable.symbol}".rstrip()


def in_digits(value: float, digits: int = 4) -> str:
    """Write a number with so many significant digits, without an exponent where it can.

    Parameters
    ----------
    value : float
        The number.
    digits : int
        How many significant digits to print.

    Returns
    -------
    str
        The number; a dash for NaN, which stands for "does not apply".

    Examples
    --------
    >>> in_digits(152.2349), in_digits(9.99999), in_digits(float("nan"))
    ('152.2', '10.00', '-')
    """
    if math.isnan(value):
        return "-"
    # Two values that differ by rounding only are to print alike: 4.7825 is 4.782 or 4.783.
    value = float(f"{value:.{max(9, digits + 2) - 1}e}")
    if value == 0.0 or not 1e-4 <= abs(value) < 1e6:
        return f"{value:.{digits}g}"
    # Of the rounded number: 9.99999 has two digits in front once it is written 10.00.
    rounded = abs(float(f"{value:.{digits - 1}e}"))
    decimals = max(0, digits - 1 - math.floor(math.log10(rounded)))
    return f"{value:.{decimals}f}"
