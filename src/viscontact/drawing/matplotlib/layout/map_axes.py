"""Axes of maps of the surface."""

from __future__ import annotations

from collections.abc import Iterable

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.path import Path
from matplotlib.transforms import offset_copy

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.map import BodyPlace
from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style

#: Length of the arrow along a motion [points].
_LENGTH = 20.0
_ARROW = {
    **{"arrowstyle": "-|>", "color": style.BODY, "linewidth": 1.4},
    **{"shrinkA": 0.0, "shrinkB": 0.0},
}


def show_window(axes: Axes, window: Window) -> None:
    """Set limits and aspect of axes that are drawn in the window's unit."""
    axes.set(xlim=window.unit(window.x), ylim=window.unit(window.y), aspect=window.stretch)


def rim_path(polygons: Iterable[Floats]) -> Path:
    """Closed path of all polygons of a rim, without the holes in spots."""
    return Path.make_compound_path(*(Path(polygon, closed=True) for polygon in polygons))


def mark_body(axes: Axes, body: BodyPlace | None, window: Window) -> list[Artist]:
    """Cross at the axis of a moving body, and an arrow along its motion; nothing if it stands."""
    if body is None:
        return []
    x, y = window.unit(body.axis).tolist()
    marks: list[Artist] = [*axes.plot(x, y, "+", color=style.BODY, ms=6.0, mew=1.3, zorder=5.0)]
    arrow = body.arrow(window.stretch, _LENGTH)
    if arrow is not None:
        ahead = offset_copy(axes.transData, style.figure_of(axes), *arrow, units="points")
        marks.append(axes.annotate("", (x, y), (x, y), ahead, "data", arrowprops=_ARROW))
    return marks
