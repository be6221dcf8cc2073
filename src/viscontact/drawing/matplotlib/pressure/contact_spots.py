"""Sizes of the contact spots of a rough contact."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike

from viscontact.drawing.content.contact_area import spots_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


def contact_spots(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    theory: bool = False,
    width: Width | None = None,
) -> Figure:
    """Draw how many contact spots are as large as an area or larger.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instants [s], or speeds [m/s]; the nearest stored ones are drawn and named. By default
        five, from the first in contact to the last.
    theory : bool, optional
        State the real over the nominal area by Persson's theory beside it, on a grid that is
        periodic along both axes: for elastic bodies, or under a force that is held.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Number of spots over their area, by counting cells; the legend states the number of all
        spots and the real over the nominal area, as `viscontact.contact_spots` defines them. The
        heading names the gaps of the leakage at the last stored instant, if the case has one.

    Raises
    ------
    ValueError
        If no fields are stored, or the bodies do not touch at these instants.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> contact_spots(ds).axes[0].get_ylabel()
    'Spots of this area or larger [-]'
    """
    panel = spots_panel(results, times, "contact-spots", theory=theory)
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 3.4)
    axes = figure.subplots()
    draw_panel(axes, panel)
    if panel.y.scale == "linear":
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        axes.set_ylim(0, None)
    style.add_legend_below(figure, *named_keys(panel.curves))
    return figure
