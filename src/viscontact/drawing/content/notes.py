"""Notes on what a figure draws."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import mesh_dependent
from viscontact.results.variables import MESH_DEPENDENT


def peak_note(runs: Iterable[xr.Dataset], times: ArrayLike | None = None) -> str:
    """Note on peak pressures that depend on the mesh at the drawn instants [s]; empty if none does.

    >>> peak = ("time", [np.inf, 1.0])
    >>> run = xr.Dataset({"peak_pressure_error": peak}, coords={"time": [0.0, 1.0]})
    >>> peak_note([run]), peak_note([run], [0.9])
    ('peak depends on the mesh', '')
    """
    for run in runs:
        marked, instants = mesh_dependent(run, "peak_pressure"), run_axis(run).values(run)
        wanted = instants if times is None else np.atleast_1d(np.asarray(times, dtype=float))
        if any(marked[np.abs(instants - instant).argmin()] for instant in wanted):
            return f"peak {MESH_DEPENDENT}"
    return ""
