"""Specifications of the runs of `simulate_many`, checked before the first one starts."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterable, Mapping
from inspect import signature
from typing import Any

import xarray as xr

from viscontact.grid import Grid
from viscontact.materials.material import Material
from viscontact.runs.resources import PROGRAM, least_memory
from viscontact.runs.single import simulate

#: Specification of a run: arguments of `simulate` by name, or a function that returns a result.
Recipe = Mapping[str, Any] | Callable[[], xr.Dataset]

#: Advice for a process that has ended without an answer.
BEHIND_MAIN = 'in a script, call simulate_many behind `if __name__ == "__main__":`'

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


def require_executor(executor: object, client: object, workers: object) -> None:
    """Raise TypeError or ValueError for an executor or a client that is none, or for several."""
    given = {"executor": executor, "client": client, "workers": workers}
    named = [name for name, value in given.items() if value is not None]
    if len(named) > 1:
        raise ValueError(f"{' and '.join(named)} are given together; give one of them")
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise TypeError(
            "executor: must have a method submit, as a ProcessPoolExecutor of concurrent.futures "
            f"has, got {executor!r}"
        )
    if client is not None and not callable(getattr(client, "get_executor", None)):
        raise TypeError(
            "client: must be a Client of dask.distributed, as Client('tcp://10.0.0.1:8786'), got "
            f"{client!r}"
        )


def refuse_import_by_a_worker() -> None:
    """Raise RuntimeError in a new process that is importing the calling script."""
    # Set by multiprocessing, which refuses to start processes meanwhile.
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise RuntimeError(
            f"a new process has imported this file and would start others: {BEHIND_MAIN}"
        )


def known_memory(recipe: Recipe) -> float:
    """Memory of a run, as far as it is known before it is set up [bytes]."""
    given = recipe if isinstance(recipe, Mapping) else {}
    grid, bodies = given.get("grid"), (given.get("material"), given.get("indenter_material"))
    compliances = [body.contact_compliance() for body in bodies if isinstance(body, Material)]
    if isinstance(grid, Grid) and compliances:
        return least_memory(grid, sum(compliances[1:], start=compliances[0]))
    return PROGRAM
