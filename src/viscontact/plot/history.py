"""Approach, tilt, area and pressure against time (the paper's Figs. 17, 18 and 19)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from numpy.typing import ArrayLike, NDArray

from viscontact.plot import style
from viscontact.plot.error_band import (
    band_key,
    draw_band,
    has_bands,
    keep_curves_in_sight,
    peak_note,
)
from viscontact.plot.page import NARROW, Width, page_width
from viscontact.plot.readable import DisplayUnit, display_unit
from viscontact.plot.span import within_span
from viscontact.stated_errors import stated_error
from viscontact.units import is_rounding_tilt
from viscontact.variables import error_name

_NAME = "history"

#: A change by less than this part is rounding; a load that is held from this part of the time on
#: leaves the rest to creep, which is even in log time.
_STEADY, _SOON = 1e-5, 0.05
#: Length of a logarithmic time axis before the first step, against the rest of it.
BEFORE_FIRST = 0.2
#: What changes by less than this part, its error included, is rounding, not to fill an axis.
_ROUNDING = 1e-6


@dataclass(frozen=True)
class Quantity:
    """A variable of the dataset as it is drawn, and whether to leave it out when idle."""

    name: str
    label: str
    si_unit: str
    only_if_varied: bool = False


QUANTITIES = (
    Quantity("force", "Force", "N", only_if_varied=True),
    Quantity("contact_area", "Contact area", "m2"),
    Quantity("approach", "Approach", "m"),
    Quantity("tilt_x", "Tilt along x", "rad", only_if_varied=True),
    Quantity("tilt_y", "Tilt along y", "rad", only_if_varied=True),
    Quantity("peak_pressure", "Peak pressure", "Pa"),
)


def history(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw contact area, approach, tilts and peak pressure against time.

    Parameters
    ----------
    results : xarray.Dataset
        What ``simulate`` or ``open_results`` returned.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One panel a quantity. Force and tilts have one only where they change. Time is
        logarithmic where the run's steps are and the load is held nearly from the start. Bands
        are the errors that the result states; a peak pressure that depends on the mesh is called
        so.

    Raises
    ------
    ValueError
        If fewer than two steps lie in the span.
    """
    return compare_histories({"": results}, times=times, width=width)


