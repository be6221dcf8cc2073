"""Independent runs from Python that are recorded in directories."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import INTERRUPTED, STOPPED, RunRequest
from viscontact.studies.executors.driver import Active, Workers, case_task, drive
from viscontact.studies.executors.simulation_task import SimulationTask, change_of_results
from viscontact.studies.executors.task import RecordedTask
from viscontact.studies.sweep.continuation import (
    OtherSweepError,
    continued,
    pinned,
    record,
    recorded_runs,
    refuse_shared_directories,
)
from viscontact.studies.sweep.manifest import SweepRun
from viscontact.studies.sweep.specifications import Recipe, known_memory
from viscontact.studies.sweep.varied_runs import VariedRun, case_name, sweep_run

#: Called with the number of a run, from 0, that has ended, and the numbers of ended and all runs.
Progress = Callable[[int, int, int], None]

#: Most failed runs whose messages are raised.
_MOST_NAMED = 5


def record_many(
    recipes: Sequence[Recipe],
    directory: Path,
    workers: Workers,
    progress: Progress | None,
    *,
    return_exceptions: bool,
    overwrite: bool = False,
) -> None:
    """Compute runs in directories within one, or what remains of them unless they are overwritten.

    ValueError if a run cannot be recorded, or the directory holds other runs; RuntimeError after
    the end of all runs if any has failed, unless `return_exceptions`.
    """
    runs = _write_runs(recipes, directory, [] if overwrite else recorded_runs(directory))
    jobs = [
        _job(run, recipe, directory, overwrite) for run, recipe in zip(runs, recipes, strict=True)
    ]
    given = {job.directory: recipe for job, recipe in zip(jobs, recipes, strict=True)}
    digests = {job.directory: run.digests for job, run in zip(jobs, runs, strict=True)}

    def task_of(job: Job, token: str) -> RecordedTask:
        recipe = given[job.directory]
        if isinstance(recipe, VariedRun):
            return replace(case_task(job, token), digests=digests[job.directory])
        assert isinstance(recipe, Mapping)  # checked above
        return SimulationTask(recipe, job.directory)

    display = _Reports([job.directory for job in jobs], progress)
    ended = drive(jobs, workers, StopRequests(), display, task_of)
    if len(ended) < len(jobs) or any(each.code == INTERRUPTED for each in ended):
        raise KeyboardInterrupt
    failed = [each for each in ended if each.code == STOPPED]
    if failed and not return_exceptions:
        lines = [f"{each.job.name}: {'; '.join(each.lines)}" for each in failed[:_MOST_NAMED]]
        raise RuntimeError("\n".join((f"{len(failed)} of {len(jobs)} runs failed", *lines)))


def _write_runs(
    recipes: Sequence[Recipe], directory: Path, earlier: Sequence[SweepRun]
) -> list[SweepRun]:
    """Write the manifest of runs, and return its lines; ValueError if it is one of other runs."""
    if not recipes:
        raise ValueError("runs: there are none to record")
    place = directory.resolve()
    cases = {each.case for each in recipes if isinstance(each, VariedRun)}
    names = {case: case_name(case, place) for case in cases}
    runs = [_sweep_run(n, recipe, names, earlier) for n, recipe in enumerate(recipes)]
    try:
        recorded = continued(directory, runs, earlier)
    except OtherSweepError as error:
        raise ValueError(f"{directory}: holds other runs: {error}; choose another one") from None
    refuse_shared_directories([directory / each.directory for each in recorded])
    for run, recipe in zip(recorded, recipes, strict=True):
        _refuse_other_results(run, recipe, directory)
    try:
        recorded = pinned(directory, recorded)
    except ValueError as error:
        raise ValueError(
            f"{directory}: {error}; choose another directory, or undo the change"
        ) from None
    record(directory, recorded, earlier)
    return recorded


def _sweep_run(
    number: int, recipe: Recipe, names: Mapping[Path, str], earlier: Sequence[SweepRun]
) -> SweepRun:
    """Line of the manifest of a run."""
    if isinstance(recipe, VariedRun):
        return sweep_run(number, recipe, names[recipe.case], earlier)
    if isinstance(recipe, Mapping):
        return SweepRun(number, f"run{number}", f"run{number}", {}, (), "", "cases")
    raise ValueError(
        f"runs[{number}]: a run in a directory is given by the arguments of simulate or by vary, "
        f"got {recipe!r}"
    )


def _refuse_other_results(run: SweepRun, recipe: Recipe, directory: Path) -> None:
    """Raise ValueError for arguments of `simulate` whose directory has results of others."""
    if not isinstance(recipe, Mapping):
        return
    try:
        change = change_of_results(recipe, directory / run.directory)
    except (ValueError, TypeError) as error:
        kind = TypeError if isinstance(error, TypeError) else ValueError
        raise kind(f"runs[{run.run}]: {error}") from error
    if change:
        raise ValueError(
            f"{directory}: holds other runs: its {run.directory} has {change}; runs that are given "
            "as mappings are known by their position: keep their order and append others at the "
            "end, or choose another directory"
        )


def _job(run: SweepRun, recipe: Recipe, directory: Path, overwrite: bool) -> Job:
    place = directory / run.directory
    case = recipe.case if isinstance(recipe, VariedRun) else Path(run.directory)
    request = RunRequest(case, place, overwrite, not overwrite, settings=run.assignments)
    memory = known_memory(recipe)
    return Job(request, place, run.name, RunStage.STOPPED, None, 0.0, 1.0, memory)


class _Reports:
    """Display that reports the end of each run."""

    def __init__(self, places: Sequence[Path], progress: Progress | None) -> None:
        self._numbers = {place: number for number, place in enumerate(places)}
        self._progress, self._ended = progress, 0

    def update(self, active: Sequence[Active]) -> None:
        """Show nothing during the runs."""

    def end(self, ended: Ended) -> None:
        """Report the end of a run."""
        self._ended += 1
        if self._progress is not None:
            self._progress(self._numbers[ended.job.directory], self._ended, len(self._numbers))
