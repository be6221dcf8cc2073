"""Axes of small drawings: range, unit and ticks."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.panel import Axis
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


def scale_of(axis: Axis, most: int = 4) -> AxisScale:
    """Scale with about `most` ticks of an axis with limits."""
    low, high = axis.limits or (0.0, 1.0)
    if axis.scale != "linear":
        return _logarithmic(axis, axis.first, high)
    factor, zero = axis.unit.factor, axis.unit.zero
    step = round_step((high - low) / factor / most)
    first = math.ceil((low - zero) / factor / step - 1e-9)
    last = (high - zero) / factor / step + 1e-9
    texts = {step * k: _number(step * k) for k in range(first, math.floor(last) + 1)}
    if axis.texts:
        texts = {float(place): text for place, text in enumerate(axis.texts)}
    ticks = tuple(((at * factor + zero - low) / (high - low), text) for at, text in texts.items())
    return AxisScale(_label(axis), low, high, ticks)


def linear(quantity: str, si: str, low: float, high: float, most: int = 4) -> AxisScale:
    """Linear axis of an SI unit between two ends, `low` < `high` [SI]."""
    return scale_of(Axis.between(quantity, si, low, high), most)


def _logarithmic(axis: Axis, low: float, high: float) -> AxisScale:
    """Logarithmic axis between two ends above 0 [SI], with ticks at decades, or of the clock."""
    ends = math.log10(low), math.log10(high)
    decades = range(math.ceil(ends[0] - 1e-9), math.floor(ends[1] + 1e-9) + 1)
    every = max(1, math.ceil((len(decades) - 1) / _MOST_DECADES))
    places = [10.0**decade for decade in decades[::every]]
    if axis.in_clock_units:
        texts = _clock(low, high) or {place: format_quantity(place, "s") for place in places}
    else:
        texts = {place: _number(place / axis.unit.factor) for place in places}
    ticks = tuple(
        ((math.log10(place) - ends[0]) / (ends[1] - ends[0]), text) for place, text in texts.items()
    )
    return AxisScale(_label(axis), *ends, ticks, logarithmic=True)


def _clock(low: float, high: float) -> dict[float, str]:
    """Instants [s] of an axis over hours or days that have a label, and the labels."""
    unit = readable_unit("s", high)
    ticks = clock_ticks(unit, low / unit.factor, high / unit.factor, close=10.0**_MOST_DECADES)
    return {place * unit.factor: text for place, text in ticks.items() if text}


def _number(value: float) -> str:
    return f"{value:.6g}".replace("-", "\N{MINUS SIGN}") if abs(value) > 1e-12 else "0"


def _label(axis: Axis) -> str:
    """Quantity, and the unit where it does not stand at each tick."""
    name = axis.quantity
    name = name if len(name) == 1 else name[0].lower() + name[1:]  # but for a symbol
    each_has_unit = axis.scale != "linear" and axis.in_clock_units
    return name if each_has_unit or not axis.unit.symbol else f"{name} [{axis.unit.symbol}]"
