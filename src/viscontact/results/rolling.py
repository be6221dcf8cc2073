"""Tractions of a result over speed and creepage, as tables and figures show them."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.recorded_case import case_of
from viscontact.results.variables import error_name, per_length


def has_creepages(results: xr.Dataset) -> bool:
    """True for a result of steady motion with tractions over the creepage."""
    return "creepage" in results.dims


@dataclass(frozen=True, eq=False)
class TractionCurves:
    """Part of what friction carries that a body pushes the half-space back with, by speed."""

    speeds: Floats  # ascending [m/s]
    creepages: Floats  # ascending [-]
    parts: Floats  # over friction times force, positive where the body drives, by speed [-]
    errors: Floats  # NaN where unknown


def traction_curves(results: xr.Dataset) -> TractionCurves:
    """Traction over the creepage of a result, in order; ValueError without."""
    if not has_creepages(results):
        raise ValueError(
            "traction-creepage: needs a result of steady motion under friction, got one without "
            "creepages; use steady(..., friction=, creepage=)"
        )
    ordered = results.sortby(["speed", "creepage"])
    name = f"tangential_force_{results.attrs['along']}"
    coefficient = float(case_of(results)["friction"]["coefficient"])
    carried = coefficient * ordered["force"].values[:, None]
    parts: Floats = -ordered[name].values / carried
    known = error_name(name) in ordered
    errors = ordered[error_name(name)].values / carried if known else np.full(parts.shape, np.nan)
    return TractionCurves(ordered["speed"].values, ordered["creepage"].values, parts, errors)


def tabled_names(results: xr.Dataset) -> list[str]:
    """Names of the values over the creepage that a table shows."""
    force = f"tangential_force_{results.attrs['along']}"
    names = (force, "slip_fraction", "drive_torque", "friction_power", "traction_dissipation")
    lengths = {name: per_length(name) for name in names}
    found = [each if (each := lengths[name]) in results else name for name in names]
    return [name for name in found if np.isfinite(results[name].values).any()]
