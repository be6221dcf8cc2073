"""Pressure maps, outlines and sections as plain data for a page's figures."""

from __future__ import annotations

import base64
import math
from typing import Any, Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.figures.shown_fields import ShownFields
from viscontact.plot.layout.style import time_colours
from viscontact.plot.pressure.rim_polygons import rim_curves
from viscontact.results.recorded_motion import contact_edges
from viscontact.results.shown_scalars import is_long
from viscontact.results.snapshots import Snapshot, labels_of
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit

Floats = NDArray[np.float64]

#: More cells than these along an axis are joined.
MOST_CELLS = 256
#: Steps of a pressure on the page, two bytes each: far finer than its colours.
STEPS = 65535
#: Number of outlines that remain distinguishable in one figure.
_OUTLINES = 5


def map_data(fields: ShownFields) -> dict[str, Any]:
    """Return the pressure over the surface at every instant shown."""
    length, pressure = fields.window.unit, readable_unit("Pa", fields.peak)
    first, (in_x, in_y) = fields.snapshots[0], fields.inside
    strides = strides_of(fields)
    x, y = (
        _joined(positions[part], stride)
        for positions, part, stride in zip((first.x, first.y), (in_x, in_y), strides, strict=True)
    )
    return {
        "x": rounded(length(x)),
        "y": rounded(length(y)),
        "xRange": rounded(length(fields.window.x)),
        "yRange": rounded(length(fields.window.y)),
        "unit": length.symbol,
        "stretch": fields.window.stretch,
        "periodic": any(first.periodic),
        "pressureUnit": pressure.symbol,
        "peak": float(pressure(fields.peak)),
        "steps": STEPS,
        "parts": [_parts(each, fields, strides) for each in fields.snapshots],
        "rims": [_rim(each, length) for each in fields.snapshots],
        "labels": list(labels_of(fields.snapshots)),
        "peaks": _peaks(fields, pressure),
        "mesh": list(fields.marked),
        "colours": time_colours(len(fields.snapshots)),
        "outlines": _outlined(fields),
        "start": fields.start,
        "body": _body(fields, length),
    }


def curves_data(ds: xr.Dataset, fields: ShownFields) -> list[dict[str, Any]]:
    """Return the sections through the pressure, and the line load of a long contact."""
    sections = [section_data(fields, "x"), section_data(fields, "y")]
    return [*sections, line_load_data(fields)] if is_long(ds) else sections


def section_data(fields: ShownFields, along: Literal["x", "y"]) -> dict[str, Any]:
    """Return the pressure on a line at every instant shown, at full resolution."""
    length, pressure = fields.window.unit, readable_unit("Pa", fields.peak)
    inside = fields.inside["xy".index(along)]
    lines = _lines(fields, along)
    positions = lines[0][0]
    return {
        "name": f"section-{along}",
        "position": rounded(length(positions[inside])),
        "values": [rounded(pressure(each[inside])) for _, each in lines],
        "edges": _edges(fields, along, lines),
        "along": along,
        "unit": length.symbol,
        "label": "Pressure",
        **_unit_of_values("Pa", pressure),
    }


def line_load_data(fields: ShownFields) -> dict[str, Any]:
    """Return the line load along x at every instant shown."""
    length, inside = fields.window.unit, fields.inside[0]
    x, _ = fields.snapshots[0].line_load()
    loads = [each.line_load()[1] for each in fields.snapshots]
    unit = readable_unit("N/m", *loads)
    return {
        "name": "line-load",
        "position": rounded(length(x[inside])),
        "values": [rounded(unit(each[inside])) for each in loads],
        "along": "x",
        "unit": length.symbol,
        "label": "Line load",
        **_unit_of_values("N/m", unit),
    }


def _unit_of_values(si: str, unit: ReadableUnit) -> dict[str, Any]:
    return {"valueUnit": unit.symbol, "valueFactor": unit.factor, "si": si}


