"""Scripts of job arrays: one task of a batch system for each run of a manifest."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

#: Most tasks of an array; SLURM has 1001 unless its administrators change MaxArraySize.
MOST_TASKS = 1000
#: Requested over predicted memory and time, which holds within a factor of two or three.
_MEMORY_MARGIN, _TIME_MARGIN = 1.5, 3.0
#: Shortest time that is requested [s], and time to save before it is over [s].
_LEAST_SECONDS, _SAVING = 600.0, 60


@dataclass(frozen=True)
class JobArray:
    """Tasks of a batch system that compute the runs of a manifest.

    The memory [bytes] and the time [s] are predicted for the largest run.
    """

    manifest: Path  # absolute
    runs: int  # in the manifest
    left: Sequence[int]  # numbers of the runs to compute
    memory: float
    seconds: float
    logs: Path  # absolute
    threads: int = 1
    at_once: int | None = None  # most tasks at the same time
    program: str = "viscontact"

    @property
    def name(self) -> str:
        """Name of the array, of letters that all systems take."""
        return re.sub(r"[^A-Za-z0-9]+", "-", f"viscontact-{self.manifest.parent.name}").strip("-")

    @property
    def runs_per_task(self) -> int:
        """Number of runs that a task computes one after another."""
        return math.ceil(self.runs / MOST_TASKS)

    @property
    def tasks(self) -> str:
        """Numbers of the tasks, as `0-9,12`."""
        if self.runs_per_task == 1:
            return _ranges(self.left)
        return f"0-{math.ceil(self.runs / self.runs_per_task) - 1}"

    def command(self, index: str) -> str:
        """Shell commands of a task, with the variable that holds its number."""
        threads = f" --threads {self.threads}" if self.threads != 1 else ""
        name = shlex.quote(str(self.manifest))
        each = self.runs_per_task
        if each == 1:
            # In place of the shell, so that the signal to save reaches it.
            return f"exec {self.program} run --task ${index} {name}{threads}\n"
        return (
            f"first=$(({index} * {each}))\n"
            f"last=$((first + {each - 1} < {self.runs - 1} ? first + {each - 1} : "
            f"{self.runs - 1}))\n"
            "failed=0\n"
            "for run in $(seq $first $last); do\n"
            f"  {self.program} run --task $run {name}{threads} || failed=1\n"
            "done\n"
            "exit $failed\n"
        )

    @property
    def megabytes(self) -> int:
        """Memory to request."""
        return math.ceil(self.memory * _MEMORY_MARGIN / 1e8) * 100

    @property
    def wall_time(self) -> str:
        """Time to request, as HH:MM:SS."""
        whole = max(_LEAST_SECONDS, _TIME_MARGIN * self.seconds * self.runs_per_task)
        minutes = math.ceil(whole / 60)
        return f"{minutes // 60:02d}:{minutes % 60:02d}:00"


def slurm_script(array: JobArray) -> str:
    """Script for ``sbatch``; a task is asked to save a minute before its time is over."""
    limit = f"%{array.at_once}" if array.at_once else ""
    logs = str(array.logs).replace("%", "%%")
    return (
        "#!/bin/bash\n"
        f"#SBATCH --job-name={array.name}\n"
        f"#SBATCH --array={array.tasks}{limit}\n"
        f"#SBATCH --cpus-per-task={array.threads}\n"
        f"#SBATCH --mem={array.megabytes}M\n"
        f"#SBATCH --time={array.wall_time}\n"
        f"#SBATCH --signal=B:TERM@{_SAVING}\n"
        "#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n"
        f'#SBATCH --output="{logs}/%a.txt"\n'
        f"\n{array.command('SLURM_ARRAY_TASK_ID')}"
    )


def pbs_script(array: JobArray) -> str:
    """Script for ``qsub`` of PBS Professional and OpenPBS, whose arrays have two tasks or more."""
    whole = _whole(array)
    limit = f"%{array.at_once}" if array.at_once else ""
    size = f"ncpus={array.threads}:mem={array.megabytes}mb"
    return (
        "#!/bin/bash\n"
        f"#PBS -N {array.name[:15]}\n"
        + (f"#PBS -J {whole.tasks}{limit}\n" if whole.runs > 1 else "")
        + f"#PBS -l select=1:{size}\n"
        f"#PBS -l walltime={array.wall_time}\n"
        "#PBS -r y\n"
        "#PBS -j oe\n"
        f"#PBS -o {array.logs}/\n"
        f"\nPBS_ARRAY_INDEX=${{PBS_ARRAY_INDEX:-0}}\n{whole.command('PBS_ARRAY_INDEX')}"
    )


def _whole(array: JobArray) -> JobArray:
    """Array of all runs: PBS knows no lists of numbers."""
    return JobArray(**{**vars(array), "left": range(array.runs)})


def _ranges(numbers: Sequence[int]) -> str:
    """Numbers in rising order as ranges.

    >>> _ranges([0, 1, 2, 5, 7, 8])
    '0-2,5,7-8'
    """
    runs = groupby(enumerate(numbers), key=lambda pair: pair[1] - pair[0])
    found = [[number for _, number in pairs] for _, pairs in runs]
    return ",".join(f"{each[0]}-{each[-1]}" if len(each) > 1 else f"{each[0]}" for each in found)
