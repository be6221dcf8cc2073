"""Number of cores that a process may use."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from viscontact.runs.machine.control_groups import ROOT, control_groups, number_in
from viscontact.runs.machine.system import bound_cores


def usable_cores(root: Path = ROOT, environment: Mapping[str, str] = os.environ) -> int:
    """Number of cores that this process may use, at least 1."""
    # The least of the cores to which it is bound, the processor time of its control groups (rounded
    # up), and the cores that SLURM has allocated to the task, or else to the job on this node.
    allocated = slurm_number("SLURM_CPUS_PER_TASK", environment) or slurm_number(
        "SLURM_CPUS_ON_NODE", environment
    )
    limits = [bound_cores(), *_quotas(root), allocated or math.inf]
    return max(1, math.ceil(min(limits)))


def slurm_number(name: str, environment: Mapping[str, str]) -> int:
    """Value of a variable of SLURM; 0 if it is not set or is no number."""
    value = environment.get(name, "").strip()
    return int(value) if value.isdecimal() and value.isascii() else 0


def _quotas(root: Path) -> Iterator[float]:
    """Processor time per time of each control group."""
    for group in control_groups("cpu", root):
        quota = number_in(group / "cpu.cfs_quota_us")
        period = number_in(group / "cpu.cfs_period_us")
        try:
            words = (group / "cpu.max").read_text(encoding="ascii").split()
            quota, period = float(int(words[0])), float(int(words[1]))
        except (OSError, ValueError, IndexError):
            pass
        if quota and period and quota > 0 and period > 0:  # -1 is no limit
            yield quota / period
