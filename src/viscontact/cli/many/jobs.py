"""Runs of one command, all checked before the first of them begins."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from viscontact.cli.many.common_cells import with_common_cells
from viscontact.cli.many.recorded_sweep import RecordedSweep, recorded_runs, sweep_runs
from viscontact.cli.many.variations import as_typed, key_of, variations
from viscontact.cli.terminal.messages import CommandError, refuse
from viscontact.run_files import LOCK_NAME
from viscontact.runs import resources
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.runs.execution.checked_run import checked_run
from viscontact.runs.execution.run_directory import chosen_directory
from viscontact.runs.machine.cores import usable_cores
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.processes.job import Job
from viscontact.runs.processes.request import RunRequest, command, no_option
from viscontact.units.formatting import format_number


@dataclass(frozen=True)
class ManyRequest:
    """Arguments of ``viscontact run`` with several cases or varied values.

    The case of `common` is ignored; its output is the directory of the run directories.
    """

    cases: tuple[Path, ...]
    common: RunRequest
    varied: tuple[str, ...] = ()
    jobs: int = 1

    def runs(self) -> list[RunRequest]:
        """Return one request for each combination of case and varied values."""
        found = []
        for case in self.cases:
            for variation in variations(self.varied, self.common.settings):
                settings = (*self.common.settings, *variation.settings)
                output = self._output(case, variation.name)
                found.append(replace(self.common, case=case, output=output, settings=settings))
        return found

    @property
    def resuming(self) -> str:
        """Command that resumes all of them, quoted for a shell.

        Examples
        --------
        >>> common = RunRequest(Path("a.yaml"), output=Path("all"))
        >>> ManyRequest((Path("a.yaml"), Path("b.yaml")), common, jobs=2).resuming
        'viscontact run a.yaml b.yaml -o all -j 2 --resume'
        """
        return command(*self._words(), "--resume")

    def _words(self) -> Iterator[str]:
        yield from (no_option(case) for case in self.cases)
        _, *options = replace(self.common, resume=False, overwrite=False).words()
        yield from options
        for text in self.varied:
            yield from ("--vary", text)
        if self.jobs != 1:
            yield from ("-j", str(self.jobs))

    def _output(self, case: Path, name: str) -> Path | None:
        """Directory of a run: CASE/ or CASE_KEY=VALUE/, by default next to the case file."""
        if self.common.output is None and not name:
            return None
        if not case.stem:
            refuse(f"{case}: there is no name in it for a directory; give the file another one")
        beside = chosen_directory(case, None)
        parent = beside.parent if self.common.output is None else self.common.output
        return parent / "_".join(filter(None, (beside.name, name)))


@dataclass(frozen=True)
class CheckedSweep:
    """Checked runs of one command, and their manifest."""

    jobs: list[Job]
    recorded: RecordedSweep


def checked_sweep(request: ManyRequest) -> CheckedSweep:
    """Check all runs of a request; nothing is created."""
    common, requests = request.common, request.runs()
    keys = [key_of(text) for text in request.varied]
    earlier = recorded_runs(common.output)
    runs = with_common_cells(requests, keys, earlier if common.resume else ())
    jobs = _checked_jobs(request, requests, runs)
    recorded = RecordedSweep(common.output, sweep_runs(common.output, runs, keys), earlier)
    if not common.overwrite:
        recorded.refuse_another(resume=common.resume)
    return CheckedSweep(jobs, recorded)


def _checked_jobs(
    request: ManyRequest, requests: Sequence[RunRequest], runs: Sequence[RunRequest]
) -> list[Job]:
    """Check all runs; the problems of all of them are reported together."""
    jobs: list[Job] = []
    problems: dict[str, list[RunRequest]] = {}
    for each, run in zip(requests, runs, strict=True):
        try:
            jobs.append(_checked(run))
        except CommandError as refusal:
            for line in refusal.lines:
                problems.setdefault(as_typed(line, request.varied), []).append(each)
    if problems:
        refuse(*(_attributed(line, runs, requests) for line, runs in problems.items()))
    _refuse_shared_directories(jobs)
    return _named(jobs)


def fitting(jobs: Sequence[Job]) -> int:
    """Return how many of the runs fit into the free memory at the same time, at least 1."""
    return max(1, resources.fitting((job.memory for job in jobs), available_memory()))


def resource_warnings(jobs: Sequence[Job], wanted: int, at_once: int, threads: int) -> list[str]:
    """Return a line for each resource of the machine that the runs exceed."""
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


def _checked(request: RunRequest) -> Job:
    checked = checked_run(request)
    standing = checked.standing()
    _refuse_in_use(checked.recorded.directory)
    return checked.job(standing)


def _refuse_in_use(directory: Path) -> None:
    if not (directory / LOCK_NAME).exists():
        return
    try:
        with suppress(OSError), locked(directory):
            pass
    except DirectoryInUse as error:
        refuse(str(error))


def _attributed(line: str, concerned: list[RunRequest], requests: Sequence[RunRequest]) -> str:
    """Add the varied values to a problem that other runs of the same case do not have."""
    cases = {each.case for each in concerned}
    others = [each for each in requests if each.case in cases and each not in concerned]
    if not others:
        return line
    common = set.intersection(*(set(each.settings) for each in requests))
    varied = [[text for text in each.settings if text not in common] for each in concerned]
    combinations = {", ".join(texts): None for texts in varied}
    if len(combinations) == 1 and all(text.partition("=")[2].strip() in line for text in varied[0]):
        return line
    return f"{line} [with {'; '.join(combinations)}]"


def _refuse_shared_directories(jobs: Sequence[Job]) -> None:
    # On a file system that ignores the case of letters, MPa and mPa are the same name.
    places = [str(job.directory.resolve()).casefold() for job in jobs]
    for place, count in Counter(places).items():
        if count > 1:
            job = jobs[places.index(place)]
            refuse(
                f"{job.directory}: {count} of the runs would go there; give each case file a name "
                "of its own, and each value once"
            )


def _named(jobs: list[Job]) -> list[Job]:
    """Name runs after their directories, with the whole path where names are equal."""
    count = Counter(job.name for job in jobs)
    return [
        job if count[job.name] == 1 else Job(**{**vars(job), "name": str(job.directory)})
        for job in jobs
    ]
