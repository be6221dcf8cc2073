"""Measured surface of a run, reconstructed on its grid from the stored fields."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from viscontact.bodies.indenters import HeightMap


def is_left_out(described: Any) -> bool:
    """Test for a described object of which a result keeps a fingerprint only: a large map."""
    return '"sha256"' in json.dumps(described)


def recorded_surface(ds: xr.Dataset) -> HeightMap:
    """Return the indenter on the grid of a run, from the fields that are stored."""
    missing = {"gap", "displacement"} - set(ds.variables)
    if missing or not ds["gap"].size:
        raise ValueError(
            "the surface is measured, results do not store it, and there are no fields to "
            "compute it from; store some (output.fields)"
        )
    # From gap = initial gap + displacement - approach - tilt_x x - tilt_y y (eq. 1), at the last
    # stored instant: the grid is the whole one by then. The level of a map does not matter, so that
    # a line contact, whose approach has no datum, counts from 0.
    over = str(ds["gap"].dims[0])
    last = ds[["gap", "displacement"]].isel({over: -1}).transpose("x", "y")
    motion = ds[["approach", "tilt_x", "tilt_y"]].sel(time=float(ds[over][-1]), method="nearest")
    x, y = ds["x"].values, ds["y"].values
    rigid = np.nan_to_num(motion["approach"].item()) + motion["tilt_x"].item() * x[:, None]
    gap = last["gap"].values - last["displacement"].values + rigid + motion["tilt_y"].item() * y
    known = np.where(np.isfinite(gap), gap, np.nan)
    if not np.isfinite(known).any():
        raise ValueError("the surface is a measured one, and no gap of it is stored")
    return HeightMap(x, y, -known, holes=True)
