"""Style of all figures: sizes, fonts, colours and lines.

matplotlib's global settings are not changed, so figures may be drawn in several threads and a
user's own plots are not affected.

"""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import Any, TypeVar

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colorbar import Colorbar
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from viscontact.drawing.content.look import INSTANTS, LIGHT, RED, RUNS, shades
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import Ink
from viscontact.units.visible import visible

# Widths of one and of two columns of a journal page, in inches.
ONE_COLUMN = 4.6
TWO_COLUMNS = 7.2

LABEL_SIZE = 9.0
TICK_SIZE = 8.0
LINE_WIDTH = 1.4
THIN_LINE = 0.6
# Mean width of a letter of a legend, and width of the key before its text [inch].
_LETTER, _KEY = 0.062, 0.5
# Width beside a text: ticks and label of an axis, key of a legend [inch].
_BESIDE = 1.5
# Height of a row of a legend [inch], and number of rows for which figures have room.
_ROW, _FEW_ROWS = 0.18, 3
_Entry = TypeVar("_Entry")

INK, FAINT, LINE, BODY = LIGHT.ink, LIGHT.faint, LIGHT.blue, LIGHT.warm
#: Cold to warm, without the palest end of plasma, which is hard to see on white.
TEMPERATURES = LinearSegmentedColormap.from_list("sets", colormaps["plasma"](np.linspace(0, 0.85)))
#: Background of a range.
SHADE = "#eef2f6"
_RUN_DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1, 1.2)))

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">")


def new_figure(width: float, height: float, *, fixed_aspect: bool = False) -> Figure:
    """Empty figure of this size [inch] with automatic layout."""
    return Figure(figsize=(width, height), layout="compressed" if fixed_aspect else "constrained")


def dress(axes: Axes) -> None:
    """Apply thin frames, small outward ticks and the common text sizes to axes."""
    for name, spine in axes.spines.items():
        spine.set_linewidth(THIN_LINE)
        spine.set_color(INK)
        spine.set_visible(name in ("left", "bottom"))
    axes.tick_params(labelsize=TICK_SIZE, width=THIN_LINE, length=3.0, colors=INK)
    axes.tick_params(which="minor", width=0.4, length=1.8)
    axes.xaxis.label.set(size=LABEL_SIZE, color=INK)
    axes.yaxis.label.set(size=LABEL_SIZE, color=INK)


def literal(text: str) -> str:
    """Text of a user as Matplotlib draws it unchanged: nothing in it is a formula."""
    return visible(text).replace("$", r"\$")


def _in_lines(text: str, width: float) -> str:
    """Text in lines of this width [inch]: a longer one would leave no room for axes."""
    letters = max(20, int(width / _LETTER))
    lines = literal(text).split("\n")
    return "\n".join(line if len(line) <= letters else fill(line, letters) for line in lines)


def add_legend(
    drawn: Axes | Figure, handles: Sequence[Artist], labels: Sequence[str], **how: Any
) -> None:
    """Add a frameless legend, by default at the right of the axes."""
    look: dict[str, Any] = {"frameon": False, "handlelength": 1.6, "labelcolor": INK}
    look |= {"fontsize": TICK_SIZE, "title_fontsize": TICK_SIZE}
    look |= how or {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)}
    figure = drawn if isinstance(drawn, Figure) else figure_of(drawn)
    width = figure.get_figwidth() - _BESIDE
    legend = drawn.legend(handles, [_in_lines(label, width) for label in labels], **look)
    legend.get_title().set_color(INK)


