"""Margins to the allowable values of a case over time."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from viscontact.plot.histories.time_axis import scale_time
from viscontact.plot.layout import style
from viscontact.plot.layout.ordered_names import styles_of
from viscontact.plot.layout.page import Width, page_width
from viscontact.results.margins import PREFIX, margins
from viscontact.results.run_axis import require_time
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import readable_unit


def margin_history(results: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the margins of the limited scalars over time.

    Parameters
    ----------
    results : xarray.Dataset
        Result of a case with ``allowable:`` values, over time.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A line for each limited scalar, in percent of its limit; below the dashed line the limit is
        exceeded. Values that depend on the mesh, or whose error is not known, are left out.

    Raises
    ------
    ValueError
        If the result is not over time, or has no margin.

    Examples
    --------
    >>> size = {"force": ("time", [4.0, 7.0]), "force_error": ("time", [1.0, 1.0])}
    >>> run = xr.Dataset(size, {"time": [0.0, 1.0]}, {"allowable": '{"force": {"limit": 10.0}}'})
    >>> margin_history(run).axes[0].lines[1].get_ydata().round(1).tolist()
    [50.0, 20.0]
    """
    require_time(results, "margins")
    found = margins(results)
    drawn = {name: 100 * found[name].values for name in map(str, found.data_vars)}
    drawn = {name: values for name, values in drawn.items() if np.isfinite(values).any()}
    if not drawn:
        raise ValueError("margins: the result has no allowable value of a scalar with an error")
    figure = style.new_figure(page_width(width, style.ONE_COLUMN), 2.6)
    axes = figure.subplots()
    style.dress(axes)
    time = readable_unit("s", results["time"].values)
    axes.axhline(0.0, color=style.FAINT, linewidth=0.8, linestyle="--")
    labels = [SCALARS[name.removeprefix(PREFIX)].label for name in drawn]
    lines = [
        axes.plot(
            time(results["time"].values), np.where(np.isfinite(values), values, np.nan), **look
        )[0]
        for values, look in zip(drawn.values(), styles_of(labels), strict=True)
    ]
    axes.set_ylabel("Margin [%]")
    scale_time([axes], {"": results}, time)
    style.add_legend_below(figure, lines, labels, columns=3)
    return figure
