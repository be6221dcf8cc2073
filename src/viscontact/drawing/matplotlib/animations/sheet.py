"""Panels of an animation."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style

#: Space [inch] for a heading, labels at the left and below, a colour bar, panels of curves.
_HEAD, _LEFT, _BELOW, _BAR, _CURVES = 0.42, 0.68, 0.5, 0.95, 1.15
#: Sizes are multiples of this: video encoders need even numbers of pixels [inch].
STEP = 0.04


@dataclass(frozen=True, eq=False)
class AnimationSheet:
    """Empty panels of an animation, fixed in place; with is_long the section is below the map."""

    figure: Figure
    surface: Axes
    bar: Axes
    section: Axes
    histories: list[Axes]
    is_long: bool


def new_sheet(window: Window, width: float, histories: int, along: str) -> AnimationSheet:
    """Page of some width [inch]: map, section along x that shares its axis, and histories below."""
    is_long = window.height_to_width < 0.6
    width = STEP * round(width / STEP)
    room = width - _LEFT - _BAR - (0.0 if is_long else _LEFT + 0.1)
    across = room if is_long else room / 2
    tall = across * window.height_to_width
    between = 0.2 if along == "x" else 0.2 + _BELOW
    upper = _HEAD + tall + (between + _CURVES if is_long else 0.0) + _BELOW
    height = STEP * math.ceil((upper + 0.15 + _CURVES + _BELOW) / STEP)
    figure = Figure(figsize=(width, height))

    def panel(left: float, top: float, wide: float, high: float) -> Axes:
        axes = figure.add_axes(
            (left / width, 1 - (top + high) / height, wide / width, high / height)
        )
        style.dress(axes)
        return axes

    surface = panel(_LEFT, _HEAD, across, tall)
    bar = panel(_LEFT + across + 0.12, _HEAD, 0.12, tall)
    if is_long:
        section = panel(_LEFT, _HEAD + tall + between, across, _CURVES)
    else:
        section = panel(_LEFT + across + _BAR + _LEFT, _HEAD, room - across, tall)
    each = width / histories
    wide = each - _LEFT - 0.12
    curves = [panel(_LEFT + n * each, upper + 0.15, wide, _CURVES) for n in range(histories)]
    return AnimationSheet(figure, surface, bar, section, curves, is_long)
