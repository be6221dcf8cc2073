"""Panels of curves in Matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import Aside, Axis, Curve, Mark, Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.error_band import ErrorBand, draw_band
from viscontact.drawing.matplotlib.layout.log_ticks import plain_log_ticks
from viscontact.drawing.matplotlib.layout.log_time import label_log_time, set_log_time
from viscontact.drawing.matplotlib.layout.page import NARROW

_WHITE: dict[str, Any] = {"marker": "o", "markersize": 3.6, "markerfacecolor": "white"}
_WHITE["markeredgewidth"] = 0.9
_EDGE: dict[str, Any] = {"marker": "o", "markersize": 4.0, "linestyle": "none"}
#: Dashes and markers of a curve by its look.
_LOOKS: Mapping[str, dict[str, Any]] = {
    "line": {},
    "bold": {"linewidth": 2.0},
    "thin": {"linewidth": style.THIN_LINE},
    "dashed": {"linestyle": "--", "linewidth": 1.0},
    "beyond": {"linestyle": (0, (3, 2)), "alpha": 0.7},
    "dotted": {"linestyle": ":", "linewidth": 1.0},
    "joined": {"marker": "o", "markersize": 3.5},
    "points": {"marker": "o", "markersize": 3.5, "linestyle": "none"},
    "hollow": {
        **{"marker": "o", "markersize": 3.2, "linestyle": "none", "markerfacecolor": "none"},
        "markeredgewidth": 0.8,
    },
    "white": _WHITE | {"linestyle": "none"},
    "linked": _WHITE | {"linestyle": "-", "linewidth": style.THIN_LINE},
    "cross": {"marker": "x", "markersize": 3.5, "linestyle": "none"},
    "square": {
        **{"marker": "s", "markersize": 8.0, "linestyle": "none", "markerfacecolor": "none"},
        "zorder": 2.1,  # around a point with its error bars
    },
    "leading": _EDGE,
    "trailing": _EDGE | {"markerfacecolor": "white"},
}
#: Curves among many, with markers or without, and markers that are apart, against the diagonal.
_FINE: Mapping[str, Any] = {"markersize": 2.6, "markeredgewidth": 0.7, "linewidth": 0.6}
_FINE_LINE: Mapping[str, Any] = {"linewidth": 1.0}
_APART = 0.05
#: Curves that the border of a panel does not cut.
_ON_TOP: Mapping[str, Any] = {"clip_on": False, "zorder": 3}
#: Errors of bars.
_CAPPED: Mapping[str, Any] = {"ecolor": style.INK, "elinewidth": 0.9, "capsize": 2.0}
#: Heights and markers of marks at the border.
_AT_BORDER: Mapping[str, tuple[float, dict[str, Any]]] = {
    "tick": (0.0, {"marker": "|", "markersize": 9, "clip_on": False}),
    "cross": (0.02, {"marker": "x", "markersize": 4}),
}
#: Dashes of marks, which lie behind the curves.
_MARKS, _BEHIND = {"line": "-", "dashed": "--", "dotted": ":"}, 1.9


def grid_of_panels(count: int, width: float) -> tuple[Figure, list[Axes]]:
    """Figure of a width [inch] with equal panels over a common axis."""
    columns = 1 if width <= NARROW else 2 if count in (2, 4) else 3
    rows = -(-count // columns)
    height = {1: 1.5, 2: 2.3, 3: 2.0}[columns] * rows + 0.2
    figure = style.new_figure(width, height)
    panels = list(figure.subplots(rows, columns, sharex=True, squeeze=False).flat)
    for unused in panels[count:]:
        unused.remove()
    # Only the lowest panel of each column has an axis label, or all of them where columns differ,
    # for even spacing of the rows.
    first = max(count - columns, 0) if count % columns == 0 else 0
    for axes in panels[first:count]:
        axes.tick_params(labelbottom=True)
    return figure, panels[:count]


def stacked_panels(panels: Sequence[Panel], width: float, height: float) -> Figure:
    """Figure of a width and height [inch] with panels over a common axis, and one legend below."""
    figure = style.new_figure(width, height)
    both = figure.subplots(len(panels), 1, sharex=True)
    for axes, panel in zip(both, panels, strict=True):
        draw_panel(axes, panel)
        if axes is not both[-1]:
            axes.set_xlabel("")
    named = next((panel for panel in panels if any(c.name for c in panel.curves)), None)
    if named is not None:
        style.add_legend_below(figure, *named_keys(named.curves))
    return figure


def draw_panel(axes: Axes, panel: Panel) -> list[ErrorBand]:
    """Draw a panel, and return the error bands of its curves."""
    style.dress(axes)
    if panel.aside is not None:
        _draw_aside(axes, panel, panel.aside)
    if panel.shaded is not None:
        low, high = panel.x.unit(panel.shaded).tolist()
        axes.axvspan(low, high, color=style.SHADE, zorder=0, linewidth=0)
    for shaded in panel.bands:
        look = {"color": style.look_of(shaded.ink)["color"], "alpha": 0.25, "linewidth": 0.0}
        edges = panel.y.unit(shaded.low), panel.y.unit(shaded.high)
        axes.fill_between(panel.x.unit(shaded.x), *edges, label=shaded.name, **look)
    for curve in panel.curves:
        _draw_curve(axes, panel.x.unit(curve.x), panel.y.unit(curve.y), curve)
    bands = [band for curve in panel.curves for band in _errors(axes, panel, curve)]
    for mark in panel.marks:
        _draw_mark(axes, panel, mark)
    _scale_up(axes, panel.y)
    scale_along(axes, panel.x)
    if panel.in_place:
        _say_not_drawn(axes, panel.in_place)
    if panel.title:
        style.add_heading(axes, panel.title)
    if panel.note:
        style.add_heading(axes, panel.note, aside=True)
    return bands


def _draw_aside(axes: Axes, panel: Panel, aside: Aside) -> None:
    """Draw a curve on an axis of its own at the right, behind the panel's."""
    right = axes.twinx()
    style.dress(right)
    look = _look_of(aside.curve)
    right.plot(panel.x.unit(aside.curve.x), aside.axis.unit(aside.curve.y), **look)
    _scale_up(right, aside.axis)
    right.spines["left"].set_visible(False)
    right.spines["right"].set_visible(True)
    for part in (right.spines["right"], right.yaxis.label):
        part.set_color(look["color"])
    right.tick_params(axis="y", colors=look["color"])
    axes.set_zorder(right.get_zorder() + 1)
    axes.patch.set_visible(False)


