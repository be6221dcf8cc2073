"""Plain data of a run for interactive figures."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from viscontact.figures.histories import panel_names
from viscontact.figures.look import LIGHT
from viscontact.figures.run_scale import run_scale
from viscontact.figures.shown_fields import shown_fields
from viscontact.plot.histories.time_axis import suits_log_time
from viscontact.plot.motion.friction import friction_limits, limit_speeds
from viscontact.report.accuracy import accuracy_lines
from viscontact.report.limits import notices, warnings_of
from viscontact.report.loops import loops_data
from viscontact.report.map_data import curves_data, finite_or_none, map_data, rounded
from viscontact.report.result_chapters import title_of
from viscontact.results.run_axis import TIME, in_order, run_axis
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.stated_errors import drawn_values, errors_of
from viscontact.results.summary import summary_scalars
from viscontact.results.variables import SCALARS, Place
from viscontact.results.worst_values import worst_places
from viscontact.units.formatting import readable_unit


def run_data(ds: xr.Dataset) -> dict[str, Any]:
    """Return the numbers of a run that figures are drawn from; ValueError without a row.

    Plain data without NaN and inf, which JSON cannot hold: instants, or speeds from the slowest to
    the fastest, and scalars with their errors in SI units, the prescribed and the listed scalars,
    the fields by `map_data` and `curves_data` with the factors of their units to SI, the limits of
    friction, warnings and the account of accuracy. Null where there is no value or an error is
    unknown; `mesh` marks places at which a scalar depends on the mesh, where `drawn` has no value.

    >>> import viscontact as vc
    >>> pmma = vc.Material(vc.Elastic(1e9), 0.4)
    >>> ds = vc.simulate(vc.Sphere(0.01), pmma, vc.step(100.0), times=[1.0], errors=False)
    >>> run_data(ds)["scalars"]["force"]["value"], run_data(ds)["given"]
    ([100.0], {'force': 'Force'})
    """
    axis = run_axis(ds)
    if not ds.sizes.get(axis.name):
        raise ValueError(f"figures need one {axis.row} at least, got a result without any; run it")
    ds = in_order(ds)
    given, answers = ({name: SCALARS[name].label for name in names} for names in panel_names(ds))
    return {
        "title": title_of(ds),
        "axis": _axis(ds),
        "scalars": {name: _scalar(ds, name) for name in SCALARS if name in ds},
        "given": given,
        "answers": answers,
        "facts": shown_labels(ds, Place.FACTS),
        "worst": _worst(ds),
        "listed": summary_scalars(ds),
        "map": _map(ds),
        "loops": loops_data(ds),
        "friction": _friction(ds),
        "notices": notices(ds),
        "warnings": warnings_of(ds),
        "accuracy": list(accuracy_lines(ds)),
    }


def _worst(ds: xr.Dataset) -> dict[str, Any]:
    """Places of the worst values beside the end, or beside the largest contact if it is lost."""
    area = ds["contact_area"].values
    shown = len(area) - 1 if area[-1] > 0 else int(area.argmax())
    return {name: worst_places(ds, name, shown) for name in shown_labels(ds, Place.FACTS)}


def _axis(ds: xr.Dataset) -> dict[str, Any]:
    """Instants or speeds, how they are named and written, and whether they suit a log scale."""
    axis = run_axis(ds)
    return {
        **{"name": axis.name, "unit": axis.unit, "symbol": axis.symbol, "row": axis.row},
        "values": rounded(axis.values(ds), 12),
        "startsLog": bool(suits_log_time(ds) if axis is TIME else run_scale(ds, LIGHT).starts_log),
    }


def _friction(ds: xr.Dataset) -> dict[str, Any] | None:
    """Curves of the limits of slow and fast motion; None where no curve can be drawn."""
    if run_axis(ds) is TIME or ds.sizes["speed"] < 2:
        return None
    if not (ds["friction_coefficient"].values > 0).any():
        return None
    speeds = limit_speeds(ds)
    limits = [
        {"name": name, "dash": "dash" if dashes == "--" else "dot", "value": rounded(values)}
        for name, dashes, values in friction_limits(ds, speeds)
    ]
    return {"speed": rounded(speeds), "limits": limits}


def _scalar(ds: xr.Dataset, name: str) -> dict[str, Any]:
    values = np.asarray(ds[name].values, dtype=np.float64)
    errors = errors_of(ds, name)
    return {
        "unit": SCALARS[name].units,
        "meaning": SCALARS[name].long_name,
        "value": finite_or_none(values, 9),
        "error": finite_or_none(errors, 9),
        "drawn": finite_or_none(drawn_values(ds, name), 9),
        "mesh": np.isposinf(errors).tolist(),
    }


def _map(ds: xr.Dataset) -> dict[str, Any] | None:
    try:
        fields = shown_fields(ds)
    except ValueError:  # none are stored, or there is no contact in them
        return None
    data = map_data(fields)
    return data | {
        "places": [each.time for each in fields.snapshots],
        "lengthFactor": fields.window.unit.factor,
        "pressureFactor": readable_unit("Pa", fields.peak).factor,
        "sections": curves_data(ds, fields),
        "crossings": fields.through,
    }
