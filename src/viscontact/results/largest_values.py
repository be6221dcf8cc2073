"""Largest values over time or speed of the scalars of many runs, as `open_many` returns them."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.results.shown_scalars import LONG, OF_LONG_CONTACTS
from viscontact.results.sweep_axes import varied_keys
from viscontact.results.variables import RUN_VALUES, Place, error_name, shown_in


def largest_values(ds: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray]:
    """Largest magnitudes of a scalar in each run, and their errors; NaN without result or error.

    A value of a whole run is returned as it is.
    """
    if name in RUN_VALUES:
        return ds[name], ds[error_name(name)]
    along = str(ds[name].dims[-1])  # time, speed or step
    size = abs(ds[name])
    at = size.fillna(-1.0).argmax(along)
    error = error_name(name)
    bars = ds[error] if error in ds else xr.full_like(size, np.nan)
    return size.isel({along: at}), bars.isel({along: at})


def compared_scalars(ds: xr.Dataset) -> list[str]:
    """Names of the chief scalars of a sweep that differ between its runs, and are not varied."""
    sizes = {name: largest_values(ds, name)[0] for name in chief_scalars(ds)}
    return [name for name, each in sizes.items() if np.ptp(_known_values(each)) > 1e-6 * each.max()]


def chief_scalars(ds: xr.Dataset) -> list[str]:
    """Names of the chief scalars of the finished runs of a sweep that are not varied."""
    given = {key.rpartition(".")[2] for key in varied_keys(ds)}
    found = []
    values = [name for name, each in RUN_VALUES.items() if name in ds and Place.KEY in each.places]
    for name in [*values, *shown_in(Place.KEY, ds)]:
        if name in given or (name in OF_LONG_CONTACTS and not _has_long_contact(ds)):
            continue
        if _known_values(largest_values(ds, name)[0]).size:
            found.append(name)
    return found


def _known_values(values: xr.DataArray) -> Floats:
    found: Floats = values.values[np.isfinite(values.values)]
    return found


def _has_long_contact(ds: xr.Dataset) -> bool:
    length, width = (largest_values(ds, f"contact_{each}")[0] for each in ("length", "width"))
    return bool(((length >= LONG * width) & (width > 0)).any())
