"""Record of a result over speed: the problem, states on a common grid, and error bars."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from viscontact import __version__
from viscontact.backend.arrays import Field, Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.rolling_traction import RollingTraction
from viscontact.mechanics.state import MOTION, ContactState
from viscontact.results.descriptions import describe
from viscontact.results.variables import (
    FRICTION_FIELDS,
    curves_with_error,
    fields_of,
    scalars_with_error,
)
from viscontact.simulation.steady_motion.preparation import SteadySetup
from viscontact.simulation.steady_motion.problem import SteadyProblem


def errors_by_name(bars: Sequence[Mapping[str, float | Floats]]) -> dict[str, Floats]:
    """Error bars of each scalar over the speeds, in its unit."""
    names = [*scalars_with_error((MOTION,), "speed"), *curves_with_error()]
    return {name: np.array([each[name] for each in bars]) for name in names if name in bars[0]}


def on_grid(state: ContactState, grid: Grid) -> ContactState:
    """A state on the grid of all speeds: beyond its own, gap and displacement are NaN."""
    if state.grid == grid or not state.pressure.size:
        return replace(state, grid=grid)
    fields: dict[str, Any] = {
        name: _embed(getattr(state, name), state.grid, grid, variable.beyond)
        for name, variable in fields_of().items()
    }
    line_load = _embed(state.line_load, state.grid, grid, 0.0)
    traction = state.rolling_traction and _traction_on(state.rolling_traction, state.grid, grid)
    return replace(state, grid=grid, line_load=line_load, rolling_traction=traction, **fields)


def _traction_on(traction: RollingTraction, grid: Grid, wider: Grid) -> RollingTraction:
    fields = {
        name: np.stack(
            [_embed(each, grid, wider, variable.beyond) for each in getattr(traction, name)]
        )
        for name, variable in FRICTION_FIELDS.items()
    }
    return replace(traction, **fields)


def _embed(field: Field, grid: Grid, wider: Grid, beyond: float) -> Field:
    """A field on the grid of all speeds, with a value beyond its own."""
    whole = np.full(wider.shape[: field.ndim], beyond, dtype=field.dtype)
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


def steady_attributes(run: SteadySetup, grid: Grid) -> dict[str, Any]:
    """Attributes that every result of a run carries, on a grid."""
    problem = run.problem
    return {
        "Conventions": "CF-1.11",
        "source": f"viscontact {__version__}",
        "version": __version__,
        "case": json.dumps(describe_steady_problem(problem, grid)),
        "tolerance": problem.contact.tolerance,
        "along": problem.motion.along,
        "transforms": run.transforms,
        "memory_error": run.solver.laws.error,
        "splitting_error": problem.contact.surface.splitting_error,
        "inversion_error": problem.contact.compliance.inversion_error,
        **({"ends_error": run.ends_error} if problem.contact.ended_bodies else {}),
    }


def describe_steady_problem(problem: SteadyProblem, grid: Grid | None) -> dict[str, Any]:
    """Describe a problem of steady motion, solved on a grid, as plain data."""
    contact = problem.contact
    temperature = contact.temperature
    heat = {} if temperature is None else {"temperature": describe(temperature)}
    creepages, friction = problem.motion.creepages, contact.friction
    creeping = {"creepage": describe(np.array(creepages))} if creepages else {}
    if problem.motion.lateral_creepage is not None:
        creeping["lateral_creepage"] = problem.motion.lateral_creepage
    if problem.motion.spin is not None:
        creeping["spin"] = problem.motion.spin
    rubbing = {} if friction is None else {"friction": describe(friction)}
    return {
        "indenter": describe(contact.indenter),
        "material": describe(contact.material),
        "indenter_material": describe(contact.indenter_material),
        "load": describe(contact.load),
        "motion": {
            "kind": "steady",
            "speed": describe(problem.speeds),
            "along": problem.motion.along,
            "rolling": problem.motion.rolling,
            **creeping,
        },
        **heat,
        **rubbing,
        "grid": describe(grid),
        "automatic": describe(contact.automatic_grid),
        "tolerance": contact.tolerance,
    }
