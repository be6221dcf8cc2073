"""Result file read without xarray, whose import takes longer than to print a table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self, TypeAlias, TypeVar, Union

import netCDF4
import numpy as np

from viscontact.results.run_files import RESULT_NAME
from viscontact.results.stated_sizes import require_stated_sizes
from viscontact.results.variables import FIELDS

if TYPE_CHECKING:
    import xarray as xr

_Opened = TypeVar("_Opened")


def open_file(path: Path, mode: Literal["r", "a"] = "r") -> netCDF4.Dataset:
    """Open a result without masks, ``"r"`` for reading or ``"a"`` for appending."""
    file = netCDF4.Dataset(str(path), mode)
    # NaN is the fill value and would be masked.
    file.set_auto_maskandscale(False)
    keep_little(file)
    return file


def keep_little(file: netCDF4.Dataset) -> None:
    """Let HDF5 write fields at once: its default cache holds some dozen rows until closing."""
    for name in FIELDS:
        if name in file.variables:
            file.variables[name].set_var_chunk_cache(size=1, nelems=1, preemption=1.0)


class StoredVariable:
    """Variable of a result file, with the attributes of an xarray.DataArray that tables use."""

    def __init__(self, variable: netCDF4.Variable[Any]) -> None:
        self._variable = variable

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes."""
        return self._variable.dimensions

    @property
    def values(self) -> Any:
        """All values, in the unit of the file."""
        return self[...]

    def __getitem__(self, key: Any) -> Any:
        """Return some of the values."""
        return np.asarray(self._variable[key])


class StoredResult:
    """Result file, with the attributes of an xarray.Dataset that tables use."""

    def __init__(self, file: Path) -> None:
        self._file = open_file(file)
        self.encoding = {"source": str(file)}
        self.attrs = {name: self._file.getncattr(name) for name in self._file.ncattrs()}
        self.sizes = {name: len(axis) for name, axis in self._file.dimensions.items()}
        #: Variables other than coordinates.
        self.data_vars = [name for name in self._file.variables if name not in self.sizes]

    @property
    def dims(self) -> dict[str, int]:
        """Lengths of the axes."""
        return self.sizes

    def __contains__(self, name: object) -> bool:
        """Return whether there is a variable of some name."""
        return name in self._file.variables

    def __getitem__(self, name: str) -> StoredVariable:
        """Return a variable."""
        return StoredVariable(self._file.variables[name])

    def __enter__(self) -> Self:
        """Return the result itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self._file.close()


#: A result for functions that read scalars and attributes only.
Result: TypeAlias = Union["xr.Dataset", StoredResult]


def stored_result(path: str | Path) -> StoredResult:
    """Open the result in a run directory or a file; errors are those of `open_results`."""
    return open_replaceable(path, StoredResult)


def open_replaceable(path: str | Path, open_file: Callable[[Path], _Opened]) -> _Opened:
    """Open the result in a run directory or a file, which a run may replace meanwhile.

    FileNotFoundError if there is none, ValueError if it cannot be read.
    """
    file = Path(path)
    # Absolute: else "~", a blank in front or "file:" mean something of their own to the reader.
    file = (file / RESULT_NAME if file.is_dir() else file).absolute()
    if not file.is_file():
        raise FileNotFoundError(f"no result at {path}")
    while True:
        before = _marks(file)
        try:
            require_stated_sizes(file)
            return open_file(file)
        except (OSError, ValueError) as error:
            # A running run may have replaced the file at this very moment.
            if _marks(file) == before:
                raise ValueError(f"{file} cannot be read as a netCDF result: {error}") from error


def _marks(file: Path) -> tuple[int, int]:
    """Identity of a file's content: inode and time of change."""
    found = file.stat()
    return found.st_ino, found.st_mtime_ns
