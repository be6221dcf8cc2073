"""File of the result of a sensitivity: its table."""

from __future__ import annotations

from pathlib import Path

from viscontact.runs.directory.atomic_files import fresh_name, put_in_place
from viscontact.studies.sensitivity.result import SensitivityResult

#: The table as netCDF-4, in the directory of the runs.
TABLE_NAME = "sensitivity.nc"


def write_table(directory: Path, found: SensitivityResult) -> None:
    """Write the table to the directory of the runs."""
    fresh = fresh_name(directory / TABLE_NAME)
    try:
        found.table.to_netcdf(fresh.absolute(), format="NETCDF4", engine="netcdf4")
        put_in_place(fresh, directory / TABLE_NAME)
    finally:
        fresh.unlink(missing_ok=True)
