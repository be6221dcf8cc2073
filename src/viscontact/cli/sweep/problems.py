"""Problems of several runs as lines that name the runs, each problem once."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

from viscontact.cli.sweep.request import PlannedRun
from viscontact.studies.sweep.designs import Design

#: Most problems that are printed, and most runs that are named in one.
_MOST_PROBLEMS, _MOST_PLACES = 50, 5


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
        shown.append(first if is_of_all else _attributed(first, concerned, common))
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


def _attributed(line: str, concerned: Sequence[PlannedRun], common: set[str]) -> str:
    """Problem with its runs: their lines in a table, their numbers, or their values."""
    design = concerned[0].design
    if design.lines:
        numbers = [str(each.design.lines[each.row]) for each in concerned]
        table, colon, rest = line.partition(": column ")
        if not colon:
            return f"{line} [{_listed('line', numbers)} of the table]"
        others = f" [and in {_listed('line', numbers[1:])}]" if numbers[1:] else ""
        return f"{table}:{numbers[0]}: column {rest}{others}"
    if design.kind == "sample":
        return f"{line} [{_listed('run', [str(each.row) for each in concerned])}]"
    varied = [[t for t in each.request.settings if t not in common] for each in concerned]
    if len(varied) == 1 and all(t.partition("=")[2].strip() in line for t in varied[0]):
        return line
    return f"{line} [{_listed('', ['with ' + ', '.join(texts) for texts in varied], '; ')}]"


def _listed(noun: str, names: Sequence[str], separator: str = ", ") -> str:
    """Some of the names, behind their noun.

    >>> _listed("line", ["2", "5"])
    'lines 2, 5'
    """
    more = len(names) - _MOST_PLACES
    shown = separator.join(dict.fromkeys(names[:_MOST_PLACES]))
    plural = f"{noun}{'s' if len(names) > 1 else ''} " if noun else ""
    return f"{plural}{shown}{f' and {more} more' if more > 0 else ''}"
