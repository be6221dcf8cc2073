"""Sections through the pressure and the line load, with a frame for each instant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.figures.look import LIGHT, Look, Part, drawn, numbers
from viscontact.figures.pressure_map import nearest_to
from viscontact.figures.shown_fields import ShownFields
from viscontact.results.recorded_motion import contact_edges
from viscontact.results.shown_scalars import is_long
from viscontact.results.snapshots import labels_of
from viscontact.units.formatting import ReadableUnit, format_compact

#: Positions [m] and values [SI] of a curve.
Curve = tuple[Floats, Floats]


def sections(
    ds: xr.Dataset,
    fields: ShownFields,
    look: Look = LIGHT,
    reference: ShownFields | None = None,
) -> list[go.Figure]:
    """Draw the sections along x and y and, of a long contact, the line load; see `section`."""
    figures = [section(fields, "x", look, reference), section(fields, "y", look, reference)]
    return [*figures, line_load(fields, look, reference)] if is_long(ds) else figures


def section(
    fields: ShownFields,
    along: Literal["x", "y"],
    look: Look = LIGHT,
    reference: ShownFields | None = None,
) -> go.Figure:
    """Draw the pressure along x or y at every instant, with a frame that emphasises each.

    Parameters
    ----------
    fields : ShownFields
        Fields of a result.
    along : {"x", "y"}
        Direction of the section; it runs through the resultant.
    look : Look, optional
        Colours and units.
    reference : ShownFields, optional
        Fields of another result, whose section at the nearest instant is dashed.

    Returns
    -------
    plotly.graph_objects.Figure
        Frames are named as those of `pressure_map`. A moving contact has marks at its leading
        (full) and trailing (hollow) edge.
    """
    lines = section_lines(fields, along)
    others = [] if reference is None else section_lines(reference, along)
    titles = [f"Along {along}, {place}" for place in _places(fields, along, look)]
    drawn_lines = _Lines(f"section-{along}", ("Pressure", "Pa"), along, lines, others, titles)
    return _curves(fields, look, drawn_lines, reference, _edges(fields, along))


def line_load(
    fields: ShownFields, look: Look = LIGHT, reference: ShownFields | None = None
) -> go.Figure:
    """Draw the line load along x at every instant, with a frame that emphasises each."""
    lines = [each.line_load() for each in fields.snapshots]
    others = [] if reference is None else [each.line_load() for each in reference.snapshots]
    titles = ["Line load along x: the pressure integrated over y"] * len(lines)
    drawn_lines = _Lines("line-load", ("Line load", "N/m"), "x", lines, others, titles)
    return _curves(fields, look, drawn_lines, reference, [None] * len(lines))


def section_lines(fields: ShownFields, along: Literal["x", "y"]) -> list[Curve]:
    """Positions [m] and pressure [Pa] on a section at each instant."""
    pairs = zip(fields.snapshots, crossings(fields, along), strict=True)
    return [each.section(along, at) for each, at in pairs]


def crossings(fields: ShownFields, along: Literal["x", "y"]) -> list[float]:
    """Position of a section at each instant [m]."""
    return [through[1 if along == "x" else 0] for through in fields.through]


def section_place(fields: ShownFields, along: Literal["x", "y"]) -> str:
    """Position of a section, such as ``"at y = 0 mm"``."""
    return _place(fields.window.unit, along, crossings(fields, along))


def _places(fields: ShownFields, along: Literal["x", "y"], look: Look) -> list[str]:
    """Position of a section at each instant."""
    length = look.unit("m", fields.window.x, fields.window.y)
    return [_place(length, along, [at]) for at in crossings(fields, along)]


def _place(unit: ReadableUnit, along: str, at: list[float]) -> str:
    if len(set(at)) > 1:
        return "through each resultant"
    other = "y" if along == "x" else "x"
    return f"at {other} = {format_compact(float(unit(at[0])), 4)} {unit.symbol}"


@dataclass(frozen=True)
class _Lines:
    """Curves at all instants, those of the reference, and what they show."""

    name: str
    quantity: tuple[str, str]  # in words, and its SI unit
    along: str
    lines: list[Curve]
    others: list[Curve]  # of the reference; empty without one
    titles: list[str]


def _curves(
    fields: ShownFields,
    look: Look,
    shown: _Lines,
    reference: ShownFields | None,
    edges: Sequence[Floats | None],
) -> go.Figure:
    """Draw a curve for each instant: all of them thin, and in each frame one of them bold."""
    (quantity, si), within = shown.quantity, fields.inside["xy".index(shown.along)]
    length = look.unit("m", fields.window.x, fields.window.y)
    unit = look.unit(si, *(values for _, values in shown.lines))
    position = length(shown.lines[0][0][within])
    hover = f"{shown.along} %{{x:.4g}} {length.symbol}: %{{y:.4g}} {unit.symbol}"
    thin = [
        {
            **{"x": numbers(position), "y": numbers(unit(values[within])), "mode": "lines"},
            **{"name": label, "opacity": 0.55, "line": {"color": colour, "width": 1}},
            "hovertemplate": hover,
        }
        for (_, values), label, colour in zip(
            shown.lines,
            labels_of(fields.snapshots),
            look.instants(len(shown.lines)),
            strict=True,
        )
    ]
    styles: list[Part] = []
    if reference is not None:
        dashed = {"color": look.warm, "width": 2, "dash": "dash"}
        styles.append({"name": "reference", "line": dashed})
    styles.append({"x": numbers(position), "line": {"color": look.blue, "width": 2.6}})
    styles = [{"mode": "lines", "hovertemplate": hover} | style for style in styles]
    if any(each is not None for each in edges):
        styles.append(_edge_style(look, shown.along, length))
    frames: list[Part] = []
    for index, each in enumerate(fields.snapshots):
        parts: list[Part] = []
        if reference is not None:
            at, values = shown.others[nearest_to(reference, each.time)]
            parts.append({"x": numbers(length(at)), "y": numbers(unit(values))})
        parts.append({"y": thin[index]["y"], "name": thin[index]["name"]})
        if len(styles) > len(parts):
            marks = edges[index]
            parts.append({"x": [] if marks is None else length(marks).tolist()})
        traces = list(range(len(thin), len(thin) + len(parts)))
        layout = {"meta": {"name": shown.name, "title": shown.titles[index]}}
        frames.append({"name": str(index), "traces": traces, "data": parts, "layout": layout})
    start = frames[fields.start]
    return drawn(
        [*thin, *(style | part for style, part in zip(styles, start["data"], strict=True))],
        look,
        **start["layout"],
        frames=frames,
        xaxis={"title": {"text": length.label(shown.along)}, "range": position[[0, -1]].tolist()},
        yaxis={"title": {"text": unit.label(quantity)}, "rangemode": "tozero"},
    )


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


def _edges(fields: ShownFields, along: Literal["x", "y"]) -> list[Floats | None]:
    """Leading and trailing edge of a moving contact at each instant [m], None without them."""
    pairs = zip(fields.snapshots, crossings(fields, along), strict=True)
    lines = [each.contact_section(along, at) for each, at in pairs]
    ways = [place.way(along) for place in fields.body] or [0.0] * len(lines)
    found = [contact_edges(*line, way) for line, way in zip(lines, ways, strict=True)]
    return [None if edges is None else np.asarray(edges) for edges in found]
