"""Result of an earlier process: its description, and checks before a run is resumed from it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.state import LEAKAGE
from viscontact.results.damage import DamagedFileError
from viscontact.results.descriptions import parse_case
from viscontact.results.stored_result import StoredFile
from viscontact.results.variables import AXES
from viscontact.runs.directory.checkpoint import REMEDY
from viscontact.runs.directory.netcdf_layout import Extent, Layout


@dataclass(frozen=True)
class StoredRun:
    """Description of a stored result."""

    rows: int  # number of instants or speeds
    complete: bool  # True if the run was finished
    case: dict[str, Any] | None  # as `Analysis.case`; None in a file of another origin


def stored_run(path: Path) -> StoredRun:
    """Read the description of a stored result; ValueError if it cannot be read as one."""
    try:
        with StoredFile(path) as file:
            over = next((name for name in AXES if name in file.dimensions), None)
            if over is None:
                raise ValueError("it has no times")
            complete = "complete" in file.ncattrs() and int(file.getncattr("complete")) == 1
            return StoredRun(len(file.dimensions[over]), complete, _case(file))
    except DamagedFileError as error:
        raise ValueError(error.fault) from error
    except (OSError, RuntimeError, ValueError, TypeError, OverflowError) as error:
        raise ValueError(f"{path} cannot be read as a result of viscontact: {error}") from error


def _case(file: StoredFile) -> dict[str, Any] | None:
    if not {"case", "fields"} <= set(file.ncattrs()):
        return None
    case = parse_case(str(file.getncattr("case")))
    fields = json.loads(str(file.getncattr("fields")))
    errors = json.loads(str(file.getncattr("errors"))) if "errors" in file.ncattrs() else False
    fluid = {LEAKAGE: json.loads(str(file.getncattr(LEAKAGE)))} if LEAKAGE in file.ncattrs() else {}
    return {**case, "fields": fields, "errors": errors, **fluid}


def check_result(path: Path, layout: Layout, extent: Extent) -> None:
    """Raise ValueError for a result that is damaged, of another layout, or has fewer rows."""
    if not path.is_file():
        raise ValueError(f"{path} is missing, so the run cannot be continued; {REMEDY}")
    try:
        with StoredFile(path) as file:
            fault = _fault(file, layout, extent) or _fault_of_scalars(file, layout, extent)
    except DamagedFileError as error:
        raise ValueError(f"{error.fault}; {REMEDY}") from error
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"{path} cannot be read as a netCDF result ({error}); {REMEDY}") from error
    if fault:
        raise ValueError(f"{path} is not the result of this run so far: {fault}; {REMEDY}")


def stored_grid(path: Path, grid: Grid) -> Grid:
    """Return the grid of a result, whose run may have enlarged the given grid."""
    try:
        with StoredFile(path) as file:
            return grid.widened((len(file.dimensions["x"]), len(file.dimensions["y"])))
    except (OSError, RuntimeError, ValueError, KeyError):
        return grid  # `check_result` reports what is wrong with the file


def _fault(file: StoredFile, layout: Layout, extent: Extent) -> str:
    for name, (variable, dimensions) in layout.columns.items():
        if name not in file.variables:
            return f"it has no {name}"
        found: Any = file.variables[name]
        if found.dimensions != dimensions or found.dtype != np.dtype(variable.kind):
            return f"its {name} is another kind of variable"
    if layout.axis is None and f"field_{layout.over}" in file.dimensions:
        return "it has fields"
    for name, values in layout.coordinates.items():
        if not np.array_equal(file.variables[name][:], values):
            return f"its {name} is another grid's"
    there = layout.extent_of(file)
    rows = "instants" if layout.over == "time" else "speeds"
    if there.rows < extent.rows or there.field_rows < extent.field_rows:
        return (
            f"it has {there.rows} {rows} and {there.field_rows} with fields, "
            f"and {extent.rows} and {extent.field_rows} are wanted"
        )
    return ""


def _fault_of_scalars(file: StoredFile, layout: Layout, extent: Extent) -> str:
    for name, (_, dimensions) in layout.columns.items():
        if len(dimensions) == 1:
            file.variables[name][:]  # raises where it is damaged
    if layout.over != "time":
        return ""
    times = file.variables["time"][: extent.rows]
    return "" if (np.diff(times) > 0).all() else "its times do not increase"
