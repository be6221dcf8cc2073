"""Overview of a result: a headline, a table, and three small drawings."""

from __future__ import annotations

from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.along_run import along_run
from viscontact.drawing.content.history import is_idle
from viscontact.drawing.content.look import ORANGE
from viscontact.drawing.content.map import maps_at
from viscontact.drawing.svg.overview import Overview
from viscontact.drawing.svg.pressure_map import map_drawing
from viscontact.drawing.svg.svg_axes import Scale, linear, logarithmic
from viscontact.drawing.svg.svg_panel import Mark, panel
from viscontact.results.formatting import format_scalar
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.stated_errors import errors_of
from viscontact.results.summary import headline
from viscontact.results.variables import REQUIRED, Place, shown_in
from viscontact.units.formatting import format_quantity

#: Up to this ratio of its extents along y and x a contact counts as round.
ROUND = 1.05


def result_overview(ds: xr.Dataset) -> Overview:
    """Make the overview of a result."""
    needed = ["time", *(name for name in shown_in(Place.CARD) if name in REQUIRED)]
    missing = [name for name in needed if name not in ds.variables]
    if missing:
        lead = f"It has no {missing[0]}; simulate and open_results make results."
        return Overview("No result of viscontact", [], lead=lead)
    if not ds.sizes["time"]:
        return Overview(_title(ds), [], lead="It holds no instant.")
    last = ds.sizes["time"] - 1
    # The largest contact as well where it is at neither end.
    shown = sorted({0, int(ds["contact_area"].values.argmax()), last})
    heads = tuple(f"t = {format_quantity(float(ds['time'][k]), 's')}" for k in shown)
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
    if ds.sizes["time"] > 1 and np.isfinite(area).all() and area.max() > 0:
        drawn.append(_history(ds, area))
    return [*drawn, *_map(ds)]


def _map(ds: xr.Dataset) -> list[Element]:
    """Map of the pressure at the last instant stored in contact."""
    try:
        return [map_drawing(maps_at(ds, None, "map"))]
    except ValueError:  # no fields, or no contact in them
        return []


def _history(ds: xr.Dataset, area: Floats) -> Element:
    instants, errors = ds["time"].values, errors_of(ds, "contact_area")
    y = linear("area", "m2", 0.0, 1.1 * float(area.max()), 3)
    marks = [Mark(instants, area)]
    if np.isfinite(errors).all():
        marks += [Mark(instants, area + s * errors, dashed=True) for s in (-1.0, 1.0)]
    return panel("contact area", _time(ds), y, marks)


def _time(ds: xr.Dataset) -> Scale:
    axis = along_run([ds])
    start, end = axis.limits or (0.0, 1.0)
    if axis.scale == "time":
        return logarithmic("time", "s", axis.first, end, each_with_unit=True)
    return linear("time", "s", start, end)


def _section(ds: xr.Dataset) -> list[Element]:
    """Pressure along the longer extent of the contact, at the first and last stored instant."""
    if "pressure" not in ds:
        return []
    over = str(ds["pressure"].dims[0])
    ends = [ds["pressure"].isel({over: k}).transpose("x", "y").values for k in (0, -1)]
    touched = [k for k in (0, 1) if ends[k].max(initial=0.0) > 0]
    if not touched:
        return []
    at_last = ends[touched[-1]] > 0
    extents = [np.ptp(ds[axis].values[at_last.any(axis=1 - k)]) for k, axis in enumerate("xy")]
    axis = int(extents[1] > ROUND * extents[0])
    position = ds["xy"[axis]].values
    lines = [ends[k].take(ends[k].sum(axis=axis).argmax(), axis=1 - axis) for k in touched]
    half = 1.15 * max(float(np.abs(position[line > 0]).max(initial=0.0)) for line in lines)
    half = min(max(half, float(position[-1]) / 50), float(position[-1]))
    x = linear("xy"[axis], "m", -half, half)
    y = linear("pressure", "Pa", 0.0, 1.1 * max(float(line.max()) for line in lines), 3)
    marks = [Mark(position, lines[-1])]
    aside = ""
    if len(lines) > 1 and ds.sizes[over] > 1:
        marks.insert(0, Mark(position, lines[0], colour=ORANGE, dashed=True))
        aside = f"dashed: t = {format_quantity(float(ds[over][0]), 's')}"
    return [panel(f"along {'xy'[axis]}", x, y, marks, aside=aside)]
