"""The summary of a run, in readable units."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from viscontact.cli.accuracy import accuracy_lines, mesh_lines, unknown_lines
from viscontact.recording.recorded import PROGRESS_NAME
from viscontact.results import RESULT_NAME, open_results
from viscontact.stated_errors import MESH_DEPENDENT, largest_error, stated_error
from viscontact.units import (
    in_error_digits,
    in_percent,
    in_supported_digits,
    in_words,
    is_rounding_tilt,
    readable_unit,
)
from viscontact.variables import SCALARS

_ROWS = (
    *("force", "eccentricity_x", "eccentricity_y", "approach", "tilt_x", "tilt_y"),
    *("contact_area", "contact_length", "contact_width", "peak_pressure", "mean_pressure", "work"),
    "loss_per_cycle",
)
# Exactly centred loads leave eccentricities of rounding size [m].
_NEGLIGIBLE = 1e-12


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
    console.print(_table(ds))
    count, seconds = ds.sizes["time"], float(ds.attrs["wall_time"])
    console.print(
        f"{count} instants in {in_words(seconds, 's', 3)}, {int(ds['iterations'].sum())} "
        f"iterations, residual at most {float(ds['residual'].max()):.1e}"
    )
    attributes = (str(ds.attrs["memory"]), float(ds.attrs["inversion_error"]))
    shown = [name for name in _ROWS if not _is_rounding(ds, name)]
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


def _table(ds: xr.Dataset) -> Table:
    first, last = (float(ds["time"][index]) for index in (0, -1))
    table = Table()
    table.add_column("")
    for heading in (f"t = {in_words(first, 's')}", f"t = {in_words(last, 's')}", "largest"):
        table.add_column(heading, justify="right")
    shown = [name for name in _ROWS if not _is_rounding(ds, name)]
    with_errors = any(largest_error(ds, name) for name in shown)
    if with_errors:
        table.add_column("error at most", justify="right", no_wrap=True)
    for name in shown:
        table.add_row(*_row(ds, name, with_error=with_errors))
    return table


def _row(ds: xr.Dataset, name: str, *, with_error: bool) -> Iterator[str]:
    values, error = ds[name].values, stated_error(ds, name)
    largest = _largest(ds, name)
    unit = readable_unit(largest, SCALARS[name].units)
    yield f"{name.replace('_', ' ')} [{unit.symbol}]".replace("[", r"\[")
    bars = np.full(len(values), np.nan) if error is None else error
    at_largest = int(np.nanargmax(np.abs(values)))
    for index in (0, -1):
        yield in_supported_digits(float(values[index]) / unit.factor, bars[index] / unit.factor)
    yield in_supported_digits(largest / unit.factor, float(bars[at_largest]) / unit.factor)
    if with_error:
        yield _error_told(ds, name, unit.factor)


def _error_told(ds: xr.Dataset, name: str, factor: float) -> str:
    """The largest error, in the row's unit and as a part of the largest value."""
    found = largest_error(ds, name)
    if found is None or math.isnan(found.half_width):
        return "not known"
    if math.isinf(found.half_width):
        return MESH_DEPENDENT
    return f"{in_error_digits(found.half_width / factor)} ({in_percent(found.part)})"


def _largest(ds: xr.Dataset, name: str) -> float:
    values = ds[name].values
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def _is_rounding(ds: xr.Dataset, name: str) -> bool:
    if name.startswith("tilt"):
        lengths, approaches = ds["contact_length"].values, ds["approach"].values
        return is_rounding_tilt(ds[name].values, lengths, approaches)
    return _largest(ds, name) <= (_NEGLIGIBLE if name.startswith("eccentricity") else 0.0)
