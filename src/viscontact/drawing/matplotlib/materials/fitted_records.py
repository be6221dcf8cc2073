"""Figure of records that were fitted by runs of a case: measured and fitted values, residuals."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.drawing.content.fit_course import course_panels
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW, Width, page_width
from viscontact.drawing.matplotlib.materials.fitted import draw_course

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
    quantity, si = (str(record[name].values[0]) for name in ("quantity", "units"))
    columns = [record[name].values for name in ("time", "measured", "fitted", "residual")]
    draw_course(above, below, course_panels(_LABELS[quantity], si, *columns))
    style.add_legend(above, above.get_lines(), ["measured", "fitted"], loc="best")
    root = 100 * np.sqrt(np.nanmean(record["residual"].values ** 2))
    style.add_heading(above, f"{record['name'].values[0]}, residual {root:.2g} % rms")
