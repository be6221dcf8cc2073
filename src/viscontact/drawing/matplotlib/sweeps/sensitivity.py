"""Outputs of a sensitivity: elasticities, the largest first, and scatter over time."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.content.sensitivity import scatter_panels, tornado_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel

#: Heights of a bar, of the rest of its panel, and of a panel of scatter [inch].
_BAR, _REST, _SCATTER = 0.22, 0.75, 2.2


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
    drawn = tornado_panels(table)
    heights = [_BAR * max(1, len(panel.y.texts)) + _REST for panel in drawn]
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), sum(heights))
    panels = figure.subplots(len(drawn), 1, squeeze=False, height_ratios=heights)[:, 0]
    for panel, axes in zip(drawn, panels, strict=True):
        draw_panel(axes, panel)
    for axes in panels[:-1]:
        axes.set_xlabel("")
    return figure


def scatter_bands(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the scatter of the outputs of a sensitivity over time, a panel for each output.

    Parameters
    ----------
    table : xarray.Dataset
        `SensitivityResult.table` with scatter, over common instants or speeds.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Bands from 5 to 95 % of the samples, their median, and the values of the case (dashed).

    Raises
    ------
    ValueError
        If the table has no scatter over time, or has a single instant.

    Examples
    --------
    >>> data = {"band": (("output", "percent", "time"), [[[1.0, 2.0], [2.0, 3.0], [3.0, 4.0]]])}
    >>> data |= {"nominal": (("output", "time"), [[2.0, 3.1]])}
    >>> coords = {"output": ["force"], "percent": [5.0, 50.0, 95.0], "time": [0.0, 1.0]}
    >>> scatter_bands(xr.Dataset(data, coords)).axes[0].get_ylabel()
    'Force [N]'
    """
    drawn = scatter_panels(table)
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), _SCATTER * len(drawn) + 0.5)
    panels = figure.subplots(len(drawn), 1, squeeze=False, sharex=True)[:, 0]
    for panel, axes in zip(drawn, panels, strict=True):
        draw_panel(axes, panel)
    style.add_legend_below(figure, *panels[0].get_legend_handles_labels())
    return figure
