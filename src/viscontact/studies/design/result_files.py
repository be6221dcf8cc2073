"""Files of a result of a design: the best case and the table of the trials."""

from __future__ import annotations

from pathlib import Path

from viscontact.runs.directory.atomic_files import fresh_name, put_in_place, replacing
from viscontact.studies.design.result import DesignResult

#: The best case, and all trials as CF netCDF-4.
BEST_NAME, TRIALS_NAME = "best.yaml", "trials.nc"


def write_result(directory: Path, found: DesignResult) -> None:
    """Write the best case, with the files that it names beside it, and the table of the trials."""
    case = found.best_case
    with replacing(directory / BEST_NAME) as file:
        file.write(case.text.encode())
    for source, name in case.file_names.items():
        with replacing(directory / name) as file:
            file.write(source.read_bytes())
    fresh = fresh_name(directory / TRIALS_NAME)
    try:
        found.table.to_netcdf(fresh.absolute(), format="NETCDF4", engine="netcdf4")
        put_in_place(fresh, directory / TRIALS_NAME)
    finally:
        fresh.unlink(missing_ok=True)