def compare_histories(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay the histories of several runs.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One panel a quantity, one line a run, and a band around it where its error is known.

    Raises
    ------
    ValueError
        If there are no runs, or one has fewer than two steps in the span.
    """
    if not runs:
        raise ValueError(f"{_NAME}: needs at least one run to compare, got none")
    shown = {name: within_span(run, _drawn(run), times, _NAME, name) for name, run in runs.items()}
    quantities = worthwhile_quantities(shown)
    figure, panels = _panels(len(quantities), page_width(width, style.TWO_COLUMNS))
    draw_quantities(panels, quantities, shown)
    _add_key(figure, panels, list(shown))
    return figure


def worthwhile_quantities(runs: Mapping[str, xr.Dataset]) -> list[Quantity]:
    """Return what is drawn of runs: not a force or a tilt that never changes."""
    return [quantity for quantity in QUANTITIES if _worth_a_panel(quantity, runs)]


def draw_quantities(
    panels: list[Axes], quantities: list[Quantity], runs: Mapping[str, xr.Dataset]
) -> DisplayUnit:
    """Draw quantities over time, one in each panel.

    Parameters
    ----------
    panels : list of matplotlib.axes.Axes
        As many as quantities.
    quantities : list of Quantity
        From `worthwhile_quantities`.
    runs : mapping of str to xarray.Dataset
        Results by name.

    Returns
    -------
    DisplayUnit
        Of the time axis.
    """
    time_unit = display_unit("s", *(run["time"].values for run in runs.values()))
    for axes, quantity in zip(panels, quantities, strict=True):
        _draw(axes, quantity, runs, time_unit)
    scale_time(panels, runs, time_unit)
    return time_unit


def _drawn(run: xr.Dataset) -> list[str]:
    names = [quantity.name for quantity in QUANTITIES]
    errors = [error_name(name) for name in names if error_name(name) in run]
    return [*names, *errors, "contact_length"]


def _worth_a_panel(quantity: Quantity, runs: Mapping[str, xr.Dataset]) -> bool:
    if not quantity.only_if_varied:
        return True
    values = [run[quantity.name].values for run in runs.values()]
    if quantity.name == "force":
        return any(np.ptp(force) > 1e-6 * np.max(force) for force in values)
    return not all(
        is_rounding_tilt(tilt, run["contact_length"].values, run["approach"].values)
        for tilt, run in zip(values, runs.values(), strict=True)
    )


def _panels(count: int, width: float) -> tuple[Figure, list[Axes]]:
    columns = 1 if width <= NARROW else 2 if count in (2, 4) else 3
    rows = -(-count // columns)
    height = {1: 1.5, 2: 2.3, 3: 2.0}[columns] * rows + 0.2
    figure = style.new_figure(width, height)
    grid = figure.subplots(rows, columns, sharex=True, squeeze=False)
    panels = list(grid.flat)
    for unused in panels[count:]:
        unused.remove()
    for axes in panels[:count]:
        style.dress(axes)
    # The lowest panel of each column says what runs along it.
    for axes in panels[max(count - columns, 0) : count]:
        axes.tick_params(labelbottom=True)
    return figure, panels[:count]


def _draw(
    axes: Axes, quantity: Quantity, runs: Mapping[str, xr.Dataset], time_unit: DisplayUnit
) -> None:
    unit = display_unit(quantity.si_unit, *(run[quantity.name].values for run in runs.values()))
    for (name, run), look in zip(runs.items(), style.run_styles(len(runs)), strict=True):
        values = run[quantity.name].values
        instants, error = time_unit(run["time"].values), stated_error(run, quantity.name)
        axes.plot(instants, unit(values), label=name, **look)
        bar = None if error is None else unit(error)
        draw_band(axes, instants, unit(values), bar, look["color"])
    axes.set_ylabel(unit.label(quantity.label))
    if quantity.name == "force":
        axes.set_ylim(0.0, 1.08 * axes.dataLim.y1)
    elif np.ptp(axes.dataLim.intervaly) <= _ROUNDING * abs(axes.dataLim.y1):
        axes.set_ylim(0.0, 1.15 * axes.dataLim.y1 or 1.0)
    if has_bands(axes):
        keep_curves_in_sight(axes, *(unit(run[quantity.name].values) for run in runs.values()))
    if quantity.name == "peak_pressure":
        style.add_heading(axes, peak_note(runs.values()), aside=True)


def scale_time(panels: list[Axes], runs: Mapping[str, xr.Dataset], time_unit: DisplayUnit) -> None:
    """Scale and name the time axes of panels, logarithmic where all runs suit that."""
    instants = [time_unit(run["time"].values) for run in runs.values()]
    on_log = all(map(suits_log_time, runs.values()))
    start = min(float(instant[0]) for instant in instants)
    end = max(float(instant[-1]) for instant in instants)
    for axes in panels:
        if on_log:
            first = min(float(instant[instant > 0][0]) for instant in instants)
            _set_log_time(axes, first, end)
        axes.set_xlim(start, end)
        if axes.xaxis.get_tick_params()["labelbottom"]:
            axes.set_xlabel(time_unit.label("Time"))


def _set_log_time(axes: Axes, first: float, end: float) -> None:
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
    """Tell whether a run reads best over logarithmic time.

    Parameters
    ----------
    run : xarray.Dataset
        A result.

    Returns
    -------
    bool
        Whether its steps are spread over decades and its load is held nearly from the start.

    Examples
    --------
    >>> times = [0.0, 1.0, 2.0, 4.0, 1000.0]
    >>> held = xr.Dataset({name: ("time", [1.0] * 5) for name in ("force", "approach")})
    >>> suits_log_time(held.assign_coords(time=times))
    True
    """
    return _steps_grow(run["time"].values) and _held_from(run)


def _steps_grow(instants: NDArray[np.float64]) -> bool:
    """Whether the steps are spread over decades, as on a logarithmic axis."""
    positive = instants[instants > 0]
    return positive.size > 2 and float(np.median(positive)) < 0.1 * float(positive[-1])


def _held_from(run: xr.Dataset) -> bool:
    """Whether force or approach, the one that is prescribed, is held over most of the time."""
    times = run["time"].values
    held_from = []
    for name in ("force", "approach"):
        values = run[name].values
        differs = np.abs(values - values[-1]) > _STEADY * np.abs(values).max()
        held_from.append(times[int(np.flatnonzero(differs).max(initial=-1)) + 1])
    return bool(min(held_from) <= _SOON * times[-1])


def _add_key(figure: Figure, panels: list[Axes], names: list[str]) -> None:
    """Name the runs if there are several, and the bands if there are any."""
    entries: list[tuple[Artist, str]] = []
    if len(names) > 1:
        entries += zip(panels[0].get_lines(), names, strict=True)
    if any(has_bands(axes) for axes in panels):
        entries.append(band_key(style.FAINT if len(names) > 1 else style.LINE))
    if not entries:
        return
    figure.legend(
        *zip(*entries, strict=True),
        loc="outside upper center" if len(names) > 1 else "outside upper right",
        ncols=min(len(entries), 4 if figure.get_figwidth() > NARROW else 2),
        frameon=False,
        fontsize=style.TICK_SIZE,
        labelcolor=style.INK,
        handlelength=2.4,
    )
