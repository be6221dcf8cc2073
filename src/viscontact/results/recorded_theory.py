"""Persson's theory of the rough contact that a result holds."""

from __future__ import annotations

import warnings
from typing import Literal

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.materials.material import Material
from viscontact.bodies.surfaces import Surface
from viscontact.results.persson import persson_sliding, rough_waves
from viscontact.results.recorded_case import recorded_grid
from viscontact.results.recorded_objects import recorded_object

#: Relative change of a force that counts as held.
_HELD = 1e-6


def recorded_surface(ds: xr.Dataset, figure: str) -> Surface:
    """Map of the body of a result on a doubly periodic grid, by its fields or its shape."""
    grid = recorded_grid(ds)
    if not all(grid.periodic) or min(grid.shape) < 2:
        raise ValueError(
            f"{figure}: a nominal pressure, which the theory has, needs a grid that is periodic "
            "along both axes"
        )
    if "gap" in ds and ds.sizes[str(ds["gap"].dims[0])]:
        # The undeformed gap, but for the approach.
        height = ds["displacement"].values[-1] - ds["gap"].values[-1]
    else:
        body = recorded_object(ds, "indenter", figure)
        height = -body.gap(grid.x[:, None], grid.y[None, :])
    height = np.asarray(height, dtype=np.float64)
    if not np.isfinite(height).all():
        raise ValueError(f"{figure}: the theory is of a rough plane, and the body ends within it")
    return Surface(height, grid.cell_size, periodic=True)


def area_of_theory(ds: xr.Dataset, figure: str) -> Floats:
    """Real over nominal area of the theory at all instants of a contact that stands [-]."""
    if "speed" in ds.dims:
        raise ValueError(f"{figure}: theory over speed is in the figure 'friction'")
    waves = rough_waves(recorded_surface(ds, figure), 0)
    bodies = _half_spaces(ds, figure)
    pressure = np.asarray(ds["force"].values, dtype=np.float64) / recorded_grid(ds).area
    compliances = [body.contact_compliance() for body in bodies]
    times = np.asarray(ds["time"].values, dtype=np.float64)
    creeps = not all(each.is_elastic for each in compliances)
    if creeps and (times[0] != 0 or np.ptp(pressure) > _HELD * np.abs(pressure).max()):
        raise ValueError(
            f"{figure}: the material creeps, and the theory knows only a force that is held "
            "from time 0 on ('kind: step'); leave out theory"
        )
    compliance = sum(np.asarray(each(times), dtype=np.float64) for each in compliances)
    return waves.area_fraction(np.maximum(pressure, 0.0), 1 / compliance)


def sliding_of_theory(ds: xr.Dataset, figure: str) -> xr.Dataset:
    """Theory at the speeds of a result of steady motion, in their order."""
    surface, bodies = recorded_surface(ds, figure), _half_spaces(ds, figure)
    if len(bodies) > 1:
        raise ValueError(f"{figure}: the theory of sliding is of a rigid rough body")
    pressure = float(ds["force"].values[0]) / recorded_grid(ds).area
    along: Literal["x", "y"] = "x" if ds.attrs.get("along") == "x" else "y"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        return persson_sliding(surface, bodies[0], pressure, ds["speed"].values, along)


def _half_spaces(ds: xr.Dataset, figure: str) -> list[Material]:
    """Bodies that give, as half-spaces."""
    found = [recorded_object(ds, part, figure) for part in ("material", "indenter_material")]
    bodies = [body for body in found if body is not None]
    if not all(isinstance(body, Material) for body in bodies):
        raise ValueError(
            f"{figure}: the theory is of half-spaces, not of layers or bodies that end"
        )
    return bodies
