"""The history of a run, for the eye and as CSV."""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from viscontact.cli.accuracy import accuracy_lines
from viscontact.cli.messages import refuse
from viscontact.cli.stored import early_end
from viscontact.dataset import SCALARS
from viscontact.state import Outcome
from viscontact.units import in_digits, in_words, is_rounding_tilt, readable_unit

_COLUMNS = (
    *("force", "approach", "tilt_x", "tilt_y", "contact_area", "contact_length"),
    *("contact_width", "peak_pressure"),
)
_ROWS = 20


def print_history(ds: xr.Dataset, *, everything: bool = False) -> None:
    """Print scalars over time in readable units.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    everything : bool
        Every instant; else as many as fit on a page, first and last among them.
    """
    console = Console()
    count = ds.sizes["time"]
    rows = np.arange(count) if everything else _spread(count)
    console.print(_table(ds, rows))
    if len(rows) < count:
        console.print(f"{len(rows)} of {count} instants; --all shows every one")
    for line in _footers(ds):
        console.print(line, highlight=False)
    if ended := early_end(ds):
        console.print(f"[yellow]{escape(ended)}[/]", highlight=False, soft_wrap=True)
    for line in str(ds.attrs.get("warnings", "")).splitlines():
        console.print(f"[yellow]warning:[/] {line}")


def write_csv(ds: xr.Dataset, output: Path | None) -> None:
    """Write all scalars in SI units, a row an instant.

    Parameters
    ----------
    ds : xarray.Dataset
        A result.
    output : Path or None
        The file; None for stdout.
    """
    if output is None:
        _write_rows(ds, sys.stdout)
        return
    try:
        with output.open("w", encoding="utf-8", newline="") as file:
            _write_rows(ds, file)
    except OSError as error:
        refuse(f"{output}: cannot be written: {error}")


def _footers(ds: xr.Dataset) -> Iterator[str]:
    """Loss per cycle, where the load has cycles, and what to know of errors in time."""
    losses = ds["loss_per_cycle"].values
    # The last whole cycle's loss stands at every instant until the next is over.
    known = losses[np.isfinite(losses)]
    if known.size:
        first, last = (in_words(float(loss), "J") for loss in known[[0, -1]])
        several = f"{first} in the first cycle, {last} in the last"
        yield f"loss per cycle: {last if np.ptp(known) == 0 else several}"
    attributes = (str(ds.attrs.get("memory", "")), float(ds.attrs.get("inversion_error", 0.0)))
    yield from accuracy_lines(ds["time_error"].values, *attributes)


def _spread(count: int) -> NDArray[np.int_]:
    return np.unique(np.linspace(0, count - 1, min(_ROWS, count)).round().astype(int))


def _table(ds: xr.Dataset, rows: NDArray[np.int_]) -> Table:
    # Narrow enough for nine columns on eighty characters.
    table = Table(
        box=SIMPLE_HEAD, padding=(0, 1, 0, 0), show_edge=False, title=ds.attrs.get("title") or None
    )
    cells = []
    for name in ("time", *_COLUMNS):
        values = ds[name].values
        largest = float(np.nanmax(np.abs(values), initial=0.0))
        if largest == 0.0 or (name.startswith("tilt") and _is_rounding(ds, name)):
            continue
        unit = readable_unit(largest, ds[name].attrs["units"])
        heading = rf"{name.replace('_', ' ')} \[{unit.symbol}]"
        table.add_column(heading, justify="right", vertical="bottom")
        digits = [in_digits(float(value) / unit.factor) for value in values[rows]]
        # Steps that a run chose begin small: "0.005" leaves room that "0.005000" would not.
        cells.append([_trimmed(each) for each in digits] if name == "time" else digits)
    for row in zip(*cells, strict=True):
        table.add_row(*row)
    return table


def _trimmed(digits: str) -> str:
    return digits.rstrip("0").rstrip(".") if "." in digits and "e" not in digits else digits


def _is_rounding(ds: xr.Dataset, tilt: str) -> bool:
    return is_rounding_tilt(ds[tilt].values, ds["contact_length"].values, ds["approach"].values)


def _write_rows(ds: xr.Dataset, file: IO[str]) -> None:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(_header())
    writer.writerows(_rows(ds))


def _header() -> Iterator[str]:
    yield "time [s]"
    for name, variable in SCALARS.items():
        unit = {"m2": "m^2"}.get(variable.units, variable.units)
        yield name if unit == "1" else f"{name} [{unit}]"


def _rows(ds: xr.Dataset) -> Iterator[list[object]]:
    columns = [ds["time"].values, *(ds[name].values for name in SCALARS if name != "outcome")]
    assert list(SCALARS)[-1] == "outcome"  # the one column of words
    for *numbers, outcome in zip(*columns, ds["outcome"].values, strict=True):
        # repr: every digit, so that the numbers are those of the result
        yield [*(number.item() for number in numbers), Outcome(int(outcome)).name.lower()]
