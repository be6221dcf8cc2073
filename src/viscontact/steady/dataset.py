"""From contacts at several speeds to a labelled xarray dataset."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact import __version__
from viscontact.grid import Grid
from viscontact.results.accessor import ResultAccessor as ResultAccessor
from viscontact.results.descriptions import describe
from viscontact.results.variables import (
    COORDINATES,
    ERRORS,
    FIELDS,
    LINES,
    OUTCOME_FLAGS,
    SCALARS,
    error_name,
    scalar_attributes,
)
from viscontact.state import ContactState
from viscontact.steady.problem import SteadyProblem

#: Scalars that add up over time, belong to steps in time, or are the origin of coordinates.
NOT_STEADY = (
    *("work", "loss_per_cycle", "motion_work", "heat", "time_error", "position_x", "position_y"),
)

#: Scalars of a steady contact, and those that have an error bar.
STEADY_SCALARS = tuple(name for name in SCALARS if name not in NOT_STEADY)
WITH_ERROR = tuple(name for name in STEADY_SCALARS if SCALARS[name].has_error)

_SPEED = {"units": "m s-1", "long_name": "speed of the body"}


def steady_dataset(
    problem: SteadyProblem,
    speeds: NDArray[np.float64],
    states: Sequence[ContactState],
    bars: Sequence[Mapping[str, float]] | None,
    attributes: Mapping[str, Any],
) -> xr.Dataset:
    """Label the contacts at some speeds [m/s], with their error bars if they are known."""
    grid = _union([state.grid for state in states])
    scalars: dict[str, Any] = {
        name: (
            "speed",
            np.array([getattr(state, name) for state in states], dtype=SCALARS[name].kind),
            scalar_attributes(name, errors=bars is not None),
        )
        for name in STEADY_SCALARS
    }
    if bars is not None:
        scalars |= {
            error_name(name): (
                "speed",
                np.array([each[name] for each in bars]),
                ERRORS[error_name(name)].attributes,
            )
            for name in WITH_ERROR
        }
    axes = {"x": grid.x, "y": grid.y}
    coordinates = {name: (name, axes[name], COORDINATES[name].attributes) for name in axes}
    dataset = xr.Dataset(scalars, coords={"speed": ("speed", speeds, _SPEED), **coordinates})
    dataset["outcome"].attrs.update(OUTCOME_FLAGS)
    kept = np.isin(speeds, problem.kept)
    if kept.any():
        dataset = dataset.assign(_fields(states, speeds, kept, grid))
    return dataset.assign_attrs(_provenance(problem, speeds, grid), **attributes)


def _fields(
    states: Sequence[ContactState],
    speeds: NDArray[np.float64],
    kept: NDArray[np.bool_],
    grid: Grid,
) -> dict[str, Any]:
    """Fields on the dimension speed, or field_speed if only some are kept."""
    shown = [state for state, keep in zip(states, kept, strict=True) if keep]
    axis = "speed" if kept.all() else "field_speed"
    arrays: dict[str, Any] = {}
    for name, variable in (FIELDS | LINES).items():
        beyond = 0.0 if name in ("pressure", "line_load") else np.nan
        values = np.stack([_embedded(getattr(s, name), s.grid, grid, beyond) for s in shown])
        arrays[name] = ((axis, "x", "y")[: values.ndim], values, variable.attributes)
    if axis != "speed":
        attributes = _SPEED | {"long_name": "speed of the stored fields"}
        arrays[axis] = (axis, speeds[kept], attributes)
    return arrays


def _embedded(
    field: NDArray[np.float64], grid: Grid, wider: Grid, beyond: float
) -> NDArray[np.float64]:
    """A field on the grid of all speeds, with a value beyond its own."""
    if grid == wider:
        return field
    whole = np.full(wider.shape[: field.ndim], beyond)
    first = [
        round((own[0] - all_[0]) / cell)
        for own, all_, cell in zip(
            (grid.x, grid.y), (wider.x, wider.y), grid.cell_size, strict=True
        )
    ]
    block = tuple(
        slice(start, start + count) for start, count in zip(first, field.shape, strict=False)
    )
    whole[block] = field
    return whole


def _union(grids: Sequence[Grid]) -> Grid:
    """Smallest grid that holds grids of one lattice of cells."""
    if all(grid == grids[0] for grid in grids):
        return grids[0]
    cell = grids[0].cell_size
    shape, centre = [], []
    for axis in (0, 1):
        edges = [
            (grid.centre[axis] - grid.size[axis] / 2, grid.centre[axis] + grid.size[axis] / 2)
            for grid in grids
        ]
        low, high = min(each[0] for each in edges), max(each[1] for each in edges)
        shape.append(round((high - low) / cell[axis]))
        centre.append((low + high) / 2)
    size = (shape[0] * cell[0], shape[1] * cell[1])
    return Grid((shape[0], shape[1]), size, centre=(centre[0], centre[1]))


def _provenance(problem: SteadyProblem, speeds: NDArray[np.float64], grid: Grid) -> dict[str, Any]:
    """Attributes that every result carries."""
    contact = problem.contact
    case = {
        "indenter": describe(contact.indenter),
        "material": describe(contact.material),
        "indenter_material": describe(contact.indenter_material),
        "load": describe(contact.load),
        "motion": {
            "kind": "steady",
            "speed": describe(speeds),
            "along": problem.along,
            "rolling": problem.rolling,
        },
        "grid": describe(grid),
        "automatic": describe(contact.automatic_grid),
        "tolerance": contact.tolerance,
    }
    return {
        "Conventions": "CF-1.11",
        "source": f"viscontact {__version__}",
        "version": __version__,
        "case": json.dumps(case),
        "tolerance": contact.tolerance,
        "along": problem.along,
    }
