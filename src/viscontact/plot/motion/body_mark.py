"""Mark of a moving body on a map of the surface."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.transforms import offset_copy

from viscontact.drawing.content.window import Window
from viscontact.plot.layout.style import figure_of
from viscontact.results.recorded_motion import body_axis_at, direction_at, motion_axis

#: Colour of what belongs to the body, and length of the arrow [points].
BODY_COLOUR, _LENGTH = "#D55E00", 20.0
_ARROW = {
    **{"arrowstyle": "-|>", "color": BODY_COLOUR, "linewidth": 1.4},
    **{"shrinkA": 0.0, "shrinkB": 0.0},
}


def mark_body(axes: Axes, results: xr.Dataset, time: float, window: Window) -> list[Artist]:
    """Draw a cross at the axis of a moving body, and from there an arrow along its motion.

    There is no arrow at rest, and nothing for a standing contact.
    """
    if motion_axis(results) is None:
        return []
    x, y = window.unit(body_axis_at(results, time)).tolist()
    marks: list[Artist] = [*axes.plot(x, y, "+", color=BODY_COLOUR, ms=6.0, mew=1.3, zorder=5.0)]
    direction = direction_at(results, time)
    if direction is not None:
        drawn = np.array([direction[0], window.stretch * direction[1]])
        across, up = _LENGTH * drawn / np.hypot(*drawn)
        ahead = offset_copy(axes.transData, figure_of(axes), across, up, units="points")
        marks.append(axes.annotate("", (x, y), (x, y), ahead, "data", arrowprops=_ARROW))
    return marks
