"""Notes on what a figure draws."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.drawing.content.compared_runs import depends_on_mesh
from viscontact.results.run_axis import run_axis
from viscontact.results.variables import MESH_DEPENDENT
from viscontact.units.numbers import real_array


def peak_note(runs: Iterable[xr.Dataset], times: ArrayLike | None = None) -> str:
    """Note on peaks that depend on the mesh at the drawn instants [s]; empty if none does."""
    for run in runs:
        axis = run_axis(run)
        shown = axis.values(run) if times is None else real_array(f"{axis.name}s", times, axis.unit)
        if any(depends_on_mesh(run, np.atleast_1d(shown))):
            return f"peak {MESH_DEPENDENT}"
    return ""
