"""Whether a result on disk is one that a run can go on with."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from viscontact.grid import Grid
from viscontact.runs.directory.netcdf_layout import Extent, Layout, opened

REMEDY = "start the run anew with --overwrite"


def check_result(path: Path, layout: Layout, extent: Extent) -> None:
    """Refuse a result that cannot be resumed: damaged, of another layout, or with fewer rows.

    Raises
    ------
    ValueError
        With the reason and a remedy.
    """
    if not path.is_file():
        raise ValueError(f"{path} is not there, so the run cannot go on; {REMEDY}")
    try:
        with opened(path, "r") as file:
            fault = _fault(file, layout, extent) or _fault_of_scalars(file, layout, extent)
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"{path} cannot be read as a netCDF result ({error}); {REMEDY}") from error
    if fault:
        raise ValueError(f"{path} is not the result of this run so far: {fault}; {REMEDY}")


def stored_grid(path: Path, grid: Grid) -> Grid:
    """The grid of a result whose run may have enlarged it.

    Parameters
    ----------
    path : Path
        The result.
    grid : Grid
        The run's grid so far.

    Returns
    -------
    Grid
        The same cells, as many as the result has; the grid itself where it has no such grid.
    """
    try:
        with opened(path, "r") as file:
            return grid.widened((len(file.dimensions["x"]), len(file.dimensions["y"])))
    except (OSError, RuntimeError, ValueError, KeyError):
        return grid  # what is wrong with it is reported by `check_result`


def _fault(file: netCDF4.Dataset, layout: Layout, extent: Extent) -> str:
    for name, (variable, dimensions) in layout.columns.items():
        if name not in file.variables:
            return f"it has no {name}"
        found: Any = file.variables[name]
        if found.dimensions != dimensions or found.dtype != np.dtype(variable.kind):
            return f"its {name} is another kind of variable"
    if layout.axis is None and "field_time" in file.dimensions:
        return "it has fields"
    for name, centres in (("x", layout.grid.x), ("y", layout.grid.y)):
        if not np.array_equal(file.variables[name][:], centres):
            return f"its {name} is another grid's"
    there = layout.extent_of(file)
    if there.rows < extent.rows or there.field_rows < extent.field_rows:
        return (
            f"it has {there.rows} instants and {there.field_rows} with fields, "
            f"and {extent.rows} and {extent.field_rows} are wanted"
        )
    return ""


def _fault_of_scalars(file: netCDF4.Dataset, layout: Layout, extent: Extent) -> str:
    for name, (_, dimensions) in layout.columns.items():
        if len(dimensions) == 1:
            file.variables[name][:]  # raises where it is damaged
    times = file.variables["time"][: extent.rows]
    return "" if (np.diff(times) > 0).all() else "its times do not increase"
