"""Margins to the allowable values of a case over time."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.content.history import margin_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys
from viscontact.results.run_axis import require_time


def margin_history(results: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the margins of the limited scalars over time.

    Parameters
    ----------
    results : xarray.Dataset
        Result of a case with ``allowable:`` values, over time.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line for each limited scalar, in percent of its limit; below the dashed line the limit is
        exceeded. Values that depend on the mesh, or whose error is not known, are left out.

    Raises
    ------
    ValueError
        If the result is not over time, or has no margin.

    Examples
    --------
    >>> size = {"force": ("time", [4.0, 7.0]), "force_error": ("time", [1.0, 1.0])}
    >>> run = xr.Dataset(size, {"time": [0.0, 1.0]}, {"allowable": '{"force": {"limit": 10.0}}'})
    >>> margin_history(run).axes[0].lines[0].get_ydata().round(1).tolist()
    [50.0, 20.0]
    """
    require_time(results, "margins")
    panel = margin_panel(results)
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 2.6)
    axes = figure.subplots()
    draw_panel(axes, panel)
    style.add_legend_below(figure, *named_keys(panel.curves), columns=3)
    return figure
