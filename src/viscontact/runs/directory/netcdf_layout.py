"""Layout of a result's netCDF file, and how its rows are written and copied."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import field, replace
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.kept_fields import ALL_FIELDS, KeptFields
from viscontact.mechanics.state import ContactState
from viscontact.results.digests import RunningDigests
from viscontact.results.enlarged_grid import line_on_wider, on_wider
from viscontact.results.stored_result import StoredFile, keep_little
from viscontact.results.variables import (
    AXES,
    COORDINATES,
    CREEPAGE,
    ERRORS,
    EVERY_FIELD,
    FRICTION_FIELDS,
    LINES,
    SCALARS,
    Variable,
    curve_of,
    curves_of,
    error_name,
    field_axis_attributes,
    fields_of,
    fields_over_creepage,
    parts_of,
    parts_on,
    scalar_attributes,
    scalars_of,
    scalars_with_error,
    value_of,
)

#: Memory for rows that are copied from one file to another [bytes].
BLOCK = 2**23
#: Tolerance from which fields are stored in single precision, which rounds by a tenth of it.
SINGLE_PRECISION = 10 * 2.0**-24
#: Size of a first write to a file, which finds out why HDF5 cannot create it [bytes].
_FIRST_BYTES = 4096


class Extent(NamedTuple):
    """Number of rows along each unlimited dimension of a result."""

    rows: int  # of scalars, along ``time`` or ``speed``
    field_rows: int  # of fields, along their axis


@dataclass(frozen=True, eq=False)
class Layout:
    """Dimensions and variables of a result's file."""

    grid: Grid  # of the fields
    axis: str | None  # dimension of the fields, ``time`` or ``field_time``; None without fields
    errors: bool = False  # True with room for the errors of scalars, NaN until they are known
    kind: str = "f8"  # NumPy's name of the type of the fields
    parts: frozenset[str] = frozenset()  # of scalars that only some results have
    over: str = "time"  # dimension of the scalars: "time", or "speed" in steady motion
    creepages: tuple[float, ...] = ()  # of a body that rolls in steady motion with traction [-]

    @property
    def coordinates(self) -> dict[str, Any]:
        """Values of the dimensions that the run does not add to."""
        creeping = {"creepage": np.array(self.creepages)} if self.creepages else {}
        return {"x": self.grid.x, "y": self.grid.y, **creeping}

    @property
    def curves(self) -> dict[str, Variable]:
        """Values of each row over the creepage."""
        return curves_of(self.parts)

    @property
    def scalars(self) -> dict[str, Variable]:
        """Scalars of each row."""
        return scalars_of(self.parts, self.over)

    @property
    def columns(self) -> dict[str, tuple[Variable, tuple[str, ...]]]:
        """Each variable with its dimensions, in the order of the file."""
        columns = {name: ((AXES | COORDINATES)[name], (name,)) for name in (self.over, "x", "y")}
        columns |= {name: (variable, (self.over,)) for name, variable in self.scalars.items()}
        if self.errors:
            names = map(error_name, scalars_with_error(self.parts, self.over))
            columns |= {name: (ERRORS[name], (self.over,)) for name in names}
        found: dict[str, tuple[Variable, tuple[str, ...]]] = dict(columns)
        if self.creepages:
            found["creepage"] = CREEPAGE, ("creepage",)
        for name, variable in self.curves.items():
            found[name] = variable, (self.over, "creepage")
            if self.errors and variable.has_error:
                found[error_name(name)] = ERRORS[error_name(name)], (self.over, "creepage")
        if self.axis is None:
            return found
        if self.axis != self.over:
            about = field_axis_attributes(self.over)
            found[self.axis] = (Variable(about["units"], about["long_name"]), (self.axis,))
        fields = fields_of(self.parts)
        axes: dict[str, tuple[str, ...]] = dict.fromkeys(fields, ("x", "y")) | dict.fromkeys(
            LINES, ("x",)
        )
        more = fields_over_creepage(self.parts)
        axes |= dict.fromkeys(more, ("creepage", "x", "y"))
        return found | {
            name: (
                replace(variable, kind=self.kind) if variable.kind == "f8" else variable,
                (self.axis, *axes[name]),
            )
            for name, variable in (fields | LINES | more).items()
        }

    def extent_of(self, file: netCDF4.Dataset | StoredFile) -> Extent:
        """Return how many rows a file of this layout has."""
        lengths = [len(file.dimensions[axis]) if axis else 0 for axis in (self.over, self.axis)]
        return Extent(*lengths)


