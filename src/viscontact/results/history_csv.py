"""The history of a run as CSV, in SI units."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from typing import IO

import xarray as xr

from viscontact.results.run_axis import run_axis
from viscontact.results.variables import SCALARS, error_name
from viscontact.state import Outcome


def write_history(ds: xr.Dataset, file: IO[str]) -> None:
    """Write all scalars of a result and their errors in SI units with every digit.

    A row is an instant, or a speed in steady motion.
    """
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(_header(ds))
    writer.writerows(_rows(ds))


def _header(ds: xr.Dataset) -> Iterator[str]:
    axis = run_axis(ds)
    yield f"{axis.name} [{axis.unit}]"
    for name in (*_scalars(ds), *_errors(ds)):
        units = SCALARS[name].units if name in SCALARS else str(ds[name].attrs["units"])
        unit = {"m2": "m^2"}.get(units, units)
        yield name if unit == "1" else f"{name} [{unit}]"


def _scalars(ds: xr.Dataset) -> list[str]:
    """The scalars of a result; older ones lack the latest."""
    return [name for name in SCALARS if name in ds]


def _errors(ds: xr.Dataset) -> list[str]:
    """The errors that a result states; older ones do not."""
    return [error_name(name) for name in SCALARS if error_name(name) in ds]


def _rows(ds: xr.Dataset) -> Iterator[list[object]]:
    scalars = _scalars(ds)
    numbers = [run_axis(ds).values(ds), *(ds[name].values for name in (*scalars, *_errors(ds)))]
    place = 1 + scalars.index("outcome")  # the one column of words
    for row in zip(*numbers, strict=True):
        # repr: every digit, so that the numbers are those of the result
        cells: list[object] = [number.item() for number in row]
        cells[place] = Outcome(int(row[place])).name.lower()
        yield cells
