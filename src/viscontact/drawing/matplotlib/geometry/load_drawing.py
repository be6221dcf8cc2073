"""Drawing of a prescribed load history."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from viscontact.bodies.loads import LoadHistory, TemperatureHistory
from viscontact.drawing.content.load_course import load_panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.panels import draw_panel


def draw_load(
    load: LoadHistory, end: float, *, temperature: TemperatureHistory | None = None
) -> Figure:
    """Draw the force or the approach of a load history over time.

    Parameters
    ----------
    load : LoadHistory
        The history.
    end : float
        Until when [s].
    temperature : TemperatureHistory, optional
        Drawn on a second axis, where it varies.

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
    figure = style.new_figure(style.ONE_COLUMN, 2.7)
    draw_panel(figure.subplots(), load_panel(load, end, temperature=temperature))
    return figure
