"""Script of a job array for the runs of one command, which are not started here."""

from __future__ import annotations

import math
import re
import shlex
import shutil
import sys
from dataclasses import replace
from pathlib import Path

from viscontact.cli.sweep.jobs import checked_sweep
from viscontact.cli.sweep.request import ManyRequest
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.cli.terminal.streams import printing
from viscontact.results.run_files import MANIFEST_NAME, STOP_NAME
from viscontact.runs.directory.atomic_files import replacing
from viscontact.runs.execution.checked_run import checked_run
from viscontact.runs.execution.execution import before_the_first_step
from viscontact.runs.processes.job import Job, RunStage
from viscontact.studies.sweep.job_array import JobArray, pbs_script, slurm_script
from viscontact.units.visible import visible

#: Suffixes of scripts: their text, and the command that submits them.
_SYSTEMS = {
    ".sbatch": (slurm_script, "sbatch"),
    ".slurm": (slurm_script, "sbatch"),
    ".pbs": (pbs_script, "qsub"),
}


def write_array(request: ManyRequest, script: Path) -> None:
    """Write the manifest and the script of a job array, and print the command that submits it."""
    if script.suffix not in _SYSTEMS:
        refuse(f"--array {script}: name it FILE.sbatch for SLURM or FILE.pbs for PBS")
    text_of, submit = _SYSTEMS[script.suffix]
    directory = request.common.output
    if directory is None:
        refuse("--array: name a directory for the runs, with -o DIR")
    if request.common.overwrite:
        refuse("--array and --overwrite: its tasks would not resume; choose another -o DIR")
    logs = _logs_beside(script)
    with before_the_first_step():
        sweep = checked_sweep(request, elsewhere=True)
        left = [n for n, job in enumerate(sweep.jobs) if job.standing is not RunStage.FINISHED]
        if not left:
            say(f"{directory}: all {len(sweep.jobs)} runs are finished")
            return
        array = JobArray(
            manifest=directory.resolve() / MANIFEST_NAME,
            runs=len(sweep.jobs),
            left=left,
            memory=max(job.memory for job in sweep.jobs),
            seconds=_longest_duration([sweep.jobs[number] for number in left]),
            logs=logs,
            threads=request.common.threads,
            at_once=request.jobs,
            program=_program(),
        )
        text = text_of(array)
        if script.exists() and script.read_text(encoding="utf-8", errors="replace") != text:
            refuse(f"{script}: exists already; submit it, remove it, or choose another name")
        sweep.recorded.write()
        (directory / STOP_NAME).unlink(missing_ok=True)
        _write(script, text, array.logs)
    with printing():
        put(f"{submit} {shlex.quote(str(script))}")


def _logs_beside(script: Path) -> Path:
    """Directory of the logs, whose name batch systems read from a comment of the script."""
    logs = script.parent.resolve() / f"{script.stem}-logs"
    # A line end in it would begin a command of the script, and quotes and blanks end the name.
    refused = r'["\s:]' if script.suffix == ".pbs" else r'["\r\n\v\f]'
    if re.search(refused, str(logs)) or visible(str(logs)) != str(logs):
        signs = "quotes, blanks, colons" if script.suffix == ".pbs" else "quotes"
        refuse(
            f"--array {script}: batch systems take no {signs} or control characters in the name of"
            f" the logs, {logs}; choose another name or directory of the script"
        )
    return logs


def _longest_duration(jobs: list[Job]) -> float:
    """Predicted duration of the longest run [s]."""
    longest = max(jobs, key=lambda job: job.work)
    request = replace(longest.request, output=longest.directory)
    checked = checked_run(request, memory=math.inf)
    return checked.recorded.run.seconds


def _program() -> str:
    """Command that starts this program in a job."""
    if shutil.which("viscontact"):
        return "viscontact"
    return f"{shlex.quote(sys.executable)} -m viscontact"


def _write(script: Path, text: str, logs: Path) -> None:
    try:
        logs.mkdir(parents=True, exist_ok=True)  # without it, tasks do not start
        with replacing(script) as file:
            file.write(text.encode())
    except OSError as error:
        refuse(f"{script}: cannot be written: {error}")
