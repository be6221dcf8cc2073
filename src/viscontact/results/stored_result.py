"""Result file read without xarray, whose import takes longer than to print a table."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeAlias, TypeVar, Union

import netCDF4
import numpy as np

from viscontact.results.damage import DamagedFileError, note_unchecked
from viscontact.results.digests import StoredDigests
from viscontact.results.run_files import RESULT_NAME
from viscontact.results.seal import check_seal
from viscontact.results.stated_sizes import require_stated_sizes
from viscontact.results.variables import EVERY_FIELD

if TYPE_CHECKING:
    import xarray as xr

_Opened = TypeVar("_Opened")

#: What netCDF4 and its callers raise where the bytes of a file are damaged.
_UNREADABLE = (
    *(OSError, RuntimeError, ValueError, LookupError, TypeError, AttributeError),
    *(ArithmeticError, AssertionError),
)


def open_to_append(path: Path) -> netCDF4.Dataset:
    """Open a result without masks for appending."""
    file = without_masks(netCDF4.Dataset(str(path), "a"))
    keep_little(file)
    return file


@contextmanager
def appending(path: Path) -> Iterator[netCDF4.Dataset]:
    """Open a result for appending within the block; OSError or RuntimeError if a write fails."""
    file = open_to_append(path)
    try:
        yield file
    finally:
        close_written(file)


def close_written(file: netCDF4.Dataset) -> None:
    """Close a file that was written; OSError or RuntimeError if the last bytes cannot be."""
    # Where a write fails in the call of HDF5 that closes a file, netCDF goes on with freed memory,
    # which ends the process without a word. So the rows are written before, and it is tried
    # whether the first bytes can be, which HDF5 writes again in that call.
    try:
        file.sync()
        _write_again(Path(file.filepath()))
    except (OSError, RuntimeError):
        # Its destructor would close it. HDF5 gives it up when the process ends.
        vars(netCDF4.Dataset)["_isopen"].__set__(file, 0)
        raise
    file.close()


def _write_again(path: Path) -> None:
    """Write the first byte of a file once more, as it is."""
    with path.open("r+b", buffering=0) as file:
        first = file.read(1)
        file.seek(0)
        file.write(first)


def without_masks(file: netCDF4.Dataset) -> netCDF4.Dataset:
    """Let a file return the values that it stores: NaN is the fill value and would be masked."""
    file.set_auto_maskandscale(False)
    file.set_auto_chartostring(False)
    return file


def keep_little(file: netCDF4.Dataset) -> None:
    """Let HDF5 write fields at once: its default cache holds some dozen rows until closing."""
    for name in EVERY_FIELD:
        if name in file.variables:
            file.variables[name].set_var_chunk_cache(size=1, nelems=1, preemption=1.0)


@contextmanager
def noticing_damage(path: Path) -> Iterator[None]:
    """Raise DamagedFileError for what the libraries raise where they cannot read a file."""
    try:
        yield
    except DamagedFileError:
        raise
    except _UNREADABLE as error:
        raise DamagedFileError(path, f"its contents ({error})") from error


class StoredVariable:
    """Variable of a result file, with the attributes of an xarray.DataArray that tables use."""

    def __init__(
        self, variable: netCDF4.Variable[Any], digests: StoredDigests | None, path: Path
    ) -> None:
        self._variable, self._digests, self._path = variable, digests, path
        self.shape: tuple[int, ...] = variable.shape
        self.dtype = variable.dtype
        self.getncattr = variable.getncattr

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the axes."""
        return self._variable.dimensions

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Names of the axes."""
        return self.dims

    @property
    def values(self) -> Any:
        """All values, in the unit of the file."""
        return self[...]

    def __getitem__(self, key: Any) -> Any:
        """Return some of the values; DamagedFileError if they are not as they were written."""
        with noticing_damage(self._path):
            if self._digests is None:
                return np.asarray(self._variable[key])
            return self._digests.read(self._variable, key)


class StoredFile:
    """Result file under names of netCDF4, which checks what is read against its digests.

    DamagedFileError of any method where they differ. A file without digests is `noted` in the log.
    """

    def __init__(self, path: Path, *, noted: bool = True) -> None:
        require_sound(path)
        self._file = netCDF4.Dataset(str(path))
        try:
            with noticing_damage(path):
                keep_little(self._file)
                self.digests = checked_digests(without_masks(self._file), path, noted=noted)
                self.variables = {
                    name: StoredVariable(each, self.digests, path)
                    for name, each in self._file.variables.items()
                }
        except BaseException:
            self._file.close()
            raise
        self.dimensions = self._file.dimensions
        self.ncattrs, self.getncattr = self._file.ncattrs, self._file.getncattr

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> Self:
        """Return the file itself."""
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def require_sound(path: Path) -> None:
    """Check a file before HDF5 reads it: its seal or, if it has none, the sizes that it states."""
    if not check_seal(path):
        require_stated_sizes(path)


def checked_digests(
    file: netCDF4.Dataset, path: Path, *, noted: bool = True
) -> StoredDigests | None:
    """Check a file and return its digests; None, `noted` in the log, if it has none."""
    digests = StoredDigests.of(file)
    if digests is not None:
        digests.check_file(file)
    elif noted:
        note_unchecked(path)
    return digests


class StoredResult:
    """Result file, with the attributes of an xarray.Dataset that tables use."""

    def __init__(self, path: Path) -> None:
        self._file = StoredFile(path)
        self.encoding = {"source": str(path)}
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
        return self._file.variables[name]

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
            return open_file(file)
        except (OSError, ValueError) as error:
            # A running run may have replaced the file at this very moment.
            if _marks(file) == before:
                if isinstance(error, DamagedFileError):
                    raise
                raise ValueError(f"{file} cannot be read as a netCDF result: {error}") from error


def _marks(file: Path) -> tuple[int, int]:
    """Identity of a file's content: inode and time of change."""
    found = file.stat()
    return found.st_ino, found.st_mtime_ns
