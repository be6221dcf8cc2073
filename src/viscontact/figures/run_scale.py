"""Axis of time or speed of a figure, linear or logarithmic."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.figures.look import Look, Part
from viscontact.plot.histories.time_axis import suits_log_time
from viscontact.results.run_axis import SPEED, RunAxis, run_axis
from viscontact.units.formatting import ReadableUnit, clock_ticks, format_compact

#: Decades between the instant 0 and the first step on a logarithmic axis.
_BEFORE = 0.5
#: Below this ratio of last to first step there is nothing to spread.
_LEAST_RATIO = 30.0


@dataclass(frozen=True)
class RunScale:
    """Axis of time or speed of one result, or of several that are compared."""

    axis: RunAxis
    unit: ReadableUnit
    values: Floats  # all instants [s] or speeds [m/s], in order
    starts_log: bool

    @property
    def has_log(self) -> bool:
        """True if the steps are spread over decades."""
        positive = self._positive
        return positive.size > 2 and bool(positive[-1] >= _LEAST_RATIO * positive[0])

    def at(self, values: Floats, *, log: bool) -> Floats:
        """Positions of instants [s] or speeds [m/s] on the axis."""
        if not log:
            return self.unit(values)
        places = np.full(values.shape, math.log10(self._first) - _BEFORE)
        places[values > 0] = np.log10(self.unit(values[values > 0]))
        return places

    def part(self, *, log: bool) -> Part:
        """Return the axis as Plotly reads it."""
        label = self.unit.label(self.axis.name.capitalize())
        if not log:
            return {"title": {"text": label}, "rangemode": "tozero"}
        first, last = math.log10(self._first), math.log10(self.unit(self._positive[-1]))
        decades = range(math.ceil(first), math.floor(last + 1e-9) + 1)
        ticks = [(first - _BEFORE, "0")] if self.values[0] <= 0 else []
        clock = clock_ticks(self.unit, self._first, float(self.unit(self._positive[-1])))
        if clock:
            label = self.axis.name.capitalize()
            ticks += [(math.log10(place), text) for place, text in clock.items() if text]
        else:
            ticks += [(float(decade), format_compact(10.0**decade)) for decade in decades]
        return {
            "title": {"text": f"{label}, logarithmic"},
            "tickmode": "array",
            "tickvals": [place for place, _ in ticks],
            "ticktext": [text for _, text in ticks],
        }

    @property
    def _positive(self) -> Floats:
        return self.values[self.values > 0]

    @property
    def _first(self) -> float:
        return float(self.unit(self._positive[0]))


def run_scale(ds: xr.Dataset, look: Look, reference: xr.Dataset | None = None) -> RunScale:
    """Return the axis of time or speed of a result and of another that is compared with it."""
    axis = run_axis(ds)
    compared = [ds] if reference is None else [ds, reference]
    values = np.unique(np.concatenate([axis.values(each) for each in compared]))
    scale = RunScale(axis, look.unit(axis.unit, values), values, False)
    starts_log = scale.has_log and (axis is SPEED or suits_log_time(ds))
    return RunScale(axis, scale.unit, values, starts_log)
