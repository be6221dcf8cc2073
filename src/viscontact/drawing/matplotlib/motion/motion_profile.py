"""Pressure along the motion of a body in steady motion, with leading and trailing edge."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.motion_profile import motion_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.pressure.contact_curves import draw_with_edges


def motion_profile(
    results: xr.Dataset,
    *,
    speeds: ArrayLike | None = None,
    at: float = 0.0,
    axes: Axes | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw the pressure on a line along the motion, with the edges of the contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.steady`, with fields stored.
    speeds : array_like, optional
        Speeds [m/s]; the nearest stored ones are drawn. By default five, from the slowest to the
        fastest.
    at : float, optional
        Position of the line across the motion [m]; the nearest row of cells is taken.
    axes : matplotlib.axes.Axes, optional
        Axes to draw in; by default a new figure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line per speed over the position relative to the body's axis, with a full marker at the
        leading edge and a hollow one at the trailing edge. The body moves to the right.

    Raises
    ------
    ValueError
        If the result is not one of steady motion, or has no fields.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> ds = vc.steady(ball, rubber, load, [0.01, 0.1], errors=False)
    >>> axes = motion_profile(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('y from the axis, along the motion [mm]', 'Pressure [kPa]')
    """
    panel = motion_panel(results, speeds, at)
    if axes is None:
        wide = page_width(width, style.TWO_COLUMNS)
        axes = style.new_figure(wide, 0.45 * wide).subplots()
    style.add_legend(axes, *draw_with_edges(axes, panel))
    return style.figure_of(axes)
