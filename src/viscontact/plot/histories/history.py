"""Approach, tilt, area and pressure against time (the paper's Figs. 17, 18 and 19)."""

from __future__ import annotations

import textwrap
from collections.abc import Collection, Mapping, Sequence
from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import require_runs
from viscontact.drawing.content.history import is_idle
from viscontact.plot.histories.time_axis import scale_time, within_span
from viscontact.plot.layout import style
from viscontact.plot.layout.error_band import (
    Band,
    draw_band,
    legend_entries,
    limit_axis_to_curves,
    peak_note,
)
from viscontact.plot.layout.ordered_names import styles_of
from viscontact.plot.layout.page import NARROW, Width, page_width
from viscontact.results.recorded_case import across_period, is_prescribed
from viscontact.results.recorded_events import recorded_events
from viscontact.results.shown_scalars import shown_scalars
from viscontact.results.stated_errors import (
    NOT_DRAWN,
    drawn_values,
    lacks_curve,
    stated_error,
)
from viscontact.results.variables import SCALARS, Place, shown_in
from viscontact.units.formatting import ReadableUnit, readable_unit

_Place = Literal["outside upper center", "outside upper right", "outside lower center"]
_NAME = "history"

#: Relative change, error included, below which a quantity is constant.
_ROUNDING = 1e-6

#: Look of the line at an event, and letters of its note on an inch.
_EVENT_LINE: dict[str, Any] = {"color": style.FAINT, "linestyle": ":", "linewidth": style.THIN_LINE}
_LETTERS_AN_INCH = 17


