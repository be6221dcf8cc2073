"""Checked runs of one command, and how many of them fit on the machine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.cli.sweep.checks import MOST_READ, checked_jobs
from viscontact.cli.sweep.common_cells import with_common_cells
from viscontact.cli.sweep.recorded_sweep import (
    RecordedSweep,
    any_begun,
    recorded_runs,
    sweep_runs,
)
from viscontact.cli.sweep.request import ManyRequest
from viscontact.cli.terminal.messages import say
from viscontact.runs import run_memory
from viscontact.runs.execution.case_digests import Digests
from viscontact.runs.machine.cores import usable_cores
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.processes.job import Job
from viscontact.studies.executors.driver import case_task
from viscontact.studies.executors.task import Task
from viscontact.units.formatting import format_number


@dataclass(frozen=True)
class CheckedSweep:
    """Checked runs of one command, and their manifest."""

    jobs: list[Job]
    recorded: RecordedSweep
    keys: tuple[str, ...]  # varied ones

    def task(self, job: Job, token: str) -> Task:
        """Task of a job, refused if its case changes meanwhile; `token` is that of the command."""
        return replace(case_task(job, token), digests=self._digests.get(job.directory, {}))

    @cached_property
    def _digests(self) -> dict[Path, Digests]:
        runs = self.recorded.runs  # none without a directory for them
        return {job.directory: run.digests for job, run in zip(self.jobs, runs, strict=False)}


def checked_sweep(request: ManyRequest, *, elsewhere: bool) -> CheckedSweep:
    """Check all runs of a request; memory of this machine limits them, unless `elsewhere`."""
    memory = math.inf if elsewhere else None
    common, planned = request.common, request.planned()
    place, earlier = common.output or Path(), recorded_runs(common.output)
    kept = earlier if common.resume and any_begun(place, earlier) else []
    requests = with_common_cells(planned, request.options.option, common.settings, kept, memory)
    runs = sweep_runs(common.output, planned, requests)
    recorded = RecordedSweep(place, runs, earlier)
    if not common.overwrite:
        recorded = recorded.continued(resume=common.resume)
        requests = recorded.requests(requests)
    recorded = recorded.with_digests(mixed=common.resume or common.overwrite)
    jobs = checked_jobs(request, planned, requests, memory)
    if len(jobs) > MOST_READ and not common.quiet:
        say(f"of {len(jobs)} runs, only some are checked now; each is checked as it begins")
    if elsewhere and not common.quiet:
        _warn_of_memory(jobs)
    keys = dict.fromkeys(key for each in planned for key in each.design.keys)
    return CheckedSweep(jobs, recorded, tuple(keys))


def _warn_of_memory(jobs: Sequence[Job]) -> None:
    needed, available = max(job.memory for job in jobs), available_memory()
    if needed > available:
        say(
            f"warning: a run needs about {format_number(needed / 1e9, 3)} GB of memory, this "
            f"machine has {format_number(available / 1e9, 3)} GB free; the machine that computes "
            "it must have them"
        )


def fitting(jobs: Sequence[Job]) -> int:
    """Return how many of the runs fit into the free memory at the same time, at least 1."""
    return max(1, run_memory.fitting((job.memory for job in jobs), available_memory()))


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
