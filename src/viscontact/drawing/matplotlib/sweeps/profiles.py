"""Profiles of a roller: the drop curves that a design compares."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.units.formatting import readable_unit

#: Height of the figure [inch], and the largest drop that is drawn over that of most of the line.
_HEIGHT, _MOST = 3.2, 4.0
#: Part of the half length whose drop counts as that of most of the line.
_INNER = 0.9
_WIDTHS = {"free": 2.0}


def profiles(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the drop curves of a free profile and of the named ones.

    Parameters
    ----------
    table : xarray.Dataset
        Profiles of a design, `ProfileDesign.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Drop over the position along the roller, downwards. What drops steeply next to the ends is
        cut off.

    Examples
    --------
    >>> data = {"drop": (("profile", "x"), [[1e-6, 0.0, 1e-6]])}
    >>> table = xr.Dataset(data, {"profile": ["free"], "x": [-1e-2, 0.0, 1e-2]})
    >>> axes = profiles(table).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel(), bool(axes.yaxis_inverted())
    ('x [mm]', 'Drop [µm]', True)
    """
    figure = style.new_figure(page_width(width, style.TWO_COLUMNS), _HEIGHT)
    axes = figure.subplots()
    style.dress(axes)
    x, drops = table["x"].values, table["drop"].transpose("profile", "x").values
    inner = drops[:, np.abs(x) <= _INNER * np.abs(x).max()]
    along = readable_unit("m", x)
    deepest = min(_MOST * float(np.nanmax(inner, initial=0.0)), float(np.nanmax(drops)))
    unit = readable_unit("m", np.array([deepest or 1e-6]))
    for name, drop in zip(table["profile"].values.tolist(), drops, strict=True):
        axes.plot(along(x), unit(drop), label=name, linewidth=_WIDTHS.get(name, 1.0))
    if deepest > 0:
        axes.set_ylim(-0.05 * float(unit(deepest)), float(unit(deepest)))
    axes.invert_yaxis()
    axes.set_xlabel(along.label("x"))
    axes.set_ylabel(unit.label("Drop"))
    handles, labels = axes.get_legend_handles_labels()
    style.add_legend_below(figure, handles, labels, columns=4)
    return figure
