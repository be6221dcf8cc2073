"""Scalars over time or speed as plain data for a page's figures, with their error bands."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.plot.histories.time_axis import suits_log_time
from viscontact.report.map_data import finite_or_none, rounded
from viscontact.results.formatting import format_with_error
from viscontact.results.recorded_case import prescribes_approach
from viscontact.results.recorded_motion import motion_axis
from viscontact.results.run_axis import SPEED, RunAxis, run_axis
from viscontact.results.shown_scalars import shown_scalars
from viscontact.results.stated_errors import (
    NOT_DRAWN,
    drawn_values,
    errors_of,
    is_centred,
    is_rounding,
    lacks_curve,
)
from viscontact.results.variables import MESH_DEPENDENT, SCALARS, Place, shown_in
from viscontact.units.formatting import format_compact, readable_unit

Floats = NDArray[np.float64]

#: A curve with a smaller relative variation is drawn as a constant.
_CONSTANT = 1e-6
#: Margin of an axis beyond its curve, in spans of the curve or, if more, in its largest value, so
#: that a single very large error does not flatten the curve.
_SPAN, _SIZE = 1.0, 0.5
#: Decades between the instant 0 and the first step on a logarithmic axis.
_BEFORE = 0.5
#: Below this ratio of last to first step there is nothing to spread.
_LEAST_RATIO = 30.0


def time_axis(ds: xr.Dataset) -> dict[str, Any]:
    """Return the axis of time or speed, linear and, over some decades, logarithmic."""
    over = run_axis(ds)
    instants = over.values(ds)
    unit = readable_unit(over.unit, instants)
    about = {"name": over.name.capitalize(), "symbol": over.symbol, "marked": over is SPEED}
    axis: dict[str, Any] = {
        **about,
        "unit": unit.symbol,
        "linear": rounded(unit(instants)),
        "log": None,
    }
    positive = unit(instants[instants > 0])
    if positive.size < 3 or positive[-1] < _LEAST_RATIO * positive[0]:
        return axis | {"startsLog": False}
    first = math.log10(positive[0]) - _BEFORE
    places = np.full(instants.size, first)
    places[instants > 0] = np.log10(positive)
    decades = range(math.ceil(math.log10(positive[0])), math.floor(math.log10(positive[-1])) + 1)
    ticks: list[tuple[float, str]] = [(first, "0")] if instants[0] <= 0 else []
    ticks += [(float(decade), format_compact(10.0**decade)) for decade in decades]
    return axis | {
        "log": rounded(places),
        "ticks": {"at": [place for place, _ in ticks], "text": [text for _, text in ticks]},
        "startsLog": over is SPEED or suits_log_time(ds),
    }


def load_panels(ds: xr.Dataset) -> list[dict[str, Any]]:
    """The prescribed load over time, a panel for each scalar."""
    return [_panel(ds, name) for name in _prescribed(ds)]


def response_panels(ds: xr.Dataset) -> list[dict[str, Any]]:
    """The contact's response over time, a panel for each scalar; idle tilts are left out."""
    return [_panel(ds, name) for name in _response(ds)]


def panel_labels(ds: xr.Dataset) -> tuple[dict[str, str], dict[str, str]]:
    """Names and labels of `load_panels` and of `response_panels`."""
    load, response = (
        {name: SCALARS[name].label for name in shown} for shown in (_prescribed(ds), _response(ds))
    )
    return load, response


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
    return [answer.get(name, name) for name in shown if not _is_idle(ds, name)]


def _is_idle(ds: xr.Dataset, name: str) -> bool:
    """Test for rounding under a centred load, on an elastic body, or across the motion."""
    return is_rounding(ds, name) if SCALARS[name].moving else is_centred(ds, name)


def _varies(ds: xr.Dataset, name: str) -> bool:
    values = ds[name].values[np.isfinite(ds[name].values)]
    least = 0.0 if SCALARS[name].moving else max(1e-9, _CONSTANT * np.abs(values).max(initial=0.0))
    return bool(values.size and np.ptp(values) > least)


def _panel(ds: xr.Dataset, name: str) -> dict[str, Any]:
    values = np.asarray(ds[name].values, dtype=np.float64)
    units = SCALARS[name].units
    unit, errors, drawn = readable_unit(units, values), errors_of(ds, name), drawn_values(ds, name)
    return {
        "name": name,
        "label": SCALARS[name].label,
        "unit": unit.symbol,
        "value": finite_or_none(unit(drawn)),
        "half": finite_or_none(unit(errors)),
        "range": _range(unit(drawn), unit(errors)),
        "hover": _hover(ds, values, errors, units),
        "note": _note(errors, values, run_axis(ds)) if SCALARS[name].has_error else "",
        "words": NOT_DRAWN if lacks_curve(ds, name) else "",
    }


def _hover(ds: xr.Dataset, values: Floats, errors: Floats, units: str) -> list[str]:
    axis = run_axis(ds)
    return [
        f"{axis.place(float(instant))}: {format_with_error(float(value), float(error), units)}"
        for instant, value, error in zip(axis.values(ds), values, errors, strict=True)
    ]


def _note(errors: Floats, values: Floats, axis: RunAxis) -> str:
    """Remark on errors that the band does not show."""
    given = np.isfinite(values)
    marked, unknown = int(np.isposinf(errors).sum()), int(np.isnan(errors[given]).sum())
    if marked:
        return MESH_DEPENDENT
    if unknown == int(given.sum()):
        return "error not known"
    return f"error not known at {unknown} of {given.size} {axis.row}s" if unknown else ""


def _range(values: Floats, errors: Floats) -> list[float]:
    """Limits of the vertical axis."""
    given = values[np.isfinite(values)]
    if not given.size:
        return [0.0, 1.0]
    low, high = float(given.min()), float(given.max())
    if high - low <= _CONSTANT * max(abs(low), abs(high)):
        return sorted((0.0, 1.15 * high or 1.0))
    bars = np.where(np.isfinite(errors) & np.isfinite(values), errors, 0.0)
    room = max(_SPAN * (high - low), _SIZE * max(abs(low), abs(high)))
    least = max(float(np.nanmin(values - bars)), low - room)
    most = min(float(np.nanmax(values + bars)), high + room)
    margin = 0.05 * (most - least)
    return rounded([0.0 if least == 0 else least - margin, most + margin])
