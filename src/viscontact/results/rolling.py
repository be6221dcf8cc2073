"""Tractions of a result over speed and creepage, as tables and figures show them."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.descriptions import describe
from viscontact.results.recorded_case import case_of
from viscontact.results.variables import CURVES, FRICTION_FIELDS, error_name, per_length

#: Relative difference of creepages that are one.
SAME = 1e-9


def has_creepages(results: xr.Dataset) -> bool:
    """True for a result of steady motion with tractions over the creepage."""
    return "creepage" in results.dims


def at_creepage(results: xr.Dataset, creepage: float) -> xr.Dataset:
    """Result at one of its creepages, as of a run at this one; ValueError if it is none of them."""
    known = results["creepage"].values if has_creepages(results) else np.empty(0)
    found = np.flatnonzero(np.isclose(known, creepage, rtol=SAME, atol=0.0))
    if not found.size:
        listed = ", ".join(f"{each:g}" for each in known.tolist()) or "none"
        raise ValueError(
            f"creepage: must be one of those of the result ({listed}), got {creepage:g}"
        )
    chosen = results.isel(creepage=found[:1])
    names = {*CURVES, *map(error_name, CURVES), *FRICTION_FIELDS}
    contact = [name for name in chosen.data_vars if name not in names]
    single = {
        name: chosen[name].isel(creepage=0, drop=True)
        for name in contact
        if "creepage" in chosen[name].dims
    }
    case = case_of(results)
    case = case | {"motion": case["motion"] | {"creepage": describe(chosen["creepage"].values)}}
    return chosen.assign(single).assign_attrs(case=json.dumps(case))


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
    force = ordered["force"].values
    carried = coefficient * (force if force.ndim == 2 else force[:, None])
    parts: Floats = -ordered[name].values / carried
    known = error_name(name) in ordered
    errors = ordered[error_name(name)].values / carried if known else np.full(parts.shape, np.nan)
    return TractionCurves(ordered["speed"].values, ordered["creepage"].values, parts, errors)


def rolls_askew(results: xr.Dataset) -> bool:
    """True for a body with a lateral creepage or a spin, which is pushed across its motion, too."""
    motion = case_of(results)["motion"]
    return any(motion.get(name) for name in ("lateral_creepage", "spin"))


def shown_forces(results: xr.Dataset) -> list[str]:
    """Names of the forces that tables show: across the motion where the body rolls askew."""
    along = results.attrs["along"]
    across = {"x": "y", "y": "x"}[along] if rolls_askew(results) else ""
    names = [f"tangential_force_{each}" for each in (*along, *across)]
    return _shown_per_length(results, names)


def tabled_names(results: xr.Dataset) -> list[str]:
    """Names of the values over the creepage that a table shows."""
    names = ("slip_fraction", "drive_torque", "friction_power", "traction_dissipation")
    return [*shown_forces(results), *_shown_per_length(results, names)]


def _shown_per_length(results: xr.Dataset, names: Sequence[str]) -> list[str]:
    """The names, of a line contact per unit length, of the values that are known."""
    lengths = {name: per_length(name) for name in names}
    found = [each if (each := lengths[name]) in results else name for name in names]
    return [name for name in found if np.isfinite(results[name].values).any()]
