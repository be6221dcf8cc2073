"""Notes on what a figure draws."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import depends_on_mesh
from viscontact.results.run_axis import run_axis
from viscontact.results.variables import MESH_DEPENDENT


def peak_note(runs: Iterable[xr.Dataset], times: ArrayLike | None = None) -> str:
    """Note on peaks that depend on the mesh at the drawn instants [s]; empty if none does."""
    for run in runs:
        shown = run_axis(run).values(run) if times is None else np.atleast_1d(np.asarray(times))
        if any(depends_on_mesh(run, shown)):
            return f"peak {MESH_DEPENDENT}"
    return ""
