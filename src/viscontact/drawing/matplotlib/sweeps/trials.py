"""Trials of a design: the goal over each parameter."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.key_axis import KeyAxis
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.sweeps.key_axis import label_key
from viscontact.results.variables import SCALARS, error_name
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Panels in a row, and the height of a row [inch].
_COLUMNS, _HEIGHT = 2, 2.6
#: Width of a letter of a label [inch].
_LETTER = 0.068


def trials(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the goal of a design over each of its parameters.

    Parameters
    ----------
    table : xarray.Dataset
        Trials of a design, `DesignResult.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each parameter: full points with error bars are feasible trials on the cells of
        the case, pale ones those on coarse cells, crosses trials that are not feasible, and the
        square is the best one.

    Examples
    --------
    >>> data = {"force": ("trial", [3.0, 2.0]), "force_error": ("trial", [0.1, 0.1])}
    >>> data |= {"feasible": ("trial", [True, True]), "level": ("trial", ["coarse", "case"])}
    >>> coords = {"load.x": ("trial", [1.0, 2.0], {"units": "m"})}
    >>> axes = trials(xr.Dataset(data, coords, {"goal": "force", "best": 1})).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('Load x [m]', 'Force [N]')
    """
    keys = parameters_of(table)
    columns = min(_COLUMNS, len(keys))
    rows = -(-len(keys) // columns)
    across = page_width(width, style.TWO_COLUMNS if columns > 1 else style.ONE_COLUMN)
    figure = style.new_figure(across, _HEIGHT * rows + 0.4)
    panels = list(figure.subplots(rows, columns, squeeze=False, sharey=True).flat)
    for unused in panels[len(keys) :]:
        unused.remove()
    name = _goal(table)
    unit = readable_unit(SCALARS[name].units, table[name].values)
    for key, axes in zip(keys, panels, strict=False):
        style.dress(axes)
        axis = KeyAxis.of(table, key)
        _draw(axes, table, axis.at(table[key].values), unit)
        label_key(axes, axis, int(across / columns / _LETTER))
    for row in range(rows):
        panels[row * columns].set_ylabel(unit.label(SCALARS[name].label))
    handles, labels = panels[0].get_legend_handles_labels()
    style.add_legend_below(figure, handles, labels, columns=4)
    return figure


def parameters_of(table: xr.Dataset) -> list[str]:
    """Keys of the parameters of a design."""
    return [str(name) for name in table.coords if name not in ("trial", "scenario")]


def _goal(table: xr.Dataset) -> str:
    """The goal, of several the first one."""
    return str(table.attrs["goal"]).split()[0]


def _draw(axes: Axes, table: xr.Dataset, places: Floats, unit: ReadableUnit) -> None:
    name = _goal(table)
    values, errors = (unit(table[each].values) for each in (name, error_name(name)))
    feasible, is_coarse = table["feasible"].values.astype(bool), table["level"].values == "coarse"
    bars = np.where(np.isfinite(errors), errors, 0.0)
    pale: dict[str, Any] = {
        "color": style.FAINT,
        "alpha": 0.6,
        "linestyle": "none",
        "markersize": 3.5,
    }
    full: dict[str, Any] = {"color": style.LINE, "linestyle": "none", "markersize": 3.5}
    groups = (
        (feasible & is_coarse, "coarse cells", {"marker": "o", **pale}),
        (feasible & ~is_coarse, "cells of the case", {"marker": "o", **full}),
        (~feasible, "not feasible", {"marker": "x", **pale}),
    )
    for chosen, label, look in groups:
        if chosen.any():
            axes.plot(places[chosen], values[chosen], label=label, **look)
    certified = feasible & ~is_coarse & (bars > 0)
    axes.errorbar(
        *(places[certified], values[certified], bars[certified]),
        fmt="none",
        ecolor=style.LINE,
        elinewidth=0.8,
    )
    best = int(table.attrs["best"])
    axes.plot(
        *(places[[best]], values[[best]], "s"),
        markerfacecolor="none",
        markeredgecolor=style.INK,
        markersize=8,
        label="best",
    )
