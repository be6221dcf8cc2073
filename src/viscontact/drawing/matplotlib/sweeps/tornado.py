"""Tornado diagram: elasticities of the outputs of a sensitivity, the largest first."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.results.sweep_axes import key_label
from viscontact.results.variables import SCALARS

#: Height of a bar and of the rest of a panel [inch], and most bars of a panel.
_BAR, _REST, _MOST = 0.22, 0.75, 15
_COLOURS = ("#0072B2", "#D55E00")  # the output grows, or falls, with the input


def tornado(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the elasticities of a sensitivity, a panel for each output.

    Parameters
    ----------
    table : xarray.Dataset
        `SensitivityResult.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Horizontal bars, the largest on top, at most 15; lines are their errors. Blue: the output
        grows with the input; red: it falls.

    Examples
    --------
    >>> data = {name: (("output", "input"), [[0.1, -2.0]]) for name in ("elasticity",)}
    >>> data |= {"elasticity_error": (("output", "input"), [[0.01, 0.1]])}
    >>> coords = {"output": ["force"], "input": ["load.force", "indenter.radius"]}
    >>> axes = tornado(xr.Dataset(data, coords)).axes[0]
    >>> [text.get_text() for text in axes.get_yticklabels()]
    ['Indenter radius', 'Load force']
    """
    outputs = [str(name) for name in table["output"].values]
    orders = [_order(table, name) for name in outputs]
    heights = [_BAR * max(1, len(order)) + _REST for order in orders]
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), sum(heights))
    panels = figure.subplots(len(outputs), 1, squeeze=False, height_ratios=heights)[:, 0]
    for name, order, axes in zip(outputs, orders, panels, strict=True):
        style.dress(axes)
        _draw(axes, table.sel(output=name).isel(input=order))
        style.add_heading(axes, SCALARS[name].label)
    panels[-1].set_xlabel("Elasticity: % per %")
    return figure


def _order(table: xr.Dataset, output: str) -> list[int]:
    """Numbers of the inputs whose elasticity is known, the largest first."""
    sizes = np.abs(table["elasticity"].sel(output=output).values)
    found = [int(n) for n in np.argsort(-sizes, kind="stable") if np.isfinite(sizes[n])]
    return found[:_MOST]


def _draw(axes: Axes, table: xr.Dataset) -> None:
    values, errors = (table[name].values for name in ("elasticity", "elasticity_error"))
    places = np.arange(values.size)
    colours = [_COLOURS[int(value < 0)] for value in values]
    axes.barh(places, values, height=0.65, color=colours, alpha=0.8)
    axes.errorbar(
        *(values, places),
        xerr=np.where(np.isfinite(errors), errors, 0.0),
        fmt="none",
        ecolor=style.INK,
        elinewidth=0.9,
        capsize=2.0,
    )
    axes.axvline(0.0, color=style.INK, linewidth=style.THIN_LINE)
    axes.set_yticks(places, [key_label(str(key)) for key in table["input"].values])
    axes.invert_yaxis()
