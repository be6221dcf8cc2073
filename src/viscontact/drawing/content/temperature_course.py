"""Temperature of the bodies over time: beside other curves, and alone."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import TemperatureHistory
from viscontact.drawing.content.panel import Aside, Axis, Curve, Ink, Panel
from viscontact.units.formatting import readable_unit
from viscontact.units.temperatures import CELSIUS

#: Points of a curve, besides the kinks.
_POINTS = 400
#: Kinks up to which a history is drawn alone, and part of its time that is drawn beyond.
_MOST_KINKS, _HELD = 40, 0.15
#: Margin of an axis over its length, and that of a constant temperature [K].
_MARGIN, _AROUND = 0.06, 5.0

_INK = Ink("temperature", 0.7)


def temperature_aside(temperature: TemperatureHistory | None, end: float) -> Aside | None:
    """Temperature up to an end [s] on an axis of its own; None if it does not vary until then."""
    if temperature is None:
        return None
    curve = _curve(temperature, end, "thin")
    if np.ptp(curve.y) == 0:
        return None
    return Aside(_axis(curve.y), curve)


def temperature_panel(temperature: TemperatureHistory) -> Panel:
    """Panel of a whole temperature history, or of its beginning."""
    kinks = temperature.kinks
    last = float(kinks[min(kinks.size, _MOST_KINKS) - 1])
    is_whole = kinks.size <= _MOST_KINKS
    end = last * (1 + _HELD * is_whole) or 1.0
    curve = _curve(temperature, end, "line")
    x = Axis("Time", readable_unit("s", end), (0.0, end))
    note = "then held" if is_whole else "the beginning"
    return Panel(x, _axis(curve.y), (curve,), title="temperature over time", note=note)


def _curve(temperature: TemperatureHistory, end: float, look: str) -> Curve:
    kinks = temperature.kinks[temperature.kinks < end][: 10 * _POINTS]
    marks = np.unique(np.concatenate([kinks, np.linspace(0.0, end, _POINTS)]))
    # Both values at a jump.
    both = [temperature.at(marks, side=side) for side in ("left", "right")]
    values = np.stack(both, axis=1).ravel()
    thin = look == "thin"
    return Curve(np.repeat(marks, 2), values, ink=_INK, look="thin" if thin else "line")


def _axis(values: Floats) -> Axis:
    low, high = float(values.min()), float(values.max())
    room = _MARGIN * (high - low) or _AROUND
    return Axis("Temperature", CELSIUS, (low - room, high + room))
