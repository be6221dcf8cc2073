"""Execution of `design`, and the lines that it prints."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from viscontact.case import CaseError
from viscontact.cli.design.options import DesignRequest, as_typed
from viscontact.cli.terminal.messages import INTERRUPTED, refuse, say, stop
from viscontact.cli.terminal.progress import counted
from viscontact.design.conclusions import InfeasibleError
from viscontact.design.design import design
from viscontact.design.history import HISTORY_NAME
from viscontact.design.result import DesignResult
from viscontact.design.result_files import BEST_NAME
from viscontact.errors import ConvergenceError, DomainError

#: Report in the directory of a design.
REPORT_NAME = "report.html"
#: Runs between two lines of progress, where the output is no terminal.
_LINE_RUNS = 10


def execute_design(request: DesignRequest, *, resume: bool, quiet: bool) -> None:
    """Search, write the result to its directory, and print it."""
    arguments = request.arguments()
    has_begun = (request.output / HISTORY_NAME).exists()
    if has_begun and not resume:
        refuse(
            f"{request.output}: holds a design already; continue it with --resume, or choose "
            "another directory with -o DIR"
        )
    if resume and not has_begun and not quiet:
        say(f"{request.output}: nothing is saved there yet; starting at the beginning")
    try:
        with counted("runs", quiet=quiet) as bar:
            shown = bar if sys.stderr.isatty() or quiet else _lines()
            found = design(**arguments, progress=shown)
    except CaseError as error:
        refuse(*(as_typed(line) for line in error.problems))
    except InfeasibleError as error:
        stop(str(error))
    except ValueError as error:
        refuse(*map(as_typed, str(error).splitlines()))
    except OSError as error:
        stop(f"{request.output}: {error}")
    except KeyboardInterrupt:
        stop(
            f"interrupted; {request.output} keeps the finished trials",
            "continue with the same command and --resume",
            code=INTERRUPTED,
        )
    _print(found)
    _report(found, request.output / REPORT_NAME)
    print(request.output / BEST_NAME)


def _lines() -> Callable[[int, int], None]:
    """Progress as plain lines."""
    said = 0

    def line(done: int, allowed: int) -> None:
        nonlocal said
        if done - said >= _LINE_RUNS:
            said = done
            say(f"{done} runs of at most {allowed}")

    return line


def _report(found: DesignResult, page: Path) -> None:
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
