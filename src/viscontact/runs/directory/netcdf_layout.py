"""What a result's file holds, and how its rows are written and copied."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.results.enlarged_grid import on_wider
from viscontact.results.variables import (
    COORDINATES,
    ERRORS,
    FIELDS,
    OUTCOME_FLAGS,
    SCALARS,
    Variable,
    error_name,
    scalar_attributes,
)
from viscontact.state import ContactState

#: Memory that rows on their way from one file to another may take [bytes].
BLOCK = 2**23


class Extent(NamedTuple):
    """How many rows there are along each of a result's growing dimensions.

    Attributes
    ----------
    rows : int
        Rows of scalars, along ``time``.
    field_rows : int
        Rows of fields, along the axis of the fields.
    """

    rows: int
    field_rows: int


@dataclass(frozen=True, eq=False)
class Layout:
    """Dimensions and variables of a result's file.

    Attributes
    ----------
    grid : Grid
        Grid of the fields.
    axis : str or None
        The dimension over which fields are kept, ``time`` or ``field_time``; None without fields.
    errors : bool
        Whether there is room for the errors of the scalars, which are NaN until they are known.
    """

    grid: Grid
    axis: str | None
    errors: bool = False

    @property
    def columns(self) -> dict[str, tuple[Variable, tuple[str, ...]]]:
        """Each variable with its dimensions, in the order of the file."""
        columns = {name: (variable, (name,)) for name, variable in COORDINATES.items()}
        scalars = SCALARS | ERRORS if self.errors else SCALARS
        columns |= {name: (variable, ("time",)) for name, variable in scalars.items()}
        found: dict[str, tuple[Variable, tuple[str, ...]]] = dict(columns)
        if self.axis is None:
            return found
        if self.axis != "time":
            found[self.axis] = (Variable("s", "time of the stored fields"), (self.axis,))
        axes = (self.axis, "x", "y")
        return found | {name: (variable, axes) for name, variable in FIELDS.items()}

    def extent_of(self, file: netCDF4.Dataset) -> Extent:
        """Return how many rows a file of this layout has."""
        lengths = [len(file.dimensions[axis]) if axis else 0 for axis in ("time", self.axis)]
        return Extent(*lengths)


def created(path: Path, layout: Layout, attributes: Mapping[str, Any]) -> netCDF4.Dataset:
    """Create a result without rows; what was at its place is replaced.

    Parameters
    ----------
    path : Path
        The file.
    layout : Layout
        What it is to hold.
    attributes : mapping
        Global attributes.

    Returns
    -------
    netCDF4.Dataset
        Open for appending.
    """
    file = netCDF4.Dataset(str(path), "w", format="NETCDF4")
    file.set_auto_maskandscale(False)
    file.setncatts(attributes)
    file.createDimension("time", None)
    for name, centres in (("x", layout.grid.x), ("y", layout.grid.y)):
        file.createDimension(name, len(centres))
    if layout.axis not in (None, "time"):
        file.createDimension(layout.axis, None)
    for name, (variable, dimensions) in layout.columns.items():
        _create(file, name, variable, dimensions)
    file["x"][:], file["y"][:] = layout.grid.x, layout.grid.y
    for name in SCALARS:
        file[name].setncatts(scalar_attributes(name, errors=layout.errors))
    file["outcome"].setncatts(OUTCOME_FLAGS)
    _keep_little(file)
    return file


def _create(
    file: netCDF4.Dataset, name: str, variable: Variable, dimensions: tuple[str, ...]
) -> None:
    options: dict[str, Any] = {"fill_value": np.nan} if variable.kind == "f8" else {}
    if name in FIELDS:
        chunks = (1, *(len(file.dimensions[axis]) for axis in dimensions[1:]))
        options |= {"zlib": True, "complevel": 1, "shuffle": True, "chunksizes": chunks}
    file.createVariable(name, variable.kind, dimensions, **options).setncatts(variable.attributes)


def opened(path: Path, mode: Literal["r", "a"]) -> netCDF4.Dataset:
    """Open a result as plain numbers, ``"r"`` for reading or ``"a"`` for appending.

    Parameters
    ----------
    path : Path
        The file.
    mode : str
        As for `netCDF4.Dataset`.

    Raises
    ------
    OSError
        If it cannot be opened.
    """
    file = netCDF4.Dataset(str(path), mode)
    # Else NaN, the fill value, would travel as a mask.
    file.set_auto_maskandscale(False)
    _keep_little(file)
    return file


def _keep_little(file: netCDF4.Dataset) -> None:
    """Let HDF5 write fields when they come: else some dozen rows wait, and closing takes long."""
    for name in FIELDS:
        if name in file.variables:
            file.variables[name].set_var_chunk_cache(size=1, nelems=1, preemption=1.0)


def write_scalars(file: netCDF4.Dataset, row: int, states: Sequence[ContactState]) -> None:
    """Write the scalars of states, and their instants, from a row on.

    Parameters
    ----------
    file : netCDF4.Dataset
        Open for appending.
    row : int
        Row of the first state.
    states : sequence of ContactState
        States in order; their fields are not needed.
    """
    if not states:
        return
    for name, variable in {"time": COORDINATES["time"], **SCALARS}.items():
        values = np.array([getattr(state, name) for state in states], dtype=variable.kind)
        file.variables[name][row : row + len(states)] = values


def read_scalars(file: netCDF4.Dataset) -> dict[str, NDArray[np.float64]]:
    """Read all scalars, and their instants.

    Parameters
    ----------
    file : netCDF4.Dataset
        A result.
    """
    names = ("time", *SCALARS)
    return {name: np.asarray(file.variables[name][:], dtype=np.float64) for name in names}


def write_errors(file: netCDF4.Dataset, values: Mapping[str, NDArray[np.float64]]) -> None:
    """Write the errors of the scalars, for all rows at once.

    Parameters
    ----------
    file : netCDF4.Dataset
        Open for appending, laid out for errors.
    values : mapping of str to ndarray
        The errors by the scalar's name.
    """
    for name, errors in values.items():
        file.variables[error_name(name)][: len(errors)] = errors


def write_fields(file: netCDF4.Dataset, layout: Layout, row: int, state: ContactState) -> None:
    """Write the fields of a state, and their instant, into a row.

    Parameters
    ----------
    file : netCDF4.Dataset
        Open for appending.
    layout : Layout
        Its layout, with fields.
    row : int
        The row of the fields.
    state : ContactState
        The state, on the grid of the layout or a smaller one.
    """
    for name in FIELDS:
        field = getattr(state, name)
        file.variables[name][row] = on_wider(name, field, state.grid, layout.grid)
    if layout.axis not in (None, "time"):
        file.variables[layout.axis][row] = state.time


def copy_rows(
    source: netCDF4.Dataset,
    target: netCDF4.Dataset,
    layout: Layout,
    begin: Extent,
    end: Extent,
    *,
    wider: Grid | None = None,
) -> None:
    """Copy rows from one result to another of the same layout, a few at a time.

    Parameters
    ----------
    source, target : netCDF4.Dataset
        From where, and where to; the second one open for appending.
    layout : Layout
        Their layout.
    wider : Grid, optional
        Grid of the second one; that of the layout when left out.
    begin, end : Extent
        The first rows to be copied, and those behind the last.
    """
    for name, (_, dimensions) in layout.columns.items():
        if dimensions[0] in ("x", "y"):
            continue
        along_fields = name in FIELDS or name == layout.axis != "time"
        first, last = (where.field_rows if along_fields else where.rows for where in (begin, end))
        if name not in FIELDS:
            for rows in _blocks(first, last, ()):
                target.variables[name][rows] = source.variables[name][rows]
            continue
        grid = wider or layout.grid
        for rows in _blocks(first, last, grid.shape):
            fields = on_wider(name, source.variables[name][rows], layout.grid, grid)
            target.variables[name][rows] = fields


def _blocks(first: int, last: int, shape: tuple[int, ...]) -> Iterator[slice]:
    """Yield rows in pieces that fit into the memory meant for them."""
    size = max(1, BLOCK // (8 * int(np.prod(shape))))
    for row in range(first, last, size):
        yield slice(row, min(row + size, last))
