"""Whether a result on disk is one that a run can go on with."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.runs.directory.netcdf_layout import Extent, Layout, opened

REMEDY = "start the run anew with --overwrite"


def sound_times(path: Path, layout: Layout, extent: Extent) -> NDArray[np.float64]:
    """Return the instants of a result, once it is certain that a run can go on with it.

    Parameters
    ----------
    path : Path
        The result.
    layout : Layout
        The layout it has to have.
    extent : Extent
        The rows it has to have at least.

    Returns
    -------
    ndarray
        Its instants, those beyond that extent included [s].

    Raises
    ------
    ValueError
        If it cannot be read, has another layout, or fewer rows.
    """
    if not path.is_file():
        raise ValueError(f"{path} is not there, so the run cannot go on; {REMEDY}")
    try:
        with opened(path, "r") as file:
            fault = _fault(file, layout, extent)
            times = np.array([]) if fault else _times(file, layout)
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"{path} cannot be read as a netCDF result ({error}); {REMEDY}") from error
    if not fault and not (np.diff(times[: extent.rows]) > 0).all():
        fault = "its times do not increase"
    if fault:
        raise ValueError(f"{path} is not the result of this run so far: {fault}; {REMEDY}")
    return times


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
        return grid  # what is wrong with it is told by `sound_times`


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


def _times(file: netCDF4.Dataset, layout: Layout) -> NDArray[np.float64]:
    """Read every scalar once, so that what is damaged is known now."""
    for name, (_, dimensions) in layout.columns.items():
        if len(dimensions) == 1:
            file.variables[name][:]
    return np.array(file.variables["time"][:])
