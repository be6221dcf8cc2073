"""Checked run of a case and its forecast; refused if it needs more memory than is free."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from viscontact import runs
from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.case import Case
from viscontact.mechanics.problem.problem import Problem
from viscontact.results import leakage
from viscontact.runs.analysis import Analysis
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.over_time import OverTime
from viscontact.runs.run_memory import least_memory
from viscontact.simulation import steady_motion
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.setup import prepare_run
from viscontact.units.formatting import format_number

if TYPE_CHECKING:
    from viscontact.runs.forecast import Forecast


@dataclass(frozen=True, eq=False)
class PreparedRun:
    """A checked case and its run."""

    case: Case
    run: Analysis[Any, Any]


def prepared(
    case: Case, threads: int = 1, memory: float | None = None, *, roughly: bool = False
) -> PreparedRun:
    """Set up the run of a case, `roughly` for a forecast; CaseError if it needs too many bytes."""
    # The events of a load program are found.
    available = available_memory() if memory is None else memory
    if isinstance(case.grid, Grid):  # before arrays of its size are allocated
        even = True, True  # as it may turn out to be
        least = least_memory(case.grid, case.compliance, even)
        _refuse_beyond(available, case, case.grid, least)
    case = _carried_out(case, threads, roughly=roughly)
    run = _prepared_run(case, threads)
    _refuse_beyond(available, case, run.grid, run.memory)
    return PreparedRun(case, run)


def analysis_of(problem: Problem, threads: int = 1, *, errors: bool) -> Analysis[Any, Any]:
    """Prepare a problem, whose load is known, over time or over speed as its motion requires."""
    fluid = None
    if isinstance(problem, Case) and problem.leakage:
        fluid = leakage.CaseLeakage(problem.leakage, problem.tolerance)
    if isinstance(motion := problem.motion, SteadyMotion):
        posed = steady_motion.refuse_several_pressures(
            steady_motion.steady_problem(problem, motion)
        )
        return runs.OverSpeed(steady_motion.prepare(posed, threads), errors, fluid)
    return OverTime(prepare_run(problem, threads), errors, fluid)


def predicted(prepared: PreparedRun) -> Forecast:
    """Return the forecast of a checked case; CaseError if no contact can carry the load."""
    try:
        return prepared.run.forecast()
    except ValueError as error:
        raise prepared.case.error(str(error)) from error


def _carried_out(case: Case, threads: int, *, roughly: bool) -> Case:
    """The case under the history that its load program comes to; any other as it is."""
    try:
        found = carried_out(case, threads, roughly=roughly)
    except (ValueError, ConvergenceError, DomainError) as error:
        raise case.error(str(error)) from error
    assert isinstance(found, Case)  # made from it
    return found


def _prepared_run(case: Case, threads: int) -> Analysis[Any, Any]:
    try:
        return analysis_of(case, threads, errors=case.errors)
    except ValueError as error:
        why = str(error)
        # A key of the motion, which is an argument of its own in Python.
        of_motion = why.startswith(("rolling:", "along:", "speed:"))
        raise case.error(f"motion.{why}" if of_motion else why) from error


def _refuse_beyond(available: float, case: Case, grid: Grid, needed: float) -> None:
    if needed > available:
        nx, ny = grid.shape
        raise case.error(
            f"grid.shape: {nx} x {ny} cells need about {format_number(needed / 1e9, 3)} GB of "
            f"memory, {format_number(available / 1e9, 3)} GB are free; use fewer cells"
        )
