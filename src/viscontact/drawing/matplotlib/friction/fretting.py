"""Fretting loops with the heat of their cycles, and slip over time."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike

from viscontact.drawing.content.fretting import fretting_panels, slip_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


def fretting_loop(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the tangential force over the shift of the body, and the heat of each cycle.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with friction.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each direction in which the body is loaded, a torque over its rotation included:
        a thin line for the whole way, and a line for each cycle. Of several cycles, a panel of
        their heat with its error. The heat is that of friction; the area of a loop of a creeping
        body has the loss by creep, too.

    Raises
    ------
    ValueError
        If the run has no friction, no tangential load acts, or it is a line contact.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> shaken = vc.TangentialHistory([0, 1, 2, 3], force_x=[0, 0.02, -0.02, 0.02])
    >>> grip = {"friction": 0.3, "tangential": shaken, "errors": False}
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0, 1, 2, 3], **grip)
    >>> fretting_loop(ds).axes[0].get_ylabel()
    'Tangential force along x [mN]'
    """
    panels = fretting_panels(results, times, "fretting-loop")
    wide = page_width(width, style.ONE_COLUMN if len(panels) == 1 else style.TWO_COLUMNS)
    figure = style.new_figure(wide, 0.8 * wide / len(panels) + 0.5)
    for axes, panel in zip(
        figure.subplots(1, len(panels), squeeze=False).flat, panels, strict=True
    ):
        draw_panel(axes, panel)
        if panel.name == "fretting-heat":
            axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    handles, labels = named_keys(panels[0].curves)
    if labels:
        style.add_legend_below(figure, handles, labels)
    return figure


def slip_history(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the part of the contact that slips, and the slip of its cells, over time.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with friction.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel of the slip fraction with its error, and, where fields are stored, one of the slip
        of the surface under the body since the contact of each cell: the largest and the mean.

    Raises
    ------
    ValueError
        If the run has no friction, or fewer than two steps lie in the span.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid, pull = vc.Grid((24, 24), (2e-3, 2e-3)), vc.TangentialHistory([1.0], force_x=0.02)
    >>> grip = {"friction": 0.3, "tangential": pull, "errors": False}
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], **grip)
    >>> [axes.get_ylabel() for axes in slip_history(ds).axes]
    ['Slip fraction [%]', 'Slip [µm]']
    """
    panels = slip_panels(results, times, "slip-history")
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 1.9 * len(panels) + 0.3)
    column = figure.subplots(len(panels), sharex=True, squeeze=False)[:, 0]
    for axes, panel in zip(column, panels, strict=True):
        draw_panel(axes, panel)
        axes.set_ylim(bottom=0.0)
    for axes in column[:-1]:
        axes.set_xlabel("")
    handles, labels = named_keys(panels[-1].curves)
    if labels:
        style.add_legend(column[-1], handles, labels, loc="best")
    return figure
