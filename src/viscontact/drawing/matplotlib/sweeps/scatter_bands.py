"""Bands of the outputs of a sensitivity over time, from the samples of inputs that scatter."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.backend.arrays import Floats
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_time import set_log_time
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import readable_unit

#: Height of a panel [inch].
_HEIGHT = 2.2
#: Ratio of the last to the first instant from which on the axis is logarithmic.
_LOGARITHMIC = 100.0


def scatter_bands(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the scatter of the outputs of a sensitivity over time, a panel for each output.

    Parameters
    ----------
    table : xarray.Dataset
        `SensitivityResult.table` with scatter, over common instants or speeds.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Bands from 5 to 95 % of the samples, their median, and the values of the case (dashed).

    Raises
    ------
    ValueError
        If the table has no scatter over time, or has a single instant.

    Examples
    --------
    >>> data = {"band": (("output", "percent", "time"), [[[1.0, 2.0], [2.0, 3.0], [3.0, 4.0]]])}
    >>> data |= {"nominal": (("output", "time"), [[2.0, 3.1]])}
    >>> coords = {"output": ["force"], "percent": [5.0, 50.0, 95.0], "time": [0.0, 1.0]}
    >>> scatter_bands(xr.Dataset(data, coords)).axes[0].get_ylabel()
    'Force [N]'
    """
    if "band" not in table:
        raise ValueError("scatter_bands: the table has no scatter over time")
    over = str(table["band"].dims[-1])
    if table.sizes[over] < 2:
        raise ValueError("scatter_bands: needs two instants or more")
    outputs = [str(name) for name in table["output"].values]
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), _HEIGHT * len(outputs) + 0.5)
    panels = figure.subplots(len(outputs), 1, squeeze=False, sharex=True)[:, 0]
    places = table[over].values
    unit = readable_unit("s" if over == "time" else "m/s", places)
    for name, axes in zip(outputs, panels, strict=True):
        style.dress(axes)
        one = table.sel(output=name)
        of = readable_unit(SCALARS[name].units, one["band"].values)
        low, middle, high = (of(each) for each in one["band"].values)
        x = unit(places)
        shade = {"color": style.LINE, "alpha": 0.25, "linewidth": 0.0}
        axes.fill_between(x, low, high, label="5 to 95 %", **shade)
        axes.plot(x, middle, color=style.LINE, linewidth=style.LINE_WIDTH, label="median")
        axes.plot(x, of(one["nominal"].values), "--", color=style.INK, linewidth=1.0, label="case")
        axes.set_ylabel(of.label(SCALARS[name].label))
    _scale(panels[-1], unit(places))
    panels[-1].set_xlabel(unit.label(over.capitalize()))
    style.add_legend_below(figure, *panels[0].get_legend_handles_labels())
    return figure


def _scale(axes: Axes, places: Floats) -> None:
    """Make the axis logarithmic from its second place on, if the places are spread over decades."""
    positive = places[places > 0]
    first, last = float(positive[0]), float(positive[-1])
    if last >= _LOGARITHMIC * first and float(np.median(positive)) < 0.1 * last:
        set_log_time(axes, first, last)
    axes.set_xlim(float(places[0]), last)
