"""Trade-off of a design: two scalars of all trials, and those that are not dominated."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.results.variables import SCALARS, error_name
from viscontact.units.formatting import readable_unit

#: Height of a panel [inch].
_HEIGHT = 3.0


def trade_off(table: xr.Dataset, *, width: Width | None = None) -> Figure:
    """Draw the trials of a design with several goals: each pair of its scalars.

    Parameters
    ----------
    table : xarray.Dataset
        Trials of a design with two goals or more, `DesignResult.table`.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each pair: full points with error bars, joined by a line if there are two
        scalars, are the trials that are not dominated, pale points the other feasible ones on the
        cells of the case, and the square is the compromise.

    Examples
    --------
    >>> data = {name: ("trial", [1.0, 2.0, 3.0]) for name in ("force_error", "approach_error")}
    >>> data |= {"force": ("trial", [3.0, 1.0, 4.0]), "approach": ("trial", [1.0, 3.0, 4.0])}
    >>> data |= {"feasible": ("trial", [True] * 3), "on_front": ("trial", [True, True, False])}
    >>> data |= {"level": ("trial", ["case"] * 3)}
    >>> axes = trade_off(xr.Dataset(data, attrs={"goal": "force approach", "best": 0})).axes[0]
    >>> axes.get_xlabel(), axes.lines[1].get_xdata().tolist()
    ('Force [N]', [1.0, 3.0])
    """
    pairs = list(combinations(str(table.attrs["goal"]).split(), 2))
    across = page_width(width, style.TWO_COLUMNS if len(pairs) > 1 else style.ONE_COLUMN)
    figure = style.new_figure(across, _HEIGHT + 0.4)
    panels = figure.subplots(1, len(pairs), squeeze=False)[0]
    front = table["on_front"].values.astype(bool)
    others = table["feasible"].values & (table["level"].values == "case") & ~front
    best = int(table.attrs["best"])
    for axes, names in zip(panels, pairs, strict=True):
        style.dress(axes)
        units = [readable_unit(SCALARS[name].units, table[name].values) for name in names]
        x, y = (unit(table[name].values) for unit, name in zip(units, names, strict=True))
        bars = [
            np.nan_to_num(unit(table[error_name(name)].values), nan=0.0, posinf=0.0)
            for unit, name in zip(units, names, strict=True)
        ]
        pale = {"color": style.FAINT, "alpha": 0.6, "markersize": 3.5}
        if others.any():
            axes.plot(x[others], y[others], "o", label="dominated", **pale)
        rows = np.flatnonzero(front)[np.argsort(x[front])]
        line = "o-" if len(pairs) == 1 else "o"
        look = {"color": style.LINE, "markersize": 3.5, "linewidth": 0.8}
        axes.plot(x[rows], y[rows], line, label="not dominated", **look)
        axes.errorbar(
            *(x[rows], y[rows], bars[1][rows], bars[0][rows]),
            fmt="none",
            ecolor=style.LINE,
            elinewidth=0.8,
        )
        square = {"markerfacecolor": "none", "markeredgecolor": style.INK, "markersize": 8}
        axes.plot(x[[best]], y[[best]], "s", label="compromise", **square)
        axes.set_xlabel(units[0].label(SCALARS[names[0]].label))
        axes.set_ylabel(units[1].label(SCALARS[names[1]].label))
    handles, labels = panels[0].get_legend_handles_labels()
    style.add_legend_below(figure, handles, labels, columns=3)
    return figure
