"""Pressure over the surface, with a frame for each instant, and the outlines of the contact."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import plotly.graph_objects as go

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.rim import rim_curves
from viscontact.figures.look import LIGHT, Look, Part, drawn, numbers
from viscontact.figures.shown_fields import BodyPlace, ShownFields
from viscontact.results.run_axis import TIME
from viscontact.results.snapshots import Snapshot, headings_of, labels_of
from viscontact.units.formatting import ReadableUnit, format_compact
from viscontact.units.systems import AUTOMATIC

#: More cells than these along an axis are joined.
MOST_CELLS = 256
#: Numbers of outlines that remain distinguishable in one figure, of a few spots and of many.
_OUTLINES, _OUTLINES_OF_MANY = 5, 2
#: Length of the arrow along a motion [pixel].
_ARROW = 34
_COLOURS = (
    *((0.0, "#f1f8c9"), (0.2, "#c7e9b4"), (0.4, "#7fcdbb"), (0.6, "#41b6c4"), (0.8, "#1d91c0")),
    *((0.9, "#225ea8"), (1.0, "#0c2c84")),
)


def pressure_map(
    fields: ShownFields, look: Look = LIGHT, reference: ShownFields | None = None
) -> go.Figure:
    """Draw the pressure over the surface, with a frame for each instant or speed.

    Parameters
    ----------
    fields : ShownFields
        Fields of a result.
    look : Look, optional
        Colours and units.
    reference : ShownFields, optional
        Fields of another result, whose outline at the nearest instant is dashed; it lies within
        the map.

    Returns
    -------
    plotly.graph_objects.Figure
        The map at the instant shown first. Frames are named by their numbers: ``"0"``, ``"1"``.
        The title of an instant and its largest pressure are in ``layout.meta``.
    """
    fields = fields.beside(reference)
    length = look.unit("m", fields.window.x, fields.window.y)
    pressure = look.unit("Pa", fields.peak)
    frames: list[Part] = [
        {"name": str(index), "traces": list(range(len(traces))), "data": traces, "layout": layout}
        for index, (traces, layout) in enumerate(_frames(fields, look, length, pressure, reference))
    ]
    first, strides = fields.snapshots[0], strides_of(fields)
    x, y = (
        _joined(positions[part], stride)
        for positions, part, stride in zip((first.x, first.y), fields.inside, strides, strict=True)
    )
    at = f"x %{{x:.4g}} {length.symbol}, y %{{y:.4g}} {length.symbol}"
    heat = {
        "type": "heatmap",
        "x": numbers(length(x)),
        "y": numbers(length(y)),
        "zmin": 0.0,
        "zmax": float(pressure(fields.peak)),
        "colorscale": _COLOURS,
        "hoverongaps": False,
        "zsmooth": False,
        "hovertemplate": f"{at}<br>%{{z:.4g}} {pressure.symbol}<extra></extra>",
        "colorbar": _colour_bar(pressure, look),
    }
    styles: list[Part] = [heat, _rim_style(look)]
    if reference is not None:
        styles.append(
            _rim_style(look) | {"line": {"color": look.warm, "width": 1.6, "dash": "dash"}}
        )
    if fields.body:
        styles.append(_body_style(look, length))
    shown = frames[fields.start]
    layout = _plane(fields, length) | {"margin": {"l": 56, "r": 24, "t": 60, "b": 64}}
    # Space for the tick labels, which Plotly omits beside a horizontal colour bar.
    layout["xaxis"]["title"]["standoff"] = 36
    traces = [style | part for style, part in zip(styles, shown["data"], strict=True)]
    return drawn(traces, look, **(layout | shown["layout"]), frames=frames)


def outlines(fields: ShownFields, look: Look = LIGHT) -> go.Figure:
    """Draw the outline of the contact at several instants or speeds."""
    length = look.unit("m", fields.window.x, fields.window.y)
    labels, colours = labels_of(fields.snapshots), look.instants(len(fields.snapshots))
    lines = [
        {
            **rim_of(fields.snapshots[index], length),
            "mode": "lines",
            "name": labels[index],
            "line": {"color": colours[index], "width": 1.0 if fields.many_spots else 1.6},
            "hovertemplate": f"x %{{x:.4g}} {length.symbol}, y %{{y:.4g}} {length.symbol}"
            f"<extra>{labels[index]}</extra>",
        }
        for index in _outlined(fields)
    ]
    meta = {"name": "outlines"} | _shape(fields, around=120, most=440)
    return drawn(
        lines,
        look,
        meta,
        **_plane(fields, length),
        showlegend=True,
        margin={"l": 56, "r": 24, "t": 44, "b": 46},
        legend={"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "font": {"size": 12}},
    )


def strides_of(fields: ShownFields) -> tuple[int, int]:
    """Numbers of cells along x and y that are averaged to one of the map."""
    along_x, along_y = (-(-(part.stop - part.start) // MOST_CELLS) for part in fields.inside)
    return along_x, along_y


def map_remarks(fields: ShownFields) -> str:
    """Remarks on the map: scale, averaged cells, instants left out."""
    line = "" if fields.many_spots else "The line is the outline of the contact; "
    said = [f"{line}{'w' if line else 'W'}ithout colour: no contact."]
    if fields.body:
        said.append("The cross is the body's axis, the arrow the direction of its motion.")
    if fields.window.note:
        said.append(f"In this drawing {fields.window.note.replace(' stretched', ' is stretched')}.")
    along_x, along_y = strides_of(fields)
    if max(along_x, along_y) > 1:
        said.append(
            f"To keep the page small the map shows means over {along_x} × {along_y} cells (at most "
            f"{MOST_CELLS} a side); sections are at full resolution."
        )
    if len(fields.snapshots) < fields.stored:
        rows = fields.snapshots[0].axis.row
        said.append(f"{len(fields.snapshots)} of {fields.stored} stored {rows}s are shown.")
    return " ".join(said)


def nearest_to(fields: ShownFields, place: float) -> int:
    """Index of the nearest instant [s] or speed [m/s]."""
    return int(np.abs([each.time - place for each in fields.snapshots]).argmin())


def rim_of(snapshot: Snapshot, length: ReadableUnit) -> Part:
    """All curves of an outline as one line, interrupted between them."""
    x: list[float] = []
    y: list[float] = []
    for curve in rim_curves(snapshot) if snapshot.touching else ():
        x += [*length(curve[:, 0]).tolist(), math.nan]
        y += [*length(curve[:, 1]).tolist(), math.nan]
    return {"x": numbers(x), "y": numbers(y)}


def _frames(
    fields: ShownFields,
    look: Look,
    length: ReadableUnit,
    pressure: ReadableUnit,
    reference: ShownFields | None,
) -> Iterator[tuple[list[Part], Part]]:
    """Yield what differs between the instants: parts of the traces, and of the layout."""
    shape, headings = _shape(fields, around=130, most=600), _headings(fields, look)
    for index, each in enumerate(fields.snapshots):
        z = numbers(pressure(_cells(each, fields)))
        traces: list[Part] = [{"type": "heatmap", "z": z}, _rim_on_map(fields, each, length)]
        if reference is not None:
            then = reference.snapshots[nearest_to(reference, each.time)]
            traces.append(_rim_on_map(reference, then, length))
        note = _note(each, pressure, is_marked=fields.marked[index])
        meta = {"name": "map", "title": headings[index], "note": note} | shape
        layout: Part = {"meta": meta}
        if fields.body:
            body = fields.body[index]
            x, y = length(body.axis).tolist()
            traces.append({"x": [x], "y": [y]})
            layout["annotations"] = _arrow(body, (x, y), fields.window.stretch, look)
        yield traces, layout


def _rim_on_map(fields: ShownFields, snapshot: Snapshot, length: ReadableUnit) -> Part:
    """Outline of the contact, empty for one of many spots, whose pressure it would cover."""
    return {"x": [], "y": []} if fields.many_spots else rim_of(snapshot, length)


def _headings(fields: ShownFields, look: Look) -> list[str]:
    """Instants, which share a unit where none is chosen, or speeds."""
    axis = fields.snapshots[0].axis
    if axis is TIME and look.system == AUTOMATIC:
        return headings_of(fields.snapshots)
    return [f"{axis.symbol}{look.quantity(each.time, axis.unit)}" for each in fields.snapshots]


def _note(snapshot: Snapshot, unit: ReadableUnit, *, is_marked: bool) -> str:
    """Largest pressure, with ``>`` in front if it depends on the mesh."""
    if not snapshot.touching:
        return "No contact"
    peak = format_compact(float(unit(snapshot.pressure.max())), 4)
    return f"Largest pressure {'>' * is_marked}{peak} {unit.symbol}"


def _cells(snapshot: Snapshot, fields: ShownFields) -> Floats:
    """Pressure in the cells of the map [Pa], a row for each y; NaN without contact."""
    joined = snapshot.pressure[fields.inside]
    for axis, stride in enumerate(strides_of(fields)):
        joined = _joined(joined, stride, axis)
    return np.where(joined > 0, joined, np.nan).T


def _joined(values: Floats, stride: int, axis: int = 0) -> Floats:
    """Means over a number of neighbours; the last may have fewer."""
    starts = np.arange(0, values.shape[axis], stride)
    counts = np.diff([*starts, values.shape[axis]])
    sums = np.add.reduceat(values, starts, axis=axis)
    return np.asarray(sums / np.expand_dims(counts, 1 - axis) if values.ndim > 1 else sums / counts)


def _shape(fields: ShownFields, *, around: int, most: int) -> Part:
    """Height over width of the drawing, height around it, and the largest height [pixel]."""
    return {"ratio": fields.window.height_to_width, "around": around, "most": most}


def _plane(fields: ShownFields, length: ReadableUnit) -> Part:
    """Axes in true shape, or stretched as the window is."""
    # The surface ends at the border of a period; elsewhere the plane continues, but a high map
    # would be a small part of a broad one.
    is_high = fields.window.height_to_width > 1
    constrain = "domain" if is_high or any(fields.snapshots[0].periodic) else "range"
    shared = {"constrain": constrain, "showgrid": False}
    x, y = (length(limits).tolist() for limits in (fields.window.x, fields.window.y))
    anchored = {"scaleanchor": "x", "scaleratio": fields.window.stretch}
    return {
        "xaxis": {"title": {"text": length.label("x")}, "range": x, **shared},
        "yaxis": {"title": {"text": length.label("y")}, "range": y, **shared, **anchored},
    }


def _colour_bar(pressure: ReadableUnit, look: Look) -> Part:
    return {
        "orientation": "h",
        "thickness": 10,
        "len": 0.9,
        "x": 0.5,
        "y": 1.0,
        "yanchor": "bottom",
        "outlinewidth": 0,
        "tickfont": {"size": 11, "color": look.ink},
        "title": {
            "text": pressure.label("Pressure"),
            "side": "top",
            "font": {"size": 12, "color": look.ink},
        },
    }


def _rim_style(look: Look) -> Part:
    return {"mode": "lines", "line": {"color": look.ink, "width": 1}, "hoverinfo": "skip"}


def _body_style(look: Look, length: ReadableUnit) -> Part:
    at = f"x %{{x:.4g}}, y %{{y:.4g}} {length.symbol}"
    return {
        "mode": "markers",
        "hovertemplate": f"axis of the body: {at}<extra></extra>",
        "marker": {"symbol": "cross-thin", "size": 9, "line": {"color": look.warm, "width": 2}},
    }


def _arrow(body: BodyPlace, at: tuple[float, float], stretch: float, look: Look) -> list[Part]:
    """Arrow from the axis of a moving body along its motion; none at rest."""
    if body.direction is None:
        return []
    across, up = body.direction[0], stretch * body.direction[1]
    across, up = (_ARROW * part / math.hypot(across, up) for part in (across, up))
    ends = {"xshift": across, "yshift": up, "ax": -across, "ay": up}
    head = {"showarrow": True, "arrowhead": 2, "arrowwidth": 2.2, "arrowcolor": look.warm}
    return [{"x": at[0], "y": at[1], "xref": "x", "yref": "y", "text": "", **head, **ends}]


def _outlined(fields: ShownFields) -> list[int]:
    """Instants whose outline is drawn: some in contact, from the first to the last."""
    touching = [index for index, each in enumerate(fields.snapshots) if each.touching]
    most = _OUTLINES_OF_MANY if fields.many_spots else _OUTLINES
    chosen = np.linspace(0, len(touching) - 1, min(most, len(touching))).round().astype(int)
    return [touching[index] for index in chosen]