def _draw_curve(axes: Axes, x: Floats, y: Floats, curve: Curve) -> None:
    if curve.look == "bars":
        colour = style.look_of(curve.ink)["color"]
        axes.barh(y, x, height=0.65, color=colour, alpha=0.8, label=curve.name)
    else:
        axes.plot(x, y, label=curve.name, **_look_of(curve))


def legend_key(curve: Curve) -> Line2D:
    """Line or marker of a curve for a legend."""
    return Line2D([], [], **_look_of(curve))


def named_keys(curves: Iterable[Curve]) -> tuple[list[Line2D], list[str]]:
    """Keys and names of the curves that have a name, for a legend."""
    named = [curve for curve in curves if curve.name]
    return [legend_key(curve) for curve in named], [curve.name for curve in named]


def _look_of(curve: Curve) -> dict[str, Any]:
    look = style.look_of(curve.ink) | _LOOKS[curve.look]
    if curve.symbol:
        look["marker"] = style.MARKERS[curve.symbol % len(style.MARKERS)]
    if curve.is_fine:
        look |= _FINE_LINE if curve.is_line else _FINE
    if curve.has_spaced_markers:
        look["markevery"] = _APART
    if curve.is_on_top:
        look |= _ON_TOP
    return look


def _scale_up(axes: Axes, axis: Axis) -> None:
    """Scale and label the vertical axis of a panel."""
    axes.set_ylabel(axis.label)
    if axis.limits is not None:
        axes.set_ylim(*axis.unit(axis.limits))
    if axis.texts:
        axes.set_yticks(range(len(axis.texts)), list(map(style.literal, axis.texts)))
    elif axis.scale == "log":
        axes.set_yscale("log")
        plain_log_ticks(axes.yaxis)
    else:
        axes.ticklabel_format(axis="y", useOffset=False)
    if axis.is_reversed:
        axes.yaxis.set_inverted(True)


