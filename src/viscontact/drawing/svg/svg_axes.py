"""Axes of small drawings: range, unit and ticks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.scale import round_step
from viscontact.units.formatting import clock_ticks, format_quantity, readable_unit

#: Largest number of decades that all have a tick; of more, every second, third, ... has one.
_MOST_DECADES = 3


@dataclass(frozen=True)
class AxisScale:
    """Scale of an axis, linear or logarithmic."""

    label: str  # quantity with its unit
    low: float  # end [SI, or its decimal logarithm]
    high: float
    ticks: tuple[tuple[float, str], ...]  # positions as returned by `place`, and their labels
    logarithmic: bool = False

    def place(self, values: ArrayLike) -> Floats:
        """Positions of values [SI] along the axis, from 0 to 1."""
        at = np.asarray(values, dtype=np.float64)
        if self.logarithmic:  # 0 lies before any place
            at = np.log10(np.where(at > 0, at, np.nan))
        return np.asarray((at - self.low) / (self.high - self.low))


def linear(quantity: str, unit: str, low: float, high: float, most: int = 4) -> AxisScale:
    """Linear axis between two ends, `low` < `high` [SI]."""
    shown = readable_unit(unit, low, high)
    step = round_step((high - low) / shown.factor / most)
    first, last = (math.ceil(low / shown.factor / step - 1e-9), high / shown.factor / step + 1e-9)
    numbers = [step * k for k in range(first, math.floor(last) + 1)]
    ticks = tuple(
        ((number * shown.factor - low) / (high - low), _number(number)) for number in numbers
    )
    return AxisScale(_axis_label(quantity, shown.symbol), low, high, ticks)


def logarithmic(
    quantity: str, unit: str, low: float, high: float, *, each_with_unit: bool = False
) -> AxisScale:
    """Logarithmic axis between two ends, 0 < `low` < `high` [SI], with ticks at decades."""
    shown = readable_unit(unit, math.sqrt(low * high))
    ends = math.log10(low), math.log10(high)
    decades = range(math.ceil(ends[0] - 1e-9), math.floor(ends[1] + 1e-9) + 1)
    every = max(1, math.ceil((len(decades) - 1) / _MOST_DECADES))
    ticks = tuple(
        (
            (decade - ends[0]) / (ends[1] - ends[0]),
            format_quantity(10.0**decade, unit)
            if each_with_unit
            else _number(10.0**decade / shown.factor),
        )
        for decade in decades[::every]
    )
    clock = each_with_unit and unit == "s" and _clock(low, high)
    if clock:
        ticks = tuple(
            ((math.log10(place) - ends[0]) / (ends[1] - ends[0]), text)
            for place, text in clock.items()
        )
    label = quantity if each_with_unit else _axis_label(quantity, shown.symbol)
    return AxisScale(label, *ends, ticks, logarithmic=True)


def _clock(low: float, high: float) -> dict[float, str]:
    """Instants [s] of an axis over hours or days that have a label, and the labels."""
    unit = readable_unit("s", high)
    ticks = clock_ticks(unit, low / unit.factor, high / unit.factor, close=10.0**_MOST_DECADES)
    return {place * unit.factor: text for place, text in ticks.items() if text}


def _number(value: float) -> str:
    return f"{value:.6g}".replace("-", "\N{MINUS SIGN}") if abs(value) > 1e-12 else "0"


def _axis_label(quantity: str, symbol: str) -> str:
    return f"{quantity} [{symbol}]" if symbol else quantity
