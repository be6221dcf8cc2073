"""Panels are drawn as their content says."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from matplotlib.axes import Axes

from viscontact.drawing.content.panel import Axis, Curve, LineLook, Mark, MarkLook, Panel
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.panels import draw_panel, legend_key, named_keys

X, Y = np.arange(4.0), np.array([1.0, 3.0, 2.0, 4.0])


def axes_of(*curves: Curve, marks: tuple[Mark, ...] = ()) -> Axes:
    axes = style.new_figure(4.0, 3.0).subplots()
    draw_panel(axes, Panel(Axis.of("x", "m", X), Axis.of("y", "N", Y), curves, marks=marks))
    return axes


@pytest.mark.parametrize("look", get_args(LineLook))
def test_errors_of_a_line_are_a_band_and_it_has_no_markers(look: LineLook) -> None:
    axes = axes_of(Curve(X, Y, look=look, error=0.1 * Y))
    (line,), (band, *_) = axes.get_lines(), axes.collections
    assert line.get_marker() == "None"
    assert type(band).__name__ == "FillBetweenPolyCollection"


@pytest.mark.parametrize("look", [each for each in get_args(MarkLook) if each != "bars"])
def test_errors_of_markers_are_bars(look: MarkLook) -> None:
    axes = axes_of(Curve(X, Y, look=look, error=0.1 * Y))
    (line,), (bars,) = axes.get_lines(), axes.collections
    assert line.get_marker() != "None"
    assert (line.get_linestyle() == "-") == (look in ("joined", "linked"))
    assert type(bars).__name__ == "LineCollection"


def test_leading_edge_is_full_and_trailing_edge_is_white() -> None:
    leading, trailing = (legend_key(Curve(X, Y, look=look)) for look in ("leading", "trailing"))
    assert leading.get_markerfacecolor() == leading.get_color()
    assert trailing.get_markerfacecolor() == "white"


def test_curve_on_top_is_above_others_and_not_cut() -> None:
    usual, above = axes_of(Curve(X, Y), Curve(X, Y, is_on_top=True)).get_lines()
    assert (usual.get_clip_on(), above.get_clip_on()) == (True, False)
    assert above.get_zorder() > usual.get_zorder()


def test_marks_are_behind_curves_and_name_their_level() -> None:
    axes = axes_of(Curve(X, Y), marks=(Mark(2.0, "y", "level", is_text_below=True),))
    curve, mark = axes.get_lines()
    assert mark.get_zorder() < curve.get_zorder()
    (text,) = axes.texts
    assert (text.get_text(), text.get_verticalalignment()) == ("level", "top")


def test_legend_has_the_curves_with_names() -> None:
    keys, names = named_keys([Curve(X, Y), Curve(X, Y, "measured", look="hollow")])
    assert names == ["measured"]
    assert [key.get_marker() for key in keys] == ["o"]
