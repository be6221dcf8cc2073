"""Results on disk: CF netCDF-4, streamed while a run goes on."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import netCDF4
import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.dataset import COORDINATES, FIELDS, OUTCOME_FLAGS, SCALARS, Variable, field_axis
from viscontact.grid import Grid
from viscontact.instants import field_instants
from viscontact.state import ContactState

#: The result's name in a run directory.
RESULT_NAME = "result.nc"


class ResultWriter:
    """A netCDF file that grows by a state at a time and can be read at any moment.

    Each state is synced to disk before the next is computed, so that what is complete stays
    readable if the run is killed.

    Parameters
    ----------
    path : path
        The file; what was there is replaced.
    grid : Grid
        Grid of the fields.
    times : ndarray
        Instants of the run [s].
    fields : "all", "none" or sequence of float
        Instants [s] whose fields are written.
    attributes : dict
        Global attributes.
    """

    def __init__(
        self,
        path: str | Path,
        grid: Grid,
        times: NDArray[np.float64],
        *,
        fields: str | Sequence[float] = "all",
        attributes: dict[str, Any] | None = None,
    ) -> None:
        self._started = clock.perf_counter()
        self._said: list[str] = []
        self._kept = set(field_instants(fields, times).tolist())
        self._axis = field_axis(fields)
        self._file = netCDF4.Dataset(str(path), "w", format="NETCDF4")
        self._file.setncatts({**(attributes or {}), "warnings": "", "wall_time": 0.0})
        self._lay_out(grid)

    def _lay_out(self, grid: Grid) -> None:
        self._file.createDimension("time", None)
        self._create("time", ("time",), COORDINATES["time"])
        for name, centres in (("x", grid.x), ("y", grid.y)):
            self._file.createDimension(name, len(centres))
            self._create(name, (name,), COORDINATES[name])[:] = centres
        for name, variable in SCALARS.items():
            self._create(name, ("time",), variable)
        self._file["outcome"].setncatts(OUTCOME_FLAGS)
        if not self._kept:
            return
        if self._axis != "time":
            self._file.createDimension(self._axis, None)
            self._create(self._axis, (self._axis,), Variable("s", "time of the stored fields"))
        for name, variable in FIELDS.items():
            self._create(name, (self._axis, "x", "y"), variable, compressed=True)

    def _create(
        self, name: str, dimensions: tuple[str, ...], variable: Variable, compressed: bool = False
    ) -> Any:
        options: dict[str, Any] = {"fill_value": np.nan} if variable.kind == "f8" else {}
        if compressed:
            chunks = (1, *(len(self._file.dimensions[axis]) for axis in dimensions[1:]))
            options |= {"zlib": True, "complevel": 1, "shuffle": True, "chunksizes": chunks}
        created = self._file.createVariable(name, variable.kind, dimensions, **options)
        created.setncatts(variable.attributes)
        return created

    def append(self, state: ContactState) -> None:
        """Write a state and sync.

        Parameters
        ----------
        state : ContactState
            The next state of the run.
        """
        row = len(self._file.dimensions["time"])
        if self._axis == "time" or state.time in self._kept:
            self._append_fields(state)
        for name in SCALARS:
            self._file[name][row] = getattr(state, name)
        # Time last: a row counts only once all of it is there.
        self._file["time"][row] = state.time
        self._said += state.warnings
        self._file.setncattr("warnings", "\n".join(self._said))
        self._file.setncattr("wall_time", clock.perf_counter() - self._started)
        self._file.sync()

    def _append_fields(self, state: ContactState) -> None:
        row = len(self._file.dimensions[self._axis])
        for name in FIELDS:
            self._file[name][row] = getattr(state, name)
        if self._axis != "time":
            self._file[self._axis][row] = state.time

    def close(self) -> None:
        """Close the file; further calls do nothing."""
        if self._file.isopen():
            self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def save(ds: xr.Dataset, path: str | Path) -> None:
    """Save a result as CF netCDF-4.

    Parameters
    ----------
    ds : xarray.Dataset
        From `simulate`.
    path : path
        The file, by custom ending in ``.nc``; replaced if it is there.

    Examples
    --------
    >>> import tempfile, xarray
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(xarray.Dataset({"force": ("time", [1.0])}), Path(folder) / "run.nc")
    ...     with open_results(Path(folder) / "run.nc") as ds:
    ...         float(ds.force[0])
    1.0
    """
    ds.to_netcdf(path, format="NETCDF4", engine="netcdf4")


def open_results(path: str | Path) -> xr.Dataset:
    """Open the result of a run; fields are read when used.

    Parameters
    ----------
    path : path
        A run directory or a ``.nc`` file.

    Returns
    -------
    xarray.Dataset
        As `simulate` returns it; a context manager that closes the file.

    Raises
    ------
    FileNotFoundError
        If there is no result.
    ValueError
        If the file cannot be read as netCDF.
    """
    file = Path(path)
    file = file / RESULT_NAME if file.is_dir() else file
    if not file.is_file():
        raise FileNotFoundError(f"no result at {file}")
    try:
        return xr.open_dataset(file, engine="netcdf4")
    except (OSError, ValueError) as error:
        raise ValueError(f"{file} cannot be read as a netCDF result: {error}") from error
