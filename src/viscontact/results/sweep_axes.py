"""Axes of the joint result of a sweep: its runs, the keys that vary, time or speed."""

from __future__ import annotations

import re
from collections.abc import Hashable

import numpy as np
import xarray as xr

#: Coordinates of runs that are no varied keys.
_NO_KEYS = ("run", "name")


def run_dims(ds: xr.Dataset) -> tuple[Hashable, ...]:
    """Dimensions of the runs in the joint result of a sweep."""
    return ds["state"].dims


def over_of(ds: xr.Dataset) -> str:
    """Quantity over which the runs of a sweep go, ``"time"`` or ``"speed"``."""
    return "speed" if "speed" in ds.variables else "time"


def varied_keys(ds: xr.Dataset) -> list[str]:
    """Coordinates of a sweep, or its cases, of which there are several values."""
    dims = set(run_dims(ds))
    names = [str(name) for name in ds.coords if ds[name].dims and set(ds[name].dims) <= dims]
    return [name for name in names if name not in _NO_KEYS and np.unique(ds[name]).size > 1]


def key_label(key: str) -> str:
    """Key in words, for axes and headings of tables."""
    words = " ".join(re.findall(r"[^\W_]+", key))
    words = re.sub(r"(?:material )?layers (?=\d)", "layer ", words)
    return words[:1].upper() + words[1:]
