"""Stresses below the contact, labelled: from a result to another dataset."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.stress import Stress
from viscontact.mechanics.halfspace.stress_influence import COMPONENTS
from viscontact.results.recorded_case import across_period
from viscontact.results.stress_source import Body, stress_source
from viscontact.units.numbers import finite, real_array

#: Largest default depth, in half widths of the contact.
REACH = 2.0


def section_stresses(
    results: xr.Dataset,
    depths: ArrayLike | None = None,
    *,
    x: float | None = None,
    y: float | None = None,
    times: Sequence[float] | None = None,
    poisson_ratio: float | None = None,
    body: Body = "material",
) -> xr.Dataset:
    """Stresses in the half-space or the layers on a plane below the contact, at stored instants.

    Parameters
    ----------
    results : xarray.Dataset
        Result of `simulate` or `open_results`, with stored pressure.
    depths : array_like, shape (nz,), optional
        Depths below the surface, 0 or positive [m]; from 0 to two half widths of the largest
        contact when left out. At an interface the stresses are those of the layer above; the
        depths that are chosen have a second one just below it.
    x, y : float, optional
        Position of the plane, one of them [m]; when both are left out, the plane of given y
        through the grid's middle, or that of given x across a grid that is periodic along x only.
    times : sequence of float, optional
        Instants [s], the nearest stored ones are taken; all when left out.
    poisson_ratio : float, optional
        Of the half-space [-]; the result's own when left out. Not for layers.
    body : {"material", "indenter_material"}, optional
        The pressed body or the indenter, which is treated as a half-space or as layers; z points
        into it.

    Returns
    -------
    xarray.Dataset
        ``stress_xx`` ... ``stress_xy`` (tension positive), ``von_mises`` and ``max_shear`` [Pa]
        over (time, z, x), or (time, z, y) on a plane of given x; NaN beyond the ends of a body.

    Raises
    ------
    ValueError
        If no pressure is stored, Poisson's ratio is not known or varies in time, layers creep
        differently and pressure is stored at some instants only, layers end at a free face, a depth
        is in a rigid base or more than 50 half lengths below a body between two ends, x lies beyond
        an end, or an argument is invalid.

    Notes
    -----
    For a constant Poisson's ratio the stresses follow from the present pressure alone, under
    friction from the tractions, too, whatever the body remembers: see
    `viscontact.mechanics.halfspace.stress`. In layers that creep
    differently they follow from its history, in terms whose relative error is the attribute
    ``splitting_error``: the pressure of all instants from time 0 on has to be stored.

    A body that ends has the stresses of its pressure with all images about its ends, and of what
    frees its free ends (``viscontact.mechanics.halfspace.ended_stress``). The attributes
    ``ends_error`` and ``end_stress_left`` are those of the result.

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
    source = stress_source(results, body, poisson_ratio)
    if depths is None:
        below = source.depths(_usual_depth(results, source.grid))
    else:
        below = np.atleast_1d(real_array("depths", depths, "m"))
    x, y = (
        each if each is None else finite(name, each, "m") for name, each in (("x", x), ("y", y))
    )
    if x is None and y is None and across_period(results) == "y":
        x = source.grid.centre[0]
    places = source.places(times)
    found = source.on_section(places, below, x, y)
    along = "x" if x is None else "y"
    depth = {"units": "m", "long_name": "depth below the surface", "positive": "down"}
    coordinates = {
        "time": source.time(places),
        "z": ("z", below, depth),
        along: results[along],
    }
    attributes = {"splitting_error": source.splitting_error, **source.errors_of_ends}
    return xr.Dataset(_variables(found, along), coords=coordinates, attrs=attributes)


def _usual_depth(results: xr.Dataset, grid: Grid) -> float:
    """Two half widths of the largest contact [m]."""
    extents = [results["contact_length"].values, results["contact_width"].values]
    for axis, size in enumerate(grid.size):
        if not grid.has_datum and grid.periodic[axis]:  # a strip through the period has no end
            extents[axis] = np.where(extents[axis] >= size, np.inf, extents[axis])
    half_width = float(np.minimum(*extents).max()) / 2
    if not half_width > 0:
        raise ValueError("there is no contact at any instant; give depths=")
    return REACH * half_width


def _variables(found: Stress, along: str) -> dict[str, Any]:
    """Variables over time, depth and the section."""
    fields: dict[str, Any] = {}
    for name in COMPONENTS:
        fields[f"stress_{name}"] = (f"stress component {name}, tension positive", found[name])
    fields["von_mises"] = ("von Mises stress", found.von_mises)
    fields["max_shear"] = ("largest shear stress", found.max_shear)
    return {
        name: (("time", "z", along), values, {"units": "Pa", "long_name": meaning})
        for name, (meaning, values) in fields.items()
    }