def strides_of(fields: ShownFields) -> tuple[int, int]:
    """Numbers of cells along x and y that are averaged to one of the map."""
    along_x, along_y = (-(-(part.stop - part.start) // MOST_CELLS) for part in fields.inside)
    return along_x, along_y


def rounded(values: Any, digits: int = 6) -> list[float]:
    """Numbers rounded to significant digits, which keeps a page small."""
    return [float(f"{value:.{digits - 1}e}") for value in np.asarray(values).tolist()]


def finite_or_none(values: Floats, digits: int = 6) -> list[float | None]:
    """Numbers rounded to significant digits for JSON, None in place of NaN and inf."""
    return [float(f"{v:.{digits - 1}e}") if math.isfinite(v) else None for v in values.tolist()]


def _crossings(fields: ShownFields, along: Literal["x", "y"]) -> list[float]:
    """Position of a section at each instant [m]."""
    return [through[1 if along == "x" else 0] for through in fields.through]


def _lines(fields: ShownFields, along: Literal["x", "y"]) -> list[tuple[Floats, Floats]]:
    """Positions [m] and pressure [Pa] on a section at each instant."""
    pairs = zip(fields.snapshots, _crossings(fields, along), strict=True)
    return [each.section(along, at) for each, at in pairs]


def _edges(
    fields: ShownFields, along: Literal["x", "y"], lines: list[tuple[Floats, Floats]]
) -> list[list[float] | None]:
    """Leading and trailing edge of a moving contact at each instant, None where there are none."""
    ways = [place.way(along) for place in fields.body] or [0.0] * len(lines)
    found = [contact_edges(*line, way) for line, way in zip(lines, ways, strict=True)]
    return [None if edges is None else rounded(fields.window.unit(edges)) for edges in found]


def _body(fields: ShownFields, length: ReadableUnit) -> list[dict[str, Any]]:
    """Axis and direction of a moving body at each instant; empty for a standing contact."""
    return [
        {"axis": rounded(length(place.axis)), "direction": place.direction} for place in fields.body
    ]


def _parts(snapshot: Snapshot, fields: ShownFields, strides: tuple[int, int]) -> str:
    joined = snapshot.pressure[fields.inside]
    for axis, stride in enumerate(strides):
        joined = _joined(joined, stride, axis)
    parts = np.ceil(joined / fields.peak * STEPS - 0.5)
    # A cell in contact is not to vanish from the map.
    parts = np.where(joined > 0, np.maximum(parts, 1), 0)
    return base64.b64encode(parts.T.astype("<u2").tobytes()).decode("ascii")


def _peaks(fields: ShownFields, unit: ReadableUnit) -> list[str]:
    """Largest pressures, with ``>`` in front if they depend on the mesh; empty without contact."""
    pairs = zip(fields.snapshots, fields.marked, strict=True)
    return [
        f"{'>' * marked}{format_compact(float(unit(each.pressure.max())), 4)} {unit.symbol}"
        if each.touching
        else ""
        for each, marked in pairs
    ]


def _joined(values: Floats, stride: int, axis: int = 0) -> Floats:
    """Means over a number of neighbours; the last may have fewer."""
    starts = np.arange(0, values.shape[axis], stride)
    counts = np.diff([*starts, values.shape[axis]])
    sums = np.add.reduceat(values, starts, axis=axis)
    return np.asarray(sums / np.expand_dims(counts, 1 - axis) if values.ndim > 1 else sums / counts)


def _rim(snapshot: Snapshot, length: ReadableUnit) -> dict[str, list[float | None]]:
    """All curves as one line, interrupted between them."""
    x: list[float | None] = []
    y: list[float | None] = []
    for curve in rim_curves(snapshot) if snapshot.touching else ():
        x += [*rounded(length(curve[:, 0]), 5), None]
        y += [*rounded(length(curve[:, 1]), 5), None]
    return {"x": x, "y": y}


def _outlined(fields: ShownFields) -> list[int]:
    """Instants whose outline is drawn: some in contact, from the first to the last."""
    touching = [index for index, each in enumerate(fields.snapshots) if each.touching]
    chosen = np.linspace(0, len(touching) - 1, min(_OUTLINES, len(touching))).round().astype(int)
    return [touching[index] for index in chosen]
