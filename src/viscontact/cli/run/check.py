"""Report of `check`."""

from __future__ import annotations

from rich.table import Table

from viscontact.case import CaseError
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.messages import put, refuse
from viscontact.runs.check_report import (
    expectations,
    needs,
    verdict,
    warnings_of,
)
from viscontact.runs.forecast import Forecast
from viscontact.runs.preparation import PreparedRun, predicted

#: Width of the first column, so that the values of both lists are aligned.
_NAMES = len("peak pressure")


def print_forecast(prepared: PreparedRun) -> Forecast:
    """Print the resources that a run needs and the results to expect."""
    try:
        expected = predicted(prepared)
    except CaseError as error:
        refuse(*error.problems)
    console = TextConsole()
    put(verdict(prepared, expected))
    for line in warnings_of(prepared, expected):
        console.warn(line)
    for line in prepared.case.notes:
        put(f"note: {line}")
    console.print(_rows_table(needs(prepared, expected)))
    title, rows = expectations(prepared, expected)
    if rows:
        console.print(title, soft_wrap=True)
        console.print(_rows_table(rows))
    return expected


def _rows_table(rows: list[tuple[str, str]]) -> Table:
    table = Table(show_header=False, box=None, padding=(0, 0, 0, 2))
    table.add_column(min_width=_NAMES)
    table.add_column()
    for row in rows:
        table.add_row(*row)
    return table
