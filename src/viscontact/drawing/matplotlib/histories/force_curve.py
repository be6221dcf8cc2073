"""Force curve of bodies that adhere."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.force_curve import force_curve_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


def force_curve(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the force over the approach of bodies that adhere, with their jumps.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with adhesion.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The way to the largest approach and back, thin lines from before to after each jump, and
        under a sphere the pull-off forces of an elastic body in the limits of short ranges (JKR)
        and long ones (DMT). The title states the pull-off force with its error.

    Raises
    ------
    ValueError
        If the run has no adhesion, or fewer than two steps lie in the span.

    Examples
    --------
    >>> import warnings
    >>> import viscontact as vc
    >>> warnings.filterwarnings("ignore", "the attraction at the edge", vc.AccuracyWarning)
    >>> gel = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
    >>> load, grid = vc.triangle(approach=2e-6, rise=1.0), vc.Grid((32, 32), (2.4e-4, 2.4e-4))
    >>> sticks = {"adhesion": vc.Adhesion(0.05, range=2e-6), "errors": False}
    >>> ds = vc.simulate(vc.Paraboloid(1e-3, 1e-3), gel, load, grid, [0.0, 1.0, 2.0], **sticks)
    >>> force_curve(ds).axes[0].get_ylabel()
    'Force [µN]'
    """
    panel = force_curve_panel(results, times, "force-curve")
    wide = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(wide, 0.8 * wide + 0.3)
    axes = figure.subplots()
    draw_panel(axes, panel)
    handles, labels = named_keys(panel.curves)
    if labels:
        style.add_legend(axes, handles, labels, loc="best")
    return figure
