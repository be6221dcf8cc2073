"""Leakage that the case of a result asks for."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from viscontact.mechanics.state import LEAKAGE
from viscontact.results.leakage.leakage import leakage
from viscontact.results.run_axis import run_axis
from viscontact.results.variables import OF_LEAKAGE, OF_LEAKAGE_Y, error_name
from viscontact.units.formatting import format_quantity


def leakage_settings(ds: xr.Dataset) -> dict[str, Any]:
    """Arguments of `leakage` that the case of a result gives; empty without a section."""
    try:
        found = json.loads(str(ds.attrs.get(LEAKAGE, "")))
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def case_leakage(ds: xr.Dataset, *, last: bool = False) -> xr.Dataset | None:
    """Leakage at all stored instants, or the last one; None where the case asks for none.

    None as well for a run that has not stored a gap yet.
    """
    settings = leakage_settings(ds)
    if not settings or "gap" not in ds or not ds.sizes[str(ds["pressure"].dims[0])]:
        return None
    shown = ds.isel({str(ds["pressure"].dims[0]): [-1]}) if last else ds
    return leakage(shown, **settings)


def leakage_lines(ds: xr.Dataset) -> list[str]:
    """Leakage at the last stored instant in sentences, one for each direction."""
    try:
        stated = _stated(ds)
        found = case_leakage(ds, last=True) if stated is None else stated
    except ValueError as error:  # the channel leads beyond the body, or is too large
        return [str(error)]
    if found is None:
        return []
    place = run_axis(found).place(float(run_axis(found).values(found)[-1]))
    several = "direction" in found.dims
    directions = found["direction"].values.tolist() if several else [""]
    lines = []
    for direction in directions:
        row = found.sel(direction=direction) if several else found
        where = f"leakage at {place}{f' along {direction}' if direction else ''}"
        lines.append(f"{where}: {_in_words(row)}")
    return lines


def _stated(ds: xr.Dataset) -> xr.Dataset | None:
    """Leakage at the last stored instant by the scalars of a run; None where they are not known."""
    if "transmissivity" not in ds or "pressure" not in ds:
        return None
    places, axis = ds[str(ds["pressure"].dims[0])].values, run_axis(ds)
    if not places.size:
        return None
    last = ds.isel({axis.name: [int(np.abs(axis.values(ds) - places[-1]).argmin())]})
    names = [*OF_LEAKAGE, *map(error_name, OF_LEAKAGE)]
    row = last[names]
    if "transmissivity_y" in ds:
        along_y = [*OF_LEAKAGE_Y, *map(error_name, OF_LEAKAGE_Y)]
        across = last[along_y].rename(dict(zip(along_y, names, strict=True)))
        row = xr.concat([row, across], xr.Variable("direction", ["x", "y"]))
    gap = np.cbrt(12 * row["transmissivity"])
    known = bool(np.isfinite(row["transmissivity"]).all())
    return row.assign(effective_gap=gap, percolates=gap > 0) if known else None


def gaps_in_words(ds: xr.Dataset) -> list[str]:
    """Gaps of the leakage at the last stored instant, without its rate, one for each direction."""
    return [line.partition(", leak rate")[0] for line in leakage_lines(ds)]


def _in_words(row: xr.Dataset) -> str:
    if not float(row["percolates"][-1]):
        return "closed, no channel leads through"
    critical, effective = (float(row[name][-1]) for name in ("critical_gap", "effective_gap"))
    text = (
        f"critical gap {format_quantity(critical, 'm', 3)} "
        f"(error {_relative(critical, float(row['critical_gap_error'][-1]))}), "
        f"effective gap {format_quantity(effective, 'm', 3)}"
    )
    rate, error = float(row["leak_rate"][-1]), float(row["leak_rate_error"][-1])
    if not np.isfinite(rate):
        return text
    stated = f"leak rate {format_quantity(rate, 'm3 s-1', 3)} (error {_relative(rate, error)})"
    return f"{text}, {stated}"


def _relative(value: float, error: float) -> str:
    """Error over a value in words."""
    return f"{100 * error / value:.2g} %" if error < value else f"a factor {1 + error / value:.2g}"
