"""Force or approach of a load history over time."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import HarmonicHistory, LoadHistory, TemperatureHistory
from viscontact.drawing.content.panel import Axis, Curve, Mark, Panel, Units
from viscontact.drawing.content.temperature_course import temperature_aside
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Number of cycles of a harmonic load that are drawn, and of straight pieces of a curved load.
_MOST_CYCLES, _MOST_PIECES = 5, 240
#: The level after the last point of a history is drawn over this fraction of its time.
_HELD = 0.25
#: The drawing begins earlier by this fraction of its length.
_BEFORE = 0.05
#: Room below and above the levels.
_BELOW, _ABOVE = 0.04, 0.06
#: Points of a curve up to a given end, and room at both sides of it.
_POINTS, _MARGIN = 1200, 0.02


def load_panel(
    load: LoadHistory,
    end: float,
    units: Units = readable_unit,
    temperature: TemperatureHistory | None = None,
) -> Panel:
    """Panel of a load up to an end [s], and of a temperature beside it.

    A jump is a vertical line, one at time 0 begins at zero.
    """
    kinks = load.kinks[(load.kinks > 0) & (load.kinks < end)]
    instants = np.unique(np.concatenate([np.linspace(0.0, end, _POINTS), kinks]))
    times, levels = _both_sides(load, instants)
    levels[0] = 0.0  # zero load before the beginning
    limits = (-_MARGIN * end, (1 + _MARGIN) * end)
    return Panel(
        Axis("Time", units("s", times), limits),
        Axis.of(_quantity(load), load.unit, levels, units=units),
        (Curve(times, levels),),
        marks=(Mark(0.0, "y"),),
        aside=temperature_aside(temperature, end),
    )


def whole_load_panel(load: LoadHistory, units: Units = readable_unit) -> Panel:
    """Panel of a whole load, or of its first cycles, with its level before and after it."""
    kinks = load.kinks
    curved_until = float(kinks[-1])
    end, note = curved_until * (1 + _HELD) or 1.0, "then held"
    if isinstance(load, HarmonicHistory):
        curved_until = end = min(load.cycles, _MOST_CYCLES) * load.period
        if load.cycles > _MOST_CYCLES:
            note = f"{_MOST_CYCLES} of {load.cycles} cycles"
    pieces = min(math.ceil(curved_until / load.longest_step), _MOST_PIECES)
    curve = np.linspace(0.0, curved_until, pieces + 1)
    instants = np.unique(np.concatenate([[-_BEFORE * end, end], kinks[kinks <= end], curve]))
    times, levels = _both_sides(load, instants)
    low, high = float(levels.min(initial=0.0)), float(levels.max(initial=0.0))
    span = (high - low) or 1.0
    limits = (low - _BELOW * span, low + (1 + _ABOVE) * span)
    quantity, reach = _quantity(load), (-_BEFORE * end, end)
    x = Axis("Time", units("s", times), reach)
    if kinks[-1] == 0:  # of a constant load; the drawing's end means nothing
        x = Axis("Time", ReadableUnit("", 1.0), reach, texts=("0",))
    return Panel(
        x,
        Axis(quantity, units(load.unit, *limits), limits),
        (Curve(times, levels),),
        title=f"{quantity.lower()} over time",
        note=note,
    )


def _quantity(load: LoadHistory) -> str:
    """Quantity that a load prescribes."""
    return "Share of the largest load" if load.control == "mixed" else load.control.capitalize()


def _both_sides(load: LoadHistory, instants: Floats) -> tuple[Floats, Floats]:
    """Instants and levels of a curve, with both sides of every jump."""
    both = [load.level_at(instants, side=side) for side in ("left", "right")]
    return np.repeat(instants, 2), np.stack(both, axis=1).ravel()
