"""Report of `check`."""

from __future__ import annotations

from viscontact.case import CaseError
from viscontact.cli.terminal.messages import put, refuse
from viscontact.cli.terminal.plain_report import PlainReport
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
    report = PlainReport()
    put(verdict(prepared, expected))
    for line in warnings_of(prepared, expected):
        report.warn(line)
    for line in prepared.case.notes:
        put(f"note: {line}")
    report.rows(needs(prepared, expected), _NAMES)
    title, rows = expectations(prepared, expected)
    if rows:
        report.text(title)
        report.rows(rows, _NAMES)
    return expected
