"""The law's curves: creep compliance and relaxation modulus (the paper's Fig. 5)."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from viscontact.laws import Law
from viscontact.plot import style
from viscontact.plot.page import NARROW, Width, page_width
from viscontact.plot.readable import display_unit
from viscontact.plot.recorded import recorded_noun

_NAME = "creep"


def creep(
    results: xr.Dataset, *, times: ArrayLike | None = None, width: Width | None = None
) -> Figure:
    """Draw the creep compliance and relaxation modulus of the half-space of a run.

    Parameters
    ----------
    results : xarray.Dataset
        What ``simulate`` or ``open_results`` returned.
    times : array_like, optional
        Draw the span between the least and the largest of these instants [s]; by default
        the time simulated.
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        The curves, as drawn by `creep_curve`.

    Raises
    ------
    ValueError
        If the result carries no case, or the span is empty.
    """
    law = recorded_noun(results, "material", _NAME).law
    span = np.atleast_1d(np.asarray(results["time"].values if times is None else times, float))
    positive = span[span > 0]
    if positive.size == 0 or not np.all(np.isfinite(span)):
        raise ValueError(f"{_NAME}: times must be finite with one above 0 s, got {times!r}")
    # Four decades show how the law gets to where the run begins.
    first = min(float(positive.min()), float(positive.max()) / 1e4)
    return creep_curve(law, np.geomspace(first, positive.max(), 300), width=width)


def creep_curve(law: Law, times: ArrayLike, *, width: Width | None = None) -> Figure:
    """Draw creep compliance and relaxation modulus of a law against time.

    Parameters
    ----------
    law : Law
        A creep law.
    times : array_like
        Instants to evaluate the law at, above 0 and increasing [s].
    width : {"single", "double"} or float, optional
        One or two columns of a journal (89 and 183 mm), or a width [m].

    Returns
    -------
    matplotlib.figure.Figure
        Phi(t) and G(t) over logarithmic time, side by side; a dashed line marks the value
        at time 0. The modulus is left out for a law without instant compliance, whose G(t)
        starts with an impulse.

    Raises
    ------
    ValueError
        If the times are not positive and increasing.

    Examples
    --------
    >>> from viscontact.laws import Maxwell
    >>> figure = creep_curve(Maxwell(1e9, 1e11), [1.0, 10.0, 100.0])
    >>> compliance, modulus = figure.axes
    >>> compliance.lines[0].get_ydata().round(3).tolist()  # Phi in 1/GPa
    [0.505, 0.55, 1.0]
    """
    instants = np.atleast_1d(np.asarray(times, dtype=np.float64))
    if instants.size < 2 or not (instants[0] > 0 and np.all(np.diff(instants) > 0)):
        raise ValueError(
            f"{_NAME}: times must be at least two, above 0 s and increasing, got {times!r}"
        )
    instant_compliance = float(law(0.0))
    stiff_at_once = instant_compliance > 0
    count = 2 if stiff_at_once else 1
    wide = page_width(width, style.TWO_COLUMNS if count == 2 else style.ONE_COLUMN)
    columns = 1 if wide <= NARROW else count
    rows = count // columns
    figure = style.new_figure(wide, 2.7 if rows == 1 else 2.4 * rows)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    _draw(panels[0], "Creep compliance Φ", "1/Pa", instants, law(instants), instant_compliance)
    if stiff_at_once:
        at_once = float(law.relaxation(0.0))
        _draw(panels[1], "Relaxation modulus G", "Pa", instants, law.relaxation(instants), at_once)
    return figure


def _draw(
    axes: Axes,
    quantity: str,
    si_unit: str,
    times: NDArray[np.float64],
    values: NDArray[np.float64],
    at_once: float,
) -> None:
    unit, time_unit = display_unit(si_unit, values, at_once), display_unit("s", times)
    axes.semilogx(time_unit(times), unit(values), color=style.LINE, linewidth=style.LINE_WIDTH)
    # The instant itself is not on a logarithmic axis.
    axes.axhline(float(unit(at_once)), color=style.FAINT, linewidth=0.8, linestyle=(0, (4, 3)))
    rises = values[-1] > at_once
    axes.annotate(
        "t = 0",
        (1.0, float(unit(at_once))),
        xycoords=("axes fraction", "data"),
        xytext=(-2, 3 if rises else -3),
        textcoords="offset points",
        ha="right",
        va="bottom" if rises else "top",
        fontsize=style.TICK_SIZE,
        color=style.FAINT,
    )
    axes.set(xlabel=time_unit.label("Time"), ylabel=unit.label(quantity))
    axes.set_xlim(*time_unit([times[0], times[-1]]))
    style.dress(axes)
