"""Opening of stored results, and messages about incomplete runs."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from viscontact.cli.terminal.messages import refuse
from viscontact.mechanics.state import Outcome
from viscontact.results.damage import DamagedFileError
from viscontact.results.recorded_case import case_of
from viscontact.results.run_axis import has_contacts_over_creepage, listed_creepages, run_axis
from viscontact.results.run_files import CASE_NAME, MANIFEST_NAME, RESULT_NAME, STATE_NAME
from viscontact.results.stated_sizes import StatedSizeError
from viscontact.results.stored_result import Result, stored_result
from viscontact.results.variables import REQUIRED, scalars_in, scalars_of
from viscontact.runs.directory.lock import is_locked
from viscontact.runs.processes.request import RunRequest
from viscontact.runs.progress_made import progress_made
from viscontact.units.parsing import parse_any_quantity

if TYPE_CHECKING:
    import xarray as xr

_Result = TypeVar("_Result", bound=Result)


@contextmanager
def checked_result(
    path: Path, creepage: str | None = None, *, several: bool = False
) -> Iterator[xr.Dataset]:
    """Open the result of a run, at one of its creepages if given, or refuse it with a message.

    `several` contacts of coupled bodies, one at each creepage, are refused unless they are wanted.
    """
    from viscontact.results.netcdf import open_results  # xarray takes half a second to import

    with _open_checked(path, open_results) as whole:
        ds = whole if creepage is None else _at_creepage(whole, creepage)
        if not (several and has_contacts_over_creepage(ds)):
            _require_history(path, ds)
        yield ds


@contextmanager
def checked_history(path: Path, creepage: str | None = None) -> Iterator[Result]:
    """Open the result of a run, without xarray where it is whole, with the same messages."""
    if creepage is not None:
        with checked_result(path, creepage) as ds:
            yield ds
        return
    with _open_checked(path, stored_result) as found:
        _require_history(path, found)
        yield found


def _at_creepage(ds: xr.Dataset, creepage: str) -> xr.Dataset:
    """Result at one of its creepages, or refuse it."""
    from viscontact.results.rolling import at_creepage  # as xarray

    try:
        value, unit = parse_any_quantity(creepage)
        if unit != "1":
            raise ValueError(f"creepage: {creepage!r} is no ratio; write e.g. '1 %'")
        return at_creepage(ds, value)
    except ValueError as error:
        refuse(f"--{error}" if str(error).startswith("creepage:") else f"--creepage: {error}")


@contextmanager
def _open_checked(path: Path, open_file: Callable[[Path], _Result]) -> Iterator[_Result]:
    try:
        ds = open_file(path)
    except FileNotFoundError:
        if (path / MANIFEST_NAME).is_file():
            refuse(
                f"{path}: is a sweep; name one of its runs, {path}/NAME, or write all of them to a "
                f"table with: viscontact collect {path} -o FILE.csv"
            )
        refuse(f"{path}: no result there; `viscontact run CASE.yaml -o {path}` makes one")
    except (OSError, ValueError) as error:
        refuse(_unreadable(path, error))
    try:
        with ds:
            yield ds
    except DamagedFileError as error:  # noticed when a field was read
        refuse(str(error))


def _require_history(path: Path, ds: Result) -> None:
    """Refuse a file that is not a result, of several contacts in a row, or without rows."""
    if has_contacts_over_creepage(ds):
        refuse(
            f"{path}: its bodies are coupled, and each creepage has a contact of its own; choose "
            f"one of {listed_creepages(ds)}: show, plot, export and report take e.g. "
            f"--creepage '{100 * float(ds['creepage'].values[0]):g} %'"
        )
    axis = run_axis(ds)
    required = [name for name in REQUIRED if name in scalars_of(over=axis.name)]
    missing = [name for name in (axis.name, *required) if name not in ds]
    if missing:
        refuse(f"{path}: not a result of viscontact: it has no {missing[0]}")
    stored = [name for name in (axis.name, *scalars_in(ds)) if name in ds]
    strange = [name for name in stored if ds[name].dims != (axis.name,)]
    if strange:
        refuse(f"{path}: not a result of viscontact: its {strange[0]} is not over {axis.name}")
    if not ds.sizes[axis.name]:
        refuse(f"{path}: the run was stopped before its first {axis.row} was complete")


def early_end(ds: Result) -> str:
    """Message about a run that ended early; empty for a complete one."""
    try:
        made = _progress_made(ds)
    except (KeyError, IndexError, TypeError, ValueError):  # not written by a run
        return ""
    if not made or int(ds["outcome"][-1]) == Outcome.PULLED_OFF:  # which ends a run
        return ""
    directory = _run_directory(ds)
    if directory is not None and is_locked(directory):
        return f"the run is still active, at {made}"
    failed = int(ds["outcome"][-1]) == Outcome.NOT_CONVERGED  # would fail again
    return f"the run stopped at {made}{'' if failed or directory is None else _remedy(directory)}"


def _progress_made(ds: Result) -> str:
    """Progress of a run that ended early; empty for a complete one."""
    case = case_of(ds)
    if not run_axis(ds).is_history:
        count, speeds = ds.sizes["speed"], case["motion"]["speed"]
        return f"{count} of {len(speeds)} speeds" if count < len(speeds) else ""
    times, reached = case["times"], float(ds["time"][-1])
    if reached >= float(times[-1]):
        return ""
    return progress_made(ds.sizes["time"], reached, times, case.get("adaptive"))


def _run_directory(ds: Result) -> Path | None:
    """Directory of an incomplete run; None if it cannot be resumed."""
    source = ds.encoding.get("source")
    directory = Path(str(source)).parent
    return directory if source is not None and (directory / STATE_NAME).is_file() else None


def _remedy(directory: Path) -> str:
    with suppress(ValueError):  # on another drive
        directory = Path(os.path.relpath(directory))
    return f"; continue with: {RunRequest(directory / CASE_NAME, directory).resuming}"


def _unreadable(path: Path, error: Exception) -> str:
    if isinstance(error, DamagedFileError):
        return str(error)
    # Messages of the reader repeat the file name and contain an error number.
    if isinstance(error.__cause__, StatedSizeError):
        return f"{path}: {error.__cause__}"
    if isinstance(error, ValueError) and path.is_file():
        return f"{path} is neither a run directory nor a netCDF file"
    if isinstance(error, ValueError):
        return f"{path}: its {RESULT_NAME} is not a netCDF file"
    return f"{path}: {error}"
