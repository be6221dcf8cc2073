"""Scalars over time or speed with their error bands: a figure for each."""

from __future__ import annotations

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.backend.arrays import Floats, Singles
from viscontact.drawing.content.history import is_idle
from viscontact.figures.look import LIGHT, Look, Part, drawn, numbers, words
from viscontact.figures.run_scale import RunScale, run_scale
from viscontact.results.recorded_case import prescribes_approach
from viscontact.results.recorded_events import recorded_events
from viscontact.results.recorded_motion import motion_axis
from viscontact.results.run_axis import SPEED, RunAxis, run_axis
from viscontact.results.shown_scalars import shown_scalars
from viscontact.results.stated_errors import (
    NOT_DRAWN,
    drawn_values,
    errors_of,
    lacks_curve,
)
from viscontact.results.variables import MESH_DEPENDENT, SCALARS, Place, shown_in
from viscontact.units.formatting import ReadableUnit

#: Names of the frames of a linear and a logarithmic axis.
LINEAR, LOGARITHMIC = "linear", "log"
#: Remark on a scalar without any error.
UNKNOWN = "error not known"
#: A curve with a smaller relative variation is drawn as a constant.
_CONSTANT = 1e-6
#: Margin of an axis beyond its curve, in spans of the curve or, if more, in its largest value, so
#: that a single very large error does not flatten the curve.
_SPAN, _SIZE = 1.0, 0.5


