"""The summary of a run, in readable units."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from viscontact.cli.accuracy import accuracy_lines
from viscontact.dataset import SCALARS
from viscontact.recording.recorded import PROGRESS_NAME
from viscontact.results import RESULT_NAME, open_results
from viscontact.units import in_digits, in_words, is_rounding_tilt, readable_unit

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
    for line in accuracy_lines(ds["time_error"].values, *attributes):
        console.print(line, highlight=False)
    for line in str(ds.attrs.get("grid_enlarged", "")).splitlines():
        console.print(f"grid enlarged at {line}", highlight=False)
    for line in _warnings(directory / PROGRESS_NAME):
        console.print(f"[yellow]warning:[/] {escape(line)}")
    console.print(f"{directory / RESULT_NAME}", soft_wrap=True, highlight=False)


def _warnings(lines: Path) -> Iterator[str]:
    """What was doubted, and when: the result tells only what."""
    with lines.open(encoding="utf-8") as file:
        for line in file:
            state = json.loads(line)
            for text in state["warnings"]:
                yield f"t = {in_words(state['time'], 's')}: {text}"


def _table(ds: xr.Dataset) -> Table:
    first, last = (float(ds["time"][index]) for index in (0, -1))
    table = Table()
    table.add_column("")
    for heading in (f"t = {in_words(first, 's')}", f"t = {in_words(last, 's')}"):
        table.add_column(heading, justify="right")
    table.add_column("largest", justify="right")
    for name in _ROWS:
        values = ds[name].values.tolist()
        largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
        if not _is_rounding(ds, name, largest):
            unit = readable_unit(largest, SCALARS[name].units)
            table.add_row(
                f"{name.replace('_', ' ')} [{unit.symbol}]".replace("[", r"\["),
                *(in_digits(value / unit.factor) for value in (values[0], values[-1])),
                in_digits(largest / unit.factor),
            )
    return table


def _is_rounding(ds: xr.Dataset, name: str, largest: float) -> bool:
    if name.startswith("tilt"):
        lengths, approaches = ds["contact_length"].values, ds["approach"].values
        return is_rounding_tilt(ds[name].values, lengths, approaches)
    return largest <= (_NEGLIGIBLE if name.startswith("eccentricity") else 0.0)
