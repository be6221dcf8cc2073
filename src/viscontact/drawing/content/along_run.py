"""Axis of time or speed of a figure: its span, its scale, and texts of the points along it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.panel import Axis, Units
from viscontact.results.run_axis import require_time, run_axis
from viscontact.results.shown_scalars import is_shown
from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import SCALARS, error_name, shown_name
from viscontact.units.formatting import format_quantity, readable_unit
from viscontact.units.numbers import finite_array
from viscontact.units.temperatures import CELSIUS

#: Relative change of a constant load, and share of the time from which on it is held: the rest is
#: creep, which is even in log time.
_STEADY, _SOON = 1e-5, 0.05
#: Least ratio of a logarithmic time axis: below a decade it has hardly any tick labels.
_DECADE = 10.0
#: Ratio of the last to the first step from which on a reader may choose the scale.
_SPREAD = 30.0


def along_run(
    runs: Iterable[xr.Dataset],
    units: Units = readable_unit,
    drawn: Iterable[Floats] | None = None,
) -> Axis:
    """Axis of time or speed, log where it suits all runs; `drawn`: shown places [s] or [m/s]."""
    runs = list(runs)
    over = run_axis(runs[0])
    shown = [over.values(run) for run in runs] if drawn is None else list(drawn)
    values = np.unique(np.concatenate(shown))
    start, end = float(values[0]), float(values[-1])
    positive = values[values > 0]
    first = float(positive[0]) if positive.size else end
    is_spread = positive.size > 2 and end >= _SPREAD * first
    if over.is_history:  # a few instants of a long run may be within a decade
        is_log = all(map(suits_log_time, runs)) and end >= _DECADE * first
    else:
        is_log = is_spread
    return Axis(
        over.name.capitalize(),
        units(over.unit, values),
        (start, end),
        ("time" if over.is_history else "log") if is_log else "linear",
        first=first,
        has_choice=is_log or is_spread,
    )


def texts_along(run: xr.Dataset, name: str, look: Look = LIGHT) -> tuple[str, ...]:
    """Instants or speeds of a run, and the values of a scalar there with their errors."""
    axis, si = run_axis(run), SCALARS[name].units
    if name == "temperature":
        values = zip(axis.values(run).tolist(), CELSIUS(run[name].values).tolist(), strict=True)
        return tuple(f"{axis.place(place)}: {value:.4g} °C" for place, value in values)
    columns = axis.values(run), run[name].values, errors_of(run, name)
    return tuple(
        f"{axis.place(place)}: {look.text(value, error, si)}"
        for place, value, error in zip(*(column.tolist() for column in columns), strict=True)
    )


def within_span(
    run: xr.Dataset, variables: Iterable[str], times: ArrayLike | None, figure: str, name: str
) -> xr.Dataset:
    """Cut variables and errors to a span [s], or the whole; ValueError below two instants."""
    require_time(run, figure)
    span = finite_array(f"{figure}: times", run["time"] if times is None else times, "s").ravel()
    if not span.size:
        raise ValueError(f"{figure}: times must be finite numbers, got none")
    first, last = span.min(), span.max()
    inside = (run["time"] >= first) & (run["time"] <= last)
    names = list(variables)
    names += [error_name(name) for name in names if error_name(name) in run]
    shown = run[names].isel(time=np.flatnonzero(inside))
    if shown.sizes["time"] < 2:
        raise ValueError(
            f"{figure}: needs at least two steps to draw a line, got {shown.sizes['time']} between "
            f"{format_quantity(first, 's')} and {format_quantity(last, 's')}"
            f"{f' in {name}' if name else ''}"
        )
    return shown


def suits_log_time(run: xr.Dataset) -> bool:
    """True for a run with steps over decades whose load is held nearly from the start."""
    return steps_grow(run["time"].values) and _held_from(run)


def steps_grow(instants: Floats) -> bool:
    """True if the steps are spread over decades, as on a logarithmic axis."""
    positive = instants[instants > 0]
    return positive.size > 2 and float(np.median(positive)) < 0.1 * float(positive[-1])


def _held_from(run: xr.Dataset) -> bool:
    """True if the prescribed force or approach is held over most of the time."""
    times = run["time"].values
    held_from = []
    for name in (shown_name("force", run), "approach"):
        if not is_shown(run, name):
            continue
        values = run[name].values
        differs = np.abs(values - values[-1]) > _STEADY * np.abs(values).max()
        held_from.append(times[int(np.flatnonzero(differs).max(initial=-1)) + 1])
    return bool(min(held_from) <= _SOON * times[-1])
