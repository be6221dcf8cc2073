"""Contact area over time: traced between the cells, and by counting cells."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.contact_area import area_panel, pressure_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.error_band import band_key
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys

_NAME = "contact-area"


def contact_area(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    theory: bool = False,
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
    theory : bool, optional
        Draw the area by Persson's theory beside it; see `area_pressure`.
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
    panel, shares_axes = area_panel(results, times, _NAME, theory=theory), axes is not None
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


def area_pressure(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    theory: bool = False,
    width: Width | None = None,
) -> Figure:
    """Draw the real over the nominal contact area of a rough contact over its nominal pressure.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, on a grid that is periodic along
        both axes, under a force that varies.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    theory : bool, optional
        Draw Persson's theory beside it, for elastic bodies, or under a force that is held.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Points with their errors for the instants, and a dashed line for the theory, which is 15 to
        35 % low at small loads and exact at full contact.

    Raises
    ------
    ValueError
        If the grid is not periodic along both axes, or the theory does not hold.

    Examples
    --------
    >>> import numpy as np, viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((16, 16), (1e-3, 1e-3), periodic=True)
    >>> waves, load = vc.Waviness(1e-6, wavelength_x=1e-3, wavelength_y=1e-3), vc.ramp(0.01, 1.0)
    >>> ds = vc.simulate(waves, rubber, load, grid, [0.0, 0.5, 1.0], errors=False)
    >>> area_pressure(ds).axes[0].get_ylabel()
    'Real over nominal area [-]'
    """
    panel = pressure_panel(results, times, "area-pressure", theory=theory)
    wide = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(wide, 0.75 * wide)
    draw_panel(figure.add_subplot(), panel)
    style.add_legend_below(figure, *named_keys(panel.curves))
    return figure
