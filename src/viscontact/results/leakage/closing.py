"""Closing and opening of a contact: between which instants, and at which force."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.run_axis import run_axis
from viscontact.results.stored_contact import cells_in_contact
from viscontact.units.formatting import format_quantity


def scalar_at_fields(ds: xr.Dataset, name: str) -> Floats:
    """A scalar at the stored instants or speeds; NaN where a result lacks it."""
    places, axis = ds[str(ds["pressure"].dims[0])].values, run_axis(ds)
    if name not in ds:
        return np.full(places.shape, np.nan)
    rows = np.abs(axis.values(ds)[:, None] - places).argmin(axis=0)
    return np.asarray(ds[name].values[rows], dtype=np.float64)


def contact_shares(ds: xr.Dataset) -> Floats:
    """Contact area over nominal area at the stored instants, by cells where it is not stored."""
    shares = scalar_at_fields(ds, "contact_area") / recorded_grid(ds).area
    cells = [float(np.mean(cells_in_contact(ds, index))) for index in range(shares.size)]
    return np.where(np.isnan(shares), cells, shares)


def closing_force(opened: Bools, force: Floats) -> tuple[float, float]:
    """Force at which the flow first stops and half of its uncertainty [N]; NaN if it does not.

    >>> closing_force(np.array([True, True, False]), np.array([1.0, 2.0, 3.0]))
    (2.5, 0.5)
    """
    closes = np.flatnonzero(opened[:-1] & ~opened[1:])
    if not closes.size:
        return np.nan, np.nan
    before, after = force[closes[0]], force[closes[0] + 1]
    return float(before + after) / 2, float(abs(after - before)) / 2


def changes(found: xr.Dataset) -> Iterator[str]:
    """Sentences on each closing and opening along the directions of a leakage."""
    directions = found["direction"].values.tolist() if "direction" in found.dims else [""]
    axis = run_axis(found)
    places = axis.values(found)
    for direction in directions:
        one = found.sel(direction=direction) if direction else found
        opened, force = one["percolates"].values > 0, found["force"].values
        for at in np.flatnonzero(opened[:-1] != opened[1:]).tolist():
            pair = [axis.quantity(float(places[k])) for k in (at, at + 1)]
            verb = "closes" if opened[at] else "opens"
            along = f" along {direction}" if direction else ""
            yield f"{verb}{along} between {pair[0]} and {pair[1]}{_under(*force[at : at + 2])}"


def _under(before: float, after: float) -> str:
    if np.isnan(before) or np.isnan(after):
        return ""
    if abs(after - before) <= 1e-6 * max(abs(before), abs(after)):
        return f", under {format_quantity(float(after), 'N', 3)}"
    low, high = (format_quantity(float(each), "N", 3) for each in sorted((before, after)))
    return f", at a force of {low} to {high}"
