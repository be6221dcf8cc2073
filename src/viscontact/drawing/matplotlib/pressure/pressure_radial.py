"""Pressure over distance from the axis, with the exact solution (the paper's Figs. 6, 7)."""

from __future__ import annotations

from dataclasses import replace

import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.panel import FAINT
from viscontact.drawing.content.radial import radial_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel, named_keys


def pressure_radial(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw pressure over distance from the axis of a round contact.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored, of an
        indenter that is a body of revolution under a central load.
    times : array_like, optional
        Instants [s]; the nearest stored ones are drawn and named. By default five, from the
        first in contact to the last.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Markers for the computed cells next to the x axis. For a sphere or round paraboloid
        under a step or a ramp also lines for Lee and Radok's hereditary integral, and below
        the difference in percent of the exact peak at that instant, except for cells less
        than a cell from the rim, over which the pressure is far from linear.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch at these instants, the indenter is
        not round, or the load acts off its axis.

    Notes
    -----
    Lee and Radok, like Hertz, take the sphere for the paraboloid of its radius R. That alone
    makes a difference of some (a/R)²/10 of the peak, 0.1 % for a contact of radius a = R/10.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> figure = pressure_radial(ds)
    >>> figure.axes[0].get_ylabel(), figure.axes[-1].get_xlabel()
    ('Pressure [kPa]', 'Distance from the axis [µm]')
    """
    drawn, wide = radial_panels(results, times), page_width(width, style.TWO_COLUMNS * 0.8)
    has_difference = len(drawn) > 1
    figure = style.new_figure(wide, 4.2 if has_difference else 3.1)
    ratios = (3, 1)[: len(drawn)]
    panels = figure.subplots(len(drawn), sharex=True, height_ratios=ratios, squeeze=False)[:, 0]
    for axes, panel in zip(panels, drawn, strict=True):
        draw_panel(axes, panel)
    if has_difference:
        panels[1].set_ylabel(drawn[1].y.label.replace(" [", "\n["))
    instants = [curve for curve in drawn[0].curves if not curve.is_line]
    theory = [curve for curve in drawn[0].curves if curve.is_line and curve.name]
    both = [replace(instants[0], name="computed"), theory[0]] if theory else []
    keys = named_keys([*instants, *(replace(each, ink=FAINT, symbol=0) for each in both)])
    if wide > NARROW:
        style.add_legend(panels[0], *keys)
    else:
        style.add_legend_below(figure, *keys)
    return figure