def history(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw contact area, approach, tilts and peak pressure against time.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One panel a quantity. Force, tilts and the line load of a line contact have one only where
        they change. Time is logarithmic where the run's steps are and the load is held nearly from
        the start. Bands are the errors that the result states. A peak pressure that depends on
        the mesh has no curve; its panel says so.

    Raises
    ------
    ValueError
        If fewer than two steps lie in the span.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> [axes.get_ylabel() for axes in history(ds).axes][:2]
    ['Contact area [mm²]', 'Approach [µm]']
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
        One panel per quantity, one line per run, and a band around it where its error is known.
        A peak pressure that depends on the mesh has no line; its panel says so.

    Raises
    ------
    ValueError
        If there are no runs, or one has fewer than two steps in the span.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ball = vc.Sphere(0.01)
    >>> one, two = (
    ...     vc.simulate(ball, rubber, vc.step(force), grid, [0.0, 1.0], errors=False)
    ...     for force in (0.1, 0.2)
    ... )
    >>> runs = {"0.1 N": one, "0.2 N": two}
    >>> figure = compare_histories(runs)
    >>> figure.axes[0].get_ylabel()
    'Contact area [mm²]'
    """
    require_runs(runs, _NAME)
    shown = {
        name: within_span(run, needed_variables(run), times, _NAME, name)
        for name, run in runs.items()
    }
    return _figure(shown, drawn_scalars(shown), width)


def history_with_load(results: xr.Dataset) -> Figure:
    """Draw the history of a run, the force also where it is constant."""
    shown = {"": within_span(results, needed_variables(results), None, _NAME, "")}
    others = [name for name in drawn_scalars(shown) if name != "force"]
    return _figure(shown, ["force", *others], None)


def _figure(runs: Mapping[str, xr.Dataset], names: Sequence[str], width: Width | None) -> Figure:
    figure, panels = _panels(len(names), page_width(width, style.TWO_COLUMNS))
    time_unit, bands = draw_scalars(panels, names, runs)
    if len(runs) == 1:
        _mark_events(figure, panels, next(iter(runs.values())), time_unit)
    _add_key(figure, panels, list(runs), bands)
    return figure


def drawn_scalars(runs: Mapping[str, xr.Dataset]) -> list[str]:
    """Names of the scalars to draw, which all runs have: without a constant load or tilt."""
    common = [name for name in shown_in(Place.FIGURE) if all(name in run for run in runs.values())]
    return [name for name in common if _worth_a_panel(name, runs.values())]


def draw_scalars(
    panels: list[Axes], names: Sequence[str], runs: Mapping[str, xr.Dataset]
) -> tuple[ReadableUnit, list[Band]]:
    """Draw scalars over time, one in each panel; return the unit of time, and the error bands."""
    time_unit = readable_unit("s", *(run["time"].values for run in runs.values()))
    bands: list[Band] = []
    for axes, name in zip(panels, names, strict=True):
        bands += _draw(axes, name, runs, time_unit)
    scale_time(panels, runs, time_unit)
    return time_unit, bands


def needed_variables(run: xr.Dataset) -> list[str]:
    """Names of the scalars that histories need; tilts of rounding size are found by the length."""
    return [*shown_scalars(run, Place.FIGURE), "contact_length"]


def _worth_a_panel(name: str, runs: Collection[xr.Dataset]) -> bool:
    if name == "force" or (name == "peak_line_load" and all(map(across_period, runs))):
        loads = (run[name].values for run in runs)
        return any(np.ptp(load) > 1e-6 * np.max(load) for load in loads)
    return not all(is_idle(run, name) for run in runs)


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
    # Only the lowest panel of each column has an axis label, or all of them where columns differ,
    # for even spacing of the rows.
    first = max(count - columns, 0) if count % columns == 0 else 0
    for axes in panels[first:count]:
        axes.tick_params(labelbottom=True)
    return figure, panels[:count]


def _draw(
    axes: Axes, scalar: str, runs: Mapping[str, xr.Dataset], time_unit: ReadableUnit
) -> list[Band]:
    bands = []
    variable = SCALARS[scalar]
    unit = readable_unit(variable.units, *(run[scalar].values for run in runs.values()))
    for (name, run), look in zip(runs.items(), styles_of(list(runs)), strict=True):
        values = drawn_values(run, scalar)
        instants = time_unit(run["time"].values)
        error = None if is_prescribed(run, scalar) else stated_error(run, scalar)
        axes.plot(instants, unit(values), label=name, **look)
        bar = None if error is None else unit(error)
        bands.append(draw_band(axes, instants, unit(values), bar, look["color"]))
    axes.set_ylabel(unit.label(variable.label))
    axes.ticklabel_format(axis="y", useOffset=False)
    missing = sum(lacks_curve(run, scalar) for run in runs.values())
    if missing == len(runs):
        _say_not_drawn(axes)
    elif scalar == "force":
        axes.set_ylim(0.0, 1.08 * axes.dataLim.y1)
    elif np.ptp(axes.dataLim.intervaly) <= _ROUNDING * abs(axes.dataLim.intervaly).max():
        axes.set_ylim(*sorted((0.0, 1.15 * axes.dataLim.y1 or 1.0)))
    drawn = [band for band in bands if band is not None]
    if drawn:
        limit_axis_to_curves(axes, *(unit(drawn_values(run, scalar)) for run in runs.values()))
    if scalar == "peak_pressure":
        left_out = f"{missing} of {len(runs)} runs not drawn:\n" if 0 < missing < len(runs) else ""
        style.add_heading(axes, left_out + peak_note(runs.values()), aside=True)
    return drawn


def _mark_events(
    figure: Figure, panels: list[Axes], run: xr.Dataset, time_unit: ReadableUnit
) -> None:
    """Dotted lines at the events of a load program in the span, and their names below."""
    first, last = run["time"].values[[0, -1]]
    events = [event for event in recorded_events(run) if first <= event.time <= last]
    for event in events:
        for axes in panels:
            axes.axvline(float(time_unit(event.time)), **_EVENT_LINE)
    if events:
        text = "Dotted: " + "; ".join(event.text for event in events)
        letters = int(_LETTERS_AN_INCH * figure.get_figwidth())
        note = "\n".join(textwrap.wrap(text, letters))
        style.add_height_of_legend(figure, note.count("\n") + 1)
        figure.supxlabel(note, fontsize=style.TICK_SIZE, color=style.FAINT)


def _say_not_drawn(axes: Axes) -> None:
    """Words in place of a curve."""
    look: dict[str, Any] = {"fontsize": style.TICK_SIZE, "color": style.FAINT}
    text = NOT_DRAWN.replace(": ", ":\n")
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes, **look)
    axes.set_yticks([])


def _add_key(figure: Figure, panels: list[Axes], names: list[str], bands: list[Band]) -> None:
    """Legend of several runs above the panels, and of error bands, below those of several runs."""
    entries = legend_entries(panels[0].get_lines(), names, bands)
    count = len(names) if len(names) > 1 else 0
    place: _Place = "outside lower center" if count else "outside upper right"
    if count:
        columns = style.columns_that_fit(figure, names, 4)
        style.add_height_of_legend(figure, -(-count // columns))
        _add_legend(
            figure, style.by_rows(entries[:count], columns), "outside upper center", columns
        )
    if entries[count:]:
        _add_legend(figure, entries[count:], place, 1)


def _add_legend(
    figure: Figure, entries: Sequence[tuple[Artist, str]], place: _Place, columns: int
) -> None:
    figure.legend(
        *zip(*entries, strict=True),
        loc=place,
        ncols=columns,
        frameon=False,
        fontsize=style.TICK_SIZE,
        labelcolor=style.INK,
        handlelength=2.4,
    )
