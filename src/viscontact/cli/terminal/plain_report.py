"""Reports of lines and of lists of two columns, printed without Rich where it would change nothing.

Rich takes a thirtieth of the start of a command. It is for the colours of a terminal, and for what
has to be broken into lines.
"""

from __future__ import annotations

import os
import sys
import unicodedata
from collections.abc import Callable, Sequence
from typing import Any

from viscontact.cli.terminal.messages import put
from viscontact.cli.terminal.screen_size import is_number
from viscontact.units.visible import visible

#: Variables that ask Rich for the colours of a terminal in a file.
_ASKING = ("FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE")
_USUAL_WIDTH, _GAP = 80, 2


class PlainReport:
    """Printer of a report on stdout, as `TextConsole` prints it."""

    def __init__(self) -> None:
        coloured = os.name == "nt" or sys.stdout.isatty() or any(map(os.environ.get, _ASKING))
        self._width = 0 if coloured else _width()

    def warn(self, line: str) -> None:
        """Print a warning."""
        self._print([f"warning: {visible(line)}"], lambda console: console.warn(line))

    def text(self, line: str) -> None:
        """Print a line, however long it is."""
        if self._width:
            put(line)
        else:
            _console().print(line, soft_wrap=True)

    def rows(self, rows: Sequence[tuple[str, str]], least: int) -> None:
        """Print names and values, the names in a column of a least width."""
        if not rows:
            return
        shown = [(visible(name), visible(value)) for name, value in rows]
        names = max([least, *(len(name) for name, _ in shown)])
        values = max(len(value) for _, value in shown)
        gap = " " * _GAP
        lines = [f"{gap}{name:{names}}{gap}{value:{values}}" for name, value in shown]
        self._print(lines, lambda console: console.print(_table(rows, least)))

    def _print(self, lines: list[str], otherwise: Callable[..., None]) -> None:
        fit = [line for line in lines if len(line) <= self._width and _is_narrow(line)]
        if fit == lines:
            put("\n".join(fit))
        else:
            otherwise(_console())


def _width() -> int:
    """Width of the terminal of any stream, as Rich finds it."""
    given = os.environ.get("COLUMNS", "")
    if is_number(given) and int(given):
        return int(given)
    for stream in (0, 1, 2):
        try:
            return os.get_terminal_size(stream).columns or _USUAL_WIDTH
        except (OSError, ValueError):
            continue
    return _USUAL_WIDTH


def _is_narrow(line: str) -> bool:
    """True if each character takes one place, and there is one line."""
    return (line.isascii() and line.isprintable()) or all(
        each.isprintable()
        and unicodedata.east_asian_width(each) not in "WF"
        and unicodedata.category(each)[0] not in "MC"
        for each in line
    )


def _console() -> Any:
    from viscontact.cli.terminal.console import TextConsole

    return TextConsole()


def _table(rows: Sequence[tuple[str, str]], least: int) -> Any:
    from rich.table import Table

    table = Table(show_header=False, box=None, padding=(0, 0, 0, _GAP))
    table.add_column(min_width=least)
    table.add_column()
    for row in rows:
        table.add_row(*row)
    return table
