"""Summary table of a run, in readable units."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from rich.box import SIMPLE_HEAD
from rich.table import Table

from viscontact.cli.results.accuracy import accuracy_lines, knows_errors
from viscontact.cli.results.stored_findings import print_stored_findings
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.messages import put
from viscontact.results.run_axis import RunAxis, run_axis
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME
from viscontact.results.stored_result import StoredResult, stored_result
from viscontact.results.summary import SummaryRow, legend, summary_rows
from viscontact.units.formatting import format_quantity

#: Blanks between columns.
_GAP = 2


def print_summary(directory: Path) -> None:
    """Print the results, the cost and the warnings of a finished run."""
    with stored_result(directory) as ds:
        _print(ds, directory)


def _print(ds: StoredResult, directory: Path) -> None:
    console = TextConsole()
    rows = summary_rows(ds)
    # Never truncated, even where the table is wider than the terminal.
    console.print(_table(ds, rows, console.width), crop=False)
    if _states_errors(ds, rows):
        console.print(legend(ds), highlight=False)
    axis, seconds = run_axis(ds), format_quantity(float(ds.attrs["wall_time"]), "s", 3)
    count = ds.sizes[axis.name]
    rows_of = axis.row if count == 1 and not axis.is_history else axis.rows
    console.print(
        f"{count} {rows_of} in {seconds}, {int(ds['iterations'].values.sum())} iterations, "
        f"residual at most {float(ds['residual'].values.max()):.1e}"
    )
    for line in accuracy_lines(ds, [row.name for row in rows]):
        console.print(line, highlight=False)
    print_stored_findings(console, ds, directory)
    for line in str(ds.attrs.get("grid_enlarged", "")).splitlines():
        console.print(f"grid enlarged at {line}", highlight=False)
    for line in _warnings(directory / PROGRESS_NAME, axis, str(ds.attrs.get("warnings", ""))):
        console.warn(line)
    put(directory / RESULT_NAME)


def _warnings(lines: Path, axis: RunAxis, of_result: str) -> Iterator[str]:
    """Warnings of each instant or speed with its value, then those of the whole run."""
    # Those of the first state have no value: what holds for the whole run is warned of there, too.
    printed: set[str] = set()
    with lines.open(encoding="utf-8") as file:
        for number, line in enumerate(file):
            state = json.loads(line)
            printed |= set(state["warnings"])
            place = axis.place(state[axis.name])
            for text in state["warnings"]:
                yield text if number == 0 or place in text else f"{place}: {text}"
    yield from (text for text in of_result.splitlines() if text not in printed)


def _table(ds: StoredResult, rows: list[SummaryRow], width: int) -> Table:
    """Table with the errors next to their numbers, or below them on a narrow terminal."""
    columns = _columns(ds, rows)
    whole = sum(max(map(len, [heading, *cells])) + _GAP for heading, cells in columns.items())
    narrow = whole > width
    table = Table(box=SIMPLE_HEAD, padding=(0, 1, 0, 0), show_edge=False)
    for heading, cells in columns.items():
        shown = [_on_lines(cell) if narrow else cell for cell in cells]
        least = max(len(line) for cell in (heading, *shown) for line in (cell.splitlines() or [""]))
        justify: Literal["left", "right"] = "right" if narrow and heading else "left"
        table.add_column(heading, min_width=least, justify=justify)
        columns[heading] = shown
    for cells_of_row in zip(*columns.values(), strict=True):
        table.add_row(*cells_of_row)
    return table


def _columns(ds: StoredResult, rows: list[SummaryRow]) -> dict[str, list[str]]:
    columns = {"": [row.heading for row in rows]}
    axis = run_axis(ds)
    first, last = (axis.place(float(ds[axis.name][index])) for index in (0, -1))
    # A load that starts at 0 has no values at its first instant.
    if not all(row.first.split()[0] in ("0", "-") for row in rows):
        columns[first] = _aligned([row.first for row in rows])
    columns[last] = _aligned([row.last for row in rows])
    if any(row.largest not in (row.first, row.last) for row in rows):
        columns["largest"] = _aligned([row.largest for row in rows])
    if _states_errors(ds, rows):
        columns["largest error"] = [row.largest_error for row in rows]
    return columns


def _on_lines(cell: str) -> str:
    """Cell with the error, and the time of the largest one, on lines of their own."""
    return re.sub(r"\s+(?=±|at \d)", "\n", cell.strip())


def _states_errors(ds: StoredResult, rows: list[SummaryRow]) -> bool:
    return knows_errors(ds, [row.name for row in rows])


def _aligned(cells: list[str]) -> list[str]:
    """Align numbers to the right, with the errors behind them."""
    parts = [cell.partition(" ± ") for cell in cells]
    width = max((len(number) for number, _, _ in parts), default=0)
    return [f"{number.rjust(width)}{f' ±{bar}' if bar else ''}" for number, _, bar in parts]
