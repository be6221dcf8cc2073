"""Axis of time or speed in Plotly, linear or logarithmic."""

from __future__ import annotations

import math

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import Axis
from viscontact.drawing.plotly.parts import Part
from viscontact.units.formatting import clock_ticks, format_compact

#: Decades between the instant 0 and the first step on a logarithmic axis.
_BEFORE = 0.5


def places_along(axis: Axis, values: Floats, *, log: bool) -> Floats:
    """Positions of instants [s] or speeds [m/s] on an axis."""
    if not log:
        return axis.unit(values)
    places = np.full(values.shape, math.log10(axis.unit(axis.first)) - _BEFORE)
    places[values > 0] = np.log10(axis.unit(values[values > 0]))
    return places


def part_along(axis: Axis, *, log: bool) -> Part:
    """Return an axis as Plotly reads it."""
    if not log or axis.limits is None:
        return {"title": {"text": axis.label}, "rangemode": "tozero"}
    begin, end = axis.limits
    first, last = (math.log10(axis.unit(each)) for each in (axis.first, end))
    label, ticks = axis.label, [(first - _BEFORE, "0")] if begin <= 0 else []
    clock = clock_ticks(axis.unit, float(axis.unit(axis.first)), float(axis.unit(end)))
    if clock:
        label = axis.quantity
        ticks += [(math.log10(place), text) for place, text in clock.items() if text]
    else:
        decades = range(math.ceil(first), math.floor(last + 1e-9) + 1)
        ticks += [(float(decade), format_compact(10.0**decade)) for decade in decades]
    return {
        "title": {"text": f"{label}, logarithmic"},
        "tickmode": "array",
        "tickvals": [place for place, _ in ticks],
        "ticktext": [text for _, text in ticks],
    }
