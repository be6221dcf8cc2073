"""Largest values of the runs of a sweep over its varied keys: curves or points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.key_axis import is_number, key_axis, key_labels, places_on
from viscontact.results.largest_values import compared_scalars, largest_values
from viscontact.results.sweep_axes import run_dims, varied_keys

#: Most keys of runs that are no grid.
_MOST_KEYS = 4


@dataclass(frozen=True)
class SweptKeys:
    """Runs of a sweep: the chief scalars, and the keys, the longest axis first."""

    ds: xr.Dataset
    scalars: list[str]
    keys: list[str]
    is_grid: bool  # of one or two keys: curves over the first one; else points over each

    @property
    def numeric(self) -> list[str]:
        """Keys whose values are numbers."""
        return [key for key in self.keys if is_number(self.ds, key)]


@dataclass(frozen=True)
class RunGroup:
    """Some runs: places, largest values, errors [SI], and those without a result."""

    places: Floats  # on the axis
    values: Floats
    errors: Floats  # inf for a value that depends on the mesh
    missing: Bools
    names: list[str]
    label: str = ""
    is_joined: bool = False


def swept_keys(ds: xr.Dataset, figure: str) -> SweptKeys:
    """Scalars and keys to draw; ValueError, naming the figure, if there are none."""
    scalars, keys = compared_scalars(ds), varied_keys(ds)
    if not scalars or not keys:
        what = "scalar differs between the finished runs" if keys else "key is varied"
        raise ValueError(f"{figure}: no {what}; give a sweep of two finished runs or more")
    ds = ds.squeeze([dim for dim in run_dims(ds) if ds.sizes[dim] == 1], drop=True)
    if not set(keys) <= set(run_dims(ds)) or len(keys) > 2:
        return SweptKeys(ds, scalars, keys[:_MOST_KEYS], is_grid=False)
    numeric = [key for key in keys if is_number(ds, key)]
    ds = ds.sortby(numeric)
    keys = sorted(keys, key=lambda key: (key in numeric) * ds.sizes[key], reverse=True)
    return SweptKeys(ds, scalars, keys, is_grid=True)


def points_over(ds: xr.Dataset, name: str, key: str) -> RunGroup:
    """All runs over one key."""
    values, errors = (each.values.ravel() for each in largest_values(ds, name))
    places = xr.broadcast(ds[key], ds["state"])[0].transpose(*ds["state"].dims).values.ravel()
    missing = (ds["state"] != "done").values.ravel()
    return RunGroup(places_on(key_axis(ds, key), places), values, errors, missing, _names(ds))


def curves_over(ds: xr.Dataset, name: str, keys: list[str]) -> Iterator[RunGroup]:
    """Runs over the first key, for each value of the second one."""
    axis, missing = key_axis(ds, keys[0]), ds["state"] != "done"
    arrays = (*largest_values(ds, name), missing)
    values, errors, lost = (each.transpose(*keys).values for each in arrays)
    shape = (values.shape[0], -1)
    names = np.array(_names(ds.transpose(*keys, ...)), dtype=object).reshape(shape)
    labels = key_labels(ds, keys[1]) if len(keys) > 1 else [""]
    places = places_on(axis, ds[keys[0]].values)
    for row, label in enumerate(labels):
        value, error, is_lost = (each.reshape(shape)[:, row] for each in (values, errors, lost))
        yield RunGroup(
            places, value, error, is_lost, list(names[:, row]), label, is_joined=not axis.texts
        )


def _names(ds: xr.Dataset) -> list[str]:
    names = ds["name"].values.ravel() if "name" in ds else np.full(ds["state"].size, "")
    return [str(name) for name in names]
