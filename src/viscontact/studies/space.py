"""Space of a study: ranges, choices and scatter of values of keys, as they are given."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Literal

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.parsing import parse_any_quantity, split_quantity
from viscontact.units.tolerances import read_toleranced

#: Scale of a range, or distribution of values: uniform, of their logarithm, or normal.
Scale = Literal["uniform", "log", "normal"]

#: Digits of the values that a search tries.
DIGITS = 5
#: Part of a normal distribution between its bounds.
BETWEEN = 0.95


@dataclass(frozen=True)
class Range:
    """Range of a key: two numbers in one unit, and the scale on which points are even."""

    key: str
    low: float
    high: float
    unit: str  # empty for a plain number
    logarithmic: bool = False
    digits: int | None = None  # of the values between the bounds

    def value(self, part: float) -> str:
        """Value at a part of the range, 0 to 1, as ``--set`` takes it."""
        if self.logarithmic:
            number = self.low * (self.high / self.low) ** part
        else:
            number = self.low + (self.high - self.low) * part
        text = f"{number:.12g}"
        if self.digits is not None and part not in (0.0, 1.0):
            text = f"{float(text):.{self.digits}g}"
        return f"{text} {self.unit}".rstrip()

    def part_of(self, value: str) -> float | None:
        """Part of the range at a value; None outside of it, or if it is no quantity."""
        try:
            sizes = [parse_any_quantity(each) for each in (self.value(0.0), self.value(1.0), value)]
        except ValueError:
            return None
        (low, unit), (high, _), (number, own) = sizes
        if unit != own or not low <= number <= high:
            return None
        if self.logarithmic:
            low, high, number = (math.log(each) for each in (low, high, number))
        return (number - low) / (high - low)


@dataclass(frozen=True)
class Choice:
    """Named values of a key, or single quantities, in place of a range."""

    key: str
    values: tuple[str, ...]

    def value(self, part: float) -> str:
        """Value at a part of the list, 0 to 1, as ``--set`` takes it."""
        return self.values[min(int(part * len(self.values)), len(self.values) - 1)]

    def part_of(self, value: str) -> float | None:
        """Part of the list at a value; None if it is none of them."""
        if value not in self.values:
            return None
        return (self.values.index(value) + 0.5) / len(self.values)


@dataclass(frozen=True)
class Scatter:
    """Scatter of a key: uniform between two bounds, also of the logarithm, or normal."""

    bounds: Range
    shape: Scale

    @property
    def key(self) -> str:
        """Key of the case."""
        return self.bounds.key

    def value(self, part: float) -> str:
        """Value below which a part of the distribution lies, as ``--set`` takes it."""
        if self.shape != "normal":
            return replace(self.bounds, logarithmic=self.shape == "log").value(part)
        tail = (1 - BETWEEN) / 2
        quantile = scipy.special.ndtri  # of the normal distribution
        within = float(quantile(min(max(part, 1e-12), 1 - 1e-12)) / quantile(1 - tail))
        return self.bounds.value((within + 1) / 2)

    def __str__(self) -> str:
        low, high = self.bounds.value(0.0), self.bounds.value(1.0)
        suffix = {"uniform": "", "log": ", uniform logarithm", "normal": ", normal (95 %)"}
        return f"{low} to {high}{suffix[self.shape]}"


@dataclass(frozen=True)
class Space:
    """Space of some ranges and choices; a point has a coordinate from 0 to 1 for each of them."""

    parameters: tuple[Range | Choice, ...]

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the parameters."""
        return tuple(each.key for each in self.parameters)

    @property
    def ranges(self) -> tuple[int, ...]:
        """Numbers of the parameters that are ranges, which a local search can change."""
        return tuple(n for n, each in enumerate(self.parameters) if isinstance(each, Range))

    def settings(self, point: Sequence[float] | Floats) -> dict[str, str]:
        """Values of the case at a point, by key."""
        pairs = zip(self.parameters, point, strict=True)
        return {each.key: each.value(float(np.clip(part, 0.0, 1.0))) for each, part in pairs}

    def point(self, settings: Mapping[str, str]) -> tuple[float, ...] | None:
        """Point at some values by key; None if one is missing, or outside of the space."""
        parts = [each.part_of(settings.get(each.key, "")) for each in self.parameters]
        return None if None in parts else tuple(part for part in parts if part is not None)

    def corners(self) -> list[dict[str, str]]:
        """Values with one parameter at an end of its range, and the others in their middle."""
        found = []
        for number, each in enumerate(self.parameters):
            ends = np.linspace(0, 1, len(each.values)) if isinstance(each, Choice) else (0.0, 1.0)
            for end in ends:
                point = np.full(len(self.parameters), 0.5)
                point[number] = end
                found.append(self.settings(point))
        return found


