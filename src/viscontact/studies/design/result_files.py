"""Files of a result of a design: the best case and the table of the trials."""

from __future__ import annotations

from pathlib import Path

from viscontact.studies.design.result import DesignResult
from viscontact.studies.study_files import write_case, write_table

#: The best case, and all trials as CF netCDF-4.
BEST_NAME, TRIALS_NAME = "best.yaml", "trials.nc"


def write_result(directory: Path, found: DesignResult) -> None:
    """Write the best case, with the files that it names beside it, and the table of the trials."""
    write_case(directory / BEST_NAME, found.best_case)
    write_table(directory / TRIALS_NAME, found.table)
