"""Execution of `sensitivity`, its files, and the lines that it prints."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from viscontact.case import CaseError
from viscontact.cli.terminal.messages import INTERRUPTED, refuse, say, stop
from viscontact.cli.terminal.progress import counted
from viscontact.run_files import MANIFEST_NAME
from viscontact.studies.sensitivity.result import SensitivityResult
from viscontact.studies.sensitivity.result_files import TABLE_NAME, write_table
from viscontact.studies.sensitivity.sensitivity import sensitivity
from viscontact.units.parsing import parse_quantity

#: Report in the directory of the runs.
REPORT_NAME = "report.html"
#: Options by the names of the arguments, at the beginning of a message.
_OPTIONS = {
    **{name: f"--{name}" for name in ("of", "change", "scatter", "samples", "seed", "at", "step")},
    "directory": "-o",
}
#: Part of the runs between two lines of progress, where the output is no terminal.
_LINE_PART = 0.1


@dataclass(frozen=True)
class SensitivityRequest:
    """Options of `sensitivity`, as they were typed."""

    case: Path
    output: Path
    of: str
    change: Sequence[str]
    scatter: Sequence[str]  # KEY=LOW:HIGH, with :log or :normal
    samples: int
    seed: int
    at: str
    step: float
    settings: Sequence[str]
    jobs: int

    def arguments(self) -> dict[str, Any]:
        """Arguments of `viscontact.sensitivity` by name."""
        scatter = _by_key("--scatter", self.scatter, "'indenter.radius=4.98 mm:5.02 mm'")
        return {
            **{"case": self.case, "of": self.of, "change": list(self.change) or None},
            "scatter": {
                key: tuple(map(str.strip, text.split(":"))) for key, text in scatter.items()
            },
            **{"samples": self.samples, "seed": self.seed},
            **{"at": _instant(self.at), "step": self.step},
            "settings": _by_key("--set", self.settings, "'load.force=20 kN'"),
            **{"workers": self.jobs, "directory": self.output},
        }


def _by_key(option: str, texts: Sequence[str], example: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for text in texts:
        key, equals, value = (part.strip() for part in text.partition("="))
        if not (key and equals and value):
            refuse(f"{option} {text}: write KEY=VALUE, with the unit, e.g. {example}")
        if key in found:
            refuse(f"{option} {key}: is given twice; give it once")
        found[key] = value
    return found


def execute_sensitivity(request: SensitivityRequest, *, resume: bool, quiet: bool) -> None:
    """Compute the runs, write the table and the report to the directory, and print them."""
    arguments = request.arguments()
    has_begun = (request.output / MANIFEST_NAME).exists()
    if has_begun and not resume:
        refuse(
            f"{request.output}: holds runs already; continue them with --resume, or choose another "
            "directory with -o DIR"
        )
    if resume and not has_begun and not quiet:
        say(f"{request.output}: nothing is saved there yet; starting at the beginning")
    try:
        with counted("runs", quiet=quiet) as bar:
            shown = bar if sys.stderr.isatty() or quiet else _lines()
            found = sensitivity(**arguments, progress=shown)
        write_table(request.output, found)
    except CaseError as error:
        refuse(*error.problems)
    except ValueError as error:
        refuse(*map(as_typed, str(error).splitlines()))
    except (RuntimeError, OSError) as error:
        stop(f"{request.output}: {error}")
    except KeyboardInterrupt:
        stop(
            f"interrupted; {request.output} keeps the runs",
            "continue with the same command and --resume",
            code=INTERRUPTED,
        )
    print(found)
    _report(found, request.output / REPORT_NAME)
    for note in found.notes:
        say(f"note: {note}")
    print(request.output / TABLE_NAME)


def _report(found: SensitivityResult, page: Path) -> None:
    """Write the report where the packages of figures are installed."""
    try:
        found.report(page)
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "contourpy", "plotly"):
            raise
        say(f"without a report: it needs {error.name}: pip install 'viscontact[plot]'")
    except OSError as error:
        say(f"without a report: {error}")
    else:
        print(page)


def as_typed(message: str) -> str:
    """Message about an argument of `viscontact.sensitivity`, with the option that was typed.

    >>> as_typed("of: name a scalar")
    '--of: name a scalar'
    """
    name = re.match(r"\w+(?=: | must)", message)
    option = _OPTIONS.get(name.group() if name else "")
    return message if name is None or option is None else option + message[name.end() :]


def _lines() -> Callable[[int, int], None]:
    """Progress as plain lines."""
    said = 0.0

    def line(done: int, total: int) -> None:
        nonlocal said
        if done / total >= said + _LINE_PART:
            said = done / total
            say(f"{done} of {total} runs")

    return line


def _instant(text: str) -> Any:
    if text in ("worst", "end"):
        return text
    try:
        return parse_quantity(text, "time")
    except ValueError as error:
        refuse(f"--at: write worst, end or a time: {error}")
