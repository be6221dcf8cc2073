"""Task of a run that is given by the arguments of `simulate`, recorded without a case file."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Self

from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.loads import MixedHistory
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.results.run_files import RESULT_NAME, STATE_NAME
from viscontact.runs.analysis import plain_case
from viscontact.runs.command_error import CommandError, refuse
from viscontact.runs.directory.differences import NOTHING, differences
from viscontact.runs.directory.earlier_result import stored_run
from viscontact.runs.directory.failure import remove_failure
from viscontact.runs.directory.lock_check import LockCheck
from viscontact.runs.directory.recorded import Recorded, remove_restart_files
from viscontact.runs.directory.recorder import BATCH_PAUSE, Recorder
from viscontact.runs.execution.run_directory import refuse_no_directory, reserved
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.over_time import OverTime
from viscontact.runs.processes.request import DONE, INTERRUPTED, STOPPED
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.provenance import describe_problem
from viscontact.simulation.transient.setup import prepare_run
from viscontact.studies.executors.task import ONE_AT_A_TIME, TaskEnd

_INTERRUPTED = TaskEnd("interrupted", INTERRUPTED)


@dataclass(frozen=True)
class SimulationTask:
    """A run in its directory, whose earlier results there are resumed."""

    arguments: Mapping[str, Any]  # of `simulate`, by name
    directory: Path
    stop: Path | None = None

    def compute(self, stops: StopRequests) -> TaskEnd:
        """Compute the run, or what is left of it."""
        try:
            with ONE_AT_A_TIME:
                return self._compute(stops)
        except KeyboardInterrupt:
            return _INTERRUPTED
        except CommandError as end:
            return TaskEnd("refused", STOPPED, end.lines)
        except (ConvergenceError, DomainError, OSError, MemoryError) as error:
            return TaskEnd("stopped", STOPPED, (_error_text(error),))
        except (ValueError, TypeError) as error:
            return TaskEnd("refused", STOPPED, (_error_text(error),))

    def elsewhere(self, stop: Path) -> Self:
        """Return the task with an absolute path, which the file may stop."""
        return replace(self, directory=self.directory.absolute(), stop=stop)

    def _compute(self, stops: StopRequests) -> TaskEnd:
        recorded = recorded_simulation(self.arguments, self.directory)
        refuse_no_directory(self.directory)
        with reserved(self.directory) as check:
            remove_failure(self.directory)
            if _is_finished(recorded):
                remove_restart_files(self.directory)
                return TaskEnd("done", DONE)
            with closing(_open_recorder(recorded, check)) as record, stops.marching():
                return _march(recorded, record, stops)


def recorded_simulation(arguments: Mapping[str, Any], directory: Path) -> Recorded:
    """Return the checked run of arguments of `simulate`; ValueError or TypeError if refused."""
    problem, threads, errors = _problem(arguments)
    problem = carried_out(problem, threads)
    run = prepare_run(problem, threads)
    return Recorded(directory, OverTime(run, errors))


def _problem(arguments: Mapping[str, Any]) -> tuple[Problem, int, bool]:
    """Problem, number of threads, and choice of errors of arguments of `simulate`."""
    given = dict(arguments)
    if given.pop("progress", None) is not None:
        raise ValueError("progress: a run in a directory reports to its progress log")
    threads, errors = given.pop("threads", 1), given.pop("errors", True)
    return contact_problem(**given), threads, errors


def _case_at_once(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Describe a run as its result does, but not what follows from the choice of a grid."""
    problem, _, errors = _problem(arguments)
    given = problem.grid if isinstance(problem.grid, Grid) else None
    case = plain_case(describe_problem(problem, given), problem.kept, errors=errors)
    if given is None:
        del case["grid"]
    if problem.awaits_cells:
        del case["times"]
    if isinstance(problem.load, MixedHistory) and problem.load.awaits_events:
        # What follows from its events is not known: its course, the times, and the rest of these.
        for name in ("times", "fields", "adaptive", "automatic"):
            del case[name]
        case["load"] = {"program": case["load"]["program"]}
    return case


def change_of_results(arguments: Mapping[str, Any], directory: Path) -> str:
    """Difference of arguments from those of the results in a directory; empty without."""
    if not (directory / RESULT_NAME).exists():
        return ""
    try:
        stored = stored_run(directory / RESULT_NAME)
    except ValueError:
        return ""
    if not stored.rows:
        return ""
    if stored.case is None:
        return "results of another program"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the run will warn
        case = _case_at_once(arguments)
    before = {key: stored.case.get(key, NOTHING) for key in case}
    if set(case["load"]) == {"program"} and isinstance(before["load"], dict):
        before["load"] = {"program": before["load"].get("program", NOTHING)}
    changes = differences(before, case)
    return f"results of other arguments: {changes[0]}" if changes else ""


def _is_finished(recorded: Recorded) -> bool:
    """True if the result is complete; a result that cannot be continued is refused."""
    directory = recorded.directory
    if not (directory / RESULT_NAME).exists():
        return False
    stored = stored_run(directory / RESULT_NAME)
    if stored.complete and stored.case == recorded.run.case:
        return True
    if stored.rows and not (directory / STATE_NAME).exists():
        refuse(f"{directory}: holds the result of another run; choose another directory")
    return False


def _open_recorder(recorded: Recorded, check: LockCheck) -> Recorder:
    held = replace(recorded, check=check)
    try:
        return Recorder.resume(held)
    except FileNotFoundError:
        return Recorder(held, pause=BATCH_PAUSE)


def _march(recorded: Recorded, record: Recorder, stops: StopRequests) -> TaskEnd:
    try:
        for state in record.steps():
            if stops.requested and not (state is not None and recorded.run.is_last(state)):
                record.checkpoint()
                return _INTERRUPTED
    except (ConvergenceError, DomainError):
        record.publish()
        raise
    record.finish(record.estimate_errors(partial(_stop_if_requested, stops)))
    stops.over = True
    return TaskEnd("done", DONE)


def _stop_if_requested(stops: StopRequests) -> None:
    if stops.requested:
        raise KeyboardInterrupt


def _error_text(error: Exception) -> str:
    return str(error) or type(error).__name__
