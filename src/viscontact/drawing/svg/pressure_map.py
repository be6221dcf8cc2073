"""Small map of the pressure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from viscontact.backend.arrays import Integers
from viscontact.drawing.content.look import ORANGE
from viscontact.drawing.content.map import Map, Maps
from viscontact.drawing.content.scale import ColourScale
from viscontact.drawing.svg.svg_panel import ColouredCells, SvgCurve, map_panel
from viscontact.results.snapshots import labels_of
from viscontact.units.formatting import format_compact

#: Most cells along an axis; of more, means are drawn. Most points of an outline.
_MOST, _POINTS = 60, 160
#: Length of the arrow along a motion over the width.
_ARROW = 0.15


def map_drawing(maps: Maps) -> Element:
    """Draw the last map: the pressure in bands between its levels, and the outline."""
    scale, (x, y) = maps.scale(), maps.centres(_MOST)
    cells = ColouredCells(x, y, _bands(maps, scale), scale.colours(len(scale.levels) - 1))
    low, high = (format_compact(float(each)) for each in scale.unit(scale.levels[[0, -1]]))
    instant = labels_of(maps.snapshots)[-1]
    return map_panel(
        scale.unit.label(scale.quantity.lower()),
        (maps.window.x, maps.window.y),
        cells,
        marks=_marks(maps, maps.maps[-1]),
        aside=f"{low} to {high}, {instant}",
        stretch=maps.window.stretch,
        note=maps.window.note,
    )


def _bands(maps: Maps, scale: ColourScale) -> Integers:
    """Numbers of the bands between levels that cells lie in, -1 without contact."""
    cells = maps.cells(len(maps.maps) - 1, _MOST)
    bands = np.searchsorted(scale.levels, cells, side="right") - 1
    return np.where(np.isfinite(cells), np.clip(bands, 0, len(scale.levels) - 2), -1)


def _marks(maps: Maps, shown: Map) -> Iterator[SvgCurve]:
    """Yield the outline, where it does not cover the pressure, and the moving body."""
    stretch = maps.window.stretch
    for curve in [] if maps.many_spots else shown.outline:
        x, y = curve[:: math.ceil(len(curve) / _POINTS)].T
        yield SvgCurve(x, y, "rim")
    if shown.body is not None:
        (x, y), arrow = shown.body.axis, shown.body.arrow(stretch, _ARROW * np.ptp(maps.window.x))
        yield SvgCurve([x], [y], "dots", ORANGE)
        if arrow is not None:
            yield SvgCurve([x, x + arrow[0]], [y, y + arrow[1] / stretch], colour=ORANGE)
