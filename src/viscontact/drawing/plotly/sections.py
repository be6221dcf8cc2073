"""Sections through the pressure and the line load, with a frame for each instant."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go

from viscontact.drawing.content.look import LIGHT, Look
from viscontact.drawing.content.map import Maps
from viscontact.drawing.content.section import Along, Lines, line_load, section
from viscontact.drawing.plotly.parts import Part, drawn, numbers
from viscontact.results.snapshots import labels_of
from viscontact.units.formatting import ReadableUnit


def sections(maps: Maps, look: Look = LIGHT) -> list[go.Figure]:
    """Draw the sections along x and y; of a line contact, which is uniform along x, that across."""
    across = draw_section(maps, "y", look)
    varies = any(np.ptp(each.pressure, axis=0).any() for each in maps.snapshots)
    return [draw_section(maps, "x", look), across] if varies else [across]


def draw_section(maps: Maps, along: Along, look: Look = LIGHT) -> go.Figure:
    """Draw the pressure along x or y at every instant, that of a reference dashed."""
    lines, unit = section(maps, along), maps.axes(look.unit)[0].unit
    titles = [f"{lines.title}, {lines.place(unit, at)}" for at in lines.crossings]
    others = None if maps.reference is None else section(maps.reference, along)
    return _curves(maps, look, lines, titles, others)


def line_loads(maps: Maps, look: Look = LIGHT) -> list[go.Figure]:
    """Draw the line load along x at every instant, with a frame for each."""
    lines = line_load(maps)
    others = None if maps.reference is None else line_load(maps.reference)
    return [_curves(maps, look, lines, [lines.title] * len(maps.maps), others)]


def _curves(
    maps: Maps, look: Look, lines: Lines, titles: list[str], others: Lines | None
) -> go.Figure:
    """Draw a curve for each instant: all of them thin, and in each frame one of them bold."""
    within = maps.inside["xy".index(lines.along)]
    length, quantity = maps.axes(look.unit)[0].unit, lines.axis(look.unit)
    position, unit = length(lines.positions[within]), quantity.unit
    hover = f"{lines.along} %{{x:.4g}} {length.symbol}: %{{y:.4g}} {unit.symbol}"
    names = zip(labels_of(maps.snapshots), look.instants(len(maps.maps)), strict=True)
    thin = [
        {
            **{"x": numbers(position), "y": numbers(unit(values[within])), "mode": "lines"},
            **{"name": label, "opacity": 0.55, "line": {"color": colour, "width": 1}},
            "hovertemplate": hover,
        }
        for values, (label, colour) in zip(lines.values, names, strict=True)
    ]
    styles: list[Part] = [{"x": numbers(position), "line": {"color": look.blue, "width": 2.6}}]
    if others is not None:
        dashed = {"color": look.warm, "width": 2, "dash": "dash"}
        styles.insert(0, {"name": "reference", "line": dashed})
    styles = [{"mode": "lines", "hovertemplate": hover} | style for style in styles]
    if any(lines.edges):
        styles.append(_edge_style(look, lines.along, length))
    frames: list[Part] = []
    for index, each in enumerate(maps.snapshots):
        parts: list[Part] = []
        if maps.reference is not None and others is not None:
            values = others.values[maps.reference.nearest(each.time)]
            parts.append({"x": numbers(length(others.positions)), "y": numbers(unit(values))})
        parts.append({"y": thin[index]["y"], "name": thin[index]["name"]})
        if len(styles) > len(parts):
            parts.append({"x": length(lines.edges[index] or []).tolist()})
        frames.append(_frame(index, len(thin), parts, lines.name, titles[index]))
    start = frames[maps.start]
    return drawn(
        [*thin, *(style | part for style, part in zip(styles, start["data"], strict=True))],
        look,
        **start["layout"],
        frames=frames,
        **(_marks_of_ends(maps, look, length) if lines.along == "x" else {}),
        xaxis={"title": {"text": length.label(lines.along)}, "range": position[[0, -1]].tolist()},
        yaxis={"title": {"text": quantity.label}, "rangemode": "tozero"},
    )


def _marks_of_ends(maps: Maps, look: Look, length: ReadableUnit) -> Part:
    """Dotted lines where bodies end along x."""
    dotted = {"color": look.faint, "width": 1.2, "dash": "dot"}
    line: Part = {"type": "line", "y0": 0, "y1": 1, "yref": "paper", "line": dotted}
    places = length(np.array([end.place for end in maps.ends])).tolist()
    return {"shapes": [line | {"x0": at, "x1": at} for at in places]} if places else {}


def _frame(index: int, first: int, parts: list[Part], name: str, title: str) -> Part:
    """Frame that replaces the traces from the first one on."""
    traces = list(range(first, first + len(parts)))
    layout = {"meta": {"name": name, "title": title}}
    return {"name": str(index), "traces": traces, "data": parts, "layout": layout}


def _edge_style(look: Look, along: str, length: ReadableUnit) -> Part:
    """Leading (full) and trailing (hollow) edge of a moving contact."""
    colours = [look.blue, look.card]
    marker = {"size": 8, "color": colours, "line": {"color": look.blue, "width": 1.6}}
    return {
        "y": [0.0, 0.0],
        "mode": "markers",
        "cliponaxis": False,
        "text": ["leading edge", "trailing edge"],
        "marker": marker,
        "hovertemplate": f"%{{text}}: {along} %{{x:.4g}} {length.symbol}<extra></extra>",
    }
