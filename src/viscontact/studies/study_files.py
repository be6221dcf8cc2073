"""Files in the directory of a study: its table, and the best case."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import IO

import xarray as xr

from viscontact.case import Case
from viscontact.results.netcdf import save
from viscontact.runs.directory.atomic_files import fresh_name, put_in_place, replacing
from viscontact.units.formatting import column_heading

#: The best case, and the table of a study as CF netCDF-4.
BEST_NAME, TRIALS_NAME = "best.yaml", "trials.nc"


def write_table(path: Path, table: xr.Dataset) -> None:
    """Write a table as netCDF-4 with digests, atomically."""
    fresh = fresh_name(path)
    try:
        save(table, fresh.absolute())
        put_in_place(fresh, path)
    finally:
        fresh.unlink(missing_ok=True)


def write_rows(table: xr.Dataset, dim: str, file: IO[str]) -> None:
    """Write the columns of a table along a dimension as CSV, in SI units with every digit."""
    names = [dim, *(name for name in table.coords if name != dim), *table.data_vars]
    columns = [name for name in names if table[name].dims == (dim,)]
    headings = [column_heading(str(n), str(table[n].attrs.get("units", "1"))) for n in columns]
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(headings)
    for row in zip(*(table[name].values.tolist() for name in columns), strict=True):
        # A spreadsheet has no NaN.
        writer.writerow("" if cell != cell else cell for cell in row)


def write_case(path: Path, case: Case) -> None:
    """Write a case, and the files that it names next to it, unless they are those there."""
    with replacing(path) as file:
        file.write(case.text.encode())
    for source, name in case.file_names.items():
        copy = path.parent / name
        if source.resolve() != copy.resolve():
            with replacing(copy) as file:
                file.write(source.read_bytes())
