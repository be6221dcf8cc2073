"""Study that is requested on the page: its check, in the words of the command line, and entry."""

from __future__ import annotations

import math
import re
import time as clock
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import Literal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import Case, CaseError, read_case_text
from viscontact.results.variables import SCALARS
from viscontact.studies.case_values import without_option
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.plan import planned_design
from viscontact.studies.space import given_range
from viscontact.studies.sweep.designs import Design, grid_design, sample_design
from viscontact.studies.typed_values import is_range, split_values, typed_parameter
from viscontact.units.numbers import whole
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.workspace.folder import RunEntry, StudyEntry
from viscontact.web.workspace.problems import (
    InputProblem,
    RequestError,
    lines_of,
    problem_of,
    without_folder,
)

#: Most runs of a sweep on the page, whose cases are all read before the first one, and runs of
#: ranges by default.
MOST_RUNS, USUAL_RUNS = 100, 8
#: Most keys of a design on the page.
MOST_KEYS = 4
#: Longest list of values in a label.
_LONGEST = 40


@dataclass(frozen=True)
class VariedKey:
    """Key of the case, and its values or range as typed."""

    key: str
    values: str


@dataclass(frozen=True)
class StudyRequest:
    """Case, the keys to vary, and for a design what is to be best; quantities as typed."""

    yaml: str
    keys: list[VariedKey]
    kind: Literal["sweep", "design"] = "sweep"
    quality: Literal["coarse", "full"] = "full"
    goal: str = ""  # scalar or key
    sense: Literal["minimise", "maximise"] = "minimise"
    constraints: tuple[str, ...] = ()
    runs: str = ""  # of ranges, or at most

    @property
    def values(self) -> dict[str, str]:
        """Texts of the values by key."""
        return {each.key: each.values.strip() for each in self.keys}

    @property
    def has_ranges(self) -> bool:
        """True if the values of a key are a range."""
        return any(map(is_range, filter(None, self.values.values())))


def new_study(
    cases: CaseReader, request: StudyRequest, at_once: int, taken: Sequence[str] = ()
) -> tuple[str, RunEntry]:
    """Check a study, and keep its case with its files; return its name and entry."""
    _require_fields(request)
    found, settings = cases.prepared(request.yaml, request.quality)
    settings = tuple(each for each in settings if not _is_varied(each, request))
    if request.kind == "sweep":
        design = _sweep_design(request)
        runs, rows = len(design.rows), [design.settings(n) for n in range(len(design.rows))]
    else:
        runs, rows = 0, list(_corners(request))
    files = _files(cases, request, [(*settings, *row) for row in rows])
    # One place is left to other runs, so that a coarse answer need not wait.
    workers = max(1, min(at_once - 1, runs or at_once))
    keys = tuple(request.values)
    command: Literal["run", "design"] = "run" if request.kind == "sweep" else "design"
    title = found.case.title or "Untitled case"
    entry = RunEntry(
        title=title,
        label=_label(title, request, taken),
        quality=request.quality,
        created=clock.strftime("%Y-%m-%dT%H:%M:%SZ", clock.gmtime()),
        settings=settings,
        instants=runs,
        end=0.0,
        work=found.run.work,
        memory=workers * found.run.memory,
        errors=False,
        study=StudyEntry(command, tuple(_options(request)), keys, workers),
    )
    try:
        name = cases.folder.new_run(request.yaml, entry, {path: path.name for path in files})
    except OSError as error:
        why = f"the study cannot be stored: {error.strerror or error}"
        raise RequestError(507, why) from error
    if request.kind == "design":
        entry = _planned(cases, request, name, entry)
    return name, entry


