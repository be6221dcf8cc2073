"""Specifications of the runs of `simulate_many`, checked before the first one starts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from inspect import signature
from typing import Any

import xarray as xr

from viscontact.bodies.grid import Grid
from viscontact.bodies.materials.material import Material
from viscontact.runs.run_memory import PROGRAM, least_memory
from viscontact.runs.single import simulate

#: Specification of a run: arguments of `simulate` by name, or a function that returns a result.
Recipe = Mapping[str, Any] | Callable[[], xr.Dataset]

_ARGUMENTS = signature(simulate)


def checked_recipes(runs: Iterable[Recipe]) -> list[Recipe]:
    """Return the runs; TypeError for one that is neither a function nor arguments of `simulate`."""
    if isinstance(runs, Mapping):
        raise TypeError("runs: must be a list of runs, got the arguments of one; write [run]")
    found = list(runs)
    for number, run in enumerate(found):
        if isinstance(run, Mapping):
            try:
                _ARGUMENTS.bind(**run)
            except TypeError as error:
                raise TypeError(f"runs[{number}]: {error}, as of simulate") from None
        elif not callable(run):
            raise TypeError(
                f"runs[{number}]: must be the arguments of simulate by name, a function, or a run "
                f"of vary, got {run!r}"
            )
    return found


def known_memory(recipe: Recipe) -> float:
    """Memory of a run, as far as it is known before it is set up [bytes]."""
    given = recipe if isinstance(recipe, Mapping) else {}
    grid, bodies = given.get("grid"), (given.get("material"), given.get("indenter_material"))
    compliances = [body.contact_compliance() for body in bodies if isinstance(body, Material)]
    if isinstance(grid, Grid) and compliances:
        return least_memory(grid, sum(compliances[1:], start=compliances[0]))
    return PROGRAM
