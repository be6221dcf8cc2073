"""Flow of a fluid through the gap of a contact, with its channel, and its pressure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import xarray as xr
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.leak import DECADES, LeakMap, leak_map
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.units.formatting import ReadableUnit, readable_unit

_NAME = "leak-channel"
#: Colour of contact, which is not among those of the flow.
_CONTACT = "#c4c4c4"
_BAR: Mapping[str, Any] = {"shrink": 0.9, "aspect": 25, "pad": 0.02}


def leak_channel(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    width: Width | None = None,
) -> Figure:
    """Draw the flow of a fluid through the gap at one instant, with the critical constriction.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instant [s] or speed [m/s]; the nearest stored one is drawn, by default the last.
    along : {"x", "y"}, optional
        Direction in which the pressure of the fluid falls.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The flow in each cell over the largest one, on a logarithmic scale of four decades;
        contact is grey, closed pools are white, and a circle is around the narrowest place of the
        widest channel. It does not depend on the viscosity. A closed contact has no flow, and is
        named so.

    Raises
    ------
    ValueError
        If no fields are stored, or several instants are given.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> panel, scale = leak_channel(ds).axes
    >>> panel.get_xlabel(), scale.get_ylabel()
    ('x [µm]', 'Flow over the largest [-]')
    """
    shown = leak_map(results, times, along, _NAME)
    look = {"cmap": "viridis", "norm": LogNorm(10.0**-DECADES, 1.0)}
    figure, drawn = _drawn_map(shown, shown.flow, look, width)
    bar = figure.colorbar(drawn, ax=figure.axes[0], extend="min", **_BAR)
    style.dress_colour_bar(bar, "Flow over the largest [-]")
    return figure


def fluid_pressure(
    results: xr.Dataset,
    *,
    times: ArrayLike | None = None,
    along: Literal["x", "y"] = "x",
    width: Width | None = None,
) -> Figure:
    """Draw the pressure of a fluid that flows through the gap, at one instant.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`, with fields stored.
    times : array_like, optional
        Instant [s] or speed [m/s]; the nearest stored one is drawn, by default the last.
    along : {"x", "y"}, optional
        Direction in which the pressure of the fluid falls.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The pressure over that at the outlet in the channels, in the unit of the difference that the
        case names, or as a part of it; with the ends of a period it may go beyond both. Contact is
        grey, closed pools are white; near closing nearly all of the pressure falls at the
        constriction, which has a circle.

    Raises
    ------
    ValueError
        If no fields are stored, or several instants are given.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [1.0], errors=False)
    >>> panel, scale = fluid_pressure(ds).axes
    >>> panel.get_xlabel(), scale.get_ylabel()
    ('x [µm]', 'Fluid pressure over its difference [-]')
    """
    shown = leak_map(results, times, along, "fluid-pressure")
    whole = 1.0 if shown.difference is None else shown.difference
    unit = ReadableUnit("", 1.0) if shown.difference is None else readable_unit("Pa", whole)
    known = shown.pressure[np.isfinite(shown.pressure)]
    limits = {"vmin": min(0.0, float(known.min(initial=0.0)) * float(unit(whole)))}
    limits["vmax"] = max(1.0, float(known.max(initial=0.0))) * float(unit(whole))
    look = {"cmap": "cividis", **limits}
    figure, drawn = _drawn_map(shown, unit(whole * shown.pressure), look, width)
    bar = figure.colorbar(drawn, ax=figure.axes[0], **_BAR)
    label = "Fluid pressure over its difference [-]"
    style.dress_colour_bar(bar, label if shown.difference is None else unit.label("Fluid pressure"))
    return figure


def _drawn_map(
    shown: LeakMap, values: Floats, look: Mapping[str, Any], width: Width | None
) -> tuple[Figure, QuadMesh]:
    """Figure of values in the channels, with contact and the constriction, and its colours."""
    extents = [float(np.ptp(each)) for each in (shown.x, shown.y)]
    shape = extents[1] / extents[0] if extents[0] > 0 else 1.0
    wide = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(wide, max((wide - 1.3) * shape + 0.85, 1.6), fixed_aspect=True)
    axes = figure.add_subplot()
    length = readable_unit("m", shown.x, shown.y)
    x, y = length(shown.x), length(shown.y)
    touched = np.ma.masked_equal(shown.touched.T.astype(float), 0.0)
    how: dict[str, Any] = {"shading": "nearest", "rasterized": True}
    axes.pcolormesh(x, y, touched, cmap=ListedColormap([_CONTACT]), **how)
    drawn = axes.pcolormesh(x, y, np.ma.masked_invalid(values.T), **look, **how)
    if shown.constriction is not None:
        at = [float(length(each)) for each in shown.constriction]
        axes.plot(*at, "o", mfc="none", mec=style.BODY, mew=1.6, ms=11)
    axes.set(xlabel=length.label("x"), ylabel=length.label("y"), aspect="equal")
    style.dress(axes)
    style.add_heading(axes, f"{shown.heading}\n{shown.note}")
    return figure, drawn