def _require_fields(request: StudyRequest) -> None:
    """Raise RequestError with each field that is empty or no number."""
    problems = []
    if request.kind == "design":
        _limit(len(request.keys), MOST_KEYS, "keys", "design", f"keys[{MOST_KEYS + 1}]")
    if not request.keys:
        problems.append(InputProblem("name a key to vary, as load.force", "keys"))
    for number, each in enumerate(request.keys, start=1):
        place, typed = f"keys[{number}]", each.values.strip()
        if not each.key:
            problems.append(InputProblem("choose a key of the case", place))
        elif [other.key for other in request.keys].index(each.key) < number - 1:
            why = f"{each.key}: is given twice; name all its values once"
            problems.append(InputProblem(why, place))
        elif not typed or not all(split_values(typed)):
            why = "write values with commas between them, as 5 kN, 10 kN, or a range, as "
            problems.append(InputProblem(f"{why}5 kN:10 kN", place))
    if request.runs.strip() and not request.runs.strip().isdecimal():
        why = f"must be a whole number, got {request.runs.strip()!r}"
        problems.append(InputProblem(why, "runs"))
    if request.kind == "design" and not request.goal:
        problems.append(InputProblem("choose what is to be least or largest", "goal"))
    if problems:
        raise RequestError(422, *problems)


def _limit(number: int, most: int, what: str, command: str, place: str = "keys[1]") -> None:
    if number > most:
        why = f"at most {most} {what} on the page, got {number}; `viscontact {command}` takes more"
        raise RequestError(422, InputProblem(why, place))


def _sweep_design(request: StudyRequest) -> Design:
    """Runs of a sweep: all combinations of the values, or points that fill the ranges."""
    for number, (key, text) in enumerate(request.values.items(), start=1):
        if request.has_ranges and not is_range(text):
            why = f"{key} has values and another key a range; give all keys values, or all ranges"
            raise RequestError(422, InputProblem(why, f"keys[{number}]"))
    values = {key: typed_parameter(text) for key, text in request.values.items()}
    # All combinations are counted before they are made.
    number = 0 if request.has_ranges else math.prod(map(len, values.values()))
    _limit(number, MOST_RUNS, "runs", "run CASE --vary")
    try:
        if not request.has_ranges:
            return grid_design({key: list(given) for key, given in values.items()})
        ranges = [given_range("change", key, given) for key, given in values.items()]
        wanted = int(request.runs) if request.runs.strip() else USUAL_RUNS
        return sample_design(ranges, whole("runs", wanted, 1, MOST_RUNS))
    except ValueError as error:
        raise RequestError(422, *_study_problems([str(error)], request)) from error


def _corners(request: StudyRequest) -> Iterator[tuple[str, ...]]:
    """Settings at the ends of the ranges of a design, and with each of its choices."""
    change = {key: typed_parameter(text) for key, text in request.values.items()}
    # They are counted before they are made: the case is read for each of them.
    number = sum(len(given) if isinstance(given, list) else 2 for given in change.values())
    _limit(number, MOST_RUNS, "values to choose from", "design")
    try:
        corners = space_of(change).corners()
    except ValueError as error:
        raise RequestError(422, *_study_problems([str(error)], request)) from error
    for corner in corners:
        yield tuple(f"{key}={value}" for key, value in corner.items())


def _files(
    cases: CaseReader, request: StudyRequest, rows: Iterable[Sequence[str]]
) -> dict[Path, None]:
    """Files of the cases with each of the settings; RequestError with all problems."""
    files: dict[Path, None] = {}
    lines: dict[str, None] = {}
    for row in rows:
        try:
            files |= dict.fromkeys(_confined(cases, request.yaml, row).files.values())
        except CaseError as error:
            lines |= dict.fromkeys(error.problems)
    if lines:
        raise RequestError(422, *_study_problems(lines, request, cases.folder.case))
    return files


def _confined(cases: CaseReader, text: str, settings: Sequence[str]) -> Case:
    """Read a case with settings, which names files of the folder only."""
    return read_case_text(text, cases.folder.case, settings)


