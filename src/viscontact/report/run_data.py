"""Plain data of a run for interactive figures."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from viscontact.plot.histories.time_axis import suits_log_time
from viscontact.report.accuracy import accuracy_lines
from viscontact.report.histories import panel_labels
from viscontact.report.limits import notices, warnings_of
from viscontact.report.map_data import curves_data, finite_or_none, map_data, rounded
from viscontact.report.resistance_loops import loops_data
from viscontact.report.result_chapters import title_of
from viscontact.report.shown_fields import shown_fields
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.stated_errors import drawn_values, errors_of
from viscontact.results.summary import summary_scalars
from viscontact.results.variables import SCALARS, Place
from viscontact.units.formatting import readable_unit


def run_data(ds: xr.Dataset) -> dict[str, Any]:
    """Return the numbers of a run that figures are drawn from; ValueError without an instant.

    Plain data without NaN and inf, which JSON cannot hold: instants and scalars with their errors
    in SI units, the prescribed and the listed scalars, the fields by `map_data` and `curves_data`
    with the factors of their units to SI, warnings and the account of accuracy. Null where there
    is no value or an error is unknown; `mesh` marks instants at which a scalar depends on the
    mesh, where `drawn` has no value.

    >>> import viscontact as vc
    >>> pmma = vc.Material(vc.Elastic(1e9), 0.4)
    >>> ds = vc.simulate(vc.Sphere(0.01), pmma, vc.step(100.0), times=[1.0], errors=False)
    >>> run_data(ds)["scalars"]["force"]["value"], run_data(ds)["given"]
    ([100.0], {'force': 'Force'})
    """
    if not ds.sizes.get("time"):
        raise ValueError("figures need one instant at least, got a result without any; run it")
    given, answers = panel_labels(ds)
    return {
        "title": title_of(ds),
        "time": rounded(ds["time"].values, 12),
        "logTime": bool(suits_log_time(ds)),
        "scalars": {name: _scalar(ds, name) for name in SCALARS if name in ds},
        "given": given,
        "answers": answers,
        "facts": shown_labels(ds, Place.FACTS),
        "listed": summary_scalars(ds),
        "map": _map(ds),
        "loops": loops_data(ds),
        "notices": notices(ds),
        "warnings": warnings_of(ds),
        "accuracy": list(accuracy_lines(ds)),
    }


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
        "times": [each.time for each in fields.snapshots],
        "lengthFactor": fields.window.unit.factor,
        "pressureFactor": readable_unit("Pa", fields.peak).factor,
        "sections": curves_data(ds, fields),
        "crossings": fields.through,
    }
