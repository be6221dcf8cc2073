"""Table of `verify`, with its progress."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Sequence
from pathlib import Path

from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.cli.terminal.console import TextConsole, styled
from viscontact.cli.terminal.messages import put, refuse, say, stop
from viscontact.verify import Case, Result, run_cases, write_table
from viscontact.verify.table import HEADINGS, SUFFIXES, row_of_words

#: Columns of numbers, aligned to the right.
_NUMBERS = ("exact", "ours", "error", "bound", "order")

#: Least width of the table, on narrower terminals as well.
_WIDTH = 130


def print_verification(*, fast: bool, output: Path | None) -> None:
    """Run all cases, print the table, and write it where a file is named."""
    _refuse_bad_output(output)
    started = clock.perf_counter()
    results = run_cases(fast=fast, progress=_say_progress)
    _print_table(results)
    if output is not None:
        try:
            write_table(results, output)
        except OSError as error:
            stop(f"{output}: cannot be written: {error.strerror}")
    failed = sum(not result.passed for result in results)
    seconds = clock.perf_counter() - started
    put(f"{len(results) - failed} of {len(results)} within their bounds, in {seconds:.0f} s")
    if failed:
        stop(f"{failed} comparisons with exact solutions failed")


def _refuse_bad_output(output: Path | None) -> None:
    if output is None:
        return
    if output.suffix not in SUFFIXES:
        refuse(f"{output}: must be a .md or .csv file, e.g. -o verification.md")
    if not output.parent.is_dir():
        refuse(f"{output}: there is no directory {output.parent}; make it, or write elsewhere")


def _say_progress(case: Case, done: int, total: int) -> None:
    """Print the current case: on one line on a terminal, at intervals elsewhere."""
    if sys.stderr.isatty():
        end = "\r" if done + 1 < total else "\r\033[K"
        print(f"\033[K{done + 1}/{total} {case.name}", end=end, file=sys.stderr, flush=True)
    elif done % max(1, total // 6) == 0:
        say(f"case {done + 1}/{total}: {case.name}")


def _print_table(results: Sequence[Result]) -> None:
    console = TextConsole()
    if not console.is_terminal or console.width < _WIDTH:
        console = TextConsole(width=_WIDTH)
    table = Table(box=SIMPLE_HEAD)
    for heading in HEADINGS:
        if heading in _NUMBERS:
            table.add_column(heading, justify="right", no_wrap=True)
        else:
            table.add_column(heading)
    before = None
    for result in results:
        case, reference, *rest, verdict = row_of_words(result)
        first = case != before
        colour = "green" if result.passed else "red"
        shown = (case, reference) if first else ("", "")
        table.add_row(*shown, *rest, styled(verdict, colour))
        before = case
    console.print(table)
