"""A paraboloid that moves over a creeping body, as tests of moving contacts press it."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import xarray as xr

import viscontact as vc

#: A Zener body that relaxes from 2000 to 200 with a retardation time of 10; J = Phi for nu = 0.
J0, J1, TIME = 1 / 2000, 1 / 200 - 1 / 2000, 10.0
ZENER = vc.Material(vc.CreepSeries(J0, [J1], [TIME]), poisson_ratio=0.0)
ELASTIC = vc.Material(vc.Elastic(1 / (2 * J0)), poisson_ratio=0.0)
BODY = vc.Paraboloid(10.0, 10.0)
LEVEL = vc.step(10.0, tilt_x=0.0, tilt_y=0.0)


def travelled(
    material: vc.Material = ZENER,
    along: Literal["x", "y"] = "y",
    way: float = 1.6,
    *,
    cell: float = 0.08,
    cells_a_step: float = 1,
    speed: float = 0.1,
    load: Any = LEVEL,
    **options: Any,
) -> xr.Dataset:
    """A paraboloid pressed with 10 N, moved from rest over a way of some contact radii."""
    size, far = 3.2, abs(way)
    shape = [round(size / cell), round((size + far) / cell)]
    centre = [0.0, way / 2]
    if along == "x":
        shape, centre = shape[::-1], centre[::-1]
    grid = vc.Grid(
        (shape[0], shape[1]),
        (shape[0] * cell, shape[1] * cell),
        centre=(centre[0], centre[1]),
    )
    step = cells_a_step * cell / speed
    times = step * np.arange(round(far / speed / step) + 1)
    path = vc.Travel([0.0, times[-1]], **{along: [0.0, way]})
    options = {"fields": "none", "errors": False} | options
    return vc.simulate(BODY, material, load, grid, times, motion=path, **options)
