"""Scalars over time as plain data for a page's figures, with their error bands."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.plot.histories.time_axis import suits_log_time
from viscontact.report.map_data import rounded
from viscontact.results.formatting import format_with_error
from viscontact.results.recorded_case import prescribes_approach
from viscontact.results.rounding import is_rounding_tilt
from viscontact.results.stated_errors import MESH_DEPENDENT, errors_of
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import format_compact, format_quantity, readable_unit

Floats = NDArray[np.float64]

#: A curve that varies by less than this part is drawn as the constant it is.
_CONSTANT = 1e-6
#: An axis goes beyond its curve by so much of the curve's span or, if more, of its largest value:
#: one wild error is not to flatten what there is to see.
_SPAN, _SIZE = 1.0, 0.5
#: The instant 0 stands so many decades before the first step on a logarithmic axis.
_BEFORE = 0.5
#: Below this ratio of last to first step there is nothing to spread.
_LEAST_RATIO = 30.0


@dataclass(frozen=True)
class _Quantity:
    name: str
    label: str


_FORCE, _APPROACH = _Quantity("force", "Force"), _Quantity("approach", "Approach")
_LOAD = (
    _FORCE,
    _Quantity("eccentricity_x", "Eccentricity along x"),
    _Quantity("eccentricity_y", "Eccentricity along y"),
)
_ANSWERS = (
    _Quantity("contact_area", "Contact area"),
    _APPROACH,
    _Quantity("tilt_x", "Tilt along x"),
    _Quantity("tilt_y", "Tilt along y"),
    _Quantity("peak_pressure", "Peak pressure"),
    _Quantity("contact_length", "Contact length, along x"),
    _Quantity("contact_width", "Contact width, along y"),
)


def time_axis(ds: xr.Dataset) -> dict[str, Any]:
    """Return the axis of time, linear and, where steps are spread over decades, logarithmic.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.

    Returns
    -------
    dict
        Unit and positions on both axes, ticks of the second, and which to begin with. On the
        logarithmic axis the instant 0 stands half a decade before the first step.
    """
    instants = np.asarray(ds["time"].values, dtype=np.float64)
    unit = readable_unit("s", instants)
    axis: dict[str, Any] = {"unit": unit.symbol, "linear": rounded(unit(instants)), "log": None}
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
        "startsLog": suits_log_time(ds),
    }


def load_panels(ds: xr.Dataset) -> list[dict[str, Any]]:
    """Return the load over time, a panel a quantity.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    """
    return [_panel(ds, each) for each in _prescribed(ds)]


def answer_panels(ds: xr.Dataset) -> list[dict[str, Any]]:
    """Return what the contact answers over time, a panel a quantity; idle tilts are left out.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    """
    return [_panel(ds, each) for each in _answered(ds)]


def panel_labels(ds: xr.Dataset) -> tuple[dict[str, str], dict[str, str]]:
    """Return names and labels of what `load_panels` and `answer_panels` show.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    """
    load, answers = (
        {each.name: each.label for each in shown} for shown in (_prescribed(ds), _answered(ds))
    )
    return load, answers


def _prescribed(ds: xr.Dataset) -> list[_Quantity]:
    if prescribes_approach(ds):
        return [_APPROACH]
    return [each for each in _LOAD if each.name == "force" or _varies(ds, each.name)]


def _answered(ds: xr.Dataset) -> list[_Quantity]:
    lengths, approaches = ds["contact_length"].values, ds["approach"].values
    return [
        _FORCE if each is _APPROACH and prescribes_approach(ds) else each
        for each in _ANSWERS
        if not each.name.startswith("tilt")
        or not is_rounding_tilt(ds[each.name].values, lengths, approaches)
    ]


def _varies(ds: xr.Dataset, name: str) -> bool:
    values = ds[name].values[np.isfinite(ds[name].values)]
    return bool(values.size and np.ptp(values) > max(1e-9, _CONSTANT * np.abs(values).max()))


def _panel(ds: xr.Dataset, quantity: _Quantity) -> dict[str, Any]:
    values = np.asarray(ds[quantity.name].values, dtype=np.float64)
    units = SCALARS[quantity.name].units
    unit, errors = readable_unit(units, values), errors_of(ds, quantity.name)
    return {
        "name": quantity.name,
        "label": quantity.label,
        "unit": unit.symbol,
        "value": _or_none(unit(values)),
        "half": _or_none(unit(errors)),
        "range": _range(unit(values), unit(errors)),
        "hover": _hover(ds, values, errors, units),
        "note": _note(errors, values),
        "mesh": bool(np.isposinf(errors).any()),
    }


def _hover(ds: xr.Dataset, values: Floats, errors: Floats, units: str) -> list[str]:
    return [
        f"t = {format_quantity(float(instant), 's')}: "
        f"{format_with_error(float(value), float(error), units)}"
        for instant, value, error in zip(ds["time"].values, values, errors, strict=True)
    ]


def _note(errors: Floats, values: Floats) -> str:
    """What the band does not say."""
    given = np.isfinite(values)
    marked, unknown = int(np.isposinf(errors).sum()), int(np.isnan(errors[given]).sum())
    if marked:
        return MESH_DEPENDENT
    if unknown == int(given.sum()):
        return "error not known"
    return f"error not known at {unknown} of {given.size} instants" if unknown else ""


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


def _or_none(values: Floats) -> list[float | None]:
    return [
        value if math.isfinite(number) else None
        for value, number in zip(rounded(np.nan_to_num(values)), values.tolist(), strict=True)
    ]
