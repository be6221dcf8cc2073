"""Curves along an axis of the contact."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import Runs
from viscontact.drawing.content.contact_curve import ContactCurve, contact_panels
from viscontact.drawing.content.panel import Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel


def draw_curves(
    results: Runs,
    curve: ContactCurve,
    times: ArrayLike | None,
    axes: Axes | None,
    width: Width | None,
) -> Figure:
    """Draw a curve for each of several instants; for each of several runs, a panel per instant."""
    several = not isinstance(results, xr.Dataset)
    if several and axes is not None:
        raise ValueError(f"{curve.figure}: axes take a single result, got several")
    panels = contact_panels(results, curve, times)
    if several:
        return _draw_panels(panels, width)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS * 0.8)
        axes = style.new_figure(wide, min(3.0, 0.75 * wide)).add_subplot()
    named = draw_with_edges(axes, panels[0])
    axes.set_ylim(bottom=0.0)
    style.add_legend(axes, *named)
    return style.figure_of(axes)


def _draw_panels(panels: list[Panel], width: Width | None) -> Figure:
    figure = style.new_figure(page_width(width, style.TWO_COLUMNS), 2.2 * len(panels) + 0.4)
    shared = figure.subplots(len(panels), sharex=True, sharey=True, squeeze=False)[:, 0]
    named = [draw_with_edges(axes, panel) for axes, panel in zip(shared, panels, strict=True)]
    shared[0].set_ylim(bottom=0.0)  # once all curves have extended the common limits
    style.add_legend_below(figure, *named[0])
    return figure


def draw_with_edges(axes: Axes, panel: Panel) -> tuple[list[Line2D], list[str]]:
    """Draw a panel, with edges of the contact on its lower border; return what has a name."""
    before = len(axes.get_lines())
    draw_panel(axes, panel)
    drawn = list(zip(axes.get_lines()[before:], panel.curves, strict=False))
    for line, curve in drawn:
        if curve.look != "line":
            white = {"markerfacecolor": "white"} if curve.look == "hollow" else {}
            line.set(markersize=4.0, zorder=3, clip_on=False, **white)
    named = [(line, curve.name) for line, curve in drawn if curve.name]
    return [line for line, _ in named], [name for _, name in named]
