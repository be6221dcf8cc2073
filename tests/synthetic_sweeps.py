"""Joint results of sweeps with given numbers, for tests of figures and pages."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from viscontact.results.variables import SCALARS


def hertz_sweep(**keys: tuple[Sequence[float] | Sequence[str], str]) -> xr.Dataset:
    """Grid of runs over keys ``load__force`` [N] and ``indenter__radius`` [m], and others.

    The approach is (F**2 / R)**(1/3) in µm, as Hertz's up to a factor, and half as large at first;
    its error is a tenth. All other scalars are those of the force.
    """
    coords = {
        name.replace("__", "."): (name.replace("__", "."), list(values), {"units": units})
        for name, (values, units) in keys.items()
    }
    dims, shape = tuple(coords), tuple(len(values) for values, _ in keys.values())
    ones = xr.DataArray(np.ones(shape), coords, dims)
    force, radius = (ones * ones.coords.get(key, 1.0) for key in ("load.force", "indenter.radius"))
    numbers = {
        "force": force,
        "approach": 1e-6 * (force**2 / radius) ** (1 / 3),
        "contact_area": 1e-6 * (force * radius) ** (2 / 3),
        "peak_pressure": 1e6 * (force / radius**2) ** (1 / 3),
    }
    instants = xr.DataArray([0.5, 1.0], {"time": [0.0, 1.0]}, "time")
    ds = xr.Dataset({name: each * instants for name, each in numbers.items()})
    for name in numbers:
        ds[name].attrs = SCALARS[name].attributes
        ds[f"{name}_error"] = 0.1 * ds[name]
    for name in ("contact_length", "contact_width"):
        ds[name] = ds["approach"]
    runs = np.arange(ones.size).reshape(shape)
    names = np.array([f"run {n}" for n in range(ones.size)]).reshape(shape)
    texts = {"state": (dims, np.full(shape, "done")), "message": (dims, np.full(shape, ""))}
    return (
        ds.assign(texts).assign_coords(coords).assign_coords(run=(dims, runs), name=(dims, names))
    )


def listed(ds: xr.Dataset) -> xr.Dataset:
    """The same runs along the dimension ``run``."""
    keys = list(ds["state"].dims)
    numbers = {key: ds[key].attrs for key in keys}
    ds = ds.drop_vars("run").stack(run=keys).reset_index("run")
    ds = ds.assign_coords(run=np.arange(ds.sizes["run"])).transpose("run", "time")
    for key, attributes in numbers.items():
        ds[key].attrs = attributes
    return ds
