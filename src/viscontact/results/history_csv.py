"""The history of a run as CSV, in SI units."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from typing import IO

import xarray as xr

from viscontact.mechanics.state import Outcome
from viscontact.results.margins import margins
from viscontact.results.run_axis import run_axis
from viscontact.results.snapshots import field_times
from viscontact.results.variables import SCALARS, error_name, scalars_in
from viscontact.units.formatting import column_heading, format_quantity


def write_history(
    ds: xr.Dataset, file: IO[str], points: Sequence[tuple[float, float]] = ()
) -> None:
    """Write all scalars of a result and their errors in SI units with every digit."""
    # A row is an instant, or a speed in steady motion, and there a creepage, if there are any,
    # whose values follow. Behind them are the margins to the allowable values, and the pressure at
    # some points (x, y) [m], empty where no fields are stored.
    writer = csv.writer(file, lineterminator="\n")
    further, curves = {**_margins(ds), **_pressures(ds, points)}, _curves(ds)
    writer.writerow([*_header(ds), *curves, *further])
    for number, row in enumerate(_rows(ds)):
        cells = [column[number] for column in further.values()]
        over = zip(*(each[number] for each in curves.values()), strict=True)
        for values in over if curves else [()]:
            numbers = (*values, *cells)
            writer.writerow([*row, *("" if math.isnan(each) else each for each in numbers)])


def _curves(ds: xr.Dataset) -> dict[str, list[list[float]]]:
    """Values over the creepages at each speed by the headings of their columns; none without."""
    if "creepage" not in ds.dims:
        return {}
    over = (run_axis(ds).name, "creepage")
    creepages = [ds["creepage"].values.tolist()] * ds.sizes[over[0]]
    found = {column_heading("creepage", "1"): creepages}
    for name, values in ds.data_vars.items():
        if values.dims == over:
            heading = column_heading(str(name), str(values.attrs.get("units", "1")))
            found[heading] = values.values.tolist()
    return found


def _margins(ds: xr.Dataset) -> dict[str, list[float]]:
    found = margins(ds)
    return {str(name): found[name].values.tolist() for name in found.data_vars}


def _pressures(ds: xr.Dataset, points: Sequence[tuple[float, float]]) -> dict[str, list[float]]:
    """Pressure at points over the rows [Pa], bilinear between the centres of the cells."""
    if not points:
        return {}
    axis = run_axis(ds)
    stored, rows = field_times(ds, "export"), axis.values(ds)
    found = {}
    for x, y in points:
        for name, place in (("x", x), ("y", y)):
            low, high = float(ds[name][0]), float(ds[name][-1])
            if low < high and not low <= place <= high:
                raise ValueError(
                    f"{name} = {format_quantity(place, 'm')} is beyond the cells, which go from "
                    f"{format_quantity(low, 'm')} to {format_quantity(high, 'm')}"
                )
        known = dict(zip(stored.tolist(), _field_at(ds["pressure"], x=x, y=y).values, strict=True))
        column = [float(known.get(row, math.nan)) for row in rows.tolist()]
        found[f"pressure at x={x:.12g} m y={y:.12g} m [Pa]"] = column
    return found


def _header(ds: xr.Dataset) -> Iterator[str]:
    axis = run_axis(ds)
    yield f"{axis.name} [{axis.unit}]"
    for name in (*_scalars(ds), *_errors(ds)):
        units = SCALARS[name].units if name in SCALARS else str(ds[name].attrs["units"])
        yield column_heading(name, units)


def _scalars(ds: xr.Dataset) -> list[str]:
    """The scalars of a result; older ones lack the latest."""
    return scalars_in(ds)


def _errors(ds: xr.Dataset) -> list[str]:
    """The errors that a result states; older ones do not."""
    return scalars_in(ds, map(error_name, SCALARS))


def _rows(ds: xr.Dataset) -> Iterator[list[object]]:
    scalars = _scalars(ds)
    numbers = [run_axis(ds).values(ds), *(ds[name].values for name in (*scalars, *_errors(ds)))]
    place = 1 + scalars.index("outcome")  # the one column of words
    for row in zip(*numbers, strict=True):
        # repr: every digit, so that the numbers are those of the result
        cells: list[object] = [number.item() for number in row]
        cells[place] = Outcome(int(row[place])).name.lower()
        yield cells


def _field_at(field: xr.DataArray, **place: float) -> xr.DataArray:
    """Field at a place; along a single cell of a period it is the same everywhere."""
    for name, coordinate in place.items():
        single = field.sizes[name] == 1
        field = field.isel({name: 0}) if single else field.interp({name: coordinate})
    return field
