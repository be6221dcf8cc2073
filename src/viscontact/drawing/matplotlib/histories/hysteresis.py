"""Loops of runs: force over approach, and in reports resistance over position."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from viscontact.drawing.content.along_run import within_span
from viscontact.drawing.content.compared_runs import runs_of
from viscontact.drawing.content.loop import Loop, loop_panel, loops_of
from viscontact.drawing.content.panel import Curve, Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.error_band import legend_entries
from viscontact.drawing.matplotlib.layout.page import Width, page_width
from viscontact.drawing.matplotlib.layout.panels import draw_panel
from viscontact.results.run_axis import require_time
from viscontact.results.shown_scalars import lacks_datum

_NAME = "hysteresis"

#: Positions of the arrows along the loop.
_ARROWS = (0.15, 0.4, 0.65, 0.9)

#: Most entries of a legend within the panel.
_MOST_INSIDE = 6


def hysteresis(
    results: xr.Dataset | Mapping[str, xr.Dataset],
    *,
    times: ArrayLike | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw force over approach, with arrows in the direction of time.

    Parameters
    ----------
    results : xarray.Dataset, or mapping of str to xarray.Dataset
        From `viscontact.simulate` or `viscontact.open_results`; several results by the names to
        print.
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
    runs = runs_of(results, _NAME)
    for run in runs.values():
        require_time(run, _NAME)
    if any(lacks_datum(run) for run in runs.values()):
        raise ValueError(f"{_NAME}: the approach of a line contact has no datum; draw history")
    shown = {name: within_span(run, _names(run), times, _NAME, name) for name, run in runs.items()}
    return _figure(shown, [Loop(_NAME, "approach", "force")], width)


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
    return hysteresis(runs, times=times, width=width)


def loops(results: xr.Dataset) -> Figure:
    """Draw all loops of a run: force over approach, and resistance over position."""
    return _figure({"": results}, loops_of(results), None)


def _figure(runs: Mapping[str, xr.Dataset], drawn: Sequence[Loop], width: Width | None) -> Figure:
    """Figure with a panel for each loop of some runs by name."""
    wide = page_width(width, style.ONE_COLUMN)
    figure = style.new_figure(wide, min(3.3, 0.8 * wide) * len(drawn))
    for axes, loop in zip(figure.subplots(len(drawn), squeeze=False).flat, drawn, strict=True):
        panel = loop_panel(runs, loop)
        bands = draw_panel(axes, panel)
        lines = axes.get_lines()
        for curve in panel.curves:
            _add_arrows(axes, panel, curve)
        entries = legend_entries(lines, list(runs), bands)
        if entries:
            handles, labels = zip(*entries, strict=True)
            if len(labels) > _MOST_INSIDE:
                style.add_legend_below(figure, handles, labels)
            else:
                style.add_legend(axes, handles, labels, loc="best")
    return figure


def _names(run: xr.Dataset) -> list[str]:
    return ["approach", "force", *(["loss_per_cycle"] if "loss_per_cycle" in run else [])]


def _add_arrows(axes: Axes, panel: Panel, curve: Curve) -> None:
    """Arrows along a loop in the direction of time, at fractions of its drawn length."""
    x, y = panel.x.unit(curve.x), panel.y.unit(curve.y)
    steps = [np.diff(values) / (np.ptp(values) or 1.0) for values in (x, y)]
    way = np.append(0.0, np.cumsum(np.hypot(*steps)))
    if way[-1] == 0:
        return
    look = {"color": style.look_of(curve.ink)["color"], "linewidth": 0.0}
    for part in _ARROWS:
        # From slightly before the position to the position, where the head is.
        ends = [
            (np.interp(at * way[-1], way, x), np.interp(at * way[-1], way, y))
            for at in (part - 0.004, part)
        ]
        head = {"arrowstyle": "-|>", "mutation_scale": 12, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", ends[1], ends[0], arrowprops=head | look)
