"""Chief scalars of a sweep against its varied keys: curves, contour maps, or points."""

from __future__ import annotations

from textwrap import fill
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.key_axis import key_axis
from viscontact.drawing.content.panel import Axis
from viscontact.drawing.content.response import (
    RunGroup,
    SweptKeys,
    curves_over,
    points_over,
    swept_keys,
)
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.style import styles_of
from viscontact.drawing.matplotlib.sweeps.key_axis import label_key, place_log_ticks
from viscontact.results.largest_values import largest_values
from viscontact.results.sweep_axes import key_label, over_of
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Least number of values of both keys for a contour map, and most curves in a panel.
_LEAST_MAP, _MOST_CURVES = 5, 8
#: Number of points in a curve from which they are smaller.
_MANY = 200
#: Width of a letter of a label [inch].
_LETTER = 0.068
#: Most contours that are drawn.
_CONTOURS = 12


def response(results: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the largest values over time of a sweep against its varied keys.

    Parameters
    ----------
    results : xarray.Dataset
        Runs of a sweep, from `viscontact.open_many`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each chief scalar that differs between the runs. A grid of one or two keys has
        curves, or contours if both keys are numbers with five values or more; other sweeps have
        points over each key. Error bars are those of the results. A hollow marker is a value that
        depends on the mesh; no curve runs through it. A cross at the lower edge, or in a map, is a
        run without a result.

    Raises
    ------
    ValueError
        If no scalar differs between the runs, or no key is varied.

    Examples
    --------
    >>> coords = {"load.force": ("load.force", [1.0, 8.0], {"units": "N"}), "time": [0.0]}
    >>> approach = (("load.force", "time"), [[1e-5], [4e-5]])
    >>> runs = {"state": ("load.force", ["done", "done"]), "approach": approach}
    >>> axes = response(xr.Dataset(runs, coords)).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel(), axes.lines[0].get_ydata().round(9).tolist()
    ('Load force [N]', 'Approach [µm]', [10.0, 40.0])
    """
    swept, across = swept_keys(results, "response"), page_width(width, style.TWO_COLUMNS)
    is_map = swept.is_grid and _suits_map(swept)
    figure = _panels(swept, across, is_map=is_map) if swept.is_grid else _points(swept, across)
    text = _heading(swept.ds, swept.scalars, has_bars=not is_map)
    heading = fill(text, _letters(across))
    figure.suptitle(heading, x=0.01, ha="left", fontsize=style.TICK_SIZE, color=style.INK)
    return figure


def _suits_map(swept: SweptKeys) -> bool:
    least = min(swept.ds.sizes[key] for key in swept.keys)
    return len(swept.numeric) == 2 and least >= _LEAST_MAP


def _heading(ds: xr.Dataset, scalars: list[str], *, has_bars: bool) -> str:
    """Description of the values, and the number of runs without one."""
    errors = [largest_values(ds, name)[1].values for name in scalars]
    note = f"Largest values over {over_of(ds)}"
    if has_bars and any((np.isfinite(each) & (each > 0)).any() for each in errors):
        note += ", with error bars"
    if has_bars and any(np.isposinf(each).any() for each in errors):
        note += "; hollow: depends on the mesh"
    if missing := int((ds["state"] != "done").sum()):
        runs = "1 run" if missing == 1 else f"{missing} runs"
        note += f"; ×: no result ({runs} of {ds['state'].size})"
    return note


def _panels(swept: SweptKeys, across: float, *, is_map: bool) -> Figure:
    """Maps or curves of a grid of one or two keys: a panel for each scalar."""
    ds, scalars, keys = swept.ds, swept.scalars, swept.keys
    has_legend = len(keys) == 2 and not is_map
    columns = 1 if across <= NARROW else 2 if len(scalars) in (2, 4) else min(3, len(scalars))
    rows = -(-len(scalars) // columns)
    height = (2.3 if columns == 3 else 2.6) * rows + (0.7 if has_legend else 0.3)
    figure = style.new_figure(across, height)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for unused in panels[len(scalars) :]:
        unused.remove()
    axis = key_axis(ds, keys[0])
    for name, axes in zip(scalars, panels, strict=False):
        style.dress(axes)
        if is_map:
            _draw_map(axes, ds, name, axis, *keys)
        else:
            _draw_curves(axes, name, axis, list(curves_over(ds, name, keys)))
        label_key(axes, axis, _letters(across, columns))
    if has_legend:
        handles, labels = panels[0].get_legend_handles_labels()
        style.add_legend_below(figure, handles, labels, columns=4, title=key_label(keys[1]))
    return figure


def _points(swept: SweptKeys, across: float) -> Figure:
    """Points of all runs: a row of panels for each scalar, a column for each key."""
    scalars, keys = swept.scalars, swept.keys
    figure = style.new_figure(across, 1.9 * len(scalars) + 0.4)
    grid = figure.subplots(len(scalars), len(keys), squeeze=False, sharey="row", sharex="col")
    for row, name in zip(grid, scalars, strict=True):
        for key, axes in zip(keys, row, strict=True):
            style.dress(axes)
            axis = key_axis(swept.ds, key)
            _draw_curves(axes, name, axis, [points_over(swept.ds, name, key)])
            label_key(axes, axis, _letters(across, len(keys)))
        for axes in row[1:]:
            axes.set_ylabel("")
    for axes in grid[:-1].flat:
        axes.set_xlabel("")
    return figure


def _letters(across: float, columns: int = 1) -> int:
    """Number of letters in a line below one of some panels [inch]."""
    return int(across / columns / _LETTER)


def _draw_curves(axes: Axes, name: str, axis: Axis, groups: list[RunGroup]) -> None:
    """Curves or points of a scalar, one for each group of runs, in a common unit."""
    unit = readable_unit(SCALARS[name].units, *(group.values for group in groups))
    axes.set_ylabel(unit.label(SCALARS[name].label))
    few, last = len(groups) <= _MOST_CURVES, len(groups) - 1
    looks = styles_of([group.label for group in groups]) if few else []
    colours = [look["color"] for look in looks] or style.time_colours(len(groups))
    for number, (group, colour) in enumerate(zip(groups, colours, strict=True)):
        label = group.label if few or number in (0, last) else ""
        _draw_group(axes, group, axis.unit(group.places), unit, colour, label)


def _draw_group(
    axes: Axes, group: RunGroup, places: Floats, unit: ReadableUnit, colour: str, label: str
) -> None:
    """Draw a curve or points with error bars; hollow markers depend on the mesh."""
    values, errors = unit(group.values), unit(group.errors)
    marked = np.isposinf(errors)
    size = 3.5 if values.size <= _MANY else 2.0
    # Values that depend on the mesh of each run are no curve.
    sure, kind = np.where(marked, np.nan, values), "o-" if group.is_joined else "o"
    axes.plot(places, sure, kind, color=colour, markersize=size, label=label)
    hollow: dict[str, Any] = {"markerfacecolor": "white", "markeredgecolor": colour}
    axes.plot(places[marked], values[marked], "o", color=colour, markersize=size, **hollow)
    missing, low = places[group.missing], axes.get_xaxis_transform()
    axes.plot(missing, np.full(missing.size, 0.02), "x", color=colour, markersize=4, transform=low)
    bars = np.where(np.isfinite(errors), errors, 0.0)
    if (bars > 0).any():
        axes.errorbar(places, values, bars, fmt="none", ecolor=colour, elinewidth=0.8)


def _draw_map(axes: Axes, ds: xr.Dataset, name: str, across: Axis, key: str, by: str) -> None:
    """Contours of a scalar over two keys, with a dot for each run."""
    largest, up = largest_values(ds, name)[0].transpose(by, key).values, key_axis(ds, by)
    missing = (ds["state"] != "done").transpose(by, key).values
    x, y = (axis.unit(ds[each].values) for axis, each in ((across, key), (up, by)))
    unit = readable_unit(SCALARS[name].units, largest)
    values = np.ma.masked_invalid(unit(largest))
    drawn = axes.contourf(x, y, values, _CONTOURS, cmap="viridis")
    bar = style.figure_of(axes).colorbar(drawn, ax=axes)
    bar.ax.tick_params(labelsize=style.TICK_SIZE)
    has_value = ~np.ma.getmaskarray(values)
    points_x, points_y = np.meshgrid(x, y)
    axes.plot(points_x[has_value], points_y[has_value], ".", color="white", markersize=2.0)
    axes.plot(points_x[missing], points_y[missing], "x", color=style.INK, markersize=3)
    axes.set_ylabel(up.label)
    if up.scale == "log":
        axes.set_yscale("log")
        place_log_ticks(axes.yaxis)
    style.add_heading(axes, unit.label(SCALARS[name].label))
