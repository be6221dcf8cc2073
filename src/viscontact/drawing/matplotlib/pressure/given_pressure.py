"""Pressure that is given, and the displacement under it."""

from __future__ import annotations

from typing import Literal

import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.given_pressure import pressure_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import stacked_panels


def given_pressure(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    width: Width | None = None,
) -> Figure:
    """Draw a pressure that was given, and the displacement under it, along a line.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.under_pressure`.
    times : array_like, optional
        Instants [s]; the nearest ones are drawn. By default five.
    along : {"x", "y"}, optional
        Direction of the line, which goes through the largest pressure.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The pressure, and below it the displacement, downwards as into the body.

    Raises
    ------
    ValueError
        If the result has no pressure or displacement over time.

    Examples
    --------
    >>> import numpy as np, viscontact as vc
    >>> body = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((8, 8), (1e-3, 1e-3))
    >>> ds = vc.under_pressure(np.full((8, 8), 1e4), body, grid, [0.0, 1.0])
    >>> [axes.get_ylabel() for axes in given_pressure(ds).axes]
    ['Pressure [kPa]', 'Displacement [µm]']
    """
    panels = pressure_panels(results, times, along, "given-pressure")
    wide = page_width(width, style.ONE_COLUMN)
    return stacked_panels(panels, wide, wide)
