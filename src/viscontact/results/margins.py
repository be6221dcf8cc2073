"""Margins of a result to the allowable values of its case, at each instant."""

from __future__ import annotations

import numpy as np
import xarray as xr

from viscontact.results.run_axis import run_axis
from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import SCALARS
from viscontact.results.verdicts import verdicts

#: Prefix of the name of a margin.
PREFIX = "margin_"


def margins(results: xr.Dataset) -> xr.Dataset:
    """Return the margins of the limited scalars at each instant, or each speed.

    The margin of a value v with the error e to an allowable value a is (a - abs(v) - e) / a: below
    zero if the value with its error is beyond the limit, NaN if there is no value or its error is
    not known, and -inf if it depends on the mesh, as it has no limit on smaller cells. Stresses
    below the surface are known at one instant only, and have a margin in their verdict.

    Parameters
    ----------
    results : xarray.Dataset
        Result of a case with ``allowable:`` values.

    Returns
    -------
    xarray.Dataset
        ``margin_<name>`` [1] for each limited scalar; empty without limits.

    Examples
    --------
    >>> size = {"force": ("time", [4.0, 7.0]), "force_error": ("time", [1.0, 1.0])}
    >>> run = xr.Dataset(size, {"time": [0.0, 1.0]}, {"allowable": '{"force": {"limit": 10.0}}'})
    >>> margins(run).margin_force.values.round(3).tolist()
    [0.5, 0.2]
    """
    axis = run_axis(results).name
    found = {}
    for each in verdicts(results):
        if each.name not in results:
            continue
        values, errors = np.abs(results[each.name].values), errors_of(results, each.name)
        margin = 1 - (values + errors) / each.limit
        label = SCALARS[each.name].label.lower()
        about = {"units": "1", "long_name": f"margin of the {label} to {each.allowed}"}
        found[f"{PREFIX}{each.name}"] = xr.Variable(axis, margin, about)
    return xr.Dataset(found, {axis: results[axis]})
