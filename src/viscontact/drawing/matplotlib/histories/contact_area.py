"""Contact area over time: traced between the cells, and by counting cells."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.contact_area import area_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.error_band import band_key
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys

_NAME = "contact-area"


def contact_area(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the contact area over time, compared with counted cells in contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line for the area found between the cells, which grows smoothly, with its error; dots
        at the stored instants for the number of cells in contact times a cell's area, which
        grows in jumps.

    Raises
    ------
    ValueError
        If no fields are stored, or fewer than two steps lie in the span.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> contact_area(ds).axes[0].get_ylabel()
    'Contact area [mm²]'
    """
    panel, shares_axes = area_panel(results, times, _NAME), axes is not None
    if axes is None:
        wide = page_width(width, style.ONE_COLUMN)
        axes = style.new_figure(wide, min(3.4, 0.85 * wide)).add_subplot()
    bands = draw_panel(axes, panel)
    named = zip(*named_keys(panel.curves), strict=True)
    handles, labels = zip(*named, *band_key(bands, style.LINE), strict=True)
    if shares_axes:
        style.add_legend(axes, handles, labels, loc="best")
    else:
        style.add_legend_below(style.figure_of(axes), handles, labels, columns=2)
    return style.figure_of(axes)
