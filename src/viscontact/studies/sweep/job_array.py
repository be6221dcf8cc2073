"""Scripts of job arrays: one task of a batch system for each run of a manifest."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass

#: Most tasks of an array; SLURM has 1001 unless its administrators change MaxArraySize.
MOST_TASKS = 1000
#: Requested over predicted memory and time, which holds within a factor of two or three.
_MEMORY_MARGIN, _TIME_MARGIN = 1.5, 3.0
#: Shortest time that is requested [s], and time to save before it is over [s].
_LEAST_SECONDS, _SAVING = 600.0, 60


@dataclass(frozen=True)
class JobArray:
    """Tasks of a batch system for a manifest; memory [bytes] and time [s] of the largest run."""

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
        return math.ceil(len(self.left) / MOST_TASKS)

    @property
    def tasks(self) -> int:
        """Number of tasks."""
        return math.ceil(len(self.left) / self.runs_per_task)

    def numbered_command(self, index: str) -> str:
        """Shell command of a task with the number of its run, in a variable."""
        # In place of the shell, so that the signal to save reaches it.
        return f"exec {self._run(f'${index}')}\n"

    def listed_command(self, index: str) -> str:
        """Shell commands of a task with its number, in a variable; they list all runs."""
        each = self.runs_per_task
        listed = f"runs=({_numbers(self.left)})\n"
        if each == 1:
            return f"{listed}exec {self._run(f'${{runs[{index}]}}')}\n"
        return (
            f"{listed}failed=0 stopping=\n"
            "# A signal to save is passed on to the run, and no other run begins.\n"
            "trap 'stopping=1; kill $! 2>/dev/null' TERM\n"
            f'for run in "${{runs[@]:{index} * {each}:{each}}}"; do\n'
            f"  {self._run('$run')} &\n"
            "  wait $! || failed=1\n"
            "  while kill -0 $! 2>/dev/null; do wait $!; done  # signals end wait\n"
            '  [ -z "$stopping" ] || exit 130\n'
            "done\n"
            "exit $failed\n"
        )

    def _run(self, number: str) -> str:
        threads = f" --threads {self.threads}" if self.threads != 1 else ""
        return f"{self.program} run --task {number} {shlex.quote(str(self.manifest))}{threads}"

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
    index = "SLURM_ARRAY_TASK_ID"
    if array.runs <= MOST_TASKS:
        tasks, command = _ranges(array.left), array.numbered_command(index)
    else:  # numbers of tasks are limited, too
        tasks, command = f"0-{array.tasks - 1}", array.listed_command(index)
    limit = f"%{array.at_once}" if array.at_once else ""
    logs = str(array.logs).replace("%", "%%")
    return (
        "#!/bin/bash\n"
        f"#SBATCH --job-name={array.name}\n"
        f"#SBATCH --array={tasks}{limit}\n"
        f"#SBATCH --cpus-per-task={array.threads}\n"
        f"#SBATCH --mem={array.megabytes}M\n"
        f"#SBATCH --time={array.wall_time}\n"
        f"#SBATCH --signal=B:TERM@{_SAVING}\n"
        "#SBATCH --requeue\n"
        "#SBATCH --open-mode=append\n"
        f'#SBATCH --output="{logs}/%a.txt"\n'
        f"\n{command}"
    )


def pbs_script(array: JobArray) -> str:
    """Script for ``qsub`` of PBS Professional and OpenPBS, whose arrays have two tasks or more."""
    limit = f"%{array.at_once}" if array.at_once else ""
    size = f"ncpus={array.threads}:mem={array.megabytes}mb"
    return (
        "#!/bin/bash\n"
        f"#PBS -N {array.name[:15]}\n"
        + (f"#PBS -J 0-{array.tasks - 1}{limit}\n" if array.tasks > 1 else "")
        + f"#PBS -l select=1:{size}\n"
        f"#PBS -l walltime={array.wall_time}\n"
        "#PBS -r y\n"
        "#PBS -j oe\n"
        f"#PBS -o {array.logs}/\n"
        f"\nPBS_ARRAY_INDEX=${{PBS_ARRAY_INDEX:-0}}\n{array.listed_command('PBS_ARRAY_INDEX')}"
    )


def _ranges(numbers: Sequence[int]) -> str:
    """Numbers in rising order, as SLURM takes them."""
    return ",".join(f"{a}-{b}" if b > a else f"{a}" for a, b in _intervals(numbers))


def _numbers(numbers: Sequence[int]) -> str:
    """Numbers in rising order, as Bash expands them."""
    return " ".join(f"{{{a}..{b}}}" if b > a else f"{a}" for a, b in _intervals(numbers))


def _intervals(numbers: Sequence[int]) -> list[tuple[int, int]]:
    """First and last of each group of consecutive numbers."""
    groups = groupby(enumerate(numbers), key=lambda pair: pair[1] - pair[0])
    found = [[number for _, number in pairs] for _, pairs in groups]
    return [(each[0], each[-1]) for each in found]