def history(
    ds: xr.Dataset, name: str, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> go.Figure:
    """Draw a scalar over time or speed with its error band.

    Parameters
    ----------
    ds : xarray.Dataset
        Result of a run, over speed from the slowest to the fastest.
    name : str
        The scalar, such as ``"contact_area"``.
    look : Look, optional
        Colours and units.
    reference : xarray.Dataset, optional
        Another result over the same quantity, dashed.

    Returns
    -------
    plotly.graph_objects.Figure
        Where the steps are spread over decades it has the frames ``"linear"`` and ``"log"``. Its
        title is in ``layout.meta``, with a remark on errors that the band does not show.

    Examples
    --------
    >>> import viscontact as vc
    >>> pmma = vc.Material(vc.Elastic(1e9), 0.4)
    >>> ds = vc.simulate(vc.Sphere(0.01), pmma, vc.step(100.0), times=[0.0, 1.0], errors=False)
    >>> history(ds, "approach").layout.meta["title"]
    'Approach [µm]'
    """
    compared = [ds, reference] if reference is not None and name in reference else [ds]
    unit = look.unit(SCALARS[name].units, *(each[name].values for each in compared))
    scale = run_scale(ds, look, reference)
    errors, values = errors_of(ds, name), np.asarray(ds[name].values, dtype=np.float64)
    styles = _styles(ds, name, look, unit, compared)
    frames: list[Part] = [
        {
            "name": LOGARITHMIC if log else LINEAR,
            "traces": list(range(len(styles))),
            "data": _positions(ds, name, scale, compared, log=log),
            # A part that was enlarged on one scale is elsewhere on the other.
            "layout": {
                "xaxis": scale.part(log=log),
                "uirevision": LOGARITHMIC if log else LINEAR,
                "shapes": _event_lines(ds, scale, look, log=log),
            },
        }
        for log in ((False, True) if scale.has_log else (False,))
    ]
    shown = frames[scale.starts_log]
    is_drawn = not lacks_curve(ds, name)
    return drawn(
        [style | part for style, part in zip(styles, shown["data"], strict=True)],
        look,
        {
            "name": f"history-{name}",
            "title": unit.label(SCALARS[name].label),
            "note": _note(errors, values, run_axis(ds)) if SCALARS[name].has_error else "",
        },
        frames=frames if len(frames) > 1 else (),
        **shown["layout"],
        yaxis={"range": _range(compared, name, unit), "showticklabels": is_drawn},
        hovermode="x",
        annotations=[] if is_drawn else [words(NOT_DRAWN, look)],
    )


def histories(
    ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None
) -> tuple[list[go.Figure], list[go.Figure]]:
    """Draw what is prescribed, and what answers: a figure for each scalar, without idle tilts."""
    load, response = panel_names(ds)
    return (
        [history(ds, name, look, reference) for name in load],
        [history(ds, name, look, reference) for name in response],
    )


def panel_names(ds: xr.Dataset) -> tuple[list[str], list[str]]:
    """Names of the scalars that are prescribed, and of those that answer."""
    return _prescribed(ds), _response(ds)


def _prescribed(ds: xr.Dataset) -> list[str]:
    names = [name for name in shown_in(Place.LOAD, ds) if name == "force" or _varies(ds, name)]
    if run_axis(ds) is SPEED:
        names = ["force"]  # a constant load
    if not prescribes_approach(ds):
        return names
    return ["approach", *(name for name in names if SCALARS[name].moving)]


def _response(ds: xr.Dataset) -> list[str]:
    answer = {"approach": "force"} if prescribes_approach(ds) else {}
    shown = shown_scalars(ds, Place.RESPONSE)
    if run_axis(ds) is SPEED:
        shown.append(f"eccentricity_{motion_axis(ds)}")  # the contact lies ahead of the axis
    return [answer.get(name, name) for name in shown if not is_idle(ds, name)]


def _varies(ds: xr.Dataset, name: str) -> bool:
    values = ds[name].values[np.isfinite(ds[name].values)]
    least = 0.0 if SCALARS[name].moving else max(1e-9, _CONSTANT * np.abs(values).max(initial=0.0))
    return bool(values.size and np.ptp(values) > least)


def _styles(
    ds: xr.Dataset, name: str, look: Look, unit: ReadableUnit, compared: list[xr.Dataset]
) -> list[Part]:
    """Curves and band without their positions: the reference first, the result on top."""
    band = {"mode": "lines", "fill": "toself", "fillcolor": look.band, "line": {"width": 0}}
    curves = [
        _curve(each, name, look, unit, line)
        for each, line in zip(
            compared,
            ({"color": look.blue, "width": 2}, {"color": look.warm, "width": 2, "dash": "dash"}),
            strict=False,
        )
    ]
    return [*curves[1:], band | {"y": _band(ds, name, unit), "hoverinfo": "skip"}, curves[0]]


def _curve(ds: xr.Dataset, name: str, look: Look, unit: ReadableUnit, line: Part) -> Part:
    values = drawn_values(ds, name)
    marked = "lines+markers" if run_axis(ds) is SPEED else "lines"
    return {
        "y": numbers(unit(values)),
        "mode": "markers" if values.size < 2 else marked,
        "line": line,
        "marker": {"color": line["color"], "size": 5},
        "text": _hover(ds, name, look),
        "hovertemplate": "%{text}<extra></extra>",
    }


def _positions(
    ds: xr.Dataset, name: str, scale: RunScale, compared: list[xr.Dataset], *, log: bool
) -> list[Part]:
    """Positions along the axis of what `_styles` returns."""
    places = [scale.at(run_axis(each).values(each), log=log) for each in compared]
    band = np.concatenate(
        [[*places[0][part], *places[0][part][::-1], np.nan] for part in _parts(ds, name)] or [[]]
    )
    return [{"x": numbers(each)} for each in (*places[1:], band, places[0])]


def _event_lines(ds: xr.Dataset, scale: RunScale, look: Look, *, log: bool) -> list[Part]:
    """Dotted lines at the events of a load program, with their numbers from 1."""
    line = {"color": look.faint, "width": 1, "dash": "dot"}
    label = {"textangle": 0, "textposition": "end", "xanchor": "right", "yanchor": "top"}
    label["font"] = {"size": 10, "color": look.faint}
    return [
        {
            **{"type": "line", "yref": "paper", "y0": 0, "y1": 1, "layer": "below", "line": line},
            **{"x0": place, "x1": place, "label": label | {"text": str(number)}},
        }
        for number, event in enumerate(recorded_events(ds), start=1)
        for place in scale.at(np.array([event.time]), log=log).tolist()
    ]


def _band(ds: xr.Dataset, name: str, unit: ReadableUnit) -> Singles:
    """Edges of the band: a closed polygon for each run of instants whose error is known."""
    values, errors = drawn_values(ds, name), errors_of(ds, name)
    low, high = unit(values - errors), unit(values + errors)
    edges = [[*high[part], *low[part][::-1], np.nan] for part in _parts(ds, name)]
    return numbers(np.concatenate(edges or [[]]))


def _parts(ds: xr.Dataset, name: str) -> list[slice]:
    """Runs of two instants or more whose error is known."""
    known = np.isfinite(drawn_values(ds, name)) & np.isfinite(errors_of(ds, name))
    changes = np.flatnonzero(np.diff([False, *known, False]))
    return [slice(a, b) for a, b in changes.reshape(-1, 2).tolist() if b - a > 1]


def _hover(ds: xr.Dataset, name: str, look: Look) -> list[str]:
    axis, units = run_axis(ds), SCALARS[name].units
    values, errors = ds[name].values.tolist(), errors_of(ds, name).tolist()
    return [
        f"{axis.place(place)}: {look.text(value, error, units)}"
        for place, value, error in zip(axis.values(ds).tolist(), values, errors, strict=True)
    ]


def _note(errors: Floats, values: Floats, axis: RunAxis) -> str:
    """Remark on errors that the band does not show."""
    given = np.isfinite(values)
    marked, unknown = int(np.isposinf(errors).sum()), int(np.isnan(errors[given]).sum())
    if marked:
        return MESH_DEPENDENT
    if unknown == int(given.sum()):
        return UNKNOWN
    return f"error not known at {unknown} of {given.size} {axis.row}s" if unknown else ""


def _range(compared: list[xr.Dataset], name: str, unit: ReadableUnit) -> list[float]:
    """Limits of the vertical axis."""
    values, errors = unit(drawn_values(compared[0], name)), unit(errors_of(compared[0], name))
    given = np.concatenate([unit(drawn_values(each, name)) for each in compared])
    given = given[np.isfinite(given)]
    if not given.size:
        return [0.0, 1.0]
    low, high = float(given.min()), float(given.max())
    if high - low <= _CONSTANT * max(abs(low), abs(high)):
        return sorted((0.0, 1.15 * high or 1.0))
    bars = np.where(np.isfinite(errors) & np.isfinite(values), errors, 0.0)
    room = max(_SPAN * (high - low), _SIZE * max(abs(low), abs(high)))
    least = max(float(np.nanmin([low, *(values - bars)])), low - room)
    most = min(float(np.nanmax([high, *(values + bars)])), high + room)
    margin = 0.05 * (most - least)
    return [0.0 if least == 0 else least - margin, most + margin]
