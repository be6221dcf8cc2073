"""Largest values over time or speed of the scalars of many runs, as `open_many` returns them."""

from __future__ import annotations

import re
from collections.abc import Hashable

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.results.shown_scalars import LONG, OF_LONG_CONTACTS
from viscontact.results.variables import Place, error_name, shown_in

#: Coordinates of runs that are no varied keys.
_NO_KEYS = ("run", "name")


def run_dims(ds: xr.Dataset) -> tuple[Hashable, ...]:
    """Dimensions of the runs in the joint result of a sweep."""
    return ds["state"].dims


def over_of(ds: xr.Dataset) -> str:
    """Quantity over which the runs of a sweep go, ``"time"`` or ``"speed"``.

    >>> over_of(xr.Dataset({"speed": (("run", "step"), [[1.0]])}))
    'speed'
    """
    return "speed" if "speed" in ds.variables else "time"


def varied_keys(ds: xr.Dataset) -> list[str]:
    """Coordinates of a sweep, or its cases, of which there are several values.

    >>> ds = xr.Dataset({"state": ("F", ["done", "done"])}, {"F": [1.0, 2.0], "G": ("F", [5, 5])})
    >>> varied_keys(ds)
    ['F']
    """
    dims = set(run_dims(ds))
    names = [str(name) for name in ds.coords if ds[name].dims and set(ds[name].dims) <= dims]
    return [name for name in names if name not in _NO_KEYS and np.unique(ds[name]).size > 1]


def key_label(key: str) -> str:
    """Key in words, for axes and headings of tables.

    >>> key_label("material.delayed_modulus"), key_label("indenter[2].radius")
    ('Material delayed modulus', 'Indenter 2 radius')
    """
    words = " ".join(re.findall(r"[^\W_]+", key))
    return words[:1].upper() + words[1:]


def largest_values(ds: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray]:
    """Largest magnitudes of a scalar over time or speed, and their errors, for each run.

    Both are NaN for a run without a result; the error is NaN if it is unknown.

    >>> force = (("run", "time"), [[1.0, -3.0], [np.nan, np.nan]])
    >>> ds = xr.Dataset({"state": ("run", ["done", "failed"]), "force": force})
    >>> largest_values(ds, "force")[0].values
    array([ 3., nan])
    """
    along = str(ds[name].dims[-1])  # time, speed or step
    size = abs(ds[name])
    at = size.fillna(-1.0).argmax(along)
    error = error_name(name)
    bars = ds[error] if error in ds else xr.full_like(size, np.nan)
    return size.isel({along: at}), bars.isel({along: at})


def compared_scalars(ds: xr.Dataset) -> list[str]:
    """Names of the chief scalars of a sweep that differ between its runs, and are not varied."""
    sizes = {name: largest_values(ds, name)[0] for name in chief_scalars(ds)}
    return [name for name, each in sizes.items() if np.ptp(_known(each)) > 1e-6 * each.max()]


def chief_scalars(ds: xr.Dataset) -> list[str]:
    """Names of the chief scalars of the finished runs of a sweep that are not varied."""
    given = {key.rpartition(".")[2] for key in varied_keys(ds)}
    found = []
    for name in shown_in(Place.KEY, ds):
        if name in given or (name in OF_LONG_CONTACTS and not _has_long_contact(ds)):
            continue
        if _known(largest_values(ds, name)[0]).size:
            found.append(name)
    return found


def _known(values: xr.DataArray) -> Floats:
    found: Floats = values.values[np.isfinite(values.values)]
    return found


def _has_long_contact(ds: xr.Dataset) -> bool:
    length, width = (largest_values(ds, f"contact_{each}")[0] for each in ("length", "width"))
    return bool(((length >= LONG * width) & (width > 0)).any())
