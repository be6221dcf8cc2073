"""Axes of maps of the surface."""

from __future__ import annotations

from collections.abc import Iterable

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.transforms import offset_copy

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.map import BodyPlace, Maps
from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import Width, page_width

#: Height over width from which on maps are beside each other.
_HIGH = 1.6
#: Length of the arrow along a motion [points].
_LENGTH = 20.0
_ARROW = {
    **{"arrowstyle": "-|>", "color": style.BODY, "linewidth": 1.4},
    **{"shrinkA": 0.0, "shrinkB": 0.0},
}


def map_panels(maps: Maps, wanted: Width | None) -> tuple[Figure, list[Axes]]:
    """Figure with axes for each map, on common axes x and y, with room for a colour bar."""
    count, shape = len(maps.maps), maps.window.height_to_width
    long = shape < 0.6
    # Two rows of high maps would not fit on a page.
    columns = 1 if long else min(count, 4 if shape > _HIGH else 2)
    rows = -(-count // columns)
    width = page_width(wanted, style.TWO_COLUMNS if columns >= 2 or long else style.ONE_COLUMN)
    height = rows * ((width - 1.3) / columns * shape + 0.22) + 0.45
    figure = style.new_figure(width, height, fixed_aspect=True)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    panels = list(grid.flat)
    for unused in panels[count:]:
        unused.remove()
    for axes in panels[:count]:
        style.dress(axes)
        show_window(axes, maps.window)
    x, y = maps.axes()
    for axes in grid[:, 0]:
        axes.set_ylabel(y.label)
    for axes in grid[-1, :]:
        axes.set_xlabel(x.label)
    return figure, panels[:count]


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