@dataclass(frozen=True, eq=False)
class Contents:
    """Quantities, grid and instants or speeds that the result of a run is to hold."""

    grid: Grid  # of the fields when the run begins
    rows: Floats  # instants [s] or speeds [m/s]
    fields: KeptFields = ALL_FIELDS
    attributes: Mapping[str, Any] = field(default_factory=dict)  # global ones
    errors: bool = False  # True if errors of the scalars will be added
    tolerance: float = 0.0  # relative error of the pressure, for the precision of the fields
    parts: frozenset[str] = frozenset()  # of scalars that only some results have
    over: str = "time"  # "time", or "speed" in steady motion
    creepages: tuple[float, ...] = ()  # of a body that rolls in steady motion with traction [-]

    @property
    def kept(self) -> frozenset[float]:
        """Instants [s] or speeds [m/s] whose fields are kept, among those known before the run."""
        return frozenset(self.fields.among(self.rows, self.over).tolist())

    def layout(self, grid: Grid) -> Layout:
        """Return the layout of the result's file for some grid of the fields."""
        axis = self.fields.axis(self.over) if self.kept else None
        kind = "f4" if self.tolerance >= SINGLE_PRECISION else "f8"
        parts = parts_on(grid, self.parts)
        return Layout(grid, axis, self.errors, kind, parts, self.over, self.creepages)


def created(
    path: Path, layout: Layout, attributes: Mapping[str, Any]
) -> tuple[netCDF4.Dataset, RunningDigests]:
    """Create a result without rows and with global attributes, open for appending."""
    with true_cause(path):
        file = netCDF4.Dataset(str(path), "w", format="NETCDF4")
    file.set_auto_maskandscale(False)
    file.setncatts(attributes)
    file.createDimension(layout.over, None)
    for name, values in layout.coordinates.items():
        file.createDimension(name, len(values))
    if layout.axis not in (None, layout.over):
        file.createDimension(layout.axis, None)
    for name, (variable, dimensions) in layout.columns.items():
        _create(file, name, variable, dimensions)
    for name in (*layout.scalars, *layout.curves):
        file[name].setncatts(scalar_attributes(name, errors=layout.errors))
    keep_little(file)
    digests = RunningDigests(file)
    for name, values in layout.coordinates.items():
        file[name][:] = values
        digests.add(name, values)
    return file, digests


@contextmanager
def true_cause(path: Path) -> Iterator[None]:
    """Raise what the system says of a file that netCDF cannot create, such as on a full disk."""
    try:
        yield
    except PermissionError:  # netCDF says so wherever HDF5 cannot write the first bytes
        with path.open("wb") as file:
            file.write(bytes(_FIRST_BYTES))
        raise


def _create(
    file: netCDF4.Dataset, name: str, variable: Variable, dimensions: tuple[str, ...]
) -> None:
    options: dict[str, Any] = {"fill_value": np.nan} if variable.kind in ("f4", "f8") else {}
    if name in EVERY_FIELD | LINES:
        options["chunksizes"] = (1, *(len(file.dimensions[axis]) for axis in dimensions[1:]))
    if name in ("pressure", "in_contact") or name in FRICTION_FIELDS:
        # Mostly 0. Gap and displacement hardly shrink, at many times the cost of writing.
        options |= {"zlib": True, "complevel": 1, "shuffle": True}
    file.createVariable(name, variable.kind, dimensions, **options).setncatts(variable.attributes)


def write_scalars(
    file: netCDF4.Dataset, digests: RunningDigests, row: int, states: Sequence[ContactState]
) -> None:
    """Write the scalars of consecutive states, and their instants or speeds, from a row on."""
    if not states:
        return
    over = states[0].over
    scalars = scalars_of(parts_of(states[0]), over)
    for name, variable in {over: AXES[over], **scalars}.items():
        own = (getattr(state, over) if name == over else value_of(state, name) for state in states)
        values = np.array(list(own), dtype=variable.kind)
        file.variables[name][row : row + len(states)] = values
        digests.add(name, values)
    for name in curves_of(parts_of(states[0])):
        curves = np.stack([curve_of(state, name) for state in states])
        _write_rows(file, digests, name, row, curves)
    unknown = np.full(len(states), np.nan)  # which fills the rows until the errors are known
    for name in ERRORS:
        if name not in file.variables:
            continue
        if file.variables[name].ndim == 1:
            digests.add(name, unknown)
        else:
            curves = np.full((len(states), file.variables[name].shape[1]), np.nan)
            _write_rows(file, digests, name, row, curves)


