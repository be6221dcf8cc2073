"""Axes of maps of the surface."""

from __future__ import annotations

from collections.abc import Iterable

from matplotlib.axes import Axes
from matplotlib.path import Path

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.window import Window


def show_window(axes: Axes, window: Window) -> None:
    """Set limits and aspect of axes that are drawn in the window's unit."""
    axes.set(xlim=window.unit(window.x), ylim=window.unit(window.y), aspect=window.stretch)


def rim_path(polygons: Iterable[Floats]) -> Path:
    """Closed path of all polygons of a rim, without the holes in spots."""
    return Path.make_compound_path(*(Path(polygon, closed=True) for polygon in polygons))
