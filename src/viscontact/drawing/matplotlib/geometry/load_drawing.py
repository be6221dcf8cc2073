"""Drawing of a prescribed load history."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import LoadHistory
from viscontact.drawing.matplotlib.layout import style
from viscontact.units.formatting import readable_unit

_POINTS = 1200


def draw_load(load: LoadHistory, end: float) -> Figure:
    """Draw the force or the approach of a load history over time.

    Parameters
    ----------
    load : LoadHistory
        The history.
    end : float
        Until when [s].

    Returns
    -------
    matplotlib.figure.Figure
        One panel; a jump is a vertical line, one at time 0 begins at zero.

    Raises
    ------
    ValueError
        If the end is not after 0.

    Examples
    --------
    >>> from viscontact.bodies.loads import step
    >>> figure = draw_load(step(10e3), 60.0)
    >>> figure.axes[0].get_ylabel(), figure.axes[0].lines[0].get_ydata()[:2].tolist()
    ('Force [kN]', [0.0, 10.0])
    """
    if not (np.isfinite(end) and end > 0):
        raise ValueError(f"end must be an instant after 0 s, got {end!r}")
    times, levels = _curve(load, end)
    unit, time_unit = readable_unit(load.unit, levels), readable_unit("s", times)
    figure = style.new_figure(style.ONE_COLUMN, 2.7)
    axes = figure.subplots()
    axes.plot(time_unit(times), unit(levels), color=style.LINE, linewidth=style.LINE_WIDTH)
    axes.axhline(0.0, color=style.FAINT, linewidth=style.THIN_LINE)
    axes.set(xlabel=time_unit.label("Time"), ylabel=unit.label(_quantity(load)))
    margin = 0.02 * end
    axes.set_xlim(*time_unit([-margin, end + margin]))
    style.dress(axes)
    return figure


def _quantity(load: LoadHistory) -> str:
    """Quantity and unit of the curve."""
    if load.control == "mixed":
        return "Share of the largest load"
    return load.control.capitalize()


def _curve(load: LoadHistory, end: float) -> tuple[Floats, Floats]:
    """Times and levels of the curve, with both sides of every jump."""
    kinks = load.kinks[(load.kinks > 0) & (load.kinks < end)]
    instants = np.unique(np.concatenate([np.linspace(0.0, end, _POINTS), kinks]))
    both = [load.level_at(instants, side=side) for side in ("left", "right")]
    both[0][0] = 0.0  # zero load before the beginning
    return np.repeat(instants, 2), np.column_stack(both).ravel()
