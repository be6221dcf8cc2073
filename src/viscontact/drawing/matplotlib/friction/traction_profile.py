"""Tractions along a line through the contact."""

from __future__ import annotations

from typing import Literal

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.traction import traction_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


def traction_profile(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] | None = None,
    at: float | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the traction on a line through the contact, between friction times pressure.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate`, `viscontact.steady` or `viscontact.open_results`, with friction
        and fields stored.
    times : array_like, optional
        Instants [s], or in steady motion speeds [m/s]; the nearest stored ones are drawn and named.
        By default four instants of the last cycle of the tangential load, or of the time under it,
        or the largest speed. Of one speed up to four creepages are drawn, of several speeds that of
        the largest traction; ``results.sel(creepage=...)`` chooses one.
    along : {"x", "y"}, optional
        Direction of the line; by default that of the larger component of the tractions, which is
        drawn, or across the period of a line contact.
    at : float, optional
        Position of the line on the other axis [m]; by default the middle of the grid.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line for each instant or creepage, and dotted ones for the largest traction that friction
        carries, on both sides.

    Raises
    ------
    ValueError
        If the run has no friction or stores no fields, the bodies do not touch, or the line misses
        the grid.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid, pull = vc.Grid((24, 24), (2e-3, 2e-3)), vc.TangentialHistory([1.0], force_x=0.02)
    >>> grip = {"friction": 0.3, "tangential": pull, "errors": False}
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], **grip)
    >>> traction_profile(ds).axes[0].get_ylabel()
    'Traction along x [kPa]'
    """
    panel = traction_panel(results, times, along, at, "traction-profile")
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS * 0.8)
        axes = style.new_figure(wide, min(3.2, 0.75 * wide)).add_subplot()
    draw_panel(axes, panel)
    style.add_legend(axes, *named_keys(panel.curves))
    return style.figure_of(axes)
