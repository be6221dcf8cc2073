"""Force over approach: the loop of loading and unloading."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.compared_runs import require_runs
from viscontact.plot.histories.time_axis import within_span
from viscontact.plot.layout import style
from viscontact.plot.layout.error_band import Band, draw_band, legend_entries
from viscontact.plot.layout.ordered_names import styles_of
from viscontact.plot.layout.page import Width, page_width
from viscontact.results.recorded_case import is_prescribed
from viscontact.results.run_axis import require_time
from viscontact.results.shown_scalars import lacks_datum
from viscontact.results.stated_errors import stated_error
from viscontact.units.formatting import format_quantity, readable_unit

_NAME = "hysteresis"

#: Positions of the arrows along the loop.
_ARROWS = (0.15, 0.4, 0.65, 0.9)

#: Most entries of a legend within the panel.
_MOST_INSIDE = 6


def hysteresis(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw force over approach, with arrows in the direction of time.

    Parameters
    ----------
    results : xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s]; by
        default all of it.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One loop a cycle. The area within it is what the cycle has cost; that of the last whole
        one is written above.

    Raises
    ------
    ValueError
        If fewer than two steps lie in the span, or the contact is a line contact.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> load, times = vc.harmonic(0.1, 0.05, period=1.0, cycles=1), vc.uniform_times(1.0, 4)
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, load, grid, times, errors=False)
    >>> axes = hysteresis(ds).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('Approach [µm]', 'Force [mN]')
    """
    figure = compare_hysteresis({"": results}, times=times, width=width)
    if loss := _last_loss(results, times):
        style.add_heading(figure.axes[0], loss, aside=True)
    return figure


def compare_hysteresis(
    runs: Mapping[str, xr.Dataset], *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Overlay force against approach of several runs.

    Parameters
    ----------
    runs : mapping of str to xarray.Dataset
        Results by the name to print.
    times : array_like, optional
        Draw only the span between the least and the largest of these instants [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        One line per run, with bands for the errors of approach and force where they are known.

    Raises
    ------
    ValueError
        If there are no runs, or one has fewer than two steps in the span or is a line contact.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ball = vc.Sphere(0.01)
    >>> one, two = (
    ...     vc.simulate(ball, rubber, vc.step(force), grid, [0.0, 1.0], errors=False)
    ...     for force in (0.1, 0.2)
    ... )
    >>> runs = {"0.1 N": one, "0.2 N": two}
    >>> axes = compare_hysteresis(runs).axes[0]
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('Approach [µm]', 'Force [mN]')
    """
    require_runs(runs, _NAME)
    for run in runs.values():
        require_time(run, _NAME)
    if any(lacks_datum(run) for run in runs.values()):
        raise ValueError(f"{_NAME}: the approach of a line contact has no datum; draw history")
    drawn = ("approach", "force")
    shown = {name: within_span(run, drawn, times, _NAME, name) for name, run in runs.items()}
    wide = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(wide, min(3.3, 0.8 * wide))
    axes = figure.subplots()
    style.dress(axes)
    x_unit = readable_unit("m", *(run["approach"].values for run in shown.values()))
    y_unit = readable_unit("N", *(run["force"].values for run in shown.values()))
    bands: list[Band] = []
    for (name, run), look in zip(shown.items(), styles_of(list(shown)), strict=True):
        x, y = x_unit(run["approach"].values), y_unit(run["force"].values)
        axes.plot(x, y, label=name, **look)
        for quantity, unit in (("approach", x_unit), ("force", y_unit)):
            error = None if is_prescribed(run, quantity) else stated_error(run, quantity)
            if error is not None:
                bands += _draw_bands(
                    axes, x, y, unit(error), look["color"], sideways=unit is x_unit
                )
        _add_arrows(axes, x, y, look)
    axes.set(xlabel=x_unit.label("Approach"), ylabel=y_unit.label("Force"))
    _frame(axes)
    entries = legend_entries(axes.get_lines(), list(shown), bands)
    if entries:
        handles, labels = zip(*entries, strict=True)
        if len(labels) > _MOST_INSIDE:
            style.add_legend_below(figure, handles, labels)
        else:
            style.add_legend(axes, handles, labels, loc="best")
    return figure


def _draw_bands(
    axes: Axes,
    x: Floats,
    y: Floats,
    error: Floats,
    colour: str,
    *,
    sideways: bool,
) -> list[Band]:
    """Error band of each loading and unloading branch, separately."""
    bands = []
    along = y if sideways else x
    turns = np.flatnonzero(np.diff(np.sign(np.diff(along)))) + 1
    for part in np.split(np.arange(x.size), turns):
        # Each part begins at the end of the previous one.
        way = np.append(part, part[-1] + 1)[: x.size - int(part[0])]
        bands.append(draw_band(axes, x[way], y[way], error[way], colour, sideways=sideways))
    return [band for band in bands if band is not None]


def _add_arrows(axes: Axes, x: Floats, y: Floats, look: dict[str, Any]) -> None:
    """Arrows along the loop, at fractions of its drawn length."""
    steps = [np.diff(values) / (np.ptp(values) or 1.0) for values in (x, y)]
    way = np.append(0.0, np.cumsum(np.hypot(*steps)))
    if way[-1] == 0:
        return
    for part in _ARROWS:
        # From slightly before the position to the position, where the head is.
        ends = [(np.interp(at * way[-1], way, x), np.interp(at * way[-1], way, y))
                for at in (part - 0.004, part)]  # fmt: skip
        axes.annotate(
            "",
            ends[1],
            ends[0],
            arrowprops={
                **{"arrowstyle": "-|>", "mutation_scale": 12, "shrinkA": 0, "shrinkB": 0},
                **{"color": look["color"], "linewidth": 0.0},
            },
        )


def _frame(axes: Axes) -> None:
    """Axis from zero where the force is steady, so that rounding does not fill it."""
    low, high = axes.dataLim.y0, axes.dataLim.y1
    if high - low <= 1e-4 * abs(high):
        axes.set_ylim(0.0, 1.15 * high or 1.0)


def _last_loss(results: xr.Dataset, times: ArrayLike | None) -> str:
    """Loss of the last complete cycle within the span, in words."""
    if "loss_per_cycle" not in results:
        return ""
    losses = within_span(results, ("loss_per_cycle",), times, _NAME, "")["loss_per_cycle"].values
    known = losses[np.isfinite(losses)]
    return f"loss per cycle {format_quantity(float(known[-1]), 'J', 3)}" if known.size else ""
