"""Plain data of a run: scalars, summary, warnings and accuracy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.report.accuracy import accuracy_lines
from viscontact.report.limits import notices, warnings_of
from viscontact.report.result_chapters import title_of
from viscontact.results.last_cycle_values import worst_places
from viscontact.results.run_axis import in_order, run_axis
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.stated_errors import errors_of
from viscontact.results.summary import summary_scalars
from viscontact.results.variables import SCALARS, Place, scalars_in


def run_data(ds: xr.Dataset) -> dict[str, Any]:
    """Return the numbers and texts of a run for JSON [SI]; ValueError without a row."""
    # JSON has no NaN and inf: null where there is no value or an error is unknown; `mesh` marks
    # places at which a scalar depends on the mesh.
    axis = run_axis(ds)
    if not ds.sizes.get(axis.name):
        raise ValueError(f"a page needs one {axis.row} at least, got a result without any; run it")
    ds = in_order(ds)
    return {
        "title": title_of(ds),
        "axis": _axis(ds),
        "scalars": {name: _scalar(ds, name) for name in scalars_in(ds)},
        "facts": shown_labels(ds, Place.FACTS),
        "worst": _worst(ds),
        "listed": summary_scalars(ds),
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
    """Instants or speeds, and how they are named and written."""
    axis = run_axis(ds)
    return {
        **{"name": axis.name, "unit": axis.unit, "symbol": axis.symbol, "row": axis.row},
        "values": _finite_or_none(axis.values(ds), 12),
    }


def _scalar(ds: xr.Dataset, name: str) -> dict[str, Any]:
    values = np.asarray(ds[name].values, dtype=np.float64)
    errors = errors_of(ds, name)
    return {
        "unit": SCALARS[name].units,
        "meaning": SCALARS[name].long_name,
        "value": _finite_or_none(values, 9),
        "error": _finite_or_none(errors, 9),
        "mesh": np.isposinf(errors).tolist(),
    }


def _finite_or_none(values: Floats, digits: int) -> list[float | None]:
    """Numbers rounded to significant digits for JSON, None in place of NaN and inf."""
    return [float(f"{v:.{digits - 1}e}") if math.isfinite(v) else None for v in values.tolist()]
