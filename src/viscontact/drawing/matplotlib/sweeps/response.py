"""Chief scalars of a sweep against its varied keys: curves, contour maps, or points."""

from __future__ import annotations

from dataclasses import replace
from textwrap import fill

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.drawing.content.key_axis import key_axis, name_of
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.content.response import (
    SweptKeys,
    response_note,
    response_panels,
    swept_keys,
)
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.drawing.matplotlib.sweeps.key_axis import label_key, place_log_ticks
from viscontact.results.largest_values import largest_values
from viscontact.results.variables import variable_of
from viscontact.units.formatting import readable_unit

#: Width of a letter of a label [inch].
_LETTER = 0.068
#: Width beside the axis of a panel, of the ticks and the label to its left [inch].
_BESIDE = 0.5
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
        run without a result. An allowable value is a dashed line, and what exceeds it is red.

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
    figure = _panels(swept, across) if swept.is_grid else _points(swept, across)
    heading = fill(response_note(swept, has_bars=not swept.suits_map), _letters(across))
    figure.suptitle(heading, x=0.01, ha="left", fontsize=style.TICK_SIZE, color=style.INK)
    return figure


def pull_off(results: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the pull-off force of a sweep against its varied keys, as a rate of retraction.

    Parameters
    ----------
    results : xarray.Dataset
        Runs of a sweep with adhesion, from `viscontact.open_many`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The largest pull before contact is lost, with error bars, over one or two keys as in
        `response`. Texts that differ in one quantity, as sentences of a load program with different
        rates or times of rest, are drawn over this quantity.

    Raises
    ------
    ValueError
        If the runs have no pull-off forces that differ, or no key is varied.

    Examples
    --------
    >>> rates = [f"retract at {rate} um/s until contact is lost" for rate in (1, 10, 100)]
    >>> key = "load.sentences[3]"
    >>> runs = {name: (key, values) for name, values in (
    ...     ("state", ["done"] * 3), ("pull_off_force", [2e-6, 3e-6, 5e-6]),
    ...     ("pull_off_force_error", [1e-8, 1e-8, 2e-8]),
    ... )}
    >>> figure = pull_off(xr.Dataset(runs, {key: rates, "time": [0.0]}))
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('Retract at [µm/s]', 'Pull-off force [µN]')
    """
    swept = swept_keys(results, "pull-off")
    if "pull_off_force" not in swept.scalars:
        raise ValueError(
            "pull-off: no pull-off force differs between the finished runs; give a sweep of bodies "
            "that adhere and are pulled off"
        )
    alone = replace(swept, scalars=["pull_off_force"])
    across = page_width(width, style.ONE_COLUMN)
    return _panels(alone, across) if swept.is_grid else _points(alone, across)


def _panels(swept: SweptKeys, across: float) -> Figure:
    """Maps or curves of a grid of one or two keys: a panel for each scalar."""
    ds, scalars, keys = swept.ds, swept.scalars, swept.keys
    has_legend = len(keys) == 2 and not swept.suits_map
    columns = 1 if across <= NARROW else 2 if len(scalars) in (2, 4) else min(3, len(scalars))
    rows = -(-len(scalars) // columns)
    height = (2.3 if columns == 3 else 2.6) * rows + (0.7 if has_legend else 0.3)
    figure = style.new_figure(across, height)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for unused in panels[len(scalars) :]:
        unused.remove()
    drawn: list[Panel] = []
    for name, axes in zip(scalars, panels, strict=False):
        if swept.suits_map:
            style.dress(axes)
            _draw_map(axes, ds, name, *keys)
        else:
            drawn += response_panels(swept, name)
            draw_panel(axes, drawn[-1])
        label_key(axes, key_axis(ds, keys[0]), _letters(across, columns))
    if has_legend:
        named = named_keys(drawn[0].curves)
        style.add_legend_below(figure, *named, columns=4, title=name_of(ds, keys[1]))
    return figure


def _points(swept: SweptKeys, across: float) -> Figure:
    """Points of all runs: a row of panels for each scalar, a column for each key."""
    scalars, keys = swept.scalars, swept.keys
    figure = style.new_figure(across, 1.9 * len(scalars) + 0.4)
    grid = figure.subplots(len(scalars), len(keys), squeeze=False, sharey="row", sharex="col")
    for row, name in zip(grid, scalars, strict=True):
        for panel, axes in zip(response_panels(swept, name), row, strict=True):
            draw_panel(axes, panel)
            label_key(axes, panel.x, _letters(across, len(keys)))
        for axes in row[1:]:
            axes.set_ylabel("")
    for axes in grid[:-1].flat:
        axes.set_xlabel("")
    return figure


def _letters(across: float, columns: int = 1) -> int:
    """Number of letters in a line below one of some panels [inch]."""
    return int((across / columns - _BESIDE) / _LETTER)


def _draw_map(axes: Axes, ds: xr.Dataset, name: str, key: str, by: str) -> None:
    """Contours of a scalar over two keys, with a dot for each run."""
    across, up = key_axis(ds, key), key_axis(ds, by)
    largest = largest_values(ds, name)[0].transpose(by, key).values
    missing = (ds["state"] != "done").transpose(by, key).values
    x, y = (axis.unit(ds[each].values) for axis, each in ((across, key), (up, by)))
    unit = readable_unit(variable_of(name).units, largest)
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
    style.add_heading(axes, unit.label(variable_of(name).label))
