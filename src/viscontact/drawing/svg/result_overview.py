"""Overview of a result: a headline, a table, and three small drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Integers
from viscontact.drawing.content.history import is_idle
from viscontact.drawing.content.look import ORANGE
from viscontact.drawing.content.map import Map, Maps, maps_at
from viscontact.drawing.content.result_card import area_panel, end_panel
from viscontact.drawing.content.scale import ColourScale
from viscontact.drawing.svg.overview import Overview
from viscontact.drawing.svg.panel_drawing import panel_drawing
from viscontact.drawing.svg.svg_panel import ColouredCells, SvgCurve, map_panel
from viscontact.results.formatting import format_scalar
from viscontact.results.run_axis import (
    has_contacts_over_creepage,
    in_order,
    listed_creepages,
    run_axis,
)
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.snapshots import labels_of
from viscontact.results.summary import headline
from viscontact.results.variables import REQUIRED, Place, shown_in
from viscontact.units.formatting import format_compact

#: Most cells along an axis; of more, means are drawn. Most points of an outline.
_MOST, _POINTS = 60, 160
#: Length of the arrow along a motion over the width.
_ARROW = 0.15


def result_overview(ds: xr.Dataset) -> Overview:
    """Make the overview of a result."""
    if has_contacts_over_creepage(ds):
        creepages = listed_creepages(ds)
        lead = f"Each creepage ({creepages}) has a contact of its own: at_creepage(...) shows one."
        return Overview(_title(ds), [], lead=lead)
    axis = run_axis(ds)
    needed = [axis.name, *(name for name in shown_in(Place.CARD) if name in REQUIRED)]
    missing = [name for name in needed if name not in ds.variables]
    if missing:
        lead = f"It has no {missing[0]}; simulate and open_results make results."
        return Overview("No result of viscontact", [], lead=lead)
    if not ds.sizes[axis.name]:
        return Overview(_title(ds), [], lead=f"It holds no {axis.row}.")
    ds, last = in_order(ds), ds.sizes[axis.name] - 1
    # The largest contact as well where it is at neither end.
    shown = sorted({0, int(ds["contact_area"].values.argmax()), last})
    heads = tuple(axis.place(axis.values(ds)[k]) for k in shown)
    rows = [
        (label.lower(), *(format_scalar(ds, name, k) for k in shown))
        for name, label in shown_labels(ds, Place.CARD).items()
        if not is_idle(ds, name)
    ]
    return Overview(_title(ds), [*rows, *_warnings(ds)], _drawings(ds), heads, headline(ds))


def _title(ds: xr.Dataset) -> str:
    return str(ds.attrs.get("title") or "Result of viscontact")


def _warnings(ds: xr.Dataset) -> list[tuple[str, str]]:
    lines = [line for line in str(ds.attrs.get("warnings", "")).splitlines() if line.strip()]
    return [("warnings", f"{len(lines)}, in ds.attrs['warnings']")] if lines else []


def _drawings(ds: xr.Dataset) -> list[Element]:
    return [*map(panel_drawing, filter(None, (end_panel(ds), area_panel(ds)))), *_map(ds)]


def _map(ds: xr.Dataset) -> list[Element]:
    """Map of the pressure at the last instant, or the first speed, stored in contact."""
    try:
        return [map_drawing(maps_at(ds, None, "map"))]
    except ValueError:  # no fields, or no contact in them
        return []


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
