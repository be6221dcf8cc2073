"""Execution of several runs at the command line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress

from viscontact.cli.sweep.cluster import cluster_tasks
from viscontact.cli.sweep.job_array import write_array
from viscontact.cli.sweep.jobs import CheckedSweep, checked_sweep, fitting, resource_warnings
from viscontact.cli.sweep.progress import shown_runs
from viscontact.cli.sweep.request import ManyRequest
from viscontact.cli.sweep.single_task import execute_task
from viscontact.cli.sweep.table import first_names, print_table
from viscontact.cli.terminal.interruption import Interruption, watched_interruption
from viscontact.cli.terminal.messages import DONE, INTERRUPTED, STOPPED, refuse, say, stop
from viscontact.cli.terminal.streams import printing, unwritten
from viscontact.runs.execution.execution import before_the_first_step, remove_leftovers
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job, RunStage
from viscontact.studies.executors.driver import Workers, drive
from viscontact.studies.executors.executor_choice import number_of_workers
from viscontact.studies.executors.local import LocalTasks, LocalWorkers
from viscontact.studies.sweep.states import State, state_at_end

#: Most failed runs that are named at the end.
_MOST_NAMES = 20


def execute_several(request: ManyRequest) -> None:
    """Run several cases, or one run of a manifest, or write the script of a job array."""
    if request.scheduler is not None and (request.task, request.array) != (None, None):
        refuse("--scheduler computes the runs; --array and --task do not go with it")
    if request.task is not None:
        execute_task(request, request.task)
    elif request.array is not None:
        write_array(request, request.array)
    elif manifests := [each for each in request.cases if each.suffix == ".jsonl"]:
        refuse(f"{manifests[0]}: is a manifest of runs; compute one of them with --task N")
    else:
        execute_many(request)


def execute_many(request: ManyRequest) -> None:
    """Run several cases, each into its directory."""
    quiet = request.common.quiet
    with watched_interruption() as interruption, ExitStack() as opened:
        with before_the_first_step():
            sweep = checked_sweep(request, elsewhere=request.is_elsewhere)
            jobs = sweep.jobs
            left = [job for job in jobs if job.standing is not RunStage.FINISHED]
            workers = opened.enter_context(_workers(request, left, interruption))
            sweep.recorded.write()
        with shown_runs(left, quiet=quiet) as shown:
            ended = drive(left, workers, interruption, shown, sweep.task)
    _end(request, sweep, ended)


@contextmanager
def _workers(
    request: ManyRequest, jobs: Sequence[Job], interruption: Interruption
) -> Iterator[Workers]:
    """Workers of this machine, or those of a scheduler."""
    quiet, threads = request.common.quiet, request.common.threads
    wanted = request.jobs or max(1, number_of_workers(None) // threads)
    at_once = min(wanted, fitting(jobs), max(1, len(jobs)))
    if request.jobs and not quiet and not request.is_elsewhere:
        for line in resource_warnings(jobs, wanted, at_once, threads):
            say(line)
    if request.scheduler is not None:
        place = request.common.output or request.cases[0].parent
        with cluster_tasks(request.scheduler, at_once, place, jobs, quiet=quiet) as tasks:
            yield tasks
        return
    local = LocalWorkers(at_once)
    try:
        yield LocalTasks(local, at_once)
    finally:
        with suppress(KeyboardInterrupt), interruption.postponed():
            local.shutdown()


def _end(request: ManyRequest, sweep: CheckedSweep, ended: Sequence[Ended]) -> None:
    """Print how all runs ended, and end with the worst of their exit codes."""
    jobs = sweep.jobs
    by_place = {each.job.directory: each for each in ended}
    runs = [by_place.get(job.directory) or _not_marched(job) for job in jobs]
    if not request.common.quiet:
        _print_table(runs)
    for each in runs:
        for line in each.lines if each.code else ():
            say(request.options.as_typed(line, sweep.keys))
    failed = [each.job.name for each in runs if state_at_end(each) is State.FAILED]
    named = first_names(failed, _MOST_NAMES)
    lines = [f"{len(failed)} of {len(runs)} runs failed: {named}"] if failed else []
    if any(each.code == INTERRUPTED for each in runs):
        stop(*lines, "interrupted", f"continue with: {request.resuming}", code=INTERRUPTED)
    if any(each.code == STOPPED for each in runs):
        stop(*lines, *sweep.recorded.change_of_failed())


def _not_marched(job: Job) -> Ended:
    if job.standing is not RunStage.FINISHED:
        return Ended(job, "not begun", INTERRUPTED)
    remove_leftovers(job.directory)
    return Ended(job, "done", DONE)


def _print_table(runs: Sequence[Ended]) -> None:
    try:
        with printing():
            print_table(runs)
    except OSError as error:
        unwritten("stdout")
        if not isinstance(error, BrokenPipeError):
            say(f"the table of the runs cannot be printed: {error.strerror or error}")
