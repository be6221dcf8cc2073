"""A result to explore in a notebook: pressure map and sections with a slider."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import plotly.graph_objects as go
import xarray as xr

from viscontact.drawing.content.look import DARK, LIGHT, Look
from viscontact.drawing.content.map import Maps, maps_over
from viscontact.drawing.content.usefulness import is_of_use
from viscontact.drawing.figures import entry_of
from viscontact.drawing.plotly.parts import Part, template_of
from viscontact.drawing.plotly.pressure_map import pressure_map
from viscontact.drawing.plotly.sections import line_loads, sections
from viscontact.results.run_axis import in_order
from viscontact.results.snapshots import labels_of
from viscontact.units.systems import AUTOMATIC, SYSTEMS

#: Width for which the height of the map is chosen, and least and largest height [pixel].
_WIDTH, _LEAST, _MOST = 760, 120, 440
#: Heights of a section, of what lies between rows, and above and below all [pixel].
_SECTION, _BETWEEN, _ABOVE, _BELOW = 190, 84, 40, 150
#: Widths below which the sections are below each other, and least width; height of a colour bar
#: above the map [pixel].
_NARROW, _LEAST_WIDTH, _BAR = 560, 300, 52
#: Time between two frames that are played [ms].
_PAUSE = 800
#: Change to a frame without a transition, and its display without delay.
_AT_ONCE: Part = {"mode": "immediate", "transition": {"duration": 0}}
_NOW: Part = _AT_ONCE | {"frame": {"duration": 0, "redraw": True}}


def explore(
    result: xr.Dataset, *, dark: bool = False, units: str = AUTOMATIC, width: int | None = None
) -> go.Figure:
    """Draw pressure map and sections of a result with a slider over time or speed.

    Parameters
    ----------
    result : xarray.Dataset
        Result with stored fields, of `viscontact.simulate` or `viscontact.open_results`.
    dark : bool, optional
        Use colours for a dark background.
    units : {"auto", "mm", "kn", "um", "us", "si"}, optional
        System of units: the units that read best; mm, N, MPa; mm, kN, MPa; µm, mN, kPa; inches and
        pounds; or SI.
    width : int, optional
        Width of the figure [pixel], such as 380 for a narrow cell; below 560 the sections are below
        each other. By default it is that of the cell, which should be 600 or wider.

    Returns
    -------
    plotly.graph_objects.Figure
        A notebook shows it; ``figure.write_html("contact.html", auto_play=False)`` saves
        it. Pressure below the
        pointer is shown in its unit. A long contact has its line load as well.

    Raises
    ------
    ValueError
        If no fields are stored, the bodies do not touch in them, the units are not known, or the
        width is below 300.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((32, 32), (4e-3, 4e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> figure = explore(ds)
    >>> [step.label for step in figure.layout.sliders[0].steps]
    ['0 s', '1 s']
    """
    if units not in SYSTEMS:
        raise ValueError(f"units: wanted one of {', '.join(SYSTEMS)}; got {units!r}")
    if width is not None and not width >= _LEAST_WIDTH:
        raise ValueError(f"width: wanted {_LEAST_WIDTH} pixels or more, got {width}")
    look = replace(DARK if dark else LIGHT, system=units)
    maps = maps_over(in_order(result))
    figures = [pressure_map(maps, look), *sections(maps, look)]
    if is_of_use(entry_of("line-load"), result):
        figures += line_loads(maps, look)
    return _combine(figures, maps, look, width)


def _combine(figures: list[go.Figure], maps: Maps, look: Look, width: int | None) -> go.Figure:
    """Place a map above sections, as one figure whose frames change all of them."""
    narrow = width is not None and width < _NARROW
    map_height = min(max((width or _WIDTH) * maps.window.height_to_width, _LEAST), _MOST)
    rows = len(figures) - (1 if narrow else 2)  # a row may have two sections side by side
    above = _ABOVE + _BAR if narrow else _ABOVE
    inner = map_height + rows * (_SECTION + _BETWEEN)
    layout: Part = {
        "template": template_of(look),
        "width": width,
        "height": inner + above + _BELOW,
        "margin": {"l": 64, "r": 30, "t": above, "b": _BELOW},
        "paper_bgcolor": look.card,
        "plot_bgcolor": look.card,
        "uirevision": "kept",
        **_controls(maps, look),
    }
    domains = _domains(rows, narrow, map_height / inner, (_SECTION / inner, _BETWEEN / inner))
    traces: list[Part] = []
    offsets = []
    for number, (figure, (across, up)) in enumerate(zip(figures, domains, strict=True), start=1):
        mark = "" if number == 1 else str(number)
        offsets.append(len(traces))
        own = {"xaxis": f"x{mark}", "yaxis": f"y{mark}"}
        traces += [each.to_plotly_json() | own for each in figure.data]
        axes = figure.layout.to_plotly_json()
        layout[f"xaxis{mark}"] = axes["xaxis"] | {"domain": across, "anchor": f"y{mark}"}
        layout[f"yaxis{mark}"] = axes["yaxis"] | {"domain": up, "anchor": f"x{mark}"}
    layout["xaxis"]["title"]["standoff"] = 8
    headings = [_heading(domain, look) for domain in domains]
    if narrow:  # the bar remains above the map
        headings = [heading | {"font": {"size": 11, "color": look.ink}} for heading in headings]
        headings[0]["yshift"] = _BAR
    else:
        upright = {"orientation": "v", "x": 1.0, "xanchor": "left", "y": 1.0, "yanchor": "top"}
        traces[0]["colorbar"] |= upright | {"len": map_height / inner}
    frames = [_frame(figures, offsets, headings, index) for index in range(len(maps.snapshots))]
    return go.Figure(traces, layout | frames[maps.start]["layout"], frames)


def _domains(
    rows: int, narrow: bool, map_part: float, heights: tuple[float, float]
) -> list[tuple[list[float], list[float]]]:
    """Horizontal and vertical domains: the map, and below it rows of sections and the line load."""
    section, between = heights
    found = [([0.0, 1.0], [1 - map_part, 1.0])]
    for row in range(rows):
        top = 1 - map_part - between - row * (section + between)
        up = [max(top - section, 0.0), top]  # not below zero by rounding
        pair = row == 0 and not narrow
        found += [(across, up) for across in ([[0.0, 0.45], [0.55, 1.0]] if pair else [[0.0, 1.0]])]
    return found


def _heading(domain: tuple[list[float], list[float]], look: Look) -> Part:
    """Place of a title above the left end of axes."""
    place = {"xref": "paper", "yref": "paper", "x": domain[0][0], "y": domain[1][1]}
    anchors = {"xanchor": "left", "yanchor": "bottom", "showarrow": False, "yshift": 4}
    return {**place, **anchors, "font": {"size": 13, "color": look.ink}}


def _frame(
    figures: list[go.Figure], offsets: list[int], headings: list[Part], index: int
) -> dict[str, Any]:
    """Frame of all figures at an instant: parts of the traces, titles, and the body's arrow."""
    data: list[Part] = []
    traces: list[int] = []
    annotations: list[Part] = []
    for figure, offset, heading in zip(figures, offsets, headings, strict=True):
        frame = figure.frames[index].to_plotly_json()
        data += list(frame["data"])
        traces += [offset + number for number in frame["traces"]]
        meta = frame["layout"]["meta"]
        title = f"<b>{meta['title']}</b>"
        text = f"{title}  {meta['note']}" if meta.get("note") else title
        annotations += [heading | {"text": text}, *frame["layout"].get("annotations", ())]
    layout = {"annotations": annotations}
    return {"name": str(index), "data": data, "traces": traces, "layout": layout}


def _controls(maps: Maps, look: Look) -> Part:
    """Slider over the instants, and buttons to play them and to colour them; none for one."""
    if len(maps.snapshots) < 2:
        return {}
    menus = [_played(look), _coloured(maps, look)]
    return {"sliders": [_slider(maps, look)], "updatemenus": menus}


def _slider(maps: Maps, look: Look) -> Part:
    labels = labels_of(maps.snapshots)
    axis = maps.snapshots[0].axis
    steps = [
        {"label": label, "method": "animate", "args": [[str(index)], _NOW]}
        for index, label in enumerate(labels)
    ]
    return {
        "x": 0.0,
        "len": 1.0,
        "y": 0.0,
        "yanchor": "top",
        "pad": {"t": 52},
        "active": maps.start,
        "steps": steps,
        "currentvalue": {"prefix": f"{axis.name.capitalize()} ", "font": {"size": 12}},
        "font": {"color": look.ink, "size": 11},
        "bordercolor": look.edge,
        "bgcolor": look.grid,
    }


def _played(look: Look) -> Part:
    """Buttons that play the instants and stop."""
    played = _AT_ONCE | {"fromcurrent": True, "frame": {"duration": _PAUSE, "redraw": True}}
    buttons: list[Part] = [
        {"label": "Play", "method": "animate", "args": [None, played]},
        {"label": "Stop", "method": "animate", "args": [[None], _NOW]},
    ]
    return _buttons(look, buttons, 1.0) | {"showactive": False}


def _coloured(maps: Maps, look: Look) -> Part:
    """Buttons that give all instants one scale of colours, or each its own."""
    scale = maps.scale(look.unit)
    low, high = scale.unit(scale.limits).tolist()
    choices: dict[str, Part] = {
        "One scale": {"zauto": False, "zmin": low, "zmax": high},
        "A scale for each": {"zauto": True},
    }
    buttons: list[Part] = [
        {"label": label, "method": "restyle", "args": [values, [0]]}
        for label, values in choices.items()
    ]
    return _buttons(look, buttons, 0.75)


def _buttons(look: Look, buttons: list[Part], end: float) -> Part:
    """Buttons in a row below the figures, with their right end at a part of the width."""
    return {
        "type": "buttons",
        "direction": "left",
        "x": end,
        "xanchor": "right",
        "y": 0.0,
        "yanchor": "top",
        "pad": {"t": 42},
        "bgcolor": look.card,
        "bordercolor": look.edge,
        "font": {"color": look.ink, "size": 11},
        "buttons": buttons,
    }
