"""Checks of the runs of one command, before the first of them begins.

Up to 1000 runs, all cases are read. Up to 100 runs are prepared, which can take a second each with
automatic grids; of more runs, those with extreme values of the varied keys, whose sizes stand for
the others. Beyond 1000 runs, only these are checked, and the others as they begin.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from viscontact.case import Case, CaseError, read_case
from viscontact.cli.sweep.request import ManyRequest, PlannedRun
from viscontact.cli.terminal.messages import CommandError, refuse
from viscontact.results.run_files import CASE_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import in_use
from viscontact.runs.execution.checked_run import checked_run, directory_of
from viscontact.runs.execution.run_directory import refuse_no_directory, refuse_occupied
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.sweep.continuation import refuse_shared_directories
from viscontact.studies.sweep.designs import Design
from viscontact.studies.sweep.extremes import extreme_rows

#: Largest number of runs whose cases are all read.
MOST_READ = 1000
#: Most problems that are printed, and most runs that are named in one.
_MOST_PROBLEMS, _MOST_PLACES = 50, 5


def checked_jobs(
    request: ManyRequest,
    planned: Sequence[PlannedRun],
    runs: Sequence[RunRequest],
    memory: float | None = None,
) -> list[Job]:
    """Check the runs of a command within a memory [bytes]; report all problems together."""
    jobs: dict[int, Job] = {}
    problems: dict[str, list[PlannedRun]] = {}
    first = _to_prepare(planned)
    for number in (*sorted(first), *(n for n in range(len(runs)) if n not in first)):
        try:
            if number in first:
                jobs[number] = _prepared_job(runs[number], memory)
            elif not problems or len(runs) <= MOST_READ:
                alike = [jobs[n] for n in first if n in jobs]
                jobs[number] = _job(runs[number], alike, len(runs), memory)
        except CommandError as refusal:
            keys = planned[number].design.keys
            for line in refusal.lines:
                typed = request.options.as_typed(line, keys)
                problems.setdefault(typed, []).append(planned[number])
    if problems:
        refuse(*problem_lines(problems, planned))
    checked = [jobs[number] for number in range(len(runs))]
    try:
        refuse_shared_directories([job.directory for job in checked])
    except ValueError as error:
        refuse(str(error))
    return _with_names(checked)


def _to_prepare(planned: Sequence[PlannedRun]) -> set[int]:
    """Numbers of the runs whose grids are chosen beforehand."""
    designs: dict[Path, list[int]] = {}
    for number, each in enumerate(planned):
        designs.setdefault(each.request.case, []).append(number)
    found = set()
    for numbers in designs.values():
        rows = set(extreme_rows(planned[numbers[0]].design))
        found |= {number for number in numbers if planned[number].row in rows}
    return found


def _prepared_job(request: RunRequest, memory: float | None) -> Job:
    checked = checked_run(request, memory)
    standing = checked.standing()
    _refuse_in_use(request, checked.recorded.directory)
    return checked.job(standing)


def _job(request: RunRequest, prepared: Sequence[Job], count: int, memory: float | None) -> Job:
    """Job of a run whose grid is not chosen beforehand, with the sizes of a prepared one."""
    alike = [job for job in prepared if job.request.case == request.case] or prepared
    if not alike:  # all of them are refused
        return _prepared_job(request, memory)
    size = max(alike, key=lambda job: job.memory)
    directory = directory_of(request)
    if count > MOST_READ:
        standing = _standing_by_names(request, directory)
    else:
        standing = _standing(request, directory, _read_case(request), memory)
    return replace(
        size, request=request, directory=directory, name=directory.name, standing=standing
    )


def _read_case(request: RunRequest) -> Case:
    try:
        return read_case(request.case, request.settings)
    except CaseError as error:
        refuse(*error.problems)


def _standing(request: RunRequest, directory: Path, case: Case, memory: float | None) -> RunStage:
    """State of a run whose case is read; a run of another case is refused."""
    refuse_no_directory(directory)
    _refuse_in_use(request, directory)
    if not request.resume:
        refuse_occupied(directory, case, overwrite=request.overwrite)
        return RunStage.NEW
    found = _standing_by_names(request, directory)
    with suppress(OSError, UnicodeDecodeError):
        if found is RunStage.NEW or (directory / CASE_NAME).read_text("utf-8") == case.text:
            return found
    return checked_run(request, memory).standing()  # compared in detail


def _standing_by_names(request: RunRequest, directory: Path) -> RunStage:
    """State of a run by its files, checked when the run begins."""
    if not request.resume:
        return RunStage.NEW
    if (directory / STATE_NAME).exists():
        return RunStage.STOPPED
    with suppress(OSError):
        written = (directory / CASE_NAME).stat().st_mtime_ns
        if (directory / RESULT_NAME).exists() and written >= request.case.stat().st_mtime_ns:
            return RunStage.FINISHED
    return RunStage.NEW


def _refuse_in_use(request: RunRequest, directory: Path) -> None:
    # A worker of the command that is resumed may still save; the run waits for its end.
    if not request.resume and (message := in_use(directory)):
        refuse(message)


def _with_names(jobs: list[Job]) -> list[Job]:
    """Name runs after their directories, with the whole path where names are equal."""
    count = Counter(job.name for job in jobs)
    return [job if count[job.name] == 1 else replace(job, name=str(job.directory)) for job in jobs]


def problem_lines(
    problems: Mapping[str, list[PlannedRun]], planned: Sequence[PlannedRun]
) -> list[str]:
    """Lines of problems, each with its runs unless all planned runs of the case have it."""
    number = Counter(each.request.case for each in planned)
    common = set.intersection(*(set(each.request.settings) for each in planned))
    alike: dict[str, dict[str, list[PlannedRun]]] = {}
    for line, concerned in problems.items():
        named = _with_heading(line, concerned[0].design)
        alike.setdefault(_subject(named, concerned[0].design), {})[named] = concerned
    shown = []
    for lines in alike.values():
        first, concerned = next(iter(lines)), [run for runs in lines.values() for run in runs]
        cases = {each.request.case for each in concerned}
        is_of_all = len(concerned) == sum(number[case] for case in cases)
        shown.append(first if is_of_all else _problem_of_runs(first, concerned, common))
    more = len(shown) - _MOST_PROBLEMS
    return shown[:_MOST_PROBLEMS] + ([f"and {more} more problems"] if more > 0 else [])


def _with_heading(line: str, design: Design) -> str:
    """Problem of a value in a table, with the heading of its column."""
    for heading in design.headings:
        line = line.replace(f": {heading.key}: ", f": column {heading.text!r}: ", 1)
    return line


def _subject(line: str, design: Design) -> str:
    """Problem without its value, where each run may have another value."""
    if design.kind == "sample" and line.startswith("--range "):
        return line.partition(": ")[0]
    if design.kind == "table" and ": column " in line:
        return re.sub(r"[+-]?\d[\d.]*(e[+-]?\d+)?", "", line)
    return line


def _problem_of_runs(line: str, concerned: Sequence[PlannedRun], common: set[str]) -> str:
    """Problem with its runs: their lines in a table, their numbers, or their values."""
    design = concerned[0].design
    if design.lines:
        numbers = [str(each.design.lines[each.row]) for each in concerned]
        table, colon, rest = line.partition(": column ")
        if not colon:
            return f"{line} [{_list_names('line', numbers)} of the table]"
        others = f" [and in {_list_names('line', numbers[1:])}]" if numbers[1:] else ""
        return f"{table}:{numbers[0]}: column {rest}{others}"
    if design.kind == "sample":
        return f"{line} [{_list_names('run', [str(each.row) for each in concerned])}]"
    varied = [[t for t in each.request.settings if t not in common] for each in concerned]
    if len(varied) == 1 and all(t.partition("=")[2].strip() in line for t in varied[0]):
        return line
    return f"{line} [{_list_names('', ['with ' + ', '.join(texts) for texts in varied], '; ')}]"


def _list_names(noun: str, names: Sequence[str], separator: str = ", ") -> str:
    """Some of the names, behind their noun."""
    more = len(names) - _MOST_PLACES
    shown = separator.join(dict.fromkeys(names[:_MOST_PLACES]))
    plural = f"{noun}{'s' if len(names) > 1 else ''} " if noun else ""
    return f"{plural}{shown}{f' and {more} more' if more > 0 else ''}"
