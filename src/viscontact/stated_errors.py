"""What a result states of its own errors, and the words for a value that has no limit."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.variables import error_name

#: Said of a value whose stated error is infinite, and why it is.
MESH_DEPENDENT = "depends on the mesh"
WHY_MESH_DEPENDENT = "the number is the largest mean over a cell, and smaller cells give more"


def stated_error(results: xr.Dataset, name: str) -> NDArray[np.float64] | None:
    """Return half widths of the error bars of a scalar.

    Parameters
    ----------
    results : xarray.Dataset
        What ``simulate`` or ``open_results`` returned.
    name : str
        A scalar of the result.

    Returns
    -------
    ndarray or None
        Over time, in the unit of the scalar: NaN where it is not known, inf where the value
        depends on the mesh. None if the result states none.

    Examples
    --------
    >>> run = xr.Dataset({"approach": ("time", [1e-5]), "approach_error": ("time", [1e-7])})
    >>> stated_error(run, "approach"), stated_error(run, "force")
    (array([1.e-07]), None)
    """
    companion = error_name(name)
    if companion not in results:
        return None
    return np.asarray(results[companion].values, dtype=np.float64)


def mesh_dependent(results: xr.Dataset, name: str) -> NDArray[np.bool_]:
    """Tell at which instants a scalar depends on the mesh.

    Parameters
    ----------
    results : xarray.Dataset
        What ``simulate`` or ``open_results`` returned.
    name : str
        A scalar of the result.

    Returns
    -------
    ndarray of bool
        Over time; nowhere if the result states no errors.

    Examples
    --------
    >>> run = xr.Dataset({"force": ("time", [1.0, 2.0]), "force_error": ("time", [0.0, np.inf])})
    >>> mesh_dependent(run, "force").tolist()
    [False, True]
    """
    error = stated_error(results, name)
    return np.zeros(results.sizes["time"], dtype=np.bool_) if error is None else np.isposinf(error)
