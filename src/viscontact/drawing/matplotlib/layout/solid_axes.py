"""Three-dimensional axes: panels, box, colour bar and texts."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, MaxNLocator
from matplotlib.transforms import Bbox
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.axes3d import Axes3D
from mpl_toolkits.mplot3d.axis3d import Axis

from viscontact.drawing.content.window import Window
from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.page import NARROW
from viscontact.units.formatting import ReadableUnit

#: View direction: above the nearer corner of the long side [degrees].
_ELEVATION, _AZIMUTH = 28.0, -58.0
#: Height of the box against its longer side.
_TALL = 0.5
#: Height of a panel against its width.
_DOWN = 0.78
#: Ticks of x per inch; a box whose short side has room for fewer than this is slender.
_TICKS, _NARROW_BOX = 1.6, 2.5
#: Part of the longer side at a slender box's corner without tick labels.
_CORNER = 0.07
#: Filled part of a panel's place.
_FILLED = 0.94
#: Space at the right for a colour bar, above each panel for a heading and below for notes [inch].
_BAR, _HEAD, _FOOT = 0.85, 0.2, 0.32


# Width of a letter of a note [inch].
_LETTER = 0.062


def solid_panels(
    count: int, window: Window, heights: tuple[float, float], labels: Sequence[str], width: float
) -> tuple[Figure, list[Axes3D]]:
    """Figure with three-dimensional panels and room for a colour bar; width [inch]."""
    # `heights` are the limits of the third axis, as drawn. Two panels are side by side where the
    # page is wide enough.
    columns = 1 if width <= NARROW else min(count, 2)
    rows = -(-count // columns)
    across = (width - _BAR) / columns
    down = across * _DOWN + _HEAD
    height = rows * down + _FOOT
    figure = Figure(figsize=(width, height))
    panels = []
    for number in range(count):
        row, column = divmod(number, columns)
        box = (
            *(column * across / width, 1 - (row + 1) * down / height),
            *(across / width, (down - _HEAD) / height),
        )
        axes = Axes3D(figure, box, auto_add_to_figure=False, computed_zorder=False)
        figure.add_axes(axes)
        _add_labels(axes, window, heights, labels, across)
        _fill(axes, Bbox.from_bounds(*box))
        panels.append(axes)
    return figure, panels


def _add_labels(
    axes: Axes3D,
    window: Window,
    heights: tuple[float, float],
    labels: Sequence[str],
    across: float,
) -> None:
    x, y = window.unit(window.x), window.unit(window.y)
    axes.patch.set_visible(False)  # panels overlap outside their boxes
    axes.set(xlim=x, ylim=y, zlim=heights, xlabel=labels[0], ylabel=labels[1])
    longer = max(1.0, window.height_to_width)
    axes.set_box_aspect((1 / longer, window.height_to_width / longer, _TALL))
    axes.view_init(_ELEVATION, _AZIMUTH)
    axes.set_proj_type("persp", focal_length=1.6)
    room = _TICKS * across * window.height_to_width
    counts = (max(3, round(_TICKS * across)), max(2, round(room)), 4)
    for axis, ticks in zip((axes.xaxis, axes.yaxis, axes.zaxis), counts, strict=True):
        axis.set_major_locator(MaxNLocator(min(ticks, 6), steps=[1, 2, 2.5, 5, 10]))
        axis.pane.set(facecolor="white", edgecolor="#d9d9d9")
        axis.label.set(size=style.LABEL_SIZE, color=style.INK)
        axis.set_tick_params(labelsize=style.TICK_SIZE, colors=style.INK, pad=-1)
        axis.labelpad = -1 if axis is axes.xaxis else 1
    if room < _NARROW_BOX:
        _thin_out(axes)


def _thin_out(axes: Axes3D) -> None:
    """Separate the tick labels at the short side of a slender box."""
    # The outermost of y; of x none at the corner where y begins.
    at_y, at_x = _ticks(axes.yaxis), _ticks(axes.xaxis)
    start, end = axes.get_xlim()
    axes.yaxis.set_major_locator(FixedLocator([at_y[0], at_y[-1]] if len(at_y) > 1 else at_y))
    axes.xaxis.set_major_locator(
        FixedLocator([at for at in at_x if at < end - _CORNER * (end - start)])
    )
    # The label of y is moved along x, which is much longer here.
    axes.yaxis.labelpad = -3.5


def _ticks(axis: Axis) -> list[float]:
    low, high = axis.get_view_interval()
    return [float(at) for at in axis.get_majorticklocs() if low <= at <= high]


def _fill(axes: Axes3D, place: Bbox) -> None:
    """Enlarge a panel to its place on the figure, texts included."""
    place = place.expanded(_FILLED, _FILLED)
    for _ in range(3):  # texts keep their size when the box grows
        taken = _covered_area(axes)
        larger = min(place.width / taken.width, place.height / taken.height)
        box = axes.get_position(original=True)
        x, y = (
            middle - larger * (was - start)
            for middle, was, start in (
                (place.x0 + place.width / 2, (taken.x0 + taken.x1) / 2, box.x0),
                (place.y0 + place.height / 2, (taken.y0 + taken.y1) / 2, box.y0),
            )
        )
        axes.set_position((x, y, larger * box.width, larger * box.height))


def _covered_area(axes: Axes3D) -> Bbox:
    """Area of the figure covered by the box and its texts."""
    figure = axes.figure
    figure.draw_without_rendering()  # gives the texts their size
    limits = (axes.get_xlim(), axes.get_ylim(), axes.get_zlim())
    corners = np.array(list(itertools.product(*limits))).T
    projected = proj3d.proj_transform(*corners, axes.get_proj())
    box = Bbox.null()
    box.update_from_data_xy(axes.transData.transform(np.transpose(projected[:2])))
    texts = [axis.get_tightbbox() for axis in (axes.xaxis, axes.yaxis, axes.zaxis)]
    return Bbox.union([box, *texts]).transformed(figure.transFigure.inverted())


def stretch_of_heights(axes: Axes3D, window: Window, unit: ReadableUnit) -> float:
    """Ratio of the scale of heights to that of lengths along x [-]."""
    low, high = axes.get_zlim()
    along, _, tall = axes.get_box_aspect()
    return float(tall / (abs(high - low) * unit.factor) * (window.x[1] - window.x[0]) / along)


def add_side_bar(
    figure: Figure, shown: ScalarMappable, label: str, *, downwards: bool = False
) -> None:
    """Add a colour bar at the right; downwards for depths."""
    width = figure.get_figwidth()
    height = min(0.6, 2.4 / figure.get_figheight())
    place = ((width - 0.72) / width, 0.5 - height / 2, 0.12 / width, height)
    bar = figure.colorbar(shown, cax=figure.add_axes(place, label="<colorbar>"))
    style.dress_colour_bar(bar, label)
    if downwards:
        bar.ax.invert_yaxis()


def add_title(axes: Axes3D, text: str) -> None:
    """Add a title above the left corner of a three-dimensional panel."""
    box = _covered_area(axes)
    _write(axes.figure, (box.x0, box.y1), text, style.INK)


def add_note(figure: Figure, *texts: str) -> None:
    """Add a note below all panels."""
    texts = tuple(filter(None, texts))
    fits = sum(map(len, texts)) * _LETTER < figure.get_figwidth()
    apart = "; " if fits else "\n"
    _write(figure, (0.02, 0.05 / figure.get_figheight()), apart.join(texts), style.FAINT)


def _write(figure: Figure, place: tuple[float, float], text: str, colour: str) -> None:
    figure.text(*place, style.literal(text), fontsize=style.TICK_SIZE, color=colour, va="bottom")
