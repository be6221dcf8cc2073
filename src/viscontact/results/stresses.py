"""Stresses below the contact, labelled: from a result to another dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from viscontact.grid import Grid
from viscontact.halfspace.stress import Stress, stress_on_section
from viscontact.halfspace.stress_influence import COMPONENTS
from viscontact.results.recorded_case import (
    across_period,
    recorded_grid,
    recorded_poisson_ratio,
    refuse_layers,
)

#: Default depths: their number, and the largest in half widths of the contact.
DEPTHS, REACH = 61, 2.0


def section_stresses(
    results: xr.Dataset,
    depths: ArrayLike | None = None,
    *,
    x: float | None = None,
    y: float | None = None,
    times: Sequence[float] | None = None,
    poisson_ratio: float | None = None,
) -> xr.Dataset:
    """Stresses in the half-space on a plane below the contact, at the stored instants.

    Parameters
    ----------
    results : xarray.Dataset
        Result of `simulate` or `open_results`, with stored pressure.
    depths : array_like, shape (nz,), optional
        Depths below the surface, 0 or positive [m]; from 0 to two half widths of the largest
        contact when left out.
    x, y : float, optional
        Position of the plane, one of them [m]; when both are left out, the plane of given y
        through the grid's middle, or that of given x across a grid that is periodic along x only.
    times : sequence of float, optional
        Instants [s], the nearest stored ones are taken; all when left out.
    poisson_ratio : float, optional
        Of the half-space [-]; the result's own when left out.

    Returns
    -------
    xarray.Dataset
        ``stress_xx`` ... ``stress_xy`` (tension positive), ``von_mises`` and ``max_shear`` [Pa]
        over (time, z, x), or (time, z, y) on a plane of given x.

    Raises
    ------
    ValueError
        If no pressure is stored, Poisson's ratio is not known or varies in time, or an argument
        is invalid.

    Notes
    -----
    For a constant Poisson's ratio the stresses follow from the present pressure alone, whatever
    the body remembers: see `viscontact.halfspace.stress`.

    Examples
    --------
    A ball makes a body of ν = 0.3 yield below the surface first, at 0.62 of the peak pressure:

    >>> import viscontact as vc
    >>> steel = vc.Material(vc.Elastic(80e9), poisson_ratio=0.3)
    >>> grid = vc.Grid((49, 49), (0.6e-3, 0.6e-3))
    >>> ds = vc.simulate(vc.Paraboloid(0.01, 0.01), steel, vc.step(100.0), grid, [0.0])
    >>> inside = vc.section_stresses(ds)
    >>> round(float(inside.von_mises.max() / ds.peak_pressure[0]), 2)
    0.62
    """
    if "pressure" not in results:
        raise ValueError(
            "stresses need stored pressure; run again with fields stored ('output: fields: all' "
            "or a list of instants in the case file, fields= in Python)"
        )
    refuse_layers(results, "stresses")
    ratio = recorded_poisson_ratio(results) if poisson_ratio is None else poisson_ratio
    grid = recorded_grid(results)
    if depths is None:
        below = _usual_depths(results, grid)
    else:
        below = np.atleast_1d(np.asarray(depths, float))
    if x is None and y is None and across_period(results) == "y":
        x = grid.centre[0]
    pressure = _chosen(results["pressure"], times)
    fields = (np.asarray(field, dtype=np.float64) for field in pressure.values)
    found = [stress_on_section(field, grid, below, ratio, x=x, y=y) for field in fields]
    return _labelled(results, pressure, found, below, "x" if x is None else "y")


def _chosen(pressure: xr.DataArray, times: Sequence[float] | None) -> xr.DataArray:
    pressure = pressure.rename({pressure.dims[0]: "time"})
    return pressure if times is None else pressure.sel(time=list(times), method="nearest")


def _usual_depths(results: xr.Dataset, grid: Grid) -> NDArray[np.float64]:
    extents = [results["contact_length"].values, results["contact_width"].values]
    for axis, size in enumerate(grid.size):
        if not grid.has_datum and grid.periodic[axis]:  # a strip through the period has no end
            extents[axis] = np.where(extents[axis] >= size, np.inf, extents[axis])
    half_width = float(np.minimum(*extents).max()) / 2
    if not half_width > 0:
        raise ValueError("there is no contact at any instant; give depths=")
    return np.linspace(0.0, REACH * half_width, DEPTHS)


def _labelled(
    results: xr.Dataset,
    pressure: xr.DataArray,
    found: Sequence[Stress],
    depths: NDArray[np.float64],
    along: str,
) -> xr.Dataset:
    fields: dict[str, Any] = {}
    for name in COMPONENTS:
        meaning = f"stress component {name}, tension positive"
        fields[f"stress_{name}"] = (meaning, [stress[name] for stress in found])
    fields["von_mises"] = ("von Mises stress", [stress.von_mises for stress in found])
    fields["max_shear"] = ("largest shear stress", [stress.max_shear for stress in found])
    variables = {
        name: (("time", "z", along), np.stack(values), {"units": "Pa", "long_name": meaning})
        for name, (meaning, values) in fields.items()
    }
    depth = (
        "z",
        depths,
        {"units": "m", "long_name": "depth below the surface", "positive": "down"},
    )
    coordinates = {"time": pressure["time"], "z": depth, along: results[along]}
    return xr.Dataset(variables, coords=coordinates)
