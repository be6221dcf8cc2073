"""Pressure over the surface, with a frame for each instant, and the outlines of the contact."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import plotly.graph_objects as go

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.map import BodyPlace, Map, Maps
from viscontact.drawing.content.scale import ColourScale
from viscontact.drawing.content.window import Window
from viscontact.drawing.figures import entry_of
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.results.run_axis import TIME
from viscontact.results.shown_rows import shown_rows
from viscontact.results.snapshots import labels_of
from viscontact.units.formatting import ReadableUnit, format_compact
from viscontact.units.systems import AUTOMATIC

#: More cells than these along an axis are joined.
MOST_CELLS = 256
#: Numbers of outlines that remain distinguishable in one figure, of a few spots and of many.
_OUTLINES, _OUTLINES_OF_MANY = 5, 2
#: Length of the arrow along a motion [pixel], and number of colours between which others lie.
_ARROW, _COLOURS = 34, 17


def pressure_map(maps: Maps, look: Look = LIGHT) -> go.Figure:
    """Draw the pressure over the surface, a frame each instant or speed; outline of a reference."""
    (x, y), scale = maps.axes(look.unit), maps.scale(look.unit)
    frames: list[Part] = [
        {"name": str(index), "traces": list(range(len(traces))), "data": traces, "layout": layout}
        for index, (traces, layout) in enumerate(_frames(maps, look, scale))
    ]
    at_x, at_y = maps.centres(MOST_CELLS)
    low, high = scale.unit(scale.limits).tolist()
    colours = scale.colours(_COLOURS)
    place = f"x %{{x:.4g}} {x.unit.symbol}, y %{{y:.4g}} {y.unit.symbol}"
    heat = {
        "type": "heatmap",
        "x": numbers(x.unit(at_x)),
        "y": numbers(y.unit(at_y)),
        "zmin": low,
        "zmax": high,
        "colorscale": list(zip(np.linspace(0, 1, _COLOURS).tolist(), colours, strict=True)),
        "hoverongaps": False,
        "zsmooth": False,
        "hovertemplate": f"{place}<br>%{{z:.4g}} {scale.unit.symbol}<extra></extra>",
        "colorbar": _colour_bar(scale, look),
    }
    styles: list[Part] = [heat, _rim_style(look)]
    if maps.reference is not None:
        styles.append(
            _rim_style(look) | {"line": {"color": look.warm, "width": 1.6, "dash": "dash"}}
        )
    if maps.moves:
        styles.append(_body_style(look, x.unit))
    shown = frames[maps.start]
    layout = _plane(maps, look) | {"margin": {"l": 56, "r": 24, "t": 60, "b": 64}}
    # Space for the tick labels, which Plotly omits beside a horizontal colour bar.
    layout["xaxis"]["title"]["standoff"] = 36
    traces = [style | part for style, part in zip(styles, shown["data"], strict=True)]
    return drawn(traces, look, **(layout | shown["layout"]), frames=frames)


def outlines(maps: Maps, look: Look = LIGHT) -> go.Figure:
    """Draw the outline of the contact at several instants or speeds."""
    unit = maps.axes(look.unit)[0].unit
    labels, colours = labels_of(maps.snapshots), look.instants(len(maps.maps))
    lines = [
        {
            **_line(maps.maps[index].outline, unit),
            "mode": "lines",
            "name": labels[index],
            "line": {"color": colours[index], "width": 1.0 if maps.many_spots else 1.6},
            "hovertemplate": f"x %{{x:.4g}} {unit.symbol}, y %{{y:.4g}} {unit.symbol}"
            f"<extra>{labels[index]}</extra>",
        }
        for index in _outlined_instants(maps)
    ]
    heading = entry_of("contact-outline").heading
    meta = {"name": "outlines", "title": heading} | _shape(maps, around=120, most=440)
    return drawn(
        lines,
        look,
        meta,
        **_plane(maps, look),
        showlegend=True,
        margin={"l": 56, "r": 24, "t": 44, "b": 46},
        legend={"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "font": {"size": 12}},
    )


def map_remarks(maps: Maps) -> str:
    """Remarks on the map: scale, averaged cells, instants left out."""
    line = "" if maps.many_spots else "The line is the outline of the contact; "
    notes = [f"{line}{'w' if line else 'W'}ithout colour: no contact."]
    if maps.moves:
        notes.append("The cross is the body's axis, the arrow the direction of its motion.")
    along_x, along_y = maps.strides(MOST_CELLS)
    if max(along_x, along_y) > 1:
        notes.append(
            f"To keep the page small the map shows means over {along_x} × {along_y} cells (at most "
            f"{MOST_CELLS} a side); sections are at full resolution."
        )
    if len(maps.maps) < maps.stored:
        rows = maps.snapshots[0].axis.row
        notes.append(f"{len(maps.maps)} of {maps.stored} stored {rows}s are shown.")
    return " ".join(notes)


def _frames(maps: Maps, look: Look, scale: ColourScale) -> Iterator[tuple[list[Part], Part]]:
    """Yield what differs between the instants: parts of the traces, and of the layout."""
    shape, headings = _shape(maps, around=170, most=600), _headings(maps, look)
    everywhere = scale.unit(scale.limits).tolist()
    own = [scale.unit(each.limits).tolist() for each in maps.own_scales(look.unit)]
    unit, reference = maps.axes(look.unit)[0].unit, maps.reference
    for index, each in enumerate(maps.maps):
        z = numbers(scale.unit(maps.cells(index, MOST_CELLS).T))
        shown = [each]
        if reference is not None:
            shown.append(reference.maps[reference.nearest(each.snapshot.time)])
        # Outlines of many spots would cover the pressure.
        rims = [[] if maps.many_spots else every.outline for every in shown]
        traces: list[Part] = [{"type": "heatmap", "z": z}, *(_line(rim, unit) for rim in rims)]
        note = _note(each, scale, maps.window)
        meta: Part = {"name": "map", "title": headings[index], "note": note} | shape
        meta["limits"] = {"all": everywhere, "each": own[index]}
        layout: Part = {"meta": meta}
        if each.body is not None:
            x, y = unit(each.body.axis).tolist()
            traces.append({"x": [x], "y": [y]})
            layout["annotations"] = _arrow(each.body, (x, y), maps.window.stretch, look)
        yield traces, layout


def _headings(maps: Maps, look: Look) -> list[str]:
    """Instants, which share a unit where none is chosen, or speeds."""
    axis = maps.snapshots[0].axis
    if axis is TIME and look.system == AUTOMATIC:
        return [each.heading for each in maps.maps]
    return [f"{axis.symbol}{look.quantity(each.time, axis.unit)}" for each in maps.snapshots]


def _note(shown: Map, scale: ColourScale, window: Window) -> str:
    """Largest pressure, with ``>`` in front if it depends on the mesh, and the stretch."""
    if not shown.snapshot.touching:
        return "No contact"
    peak = format_compact(float(scale.unit(shown.snapshot.pressure.max())), 4)
    text = f"Largest pressure {'>' * shown.depends_on_mesh}{peak} {scale.unit.symbol}"
    return "; ".join(filter(None, (text, window.note)))


def _line(curves: list[Floats], unit: ReadableUnit) -> Part:
    """All curves of an outline as one line, interrupted between them."""
    points = [part for curve in curves for part in (curve, [[np.nan, np.nan]])]
    if not points:
        return {"x": [], "y": []}
    x, y = unit(np.concatenate(points)).T
    return {"x": numbers(x), "y": numbers(y)}


def _shape(maps: Maps, *, around: int, most: int) -> Part:
    """Height over width of the drawing, height around it, and the largest height [pixel]."""
    return {"ratio": maps.window.height_to_width, "around": around, "most": most}


def _plane(maps: Maps, look: Look) -> Part:
    """Axes in true shape, or stretched as the window is."""
    # The surface ends at the border of a period; elsewhere the plane continues, but a high map
    # would be a small part of a broad one.
    is_high = maps.window.height_to_width > 1
    constrain = "domain" if is_high or any(maps.snapshots[0].periodic) else "range"
    x, y = (
        {"title": {"text": axis.label}, "range": axis.unit(limits).tolist()}
        | {"constrain": constrain, "showgrid": False}
        for axis, limits in zip(maps.axes(look.unit), (maps.window.x, maps.window.y), strict=True)
    )
    return {"xaxis": x, "yaxis": y | {"scaleanchor": "x", "scaleratio": maps.window.stretch}}


def _colour_bar(scale: ColourScale, look: Look) -> Part:
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
            "text": scale.label,
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
    ahead = body.arrow(stretch, _ARROW)
    if ahead is None:
        return []
    across, up = ahead
    ends = {"xshift": across, "yshift": up, "ax": -across, "ay": up}
    head = {"showarrow": True, "arrowhead": 2, "arrowwidth": 2.2, "arrowcolor": look.warm}
    return [{"x": at[0], "y": at[1], "xref": "x", "yref": "y", "text": "", **head, **ends}]


def _outlined_instants(maps: Maps) -> list[int]:
    """Instants whose outline is drawn: some in contact, from the first to the last."""
    touching = [index for index, each in enumerate(maps.snapshots) if each.touching]
    most = _OUTLINES_OF_MANY if maps.many_spots else _OUTLINES
    chosen = shown_rows(len(touching), most)
    return [touching[index] for index in chosen]
