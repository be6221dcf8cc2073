"""Checked run of a case and its forecast; refused if it needs more memory than is free."""

from __future__ import annotations

from dataclasses import dataclass

from viscontact.case import Case
from viscontact.grid import Grid
from viscontact.runs.forecast import Forecast, forecast
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.resources import least_memory, needed_memory
from viscontact.simulation.setup import RunSetup, prepare_run
from viscontact.units.formatting import format_number


@dataclass(frozen=True, eq=False)
class PreparedRun:
    """A checked case and its run."""

    case: Case
    run: RunSetup


def prepared(case: Case, threads: int = 1, memory: float | None = None) -> PreparedRun:
    """Set up the run of a case, on some threads of one Fourier transform.

    CaseError if it cannot be run, or needs more than some memory [bytes]; by default what is free.
    """
    available = available_memory() if memory is None else memory
    if isinstance(case.grid, Grid):  # before arrays of its size are allocated
        _refuse_beyond(available, case, case.grid, least_memory(case.grid, case.compliance))
    run = _prepared_run(case, threads)
    needed = needed_memory(run.grid, run.hereditary.fields_kept)
    _refuse_beyond(available, case, run.grid, needed)
    return PreparedRun(case, run)


def predicted(prepared: PreparedRun) -> Forecast:
    """Return the forecast of a checked case; CaseError if no contact can carry the load."""
    try:
        return forecast(prepared.run, errors=prepared.case.errors)
    except ValueError as error:
        raise prepared.case.error(str(error)) from error


def _prepared_run(case: Case, threads: int) -> RunSetup:
    try:
        return prepare_run(case, threads)
    except ValueError as error:
        raise case.error(str(error)) from error


def _refuse_beyond(available: float, case: Case, grid: Grid, needed: float) -> None:
    if needed > available:
        nx, ny = grid.shape
        raise case.error(
            f"grid.shape: {nx} x {ny} cells need about {format_number(needed / 1e9, 3)} GB of "
            f"memory, {format_number(available / 1e9, 3)} GB are free; use fewer cells"
        )
