"""Time axis: its span, and its scale, linear or logarithmic from the instant of loading."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.plot.layout import style
from viscontact.results.run_axis import require_time
from viscontact.results.shown_scalars import is_shown
from viscontact.results.variables import error_name
from viscontact.units.formatting import ReadableUnit, clock_ticks, format_quantity

#: Relative change of a constant load, and share of the time from which on it is held: the rest is
#: creep, which is even in log time.
_STEADY, _SOON = 1e-5, 0.05
#: Least ratio of a logarithmic axis: below a decade it has hardly any tick labels.
_DECADE = 10.0
#: Width of a panel beside its axis, mean width of a letter, and gap between labels [inch].
_BESIDE, _LETTER, _GAP = 0.7, 0.065, 0.07
#: Length of a logarithmic time axis before the first step, against the rest of it.
BEFORE_FIRST = 0.2


def within_span(
    run: xr.Dataset, variables: Iterable[str], times: ArrayLike | None, figure: str, name: str
) -> xr.Dataset:
    """Cut variables over time and their errors to a span [s]; None for the whole run.

    ValueError for fewer than two instants.

    >>> run = xr.Dataset({"force": ("time", [0.0, 1.0, 2.0])}, coords={"time": [0.0, 1.0, 2.0]})
    >>> within_span(run, ["force"], [0.0, 1.5], "history", "").force.values.tolist()
    [0.0, 1.0]
    """
    require_time(run, figure)
    span = run["time"].values if times is None else np.atleast_1d(np.asarray(times, dtype=float))
    if span.size == 0 or not np.all(np.isfinite(span)):
        raise ValueError(f"{figure}: times must be finite numbers of seconds, got {times!r}")
    inside = (run["time"] >= span.min()) & (run["time"] <= span.max())
    names = list(variables)
    names += [error_name(name) for name in names if error_name(name) in run]
    shown = run[names].isel(time=np.flatnonzero(inside))
    if shown.sizes["time"] < 2:
        raise ValueError(
            f"{figure}: needs at least two steps to draw a line, got {shown.sizes['time']} between "
            f"{format_quantity(span.min(), 's')} and "
            f"{format_quantity(span.max(), 's')}{f' in {name}' if name else ''}"
        )
    return shown


def scale_time(
    panels: list[Axes],
    runs: Mapping[str, xr.Dataset],
    time_unit: ReadableUnit,
    drawn: Iterable[Floats] | None = None,
) -> None:
    """Scale and label the time axes of panels, logarithmic where that suits all runs."""
    shown = [run["time"].values for run in runs.values()] if drawn is None else drawn
    instants = [time_unit(each) for each in shown]
    start = min(float(instant[0]) for instant in instants)
    end = max(float(instant[-1]) for instant in instants)
    first = min((float(t) for instant in instants for t in instant if t > 0), default=end)
    # A few instants of a long run may be within a decade.
    on_log = all(map(suits_log_time, runs.values())) and end >= _DECADE * first
    for axes in panels:
        if on_log:
            set_log_time(axes, first, end)
        if end > start:
            axes.set_xlim(start, end)
        label = time_unit.label("Time")
        if on_log:
            label = label_log_time(axes, time_unit, first, end)
        if axes.xaxis.get_tick_params()["labelbottom"]:
            axes.set_xlabel(label)


def label_log_time(axes: Axes, unit: ReadableUnit, first: float, end: float) -> str:
    """Mark s, min, h and d on a logarithmic axis over hours or days; return the axis label."""
    is_whole = axes.get_xscale() == "symlog"
    ticks = clock_ticks(unit, first, end)
    if not ticks:
        return unit.label("Time")
    before = BEFORE_FIRST / (1 + BEFORE_FIRST) if is_whole else 0.0
    width, decades = _axis_width(axes), math.log10(end / first)
    along = {
        place: width * (before + (1 - before) * math.log10(place / first) / decades)
        for place in ticks
    }
    start = {0.0: "0"} if is_whole else {}
    labelled = _apart(start | ticks, {0.0: 0.0} | along)
    axes.set_xticks(list(labelled), list(labelled.values()))
    axes.set_xticks([place for place in ticks if place not in labelled], minor=True)
    axes.xaxis.set_minor_formatter(NullFormatter())
    return "Time"


def _axis_width(axes: Axes) -> float:
    """Width of an axis [inch], an estimate before the layout is known."""
    figure, place = style.figure_of(axes), axes.get_subplotspec()
    if place is None:
        return float(axes.get_position().width * figure.get_figwidth())
    return max(figure.get_figwidth() / place.get_gridspec().ncols - _BESIDE, 0.5)


def _apart(texts: Mapping[float, str], along: Mapping[float, float]) -> dict[float, str]:
    """Labels that do not touch, at positions along an axis [inch]; whole units come first."""
    ranks = {place: number for number, place in enumerate(sorted(texts, reverse=True))}
    order = sorted(
        (place for place in texts if texts[place]),
        key=lambda place: (place != 0, not texts[place].startswith("1 "), ranks[place]),
    )
    kept: dict[float, str] = {}
    for place in order:
        half = _LETTER * len(texts[place]) / 2
        others = ((along[each], _LETTER * len(text) / 2) for each, text in kept.items())
        if all(abs(along[place] - at) > half + other + _GAP for at, other in others):
            kept[place] = texts[place]
    return dict(sorted(kept.items()))


def set_log_time(axes: Axes, first: float, end: float) -> None:
    """Make a time axis logarithmic from the first step on, with zero at its beginning."""
    # Linear up to the first step, so that the instant of loading is on the axis too, over a
    # fifth of its length, so that the tick labels there keep apart.
    share = BEFORE_FIRST * math.log10(end / first)
    axes.set_xscale("symlog", linthresh=first, linscale=share)
    decades = 10.0 ** np.arange(math.floor(math.log10(first)), math.ceil(math.log10(end)) + 1)
    between = np.outer(decades, range(2, 10)).ravel()
    # matplotlib would mark decades below the first step too, on top of the zero.
    axes.set_xticks([0.0, *decades[(decades >= first) & (decades <= end)]])
    axes.set_xticks(between[(between >= first) & (between <= end)], minor=True)
    axes.xaxis.set_minor_formatter(NullFormatter())


def suits_log_time(run: xr.Dataset) -> bool:
    """True for a run with steps over decades whose load is held nearly from the start.

    >>> times = [0.0, 1.0, 2.0, 4.0, 1000.0]
    >>> held = xr.Dataset({name: ("time", [1.0] * 5) for name in ("force", "approach")})
    >>> suits_log_time(held.assign_coords(time=times))
    True
    """
    return _steps_grow(run["time"].values) and _held_from(run)


def _steps_grow(instants: Floats) -> bool:
    """True if the steps are spread over decades, as on a logarithmic axis."""
    positive = instants[instants > 0]
    return positive.size > 2 and float(np.median(positive)) < 0.1 * float(positive[-1])


def _held_from(run: xr.Dataset) -> bool:
    """True if the prescribed force or approach is held over most of the time."""
    times = run["time"].values
    held_from = []
    for name in ("force", "approach"):
        if not is_shown(run, name):
            continue
        values = run[name].values
        differs = np.abs(values - values[-1]) > _STEADY * np.abs(values).max()
        held_from.append(times[int(np.flatnonzero(differs).max(initial=-1)) + 1])
    return bool(min(held_from) <= _SOON * times[-1])
