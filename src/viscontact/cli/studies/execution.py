"""Execution of `design`, and the lines that it prints."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TypeVar

from viscontact.case import CaseError
from viscontact.cli.studies.design import DesignRequest, as_typed
from viscontact.cli.terminal.messages import INTERRUPTED, refuse, say, stop
from viscontact.cli.terminal.progress import counted
from viscontact.errors import ConvergenceError, DomainError
from viscontact.studies.design.conclusions import InfeasibleError
from viscontact.studies.design.design import design
from viscontact.studies.design.history import HISTORY_NAME
from viscontact.studies.design.profiles.result import ProfileDesign
from viscontact.studies.design.result import DesignResult
from viscontact.studies.design.result_files import BEST_NAME

T = TypeVar("T")

#: Report in the directory of a design.
REPORT_NAME = "report.html"
#: Runs between two lines of progress, where the output is no terminal.
_LINE_RUNS = 10


def execute_design(request: DesignRequest, *, resume: bool, quiet: bool) -> None:
    """Search, write the result to its directory, and print it."""
    arguments = request.arguments()
    found = performed(partial(design, **arguments), request.output, resume=resume, quiet=quiet)
    _print(found)
    written_report(found, request.output / REPORT_NAME)
    print(request.output / BEST_NAME)


def performed(search: Callable[..., T], output: Path, *, resume: bool, quiet: bool) -> T:
    """Result of a search, which takes the argument `progress`; its failures end the program."""
    has_begun = (output / HISTORY_NAME).exists()
    if has_begun and not resume:
        refuse(
            f"{output}: holds a design already; continue it with --resume, or choose another "
            "directory with -o DIR"
        )
    if resume and not has_begun and not quiet:
        say(f"{output}: nothing is saved there yet; starting at the beginning")
    try:
        with counted("runs", quiet=quiet) as bar:
            return search(progress=bar if sys.stderr.isatty() or quiet else _lines())
    except CaseError as error:
        refuse(*(as_typed(line) for line in error.problems))
    except InfeasibleError as error:
        stop(str(error))
    except ValueError as error:
        refuse(*map(as_typed, str(error).splitlines()))
    except OSError as error:
        stop(f"{output}: {error}")
    except KeyboardInterrupt:
        stop(
            f"interrupted; {output} keeps the finished trials",
            "continue with the same command and --resume",
            code=INTERRUPTED,
        )


def _lines() -> Callable[[int, int], None]:
    """Progress as plain lines."""
    said = 0

    def line(done: int, allowed: int) -> None:
        nonlocal said
        if done - said >= _LINE_RUNS:
            said = done
            say(f"{done} runs of at most {allowed}")

    return line


def written_report(found: DesignResult | ProfileDesign, page: Path) -> None:
    """Write the report where the packages of figures are installed."""
    try:
        found.report(page)
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "contourpy", "plotly"):
            raise
        say(f"without a report: it needs {error.name}: pip install 'viscontact[plot]'")
    except (ConvergenceError, DomainError, ValueError, OSError) as error:
        say(f"without a report: {error}")
    else:
        print(page)


def _print(found: DesignResult) -> None:
    print(found)
    print(f"{found.runs} runs; the best trial has its error on the cells of the case")
    for note in found.notes:
        say(f"note: {note}")
