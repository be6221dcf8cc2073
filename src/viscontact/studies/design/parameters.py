"""Parameters of a design: ranges and choices of values of a case, and points in them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.studies.sweep.sampling import Range, bounded
from viscontact.units.parsing import split_quantity

#: Digits of the values that are tried.
DIGITS = 5
#: Most parameters of a design.
MOST_PARAMETERS = 8


@dataclass(frozen=True)
class Choice:
    """Named values of a key, or single quantities, in place of a range.

    >>> Choice("material", ("pmma-paper", "epdm-70-25c")).value(0.5)
    'epdm-70-25c'
    """

    key: str
    values: tuple[str, ...]

    def value(self, part: float) -> str:
        """Value at a part of the list, 0 to 1, as ``--set`` takes it."""
        return self.values[min(int(part * len(self.values)), len(self.values) - 1)]


@dataclass(frozen=True)
class Interval:
    """Range of a key, with values that are rounded to some digits.

    >>> Interval(Range("indenter.crown_radius", 20.0, 2000.0, "mm", logarithmic=True)).value(0.4)
    '126.19 mm'
    """

    bounds: Range

    @property
    def key(self) -> str:
        """Key of the case."""
        return self.bounds.key

    def value(self, part: float) -> str:
        """Value at a part of the range, 0 to 1, as ``--set`` takes it."""
        if part in (0.0, 1.0):  # as given
            return self.bounds.value(part)
        number, unit = split_quantity(self.bounds.value(part))
        return f"{float(number):.{DIGITS}g} {unit}".rstrip()


Parameter = Interval | Choice


@dataclass(frozen=True)
class Space:
    """Space of some parameters; a point has a coordinate from 0 to 1 for each of them.

    >>> space = Space((Interval(Range("indenter.radius", 1.0, 4.0, "mm", logarithmic=True)),))
    >>> space.settings([0.5])
    {'indenter.radius': '2 mm'}
    """

    parameters: tuple[Parameter, ...]

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the parameters."""
        return tuple(each.key for each in self.parameters)

    @property
    def ranges(self) -> tuple[int, ...]:
        """Numbers of the parameters that are ranges, which a local search can change."""
        return tuple(n for n, each in enumerate(self.parameters) if isinstance(each, Interval))

    def settings(self, point: Sequence[float] | Floats) -> dict[str, str]:
        """Values of the case at a point, by key."""
        pairs = zip(self.parameters, point, strict=True)
        return {each.key: each.value(float(np.clip(part, 0.0, 1.0))) for each, part in pairs}

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


def space_of(change: Mapping[str, Any]) -> Space:
    """Return the space of the parameters of `design`; ValueError names the fault.

    >>> space_of({"load.force": ("1 N", "1 kN", "log")}).parameters[0].value(0.0)
    '1 N'
    """
    if not isinstance(change, Mapping) or not change:
        raise ValueError(
            "change: name a key, as {'indenter.crown_radius': ('20 mm', '2 m', 'log')}"
        )
    if len(change) > MOST_PARAMETERS:
        raise ValueError(
            f"change: must have {MOST_PARAMETERS} parameters at most, got {len(change)}"
        )
    for key in change:
        if key.partition(".")[0] in ("grid", "output", "time"):
            raise ValueError(
                f"change: {key}: the cells and steps of a case are no parameters of a design"
            )
    return Space(tuple(_parameter(key, given) for key, given in change.items()))


def _parameter(key: str, given: Any) -> Parameter:
    if isinstance(given, list):
        values = tuple(str(value) for value in given)
        if len(set(values)) < 2 or len(set(values)) < len(values):
            raise ValueError(f"change: {key}: must list two values or more, each once, got {given}")
        return Choice(key, values)
    bounds = [str(each) for each in given] if isinstance(given, tuple) else []
    if len(bounds) not in (2, 3) or bounds[2:] not in ([], ["log"]):
        raise ValueError(
            f"change: {key}: must be a tuple of two bounds, as ('20 mm', '2 m'), and 'log' for a "
            f"logarithmic scale, or a list of values, got {given!r}"
        )
    try:
        return Interval(
            _in_one_unit(bounded(key, *bounds[:2], logarithmic=bool(bounds[2:])), bounds)
        )
    except ValueError as error:
        raise ValueError(f"change: {key}: {error}") from None


def _in_one_unit(found: Range, bounds: Sequence[str]) -> Range:
    """The range in the unit of its lower bound, if the bounds have different units."""
    (low, unit), (_, other) = (split_quantity(each) for each in bounds[:2])
    if unit == other or float(low) == 0.0 or found.unit == "K":
        return found
    number = float(low)
    return replace(found, low=number, high=number * (found.high / found.low), unit=unit)
