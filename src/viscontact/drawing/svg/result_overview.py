"""Overview of a result: a headline, a table, and three small drawings."""

from __future__ import annotations

from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.drawing.content.history import history_panel, is_idle
from viscontact.drawing.content.look import ORANGE
from viscontact.drawing.content.map import maps_at
from viscontact.drawing.content.panel import Axis
from viscontact.drawing.svg.overview import Overview
from viscontact.drawing.svg.pressure_map import map_drawing
from viscontact.drawing.svg.svg_axes import AxisScale, linear, logarithmic
from viscontact.drawing.svg.svg_panel import SvgCurve, panel
from viscontact.results.formatting import format_scalar
from viscontact.results.run_axis import RunAxis, in_order, run_axis
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.stored_contact import cells_in_contact
from viscontact.results.summary import headline
from viscontact.results.variables import REQUIRED, Place, shown_in

#: Up to this ratio of its extents along y and x a contact counts as round.
ROUND = 1.05


def result_overview(ds: xr.Dataset) -> Overview:
    """Make the overview of a result."""
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
    drawn = _section(ds)
    area = ds["contact_area"].values
    if area.size > 1 and np.isfinite(area).all() and area.max() > 0:
        drawn.append(_course(ds))
    return [*drawn, *_map(ds)]


def _map(ds: xr.Dataset) -> list[Element]:
    """Map of the pressure at the last instant, or the first speed, stored in contact."""
    try:
        return [map_drawing(maps_at(ds, None, "map"))]
    except ValueError:  # no fields, or no contact in them
        return []


def _course(ds: xr.Dataset) -> Element:
    """Contact area over time or speed."""
    drawn = history_panel({"": ds}, "contact_area")
    (curve,) = drawn.curves
    marks = [SvgCurve(curve.x, curve.y)]
    if curve.error is not None and np.isfinite(curve.error).all():
        marks += [SvgCurve(curve.x, curve.y + s * curve.error, dashed=True) for s in (-1.0, 1.0)]
    y = linear("area", "m2", *(drawn.y.limits or (0.0, 1.0)), 3)
    return panel("contact area", _along(drawn.x, run_axis(ds)), y, marks)


def _along(axis: Axis, over: RunAxis) -> AxisScale:
    start, end = axis.limits or (0.0, 1.0)
    if axis.scale == "linear":
        return linear(over.name, over.unit, start, end)
    return logarithmic(over.name, over.unit, axis.first, end, each_with_unit=over.is_history)


def _section(ds: xr.Dataset) -> list[Element]:
    """Pressure along the longer extent of the contact, at the first and last stored row."""
    if "pressure" not in ds:
        return []
    over = str(ds["pressure"].dims[0])
    ends = [ds["pressure"].isel({over: k}).transpose("x", "y").values for k in (0, -1)]
    masks = [cells_in_contact(ds, k).transpose("x", "y").values for k in (0, -1)]
    touched = [k for k in (0, 1) if masks[k].any()]
    if not touched:
        return []
    at_last = masks[touched[-1]]
    extents = [np.ptp(ds[axis].values[at_last.any(axis=1 - k)]) for k, axis in enumerate("xy")]
    axis = int(extents[1] > ROUND * extents[0])
    position = ds["xy"[axis]].values
    places = [ends[k].sum(axis=axis).argmax() for k in touched]
    lines, inside = (
        [fields[k].take(place, axis=1 - axis) for k, place in zip(touched, places, strict=True)]
        for fields in (ends, masks)
    )
    half = 1.15 * max(float(np.abs(position[mask]).max(initial=0.0)) for mask in inside)
    half = min(max(half, float(position[-1]) / 50), float(position[-1]))
    x = linear("xy"[axis], "m", -half, half)
    y = linear("pressure", "Pa", 0.0, 1.1 * max(float(line.max()) for line in lines), 3)
    marks = [SvgCurve(position, lines[-1])]
    aside = ""
    if len(lines) > 1 and ds.sizes[over] > 1:
        marks.insert(0, SvgCurve(position, lines[0], colour=ORANGE, dashed=True))
        aside = f"dashed: {run_axis(ds).place(ds[over].values[0])}"
    return [panel(f"along {'xy'[axis]}", x, y, marks, aside=aside)]
