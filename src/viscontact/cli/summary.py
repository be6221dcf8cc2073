"""The summary of a run, in readable units."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from viscontact.cli.accuracy import accuracy_lines, mesh_lines, unknown_lines
from viscontact.recording.recorded import PROGRESS_NAME
from viscontact.results import RESULT_NAME, open_results
from viscontact.stated_errors import largest_error
from viscontact.summary import SummaryRow, summary_rows
from viscontact.units import in_words


def print_summary(directory: Path) -> None:
    """Print what a finished run found, what it took, and what to doubt.

    Parameters
    ----------
    directory : Path
        Where its result is: all of it, whichever process has computed what.
    """
    with open_results(directory) as ds:
        _print(ds, directory)


def _print(ds: xr.Dataset, directory: Path) -> None:
    console = Console()
    rows = summary_rows(ds)
    console.print(_table(ds, rows))
    count, seconds = ds.sizes["time"], float(ds.attrs["wall_time"])
    console.print(
        f"{count} instants in {in_words(seconds, 's', 3)}, {int(ds['iterations'].sum())} "
        f"iterations, residual at most {float(ds['residual'].max()):.1e}"
    )
    attributes = (str(ds.attrs["memory"]), float(ds.attrs["inversion_error"]))
    shown = [row.name for row in rows]
    for line in (*unknown_lines(ds, shown), *mesh_lines(ds, shown)):
        console.print(line, highlight=False)
    for line in accuracy_lines(ds["time_error"].values, *attributes):
        console.print(line, highlight=False)
    for line in str(ds.attrs.get("grid_enlarged", "")).splitlines():
        console.print(f"grid enlarged at {line}", highlight=False)
    for line in _warnings(directory / PROGRESS_NAME, str(ds.attrs.get("warnings", ""))):
        console.print(f"[yellow]warning:[/] {escape(line)}")
    console.print(f"{directory / RESULT_NAME}", soft_wrap=True, highlight=False)


def _warnings(lines: Path, of_result: str) -> Iterator[str]:
    """What was doubted, and when: the result tells only what; and what was doubted in the end."""
    told: set[str] = set()
    with lines.open(encoding="utf-8") as file:
        for line in file:
            state = json.loads(line)
            told |= set(state["warnings"])
            for text in state["warnings"]:
                yield f"t = {in_words(state['time'], 's')}: {text}"
    yield from (text for text in of_result.splitlines() if text not in told)


def _table(ds: xr.Dataset, rows: list[SummaryRow]) -> Table:
    first, last = (float(ds["time"][index]) for index in (0, -1))
    table = Table()
    table.add_column("")
    for heading in (f"t = {in_words(first, 's')}", f"t = {in_words(last, 's')}", "largest"):
        table.add_column(heading, justify="right")
    with_errors = any(largest_error(ds, row.name) for row in rows)
    if with_errors:
        table.add_column("error at most", justify="right", no_wrap=True)
    for row in rows:
        errors = [row.error] if with_errors else []
        title = f"{row.title} [{row.unit}]".replace("[", r"\[")
        table.add_row(title, row.first, row.last, row.largest, *errors)
    return table
