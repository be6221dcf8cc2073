"""Memory that is free for a process on its machine, in its container or in its cluster job."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path

from viscontact.runs.machine.control_groups import ROOT, control_groups, number_in
from viscontact.runs.machine.cores import slurm_number
from viscontact.runs.machine.system import free_memory, used_memory

#: Limit and usage of a control group [bytes], of versions 2 and 1.
_FILES = ("memory.max", "memory.current"), ("memory.limit_in_bytes", "memory.usage_in_bytes")

#: Unit of memory in the variables of SLURM [bytes].
_SLURM_UNIT = 2**20


def available_memory(root: Path = ROOT, environment: Mapping[str, str] = os.environ) -> float:
    """Memory that is free for this process [bytes]."""
    # The least of the machine's free memory, of what the control groups of the process have left,
    # and of the memory that SLURM has allocated to the job on this node, less that of this process.
    left = [free_memory(), *_left_in_groups(root)]
    if allocated := _slurm_memory(environment):
        left.append(allocated - used_memory())
    return max(0.0, min(left))


def _left_in_groups(root: Path) -> Iterator[float]:
    """Memory left in each control group with a limit [bytes]."""
    for group in control_groups("memory", root):
        for limit, usage in _FILES:
            most, used = number_in(group / limit), number_in(group / usage)
            if most is not None and used is not None:
                yield most - used + _file_cache(group)


def _file_cache(group: Path) -> float:
    """Part of a control group's memory that the system frees on demand: unused pages of files."""
    with suppress(OSError, ValueError):
        counts = dict(
            line.split()
            for line in (group / "memory.stat").read_text(encoding="ascii").splitlines()
        )
        # Version 1 counts the groups below in a line of its own.
        return float(int(counts.get("total_inactive_file", counts.get("inactive_file", "0"))))
    return 0.0


def _slurm_memory(environment: Mapping[str, str]) -> float:
    """Memory that SLURM has allocated on this node [bytes]; 0 if that is not known."""
    cores = slurm_number("SLURM_CPUS_ON_NODE", environment)
    for_cores = cores * slurm_number("SLURM_MEM_PER_CPU", environment)
    return float(_SLURM_UNIT * (slurm_number("SLURM_MEM_PER_NODE", environment) or for_cores))
