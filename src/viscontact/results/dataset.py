"""From states to a labelled xarray dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.state import ContactState
from viscontact.results.accessor import ResultAccessor as ResultAccessor
from viscontact.results.enlarged_grid import line_on_wider, on_wider
from viscontact.results.variables import (
    AXES,
    COORDINATES,
    CREEPAGE,
    ERRORS,
    LINES,
    curve_of,
    curves_of,
    error_name,
    field_axis_attributes,
    fields_of,
    fields_over_creepage,
    parts_of,
    scalar_attributes,
    scalars_of,
    value_of,
    with_errors_per_length,
)


def to_dataset(
    states: Sequence[ContactState],
    field_axis: str,
    attributes: Mapping[str, Any],
    errors: Mapping[str, Floats] | None = None,
) -> xr.Dataset:
    """Label the states of a run, over time or speed; errors by name, over the states."""
    # The fields lie on an axis of their own unless all states keep them.
    over = states[0].over
    values = np.array([getattr(state, over) for state in states])
    scalars: dict[str, Any] = {
        name: (
            over,
            np.array([value_of(state, name) for state in states], dtype=variable.kind),
            scalar_attributes(name, errors=errors is not None),
        )
        for name, variable in scalars_of(parts_of(states[0]), over).items()
    }
    scalars |= {
        name: (
            (over, "creepage"),
            np.stack([curve_of(state, name) for state in states]),
            scalar_attributes(name, errors=errors is not None),
        )
        for name in curves_of(parts_of(states[0]))
    }
    scalars |= {
        error_name(name): (
            (over, "creepage")[: bars.ndim],
            bars,
            ERRORS[error_name(name)].attributes,
        )
        for name, bars in with_errors_per_length(errors or {}, states[0].grid).items()
    }
    grid = states[-1].grid  # the widest: a grid is enlarged only
    places = _coordinates(grid, over, values)
    if (traction := states[0].rolling_traction) is not None:
        places["creepage"] = ("creepage", traction.creepage, CREEPAGE.attributes)
    dataset = xr.Dataset(scalars, coords=places)
    kept = [state for state in states if state.pressure.size]
    if kept:
        dataset = dataset.assign(_field_arrays(kept, grid, field_axis))
    return dataset.assign_attrs(attributes)


def _coordinates(grid: Grid, over: str, values: Floats) -> dict[str, Any]:
    places = {over: values, "x": grid.x, "y": grid.y}
    variables = AXES | COORDINATES
    return {name: (name, each, variables[name].attributes) for name, each in places.items()}


def _field_arrays(states: Sequence[ContactState], grid: Grid, axis: str) -> dict[str, Any]:
    arrays: dict[str, Any] = {
        name: (
            (axis, "x", "y"),
            np.stack([on_wider(name, getattr(s, name), s.grid, grid) for s in states]).astype(
                variable.kind, copy=False
            ),
            variable.attributes,
        )
        for name, variable in fields_of(states[0].parts).items()
    }
    arrays |= {
        name: (
            (axis, "x"),
            np.stack([line_on_wider(getattr(s, name), s.grid, grid) for s in states]),
            variable.attributes,
        )
        for name, variable in LINES.items()
    }
    arrays |= {
        name: (
            (axis, "creepage", "x", "y"),
            np.stack([getattr(s.rolling_traction, name) for s in states]),
            variable.attributes,
        )
        for name, variable in fields_over_creepage(states[0].parts).items()
    }
    over = states[0].over
    if axis != over:
        values = np.array([getattr(state, over) for state in states])
        arrays[axis] = (axis, values, field_axis_attributes(over))
    return arrays
