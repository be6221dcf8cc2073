"""Format numbers and quantities in readable units: 167 µm, not 0.000167 m."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class ReadableUnit:
    """A unit to print or draw in: its symbol, its size and its zero in SI units."""

    symbol: str
    factor: float
    zero: float = 0.0

    def __call__(self, values: ArrayLike) -> NDArray[np.float64]:
        """Values given in SI units, expressed in this unit."""
        return (np.asarray(values, dtype=np.float64) - self.zero) / self.factor

    def label(self, quantity: str) -> str:
        """Label of an axis or a column: the quantity with its unit in brackets."""
        return f"{quantity} [{self.symbol}]" if self.symbol else quantity


_PREFIXES = (
    *((1e-18, "a"), (1e-15, "f"), (1e-12, "p"), (1e-9, "n"), (1e-6, "µ"), (1e-3, "m")),
    *((1.0, ""), (1e3, "k"), (1e6, "M"), (1e9, "G")),
)
_HOUR = 3600.0
_LONG_TIMES = ((1e4, 3600.0, "h"), (2.6e5, 86400.0, "d"))
_WITHOUT_PREFIX = ("K", "1/K", "1/(Pa s)")
_SYMBOLS = {
    **{"m2": "m²", "m^2": "m²", "m**2": "m²", "m3": "m³", "m3 s-1": "m³/s"},
    **{"J/m^2": "J/m²", "1": ""},
}


def readable_unit(unit: str, *values: ArrayLike) -> ReadableUnit:
    """Unit in which the largest of the values [SI `unit`] reads best; the SI unit for zeros."""
    finite = [np.abs(array[np.isfinite(array)]) for array in map(np.asarray, values)]
    return _unit_of(max((float(array.max(initial=0.0)) for array in finite), default=0.0), unit)


def _unit_of(size: float, unit: str) -> ReadableUnit:
    symbol = _SYMBOLS.get(unit, unit)
    if not symbol or symbol in _WITHOUT_PREFIX or not math.isfinite(size) or size == 0.0:
        return ReadableUnit(symbol, 1.0)
    if symbol == "1/Pa":
        # The largest prefix that leaves the compliance below a thousand.
        modulus = _unit_of(999 / size, "Pa")
        return ReadableUnit(f"1/{modulus.symbol}", 1 / modulus.factor)
    return _with_prefix(size, symbol)


def _with_prefix(size: float, symbol: str) -> ReadableUnit:
    units = unit_ladder(symbol)
    fitting = [unit for unit, least in units if least <= size]
    return fitting[-1] if fitting else units[0][0]


def unit_ladder(unit: str) -> list[tuple[ReadableUnit, float]]:
    """Units of an SI unit, the smallest first, with the least size [SI] that is shown in each."""
    symbol = _SYMBOLS.get(unit, unit)
    if not symbol or symbol in _WITHOUT_PREFIX:
        return [(ReadableUnit(symbol, 1.0), 0.0)]
    # Kilometres, kiloseconds, kiloradians and picometres are unusual; force and work at a sharp tip
    # are small enough for all prefixes.
    top = 1.0 if symbol in ("m", "m²", "m³", "m³/s", "s", "rad") else math.inf
    bottom = 0.0 if symbol in ("N", "J") else 1e-9
    # Areas keep their unit down to a hundredth: 0.7 mm² reads better than 700000 µm²; volumes too.
    powers = {"m²": (2, 1e-2), "m³": (3, 1e-4), "m³/s": (3, 1e-4)}
    power, least = powers.get(symbol, (1, 1.0))
    usable = [(p**power, name) for p, name in _PREFIXES if bottom <= p <= top]
    # With a margin of 0.1 %, 0.9999 mm stays in millimetres.
    margin = least / 1.001
    units = [(ReadableUnit(name + symbol, factor), margin * factor) for factor, name in usable]
    # A time of exactly the limit is still in seconds.
    long = _LONG_TIMES if symbol == "s" else ()
    limits = ((math.nextafter(above, math.inf), factor, name) for above, factor, name in long)
    return units + [(ReadableUnit(name, factor), limit) for limit, factor, name in limits]


def format_quantity(value: float, unit: str, digits: int = 4) -> str:
    """Format a value [SI `unit`] to significant digits in the unit that reads best."""
    readable = _unit_of(abs(value), unit)
    if unit == "s" and _HOUR <= abs(value) < math.inf:
        readable = _unit_of_hours(value, digits, readable)
    number = without_trailing_zeros(format_number(value / readable.factor, digits))
    return f"{number} {readable.symbol}".rstrip()


def _unit_of_hours(time: float, digits: int, usual: ReadableUnit) -> ReadableUnit:
    """Unit in which a time [s] of an hour or more has fewest digits, the first of equal ones."""
    hours, days = (ReadableUnit(name, factor) for _, factor, name in _LONG_TIMES)
    units = [hours, usual, days] if usual.symbol == "s" else [usual, hours, days]

    def needed(unit: ReadableUnit) -> int:
        number = format_number(time / unit.factor, digits)
        return len(number.replace(".", "").lstrip("0-").rstrip("0"))

    return min(units, key=needed)


def column_heading(name: str, unit: str) -> str:
    """Heading of a column of numbers in an SI unit, which is read back as a quantity."""
    return name if unit == "1" else f"{name} [{typed_unit(unit)}]"


def typed_unit(unit: str) -> str:
    """SI unit of results as it is typed behind a number."""
    return {"m2": "m^2", "m3": "m^3", "m3 s-1": "m^3/s"}.get(unit, unit)


def quoted(text: str, most: int = 60) -> str:
    """Return a text in quotation marks, shortened to a number of characters."""
    return repr(text if len(text) <= most else f"{text[: most - 3]}...")


def format_number(value: float, digits: int = 4) -> str:
    """Format a number with significant digits, zeros included, without exponent; a dash for NaN."""
    if math.isnan(value):
        return "-"
    # Values that differ by rounding print alike; otherwise 4.7825 is 4.782 or 4.783.
    value = float(f"{value:.{max(9, digits + 2) - 1}e}")
    if value == 0.0 or not 1e-4 <= abs(value) < 1e6:
        return f"{value:.{digits}g}"
    # Digits of the rounded number: 9.99999 has two before the point when written as 10.00.
    rounded = abs(float(f"{value:.{digits - 1}e}"))
    decimals = max(0, digits - 1 - math.floor(math.log10(rounded)))
    return f"{value:.{decimals}f}"


def without_trailing_zeros(number: str) -> str:
    """Drop the zeros at the end of a formatted decimal number."""
    return number.rstrip("0").rstrip(".") if "." in number and "e" not in number else number


# Unlike `format_number` it keeps no digit beyond those wanted (1234 is 1230) and has no exponent.
def format_compact(value: float, digits: int = 3) -> str:
    """Format a finite number for a label: rounded, without exponent and trailing zeros."""
    return np.format_float_positional(float(f"{value:.{digits - 1}e}"), trim="-")


def time_labels(times: Iterable[float], si: str = "s") -> tuple[str, ...]:
    """Format instants [s] (or speeds, ``"m/s"``) for a legend, with enough digits to differ."""
    # All are in one unit; instants of runs over hours or days each in s, min, h or d.
    instants = [float(instant) for instant in times]
    unit = readable_unit(si, instants)
    units = [_clock_unit(each) if _is_long(unit) else unit for each in instants]
    labels: tuple[str, ...] = ()
    for digits in range(3, 18):
        labels = tuple(
            f"{format_compact(float(unit(each)), digits)} {unit.symbol}"
            for each, unit in zip(instants, units, strict=True)
        )
        if len(set(labels)) == len(set(instants)):
            break
    return labels


def clock_ticks(
    unit: ReadableUnit, first: float, last: float, *, close: float = 1e5
) -> dict[float, str]:
    """Ticks of a log axis from `first` to `last` [`unit`] in hours or days, with their labels."""
    # Labels, of 1 s, 1 min, 1 h, 1 d, are empty where they would be too close, from a ratio of the
    # ends `close` on; an axis in seconds has no ticks.
    if not _is_long(unit):
        return {}
    below = range(-9, 0)
    instants = {10.0**n: format_quantity(10.0**n, "s") for n in below}
    instants |= {1.0: "1 s", 10.0: "10 s", 60.0: "1 min", 600.0: "10 min", 3600.0: "1 h"}
    instants |= {36000.0: "10 h"} if last < 1e4 * first else {}
    instants |= {86400.0 * 10.0**n: f"{10**n} d" for n in range(6)}
    everywhere = last < close * first
    apart = (*(10.0**n for n in below if n % 3 == 0), 1.0, 60.0, 3600.0, 86400.0, 86400.0 * 100)
    margin = 1 + 1e-9
    places = {instant: instant / unit.factor for instant in instants}
    return {
        place: instants[instant] if everywhere or instant in apart else ""
        for instant, place in places.items()
        if first <= place * margin and place <= last * margin
    }


def _is_long(unit: ReadableUnit) -> bool:
    """True for the units of times over hours or days."""
    return unit.symbol in [name for _, _, name in _LONG_TIMES]


def _clock_unit(instant: float) -> ReadableUnit:
    """Unit of an instant [s] on its own: s, min, h or d, the largest that it has two of."""
    for factor, name in ((86400.0, "d"), (3600.0, "h"), (60.0, "min")):
        if abs(instant) >= 2 * factor:
            return ReadableUnit(name, factor)
    return ReadableUnit("s", 1.0)