def scale_along(axes: Axes, axis: Axis) -> None:
    """Scale and label the horizontal axis of a panel."""
    label = axis.label
    if axis.limits is not None:
        start, end = axis.unit(axis.limits).tolist()
        if axis.scale == "time":
            set_log_time(axes, float(axis.unit(axis.first)), end)
        if end > start:
            axes.set_xlim(start, end)
    if axis.scale == "log":
        axes.set_xscale("log")
        plain_log_ticks(axes.xaxis)
    if axis.limits is not None and (axis.scale == "time" or axis.in_clock_units):
        first = float(axis.unit(axis.first))
        label = label_log_time(axes, axis.unit, first, end, axis.quantity)
    if axis.is_reversed:
        axes.xaxis.set_inverted(True)
    if axes.xaxis.get_tick_params()["labelbottom"]:
        axes.set_xlabel(label)


def _errors(axes: Axes, panel: Panel, curve: Curve) -> list[ErrorBand]:
    """Error bars at points, and bands of each branch of a line in turn."""
    x, y, colour = panel.x.unit(curve.x), panel.y.unit(curve.y), style.look_of(curve.ink)["color"]
    errors = [(curve.error, panel.y, False), (curve.error_x, panel.x, True)]
    bands = []
    for error, axis, sideways in errors:
        if error is None:
            continue
        if not curve.is_line:
            bars = np.where(np.isfinite(error), axis.unit(error), 0.0)
            how: dict[str, Any] = {"xerr" if sideways else "yerr": bars}
            how |= _CAPPED if curve.look == "bars" else {"ecolor": colour, "elinewidth": 0.8}
            axes.errorbar(x, y, fmt="none", **how)
            continue
        for part in _branches(y if sideways else x):
            half = axis.unit(error[part])
            bands.append(draw_band(axes, x[part], y[part], half, colour, sideways=sideways))
    return [band for band in bands if band is not None]


def _branches(along: Floats) -> list[Any]:
    """Indices of the parts of a curve between its turns; each begins at the end of the last."""
    turns = np.flatnonzero(np.diff(np.sign(np.diff(along)))) + 1
    return [
        np.append(part, part[-1] + 1)[: along.size - int(part[0])]
        for part in np.split(np.arange(along.size), turns)
    ]


def _draw_mark(axes: Axes, panel: Panel, mark: Mark) -> None:
    look: dict[str, Any] = {"linestyle": _MARKS.get(mark.look), "linewidth": style.THIN_LINE}
    look |= {"color": style.look_of(mark.ink)["color"], "zorder": _BEHIND}
    if mark.look in _AT_BORDER:
        height, how = _AT_BORDER[mark.look]
        at, border = float(panel.x.unit(mark.place)), axes.get_xaxis_transform()
        axes.plot([at], [height], color=look["color"], transform=border, linestyle="none", **how)
    elif mark.axis == "x":
        axes.axvline(float(panel.x.unit(mark.place)), **look)
    else:
        axes.axhline(float(panel.y.unit(mark.place)), **look)
        if mark.text:
            _add_text(axes, float(panel.y.unit(mark.place)), mark)


def _add_text(axes: Axes, place: float, mark: Mark) -> None:
    """Write what a level is at the right end of its line."""
    axes.annotate(
        style.literal(mark.text),
        (1.0, place),
        xycoords=("axes fraction", "data"),
        xytext=(-2, -3 if mark.is_text_below else 3),
        textcoords="offset points",
        ha="right",
        va="top" if mark.is_text_below else "bottom",
        fontsize=style.TICK_SIZE,
        color=style.FAINT,
    )


def _say_not_drawn(axes: Axes, text: str) -> None:
    look: dict[str, Any] = {"fontsize": style.TICK_SIZE, "color": style.FAINT}
    text = text.replace(": ", ":\n")
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes, **look)
    axes.set_yticks([])
