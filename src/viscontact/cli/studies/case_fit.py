"""Fit of a case to records: its progress, and what is printed, drawn and written."""

from __future__ import annotations

import sys
import time as clock
import warnings
from collections.abc import Callable
from pathlib import Path

from viscontact.case import CaseError
from viscontact.cli.material.fit_report import Drawing, draw_fit, write_section
from viscontact.cli.studies.case_fit_options import CaseFitRequest, as_typed
from viscontact.cli.terminal.messages import INTERRUPTED, refuse, say, stop
from viscontact.cli.terminal.progress import counted
from viscontact.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.studies.calibration.fit_case import fit_case
from viscontact.studies.calibration.result import CaseFit

#: Time between two lines of progress, where the output is no terminal [s].
_LINE_SECONDS = 30.0


def report_case_fit(
    request: CaseFitRequest,
    output: Path | None,
    section: Path | None,
    *,
    width: str | float | None,
    resume: bool,
    quiet: bool,
) -> None:
    """Fit the values of a case; print them, and draw and write them where files are named."""
    found = _fitted(request, resume=resume, quiet=quiet)
    print(found)
    for note in found.notes:
        say(f"warning: {note}")
    text = found.section_text
    print(f"\n{text}", end="")
    if output is not None:
        draw_fit(Drawing("fitted_records", found.curves), output, width)
    if section is not None:
        write_section(section, text)


def _fitted(request: CaseFitRequest, *, resume: bool, quiet: bool) -> CaseFit:
    arguments, log = request.arguments(), request.trials
    if log.exists() and not resume:
        refuse(
            f"{log}: holds the runs of an interrupted fit; continue it with --resume, or remove "
            "the file"
        )
    if resume and not log.exists() and not quiet:
        say(f"{log}: nothing is saved there; starting at the beginning")
    begun = log.exists()
    try:
        with counted("runs", quiet=quiet) as bar, warnings.catch_warnings():
            warnings.simplefilter("ignore", AccuracyWarning)  # printed from the notes
            shown = bar if sys.stderr.isatty() or quiet else _lines()
            found = fit_case(**arguments, progress=shown)
    except CaseError as error:
        refuse(*(as_typed(line) for line in error.problems))
    except ValueError as error:
        if not begun:
            log.unlink(missing_ok=True)
        refuse(*map(as_typed, str(error).splitlines()))
    except (ConvergenceError, DomainError) as error:
        stop(str(error))
    except OSError as error:
        stop(str(error))
    except KeyboardInterrupt:
        if not log.exists():
            raise
        stop(
            f"interrupted; {log} keeps the finished runs",
            "continue with the same command and --resume",
            code=INTERRUPTED,
        )
    log.unlink(missing_ok=True)
    return found


def _lines() -> Callable[[int, int], None]:
    """Progress as plain lines, with the time left if all runs are needed."""
    started = said = clock.perf_counter()

    def line(done: int, allowed: int) -> None:
        nonlocal said
        now = clock.perf_counter()
        if now - said >= _LINE_SECONDS:
            said = now
            left = (now - started) / done * (allowed - done)
            say(f"{done} runs of at most {allowed}, at most {left:.0f} s left")

    return line
