"""Friction coefficient over speed with the limits of slow and fast motion."""

from __future__ import annotations

import math

import numpy as np
import plotly.graph_objects as go
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.look import LIGHT, Look
from viscontact.figures.parts import Part, drawn, numbers
from viscontact.plot.motion.friction import friction_limits, limit_speeds
from viscontact.results.run_axis import SPEED, run_axis
from viscontact.results.stated_errors import errors_of
from viscontact.units.formatting import ReadableUnit, format_compact

NAME = "friction_coefficient"
#: Room above and below the values, as a factor.
_ROOM = 2.0
#: Dashes in the words of Plotly.
_DASHES = {"--": "dash", ":": "dot"}


def has_friction(ds: xr.Dataset) -> bool:
    """Tell whether a result has a curve of friction over speed."""
    if run_axis(ds) is not SPEED or ds.sizes["speed"] < 2:
        return False
    return bool((ds[NAME].values > 0).any())


def friction(ds: xr.Dataset, look: Look = LIGHT, reference: xr.Dataset | None = None) -> go.Figure:
    """Draw the friction coefficient over speed with the limits of slow and fast motion.

    Parameters
    ----------
    ds : xarray.Dataset
        Result of `viscontact.steady` with a positive coefficient, from the slowest to the fastest
        speed.
    look : Look, optional
        Colours and units.
    reference : xarray.Dataset, optional
        Another result over speed, dashed.

    Returns
    -------
    plotly.graph_objects.Figure
        Both axes are logarithmic.
    """
    speeds, values = limit_speeds(ds), ds[NAME].values
    unit = look.unit("m/s", speeds)
    positive = values[values > 0]
    lowest, highest = float(positive.min()) / _ROOM, float(positive.max()) * _ROOM
    traces = [
        {
            **{"x": numbers(unit(speeds)), "y": numbers(limit), "name": name, "mode": "lines"},
            "line": {
                "color": look.faint,
                "width": 1.2,
                "dash": _DASHES[dashes],
            },
            "hoverinfo": "skip",
        }
        for name, dashes, limit in friction_limits(ds, speeds)
        if ((limit > lowest) & (limit < highest)).any()
    ]
    if reference is not None:
        dashed = {"color": look.warm, "width": 2, "dash": "dash"}
        traces.append(_curve(reference, unit, dashed))
    traces.append(_curve(ds, unit, {"color": look.blue, "width": 2}))
    limits = [math.log10(lowest), math.log10(highest)]
    return drawn(
        traces,
        look,
        {"name": "friction", "title": "Friction coefficient"},
        showlegend=len(traces) > 1,
        legend={"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom"},
        margin={"l": 50, "r": 24, "t": 34, "b": 42},
        xaxis={"title": {"text": unit.label("Speed")}, **_log_ticks(unit(speeds))},
        yaxis={"range": limits, **_log_ticks(np.array([lowest, highest]))},
    )


def _curve(ds: xr.Dataset, unit: ReadableUnit, line: Part) -> Part:
    speeds, values, errors = ds["speed"].values, ds[NAME].values, errors_of(ds, NAME)
    return {
        "x": numbers(unit(speeds)),
        "y": numbers(values),
        "name": str(ds.attrs.get("title") or "this result"),
        "mode": "lines+markers",
        "line": line,
        "marker": {"color": line["color"], "size": 6},
        "error_y": {
            "type": "data",
            "array": numbers(np.nan_to_num(errors, posinf=0.0)),
            "color": line["color"],
            "thickness": 1.2,
            "width": 3,
        },
        "text": [
            f"{SPEED.place(speed)}: {LIGHT.text(value, error, '1')}"
            for speed, value, error in zip(
                speeds.tolist(), values.tolist(), errors.tolist(), strict=True
            )
        ],
        "hovertemplate": "%{text}<extra></extra>",
    }


def _log_ticks(values: Floats) -> Part:
    """Logarithmic axis with its decades, and within two of them 1, 2 and 5 of each."""
    first, last = math.log10(values.min()), math.log10(values.max())
    steps = (1,) if last - first > 2 else (1, 2, 5)
    decades = range(math.floor(first), math.floor(last) + 1)
    ticks = [step * 10.0**decade for decade in decades for step in steps]
    texts = [format_compact(tick) for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": texts}