def read_scalars(file: netCDF4.Dataset) -> dict[str, Floats]:
    """Read all scalars, and their instants or speeds, by name."""
    names = [
        name
        for name in (*AXES, *SCALARS)
        if name in file.variables and "creepage" not in file.variables[name].dimensions
    ]
    return {name: np.asarray(file.variables[name][:], dtype=np.float64) for name in names}


def described_fields(file: netCDF4.Dataset | StoredFile) -> dict[str, Any] | None:
    """Describe instants [s] or speeds [m/s], and grid [m], of the stored fields; None without."""
    # Results with equal descriptions store fields at the same places.
    # Those over the creepage are in the results of single runs only.
    names = [
        name
        for name in EVERY_FIELD | LINES
        if name in file.variables and "creepage" not in file.variables[name].dimensions
    ]
    if not names:
        return None
    axis = str(file.variables[names[0]].dimensions[0])
    centres = {name: file.variables[name][:] for name in ("x", "y")}
    grid = {name: [len(at), float(at[0]), float(at[-1])] for name, at in centres.items()}
    instants = file.variables[axis][:].tolist() if axis not in AXES else None
    return {"names": names, "axis": axis, "instants": instants, **grid}


def write_errors(
    file: netCDF4.Dataset, digests: RunningDigests, values: Mapping[str, Floats]
) -> None:
    """Write the errors of the scalars, for all rows, by the names of the scalars."""
    for scalar, errors in values.items():
        name = error_name(scalar)
        if errors.ndim > 1:
            _write_rows(file, digests, name, 0, errors)
            continue
        file.variables[name][: len(errors)] = errors
        digests.replace(name, file.variables[name][:])


def write_fields(
    file: netCDF4.Dataset, digests: RunningDigests, layout: Layout, row: int, state: ContactState
) -> None:
    """Write the fields of a state on the grid of the layout or a smaller one, and their instant."""
    for name in fields_of(layout.parts):
        values = on_wider(name, getattr(state, name), state.grid, layout.grid)
        _write_rows(file, digests, name, row, values[np.newaxis])
    for name in LINES:
        line = line_on_wider(getattr(state, name), state.grid, layout.grid)
        _write_rows(file, digests, name, row, line[np.newaxis])
    for name in fields_over_creepage(layout.parts):
        values = getattr(state.rolling_traction, name)
        _write_rows(file, digests, name, row, values[np.newaxis])
    if layout.axis not in (None, layout.over):
        file.variables[layout.axis][row] = getattr(state, layout.over)


def _write_rows(
    file: netCDF4.Dataset, digests: RunningDigests, name: str, row: int, values: Any
) -> None:
    """Write rows of a variable along several axes, in its type, and their digests."""
    variable = file.variables[name]
    stored = np.asarray(values, dtype=variable.dtype)
    variable[row : row + len(stored)] = stored
    digests.put(file, name, row, stored)


def copy_rows(
    source: StoredFile,
    target: netCDF4.Dataset,
    digests: RunningDigests,
    grids: tuple[Layout, Grid],
    extent: Extent,
) -> None:
    """Copy the first rows of a result of some layout to one on a grid that is at least as large."""
    layout, grid = grids
    for name, (_, dimensions) in layout.columns.items():
        if dimensions[0] in layout.coordinates:
            continue
        last = extent.field_rows if dimensions[0] == layout.axis else extent.rows
        if len(dimensions) == 1:
            values = source.variables[name][:last]
            target.variables[name][:last] = values
            digests.add(name, values)
            continue
        for rows in _blocks(last, source.variables[name].shape[1:]):
            values = source.variables[name][rows]
            if name in EVERY_FIELD and dimensions[-1] == "y":
                values = on_wider(name, values, layout.grid, grid)
            elif name in LINES:
                values = line_on_wider(values, layout.grid, grid)
            _write_rows(target, digests, name, rows.start, values)


def _blocks(last: int, shape: tuple[int, ...]) -> Iterator[slice]:
    """Yield slices of rows that fit into `BLOCK`."""
    size = max(1, BLOCK // (8 * int(np.prod(shape))))
    for row in range(0, last, size):
        yield slice(row, min(row + size, last))