def _planned(cases: CaseReader, request: StudyRequest, name: str, entry: RunEntry) -> RunEntry:
    """Entry of a design with its most runs, or without its files if its arguments do not fit."""
    goals = {request.sense: request.goal}
    path = cases.folder.given(name)
    try:
        plan = planned_design(
            path,
            {key: typed_parameter(text) for key, text in request.values.items()},
            minimise=goals.get("minimise"),
            maximise=goals.get("maximise"),
            constraints=request.constraints,
            runs=int(request.runs) if request.runs.strip() else None,
        )
    except ValueError as error:
        cases.folder.remove_run(name)
        lines = error.problems if isinstance(error, CaseError) else str(error).splitlines()
        raise RequestError(422, *_study_problems(lines, request, path)) from error
    known = replace(entry, instants=plan.runs)
    cases.folder.keep(name, known)
    return known


def _options(request: StudyRequest) -> Iterator[str]:
    """Words of the command line."""
    runs = request.runs.strip()
    if request.kind == "design":
        for key, text in request.values.items():
            yield from ("--change", f"{key}={text}")
        yield from (f"--{request.sense}", request.goal)
        for text in request.constraints:
            yield from ("--constraint", text)
        if runs:
            yield from ("--runs", runs)
        return
    for key, text in request.values.items():
        yield from ("--range" if request.has_ranges else "--vary", f"{key}={text}")
    if request.has_ranges:
        yield from ("--sample", runs or str(USUAL_RUNS))


def _study_problems(
    lines: Iterable[str], request: StudyRequest, path: Path | None = None
) -> list[InputProblem]:
    """Problems at the fields of the study that they are about."""
    return [_study_problem(without_option(line), request, path or Path()) for line in lines]


def _study_problem(line: str, request: StudyRequest, path: Path) -> InputProblem:
    line = re.sub(r"^(\w+) must ", r"\1: must ", line)
    found = problem_of(line, path)
    if found.line is not None or found.path not in _ARGUMENTS:
        # Of the case, or of a value in its place.
        return InputProblem(_text_of(found), _field_of_key(found.path or line, request))
    argument, message = found.path, found.message
    if argument == "constraints":
        return InputProblem(message, _field_of_constraint(message, request))
    if argument == "change":
        return InputProblem(message, _field_of_key(message, request) or "keys[1]")
    return InputProblem(message, "runs" if argument == "runs" else "goal")


#: Arguments of a design with which its messages begin.
_ARGUMENTS = ("change", "minimise", "maximise", "constraints", "runs", "at")


def _text_of(found: InputProblem) -> str:
    (text,) = lines_of([found])
    return without_folder(text, Path()) if found.line is None else f"line {found.line}: {text}"


def _field_of_key(text: str, request: StudyRequest) -> str:
    """Field of the varied key with which a text begins, or that is a part of it; else empty."""
    for number, key in enumerate(request.values, start=1):
        is_same = re.match(rf"{re.escape(key)}(?![\w\[])", text)
        is_part = re.fullmatch(r"[\w.\[\]]+", text) and key.startswith((f"{text}.", f"{text}["))
        if is_same or is_part:
            return f"keys[{number}]"
    return ""


def _field_of_constraint(message: str, request: StudyRequest) -> str:
    for number, text in enumerate(request.constraints, start=1):
        name = re.match(r"\s*(\w*)", text)
        if text in message or (name and name[1] and name[1] in message):
            return f"constraints[{number}]"
    return "constraints[1]"


def _is_varied(setting: str, request: StudyRequest) -> bool:
    """True for a setting of a coarse run whose key is varied."""
    return setting.partition("=")[0] in request.values


def _label(title: str, request: StudyRequest, taken: Sequence[str]) -> str:
    """Label of a study, which is unique among others."""
    keys = " and ".join(_short(key, text) for key, text in request.values.items())
    what = keys
    if request.kind == "design":
        goal = SCALARS[request.goal].label.lower() if request.goal in SCALARS else request.goal
        what = f"{'least' if request.sense == 'minimise' else 'largest'} {goal} by {keys}"
    label = f"{title}: {what}"
    numbered = (f"{label} ({number})" for number in count(2))
    return label if label not in taken else next(each for each in numbered if each not in taken)


def _short(key: str, text: str) -> str:
    name = key.rpartition(".")[2].replace("_", " ")
    values = " to ".join(text.split(":")[:2]) if is_range(text) else text
    return f"{name} {values}" if len(values) <= _LONGEST else name