def read_range(text: str) -> Range:
    """Read a range, ``KEY=LOW:HIGH`` or ``KEY=LOW:HIGH:log``; ValueError names the fault."""
    name, _, given = text.partition("=")
    key, (low, *others) = name.strip(), (part.strip() for part in given.split(":"))
    logarithmic = others[1:] == ["log"]
    if not (key and low and others and others[0]) or (others[1:] and not logarithmic):
        raise ValueError("write KEY=LOW:HIGH or KEY=LOW:HIGH:log, e.g. 'load.force=5 kN:20 kN:log'")
    return between(key, low, others[0], logarithmic=logarithmic)


def given_range(argument: str, key: str, given: Any) -> Range:
    """Range of two bounds, with ``"log"`` if logarithmic; ValueError begins with the argument."""
    return _read_range(argument, key, given, ("log",), takes_tolerance=False)[0]


def given_scatter(argument: str, key: str, given: Any, *, is_sampled: bool) -> Scatter:
    """Scatter of two bounds, or of a number with its tolerance; ValueError names the argument."""
    shapes = ("log", "normal") if is_sampled else ()
    return Scatter(*_read_range(argument, key, given, shapes, takes_tolerance=True))


def given_parameter(argument: str, key: str, given: Any) -> Range | Choice:
    """Range of a tuple of bounds, or choice of a list of values; ValueError names the argument."""
    if isinstance(given, list):
        values = tuple(str(value) for value in given)
        if len(set(values)) < 2 or len(set(values)) < len(values):
            raise ValueError(
                f"{argument}: {key}: must list two values or more, each once, got {given}"
            )
        return Choice(key, values)
    found = given_range(argument, key, given)
    return replace(_in_unit_of_lower(found, str(given[0]), str(given[1])), digits=DIGITS)


def _read_range(
    argument: str, key: str, given: Any, scales: tuple[str, ...], *, takes_tolerance: bool
) -> tuple[Range, Scale]:
    is_list = isinstance(given, tuple | list | np.ndarray)
    texts = [str(each) for each in given] if is_list else [given] if isinstance(given, str) else []
    scale: Scale = "uniform"
    if len(texts) > 1 and texts[-1] in scales:
        scale = "log" if texts.pop() == "log" else "normal"
    place = argument if argument == key else f"{argument}: {key}"
    try:
        toleranced = takes_tolerance and len(texts) == 1 and read_toleranced(texts[0])
        low, high = (toleranced.low, toleranced.high) if toleranced else texts
    except ValueError as error:
        if len(texts) == 1 and takes_tolerance and "±" in texts[0]:
            raise ValueError(f"{place}: {error}") from None
        raise ValueError(
            f"{place}: must be {_expected_text(scales, takes_tolerance)}, got {given!r}"
        ) from None
    try:
        return between(key, low, high, logarithmic=scale == "log"), scale
    except ValueError as error:
        raise ValueError(f"{place}: {error}") from None


def _expected_text(scales: tuple[str, ...], takes_tolerance: bool) -> str:
    tolerance = ", or a number with its tolerance, as '10 kN ± 1 kN'" if takes_tolerance else ""
    scale = ", and 'log' for a logarithmic scale" if scales else ""
    scale += " or 'normal' for a normal distribution" if "normal" in scales else ""
    return f"two bounds, as ('9 kN', '11 kN'){tolerance}{scale}"


def between(key: str, low: str, high: str, *, logarithmic: bool = False) -> Range:
    """Return the range of a key between two quantities; ValueError names the fault."""
    first, last, unit = _bounds(low, high)
    if not (math.isfinite(first) and math.isfinite(last)):
        raise ValueError(f"the bounds must be finite, got {low} and {high}")
    if not first < last:
        raise ValueError(f"the lower bound comes first, and differs; got {low} and {high}")
    if logarithmic and first <= 0:
        raise ValueError(f"a logarithmic range needs bounds above zero, got {low}")
    return Range(key, first, last, unit, logarithmic)


def _bounds(low: str, high: str) -> tuple[float, float, str]:
    """Both bounds as numbers in one unit: the given one, or the SI unit if they differ."""
    (first, unit), (last, other) = split_quantity(low), split_quantity(high)
    if unit == other:
        return float(first), float(last), unit
    if not (unit and other):
        raise ValueError(f"both bounds need a unit, or none; got {low!r} and {high!r}")
    with suppress(ValueError):
        (smallest, base), (largest, same) = parse_any_quantity(low), parse_any_quantity(high)
        # A number of kelvin may be a temperature or a difference.
        if base == same and base != "K":
            return smallest, largest, base
    raise ValueError(f"the units of {low!r} and {high!r} do not fit; write one unit in both")


def _in_unit_of_lower(found: Range, low: str, high: str) -> Range:
    """The range in the unit of its lower bound, if the bounds have different units."""
    (number, unit), (_, other) = split_quantity(low), split_quantity(high)
    if unit == other or float(number) == 0.0 or found.unit == "K":
        return found
    first = float(number)
    return replace(found, low=first, high=first * (found.high / found.low), unit=unit)
