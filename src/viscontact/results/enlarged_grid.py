"""Enlarged grids in a result: fields on the widest grid, and a log of the enlargements."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Field, Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.state import ContactState
from viscontact.results.variables import EVERY_FIELD
from viscontact.units.formatting import format_quantity


def on_wider(name: str, field: Field, grid: Grid, wider: Grid) -> Field:
    """A field (..., nx, ny) on the widest grid of a result, from the grid of its instant."""
    # Beyond its grid pressure is 0, gap and displacement are NaN, and no cell is in contact.
    if grid == wider:
        return field
    return grid.embed(field, wider, beyond=EVERY_FIELD[name].beyond)


def line_on_wider(line: Floats, grid: Grid, wider: Grid) -> Floats:
    """A field along x, shape (..., nx), on the widest grid of a result; 0 beyond its own."""
    more = (wider.shape[0] - grid.shape[0]) // 2
    return np.pad(line, [(0, 0)] * (line.ndim - 1) + [(more, more)])


def enlargement(time: float, before: Grid, after: Grid) -> str:
    """One line of the log of enlargements; the time is the first on the larger grid [s]."""
    old, new = (
        f"{grid.shape[0]} x {grid.shape[1]} cells on {format_quantity(grid.size[0], 'm')} x "
        f"{format_quantity(grid.size[1], 'm')}"
        for grid in (before, after)
    )
    return f"t = {format_quantity(time, 's', 6)}: from {old} to {new}"


def enlargements(grid: Grid, states: Sequence[ContactState]) -> list[str]:
    """Lines for each enlargement of a run's first grid, from its states so far."""
    grids = [grid, *(state.grid for state in states)]
    pairs = zip(states, grids[:-1], grids[1:], strict=True)
    return [enlargement(state.time, old, new) for state, old, new in pairs if old != new]
