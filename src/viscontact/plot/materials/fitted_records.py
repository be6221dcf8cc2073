"""Figure of records that were fitted by runs of a case: measured and fitted values, residuals."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.plot.layout import style
from viscontact.plot.layout.page import NARROW, Width, page_width
from viscontact.plot.materials.fitted import MARKER_SIZE
from viscontact.units.formatting import readable_unit

_FITTED = "#D55E00"
_MOST_ACROSS = 3
_LABELS = {"force": "Force", "approach": "Approach"}


def fitted_records(curves: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw records, the values fitted by runs of a case, and the residuals.

    Parameters
    ----------
    curves : xarray.Dataset
        ``curves`` of a `viscontact.CaseFit`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        For each record the fitted quantity over time, and below it the residual, relative to the
        largest value, in the rows that count.

    Examples
    --------
    >>> times = np.arange(5.0)
    >>> columns = {"time": times, "measured": 1e-6 * times, "fitted": 1e-6 * times}
    >>> texts = {"record": 1, "name": "a.csv", "quantity": "approach", "units": "m"}
    >>> whole = columns | {"residual": 0 * times} | {k: np.full(5, v) for k, v in texts.items()}
    >>> curves = xr.Dataset({name: ("row", values) for name, values in whole.items()})
    >>> [axes.get_ylabel() for axes in fitted_records(curves).axes]
    ['Approach [µm]', 'Residual [%]']
    """
    numbers = np.unique(curves["record"].values)
    across = min(_MOST_ACROSS, numbers.size)
    wide = page_width(width, style.TWO_COLUMNS if across > 1 else style.ONE_COLUMN)
    across = 1 if wide <= NARROW else across
    down = -(-numbers.size // across)
    figure = style.new_figure(wide, 3.2 * down)
    panels = figure.subplots(2 * down, across, squeeze=False, height_ratios=[3, 1.2] * down)
    for place in range(down * across):
        pair = panels[2 * (place // across) :][:2, place % across]
        if place < numbers.size:
            _draw(curves.isel(row=curves["record"].values == numbers[place]), *pair)
        else:
            for axes in pair:
                axes.set_visible(False)
    figure.align_ylabels()
    return figure


def _draw(record: xr.Dataset, above: Axes, below: Axes) -> None:
    """Draw one record: values above, residuals below."""
    measured, fitted = record["measured"].values, record["fitted"].values
    unit = readable_unit(str(record["units"].values[0]), measured)
    seconds = readable_unit("s", record["time"].values)
    times, counted = seconds(record["time"].values), np.isfinite(record["residual"].values)
    dots: dict[str, Any] = {
        "marker": "o",
        "markersize": MARKER_SIZE,
        "linestyle": "none",
        "markerfacecolor": "none",
        "markeredgecolor": style.LINE,
        "markeredgewidth": 0.7,
    }
    above.plot(times, unit(measured), **dots)
    above.plot(times[counted], unit(fitted[counted]), color=_FITTED, linewidth=style.LINE_WIDTH)
    above.set_ylabel(unit.label(_LABELS[str(record["quantity"].values[0])]))
    style.add_legend(above, above.get_lines(), ["measured", "fitted"], loc="best")
    residual = 100 * record["residual"].values
    root = np.sqrt(np.nanmean(residual**2))
    style.add_heading(above, f"{record['name'].values[0]}, residual {root:.2g} % rms")
    below.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    below.plot(times, residual, **dots)
    below.set(xlabel=seconds.label("Time"), ylabel="Residual [%]")
    above.sharex(below)
    above.tick_params(labelbottom=False)
    for axes in (above, below):
        style.dress(axes)
