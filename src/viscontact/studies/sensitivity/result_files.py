"""File of the result of a sensitivity: its table."""

from __future__ import annotations

from pathlib import Path

from viscontact.studies import study_files
from viscontact.studies.sensitivity.result import SensitivityResult

#: The table as netCDF-4, in the directory of the runs.
TABLE_NAME = "sensitivity.nc"


def write_table(directory: Path, found: SensitivityResult) -> None:
    """Write the table to the directory of the runs."""
    study_files.write_table(directory / TABLE_NAME, found.table)
