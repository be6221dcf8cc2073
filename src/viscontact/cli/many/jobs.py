"""Checked runs of one command, and how many of them fit on the machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from viscontact.cli.many.checks import MOST_READ, checked_jobs
from viscontact.cli.many.common_cells import with_common_cells
from viscontact.cli.many.recorded_sweep import (
    RecordedSweep,
    any_begun,
    recorded_runs,
    sweep_runs,
)
from viscontact.cli.many.request import ManyRequest
from viscontact.cli.terminal.messages import say
from viscontact.runs import resources
from viscontact.runs.machine.cores import usable_cores
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.processes.job import Job
from viscontact.units.formatting import format_number


@dataclass(frozen=True)
class CheckedSweep:
    """Checked runs of one command, and their manifest."""

    jobs: list[Job]
    recorded: RecordedSweep
    keys: tuple[str, ...]  # varied ones


def checked_sweep(request: ManyRequest) -> CheckedSweep:
    """Check all runs of a request; nothing is created."""
    common, planned = request.common, request.planned()
    earlier = recorded_runs(common.output)
    kept = earlier if common.resume and any_begun(common.output, earlier) else []
    requests = with_common_cells(planned, request.options.option, common.settings, kept)
    runs = sweep_runs(common.output, planned, requests)
    recorded = RecordedSweep(common.output, runs, earlier)
    if not common.overwrite:
        recorded = recorded.continued(resume=common.resume)
        requests = recorded.requests(requests)
    jobs = checked_jobs(request, planned, requests)
    if len(jobs) > MOST_READ and not common.quiet:
        say(f"of {len(jobs)} runs, only some are checked now; each is checked as it begins")
    keys = dict.fromkeys(key for each in planned for key in each.design.keys)
    return CheckedSweep(jobs, recorded, tuple(keys))


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
