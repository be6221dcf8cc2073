"""Several runs, all checked before the first of them begins."""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Sequence
from contextlib import redirect_stderr, suppress
from os import cpu_count
from pathlib import Path

import typer

from viscontact.cli.many.request import ManyRequest
from viscontact.cli.many.variations import as_typed
from viscontact.cli.run.attempt import attempted
from viscontact.cli.terminal.interruption import Interruption
from viscontact.cli.terminal.messages import refuse
from viscontact.run_files import LOCK_NAME
from viscontact.runs import resources
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.runs.free_memory import available_memory
from viscontact.runs.processes.job import Job
from viscontact.runs.processes.request import RunRequest
from viscontact.units.formatting import format_number


def checked_jobs(request: ManyRequest, interruption: Interruption) -> list[Job]:
    """Check runs, all of them before any is refused."""
    jobs: list[Job] = []
    problems: dict[str, list[RunRequest]] = {}
    requests = request.runs()
    for each in requests:
        said = io.StringIO()
        try:
            with redirect_stderr(said):
                jobs.append(_checked(each, interruption))
        except typer.Exit:
            for line in said.getvalue().splitlines():
                problems.setdefault(as_typed(line, request.varied), []).append(each)
    if problems:
        refuse(*(_told(line, concerned, requests) for line, concerned in problems.items()))
    _refuse_shared_directories(jobs)
    return _named(jobs)


def fitting(jobs: Sequence[Job]) -> int:
    """Return how many runs at once, whichever they are, fit into the memory that is free."""
    return max(1, resources.fitting((job.memory for job in jobs), available_memory()))


def warnings(jobs: Sequence[Job], wanted: int, at_once: int, threads: int) -> list[str]:
    """Say where more is asked for than the machine has."""
    lines = []
    if at_once < min(wanted, len(jobs)):
        needed = sum(sorted(job.memory for job in jobs)[-wanted:])
        lines.append(
            f"-j {wanted}: these runs at once would need about {format_number(needed / 1e9, 3)} GB "
            f"of memory, {format_number(available_memory() / 1e9, 3)} GB are free; {at_once} at a "
            "time"
        )
    cores = usable_cores()
    if at_once * threads > max(cores, threads):
        each = f" of {threads} threads each" if threads > 1 else ""
        lines.append(
            f"-j {wanted}: {at_once} runs{each} at once share {cores} cores, and wait for one "
            "another"
        )
    return lines


def usable_cores() -> int:
    """Return how many cores this process may use."""
    with suppress(AttributeError):  # not on every system
        from os import sched_getaffinity

        return len(sched_getaffinity(0))
    return cpu_count() or 1


def _checked(request: RunRequest, interruption: Interruption) -> Job:
    attempt = attempted(request, interruption)
    stands = attempt.standing()
    directory, run = attempt.recorded.directory, attempt.recorded.run
    _refuse_in_use(directory)
    cells = run.grid.shape[0] * run.grid.shape[1]
    return Job(
        request,
        directory,
        directory.name,
        stands,
        len(run.times) if run.adaptive is None else None,
        float(run.times[-1]),
        cells * (1.0 + resources.step_count(run)),
        resources.run_memory(run),
    )


def _refuse_in_use(directory: Path) -> None:
    if not (directory / LOCK_NAME).exists():
        return
    try:
        with suppress(OSError), locked(directory):
            pass
    except DirectoryInUse as error:
        refuse(str(error))


def _told(line: str, concerned: list[RunRequest], requests: Sequence[RunRequest]) -> str:
    """A problem, with the values that have it, where others of the same case do not."""
    cases = {each.case for each in concerned}
    others = [each for each in requests if each.case in cases and each not in concerned]
    if not others:
        return line
    common = set.intersection(*(set(each.settings) for each in requests))
    varied = [[text for text in each.settings if text not in common] for each in concerned]
    told = {", ".join(texts): None for texts in varied}
    if len(told) == 1 and all(text.partition("=")[2].strip() in line for text in varied[0]):
        return line
    return f"{line} [with {'; '.join(told)}]"


def _refuse_shared_directories(jobs: Sequence[Job]) -> None:
    # Where the case of letters does not count, MPa and mPa are one name.
    places = [str(job.directory.resolve()).casefold() for job in jobs]
    for place, count in Counter(places).items():
        if count > 1:
            job = jobs[places.index(place)]
            refuse(
                f"{job.directory}: {count} of the runs would go there; give each case file a name "
                "of its own, and each value once"
            )


def _named(jobs: list[Job]) -> list[Job]:
    """Call runs by their directories' names, and by the way there where that is not enough."""
    count = Counter(job.name for job in jobs)
    return [
        job if count[job.name] == 1 else Job(**{**vars(job), "name": str(job.directory)})
        for job in jobs
    ]
