"""Leak rate and critical gap over time or speed."""

from __future__ import annotations

from typing import Literal

import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from numpy.typing import ArrayLike

from viscontact.drawing.content.leak import leak_panels, shown_leakage
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import stacked_panels


def leak_rate(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    over: Literal["time", "force", "area"] = "time",
    width: Width | None = None,
) -> Figure:
    """Draw how much leaks over time or speed, and the gap where the channel is narrowest.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.leakage`; or from `viscontact.simulate` or `viscontact.open_results`, with
        fields stored, whose leakage is computed for the fluid of its case, or without a fluid.
    times : array_like, optional
        Instants [s], or speeds [m/s]; the nearest ones are drawn. All by default.
    along : {"x", "y"}, optional
        Direction of the flow, if there are two.
    over : {"time", "force", "area"}, optional
        Over the time, or the speed of steady motion; over the force; or over the real over the
        nominal area, where the leak rates of growing contacts lie nearly on one curve.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The leak rate with its error on a logarithmic scale, or the transmissivity if no pressure
        difference was given; below it the critical, the effective and the mean gap. A dashed line
        is where the contact closes, from which on nothing leaks.

    Raises
    ------
    ValueError
        If no fields are stored, or an argument is invalid.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> figure = leak_rate(vc.leakage(ds, viscosity=1e-3, pressure_difference=1e4))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['Leak rate [mm³/s]', 'Gap [µm]']
    """
    leak = shown_leakage(results, times, along, "leak-rate")
    panels = leak_panels(leak, along, over)
    wide = page_width(width, style.ONE_COLUMN)
    figure = stacked_panels(panels, wide, 1.15 * wide)
    for axes in figure.axes:
        if axes.get_yscale() == "log":
            axes.yaxis.set_minor_formatter(NullFormatter())
    return figure
