"""What a result on disk says of itself: whose it is, and whether it is whole."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import netCDF4

from viscontact.results.recorded_case import parse_case
from viscontact.runs.directory.netcdf_layout import opened


@dataclass(frozen=True)
class StoredRun:
    """A result that lies in a directory.

    Attributes
    ----------
    rows : int
        Its instants.
    complete : bool
        Whether its run was over.
    case : dict or None
        The run in plain words, as `Recorded.case`; None if it does not say, as one that
        viscontact has not written.
    """

    rows: int
    complete: bool
    case: dict[str, Any] | None


def stored_run(path: Path) -> StoredRun:
    """Read what a result says of itself.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    ValueError
        If it cannot be read as a result.
    """
    try:
        with opened(path, "r") as file:
            if "time" not in file.dimensions:
                raise ValueError("it has no times")
            complete = "complete" in file.ncattrs() and int(file.getncattr("complete")) == 1
            return StoredRun(len(file.dimensions["time"]), complete, _case(file))
    except (OSError, RuntimeError, ValueError, TypeError, OverflowError) as error:
        raise ValueError(f"{path} cannot be read as a result of viscontact: {error}") from error


def _case(file: netCDF4.Dataset) -> dict[str, Any] | None:
    if not {"case", "fields"} <= set(file.ncattrs()):
        return None
    case = parse_case(str(file.getncattr("case")))
    fields = json.loads(str(file.getncattr("fields")))
    errors = json.loads(str(file.getncattr("errors"))) if "errors" in file.ncattrs() else False
    return {**case, "fields": fields, "errors": errors}