def add_legend_below(
    figure: Figure,
    handles: Sequence[Artist],
    labels: Sequence[str],
    *,
    columns: int = 3,
    title: str | None = None,
) -> None:
    """Add a legend below all panels, with at most `columns` columns."""
    columns = columns_that_fit(figure, labels, columns)
    add_height_of_legend(figure, -(-len(labels) // columns))
    place = {"loc": "outside lower center", "ncols": columns, "columnspacing": 1.2, "title": title}
    add_legend(figure, by_rows(handles, columns), by_rows(labels, columns), **place)


def by_rows(entries: Sequence[_Entry], columns: int) -> list[_Entry]:
    """Entries of a legend of some columns, which is filled by columns, so that rows are read."""
    return [entry for column in range(columns) for entry in entries[column::columns]]


def columns_that_fit(figure: Figure, labels: Sequence[str], most: int) -> int:
    """Number of legend columns that fit on a page, with the widest label in each."""
    each = _KEY + _LETTER * max(map(len, labels))
    return max(1, min(most, len(labels), int(figure.get_figwidth() / each)))


def add_height_of_legend(figure: Figure, rows: int) -> None:
    """Make a figure higher by the rows of a long legend, which would cover its panels."""
    figure.set_figheight(figure.get_figheight() + _ROW * max(0, rows - _FEW_ROWS))


def add_heading(axes: Axes, text: str, *, aside: bool = False) -> None:
    """Add a heading above the left corner of a panel, or a note above its right one."""
    look: dict[str, Any] = {"fontsize": TICK_SIZE, "color": FAINT if aside else INK, "pad": 4}
    place = axes.get_subplotspec()
    columns = 1 if place is None else place.get_gridspec().ncols
    written = _in_lines(text, figure_of(axes).get_figwidth() / columns)
    axes.set_title(written, loc="right" if aside else "left", **look)


def arrange_headings(figure: Figure) -> None:
    """Move notes above headings that leave no room for them, once the layout is known."""
    for axes in figure.axes:
        found = (axes.get_title(loc=side) for side in ("left", "right"))
        heading, aside = (text.replace(r"\$", "$") for text in found)
        room = axes.get_window_extent().width / figure.dpi
        if heading and aside and _LETTER * (len(heading) + len(aside) + 2) > room:
            # Not below it, where a neighbour's heading may be.
            add_heading(axes, f"{aside}\n{heading}")
            add_heading(axes, "", aside=True)


def figure_of(axes: Axes) -> Figure:
    """Return the figure that holds these axes."""
    figure = axes.get_figure(root=True)
    if figure is None:
        raise ValueError("axes must belong to a figure, got axes that were removed from theirs")
    return figure


def time_colours(count: int) -> list[str]:
    """Colours of instants, from early (dark) to late (light)."""
    return LIGHT.instants(count)


def look_of(ink: Ink) -> dict[str, Any]:
    """Colour, dashes and width of a line."""
    line: dict[str, Any] = {"linestyle": "-", "linewidth": LINE_WIDTH}
    if ink.kind == "run":
        number = int(ink.place)
        dashes = _RUN_DASHES[number % len(_RUN_DASHES)]
        return line | {"color": RUNS[number % len(RUNS)], "linestyle": dashes}
    if ink.kind == "ordered":
        return line | {"color": shades(INSTANTS, 1, LIGHT.late * ink.place)[0]}
    if ink.kind == "temperature":
        return line | {"color": TEMPERATURES(ink.place)}
    if ink.kind == "pale":
        return line | {"color": FAINT, "alpha": 0.6}
    return line | {"color": {"fit": BODY, "faint": FAINT, "text": INK, "beyond": RED}[ink.kind]}


def styles_of(names: Sequence[str]) -> list[dict[str, Any]]:
    """Looks of the lines of runs by their names."""
    return [look_of(ink) for ink in inks_of(names)]


def dress_colour_bar(bar: Colorbar, label: str) -> None:
    """Apply thin lines and the common text sizes to a colour bar."""
    bar.set_label(label, size=LABEL_SIZE, color=INK)
    bar.ax.tick_params(labelsize=TICK_SIZE, width=THIN_LINE, length=2.5)
    bar.outline.set(linewidth=THIN_LINE, edgecolor=INK)
