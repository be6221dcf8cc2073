"""The result of a run, written while it goes on."""

from __future__ import annotations

import time as clock
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

import netCDF4
import numpy as np
from numpy.typing import NDArray

from viscontact.accuracy.error_bars import ErrorBars
from viscontact.grid import Grid
from viscontact.runs.directory.closing import Closing
from viscontact.runs.directory.double_buffer import TwoCopies
from viscontact.runs.directory.netcdf_layout import (
    Extent,
    read_scalars,
    write_errors,
    write_fields,
    write_scalars,
)
from viscontact.runs.directory.result_spec import Contents
from viscontact.runs.directory.result_validation import sound_times, stored_grid
from viscontact.runs.directory.run_account import NOTHING_YET, Account
from viscontact.state import ContactState

#: Rows of scalars that wait in memory at most.
WAITING = 4096
#: How often, and after how long [s], the last publication is tried where the place is held.
TRIES, PAUSE = 40, 0.25
START: Mapping[str, Any] = {"rows": 0, "field_rows": 0, **NOTHING_YET}


class ResultWriter(Closing):
    """A result that grows by a state at a time and can be read at any moment.

    Rows are written to a hidden working copy; `publish` closes it and puts it in the place of the
    result, whose file becomes the working copy and is brought up to date. So the name of the
    result stands for a closed and complete netCDF-4 file at every moment, whatever happens to the
    process or to the power: HDF5 tears a file that is open for writing when it is killed, and
    locks it against readers.

    Parameters
    ----------
    path : path
        The result. What is there stays as it is until the first `publish`.
    contents : Contents
        What it is to hold. A state on a wider grid has it laid out anew.

    Notes
    -----
    Global attributes of its own: `warnings` and `grid_enlarged`, a line each; `wall_time` [s],
    summed over resumptions; `complete`, 1 once the run is over.

    Examples
    --------
    >>> import tempfile
    >>> import viscontact as vc
    >>> grid, times = vc.Grid((32, 32), (3e-3, 3e-3)), [0.0, 1.0]
    >>> rubber = vc.Material(vc.Elastic(1e7), 0.5)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "result.nc"
    ...     with ResultWriter(path, Contents(grid, np.array(times), "none")) as writer:
    ...         for state in vc.march(vc.Sphere(0.01), rubber, vc.step(2.0), grid, times):
    ...             writer.append(state)
    ...         writer.finish()
    ...     with vc.open_results(path) as ds:
    ...         ds.force.values.round(3).tolist(), int(ds.attrs["complete"])
    ([2.0, 2.0], 1)
    """

    def __init__(self, path: str | Path, contents: Contents) -> None:
        self._set_up(Path(path), contents, START, contents.grid)
        with self._writing():
            self._copies.begin(self._all_attributes())

    @classmethod
    def resume(cls, path: str | Path, contents: Contents, position: Mapping[str, Any]) -> Self:
        """Go on with a result from a position.

        Parameters
        ----------
        path : path
            The result. Rows it has beyond the position are written again as they come.
        contents : Contents
            What it is to hold, as before.
        position : dict
            The `position` of an earlier process when it published.

        Returns
        -------
        ResultWriter
            The next state to be appended is the one after the position.

        Raises
        ------
        ValueError
            If the result cannot be read, is another run's, or has fewer rows than that.
        """
        writer = cls.__new__(cls)
        # It may be ahead of the position, on a wider grid.
        so_far = Account(contents.grid, position).grid
        writer._set_up(Path(path), contents, position, stored_grid(Path(path), so_far))
        there = sound_times(writer._path, writer._layout, writer._done)
        writer._ahead = there[writer._done.rows :].tolist()
        writer._copies.take_over(writer._done)
        return writer

    def _set_up(
        self, path: Path, contents: Contents, position: Mapping[str, Any], laid_out: Grid
    ) -> None:
        self._done = Extent(position["rows"], position["field_rows"])
        self._kept = contents.kept
        self._account = Account(contents.grid, position)
        self._path, self._layout = path, contents.layout(laid_out)
        self._copies = TwoCopies(path, self._layout)
        self._attributes = {**contents.attributes, "complete": np.int32(0)}
        # States without fields, of rows from `_written` on.
        self._waiting: list[ContactState] = []
        self._written = self._done.rows
        self._failed = False
        # Instants of the rows that an earlier process has published beyond the position.
        self._ahead: list[float] = []

    @property
    def position(self) -> dict[str, Any]:
        """Where the writer stands: what `resume` takes, once `publish` has returned True.

        Returns
        -------
        dict
            Plain data: ``rows`` and ``field_rows``, how many there are, and an account of the run
            so far.
        """
        return {
            "rows": self._done.rows,
            "field_rows": self._done.field_rows,
            **self._account.position,
        }

    def append(self, state: ContactState) -> None:
        """Add a state; it is safe after the next `publish`.

        Parameters
        ----------
        state : ContactState
            The next state of the run.

        Raises
        ------
        OSError
            If it cannot be written: the result is as it was published last, and the run can be
            resumed from there.
        """
        rows, field_rows = self._done
        self._follow(state.time)
        self._make_room(state.grid)
        if self._layout.axis == "time" or state.time in self._kept:
            with self._writing():
                write_fields(self._copies.file, self._layout, field_rows, state)
            field_rows += 1
        # What an interruption here has left does not count.
        self._waiting[rows - self._written :] = [state.without_fields()]
        self._account.add(state)
        self._done = Extent(rows + 1, field_rows)
        if len(self._waiting) >= WAITING:
            with self._writing():
                self._write_waiting(self._copies.file)

    def publish(self) -> bool:
        """Put all states so far in the place of the result, at once and durably.

        Returns
        -------
        bool
            Whether they are there; False if a program that reads the result holds its place, as
            happens on Windows: then the next time has to do, and `position` is not reached yet.

        Raises
        ------
        OSError
            If that fails; the result is as it was published last.
        """
        return self._copies.published == self._done or self._publish()

    @property
    def grid(self) -> Grid:
        """Grid of the last state, the widest so far."""
        return self._account.grid

    def history(self) -> dict[str, NDArray[np.float64]]:
        """Return all scalars so far, and their instants, as they are written.

        Raises
        ------
        OSError
            If they cannot be written.
        """
        with self._writing():
            self._write_waiting(self._copies.file)
            found = read_scalars(self._copies.file)
        return {name: values[: self._done.rows] for name, values in found.items()}

    def finish(self, bars: ErrorBars | None = None) -> None:
        """Publish for the last time, as complete, and remove the working copy.

        Parameters
        ----------
        bars : ErrorBars, optional
            Errors of the scalars, of all rows.

        Raises
        ------
        OSError
            If that fails; the result is as it was published last.
        """
        if self._ahead:
            self._cut()
        if bars is not None:
            with self._writing():
                write_errors(self._copies.file, bars.values)
            self._account.add_warning(bars.warnings)
        self._attributes["complete"] = np.int32(1)
        for _ in range(TRIES):
            if self._publish():
                break
            clock.sleep(PAUSE)
        else:
            raise PermissionError(
                f"{self._path} cannot be replaced while another program reads it; "
                "close that program and resume the run"
            )
        self.close()

    def close(self) -> None:
        """Give up what is not published; never fails, and further calls do nothing."""
        with suppress(OSError):
            self._copies.discard()

    def _follow(self, time: float) -> None:
        """Keep step with the rows that are there already; what differs ends there."""
        if self._ahead and self._ahead[0] != time:
            self._cut()
        del self._ahead[:1]

    def _cut(self) -> None:
        with self._writing():
            self._write_waiting(self._copies.file)
            self._copies.cut(self._done, self._all_attributes())
        self._ahead = []

    def _make_room(self, grid: Grid) -> None:
        """Lay the file out anew if the run has enlarged its grid beyond that of the file."""
        room = self._layout.grid.shape
        if grid.shape[0] <= room[0] and grid.shape[1] <= room[1]:
            return
        layout = replace(self._layout, grid=grid)
        with self._writing():
            self._write_waiting(self._copies.file)
            self._copies.widen(layout, self._done, self._all_attributes())
        self._layout, self._ahead = layout, []

    def _publish(self) -> bool:
        with self._writing():
            file = self._copies.file
            self._write_waiting(file)
            for name, value in self._all_attributes().items():
                # What is written again leaves a hole in the file.
                if name not in file.ncattrs() or not np.array_equal(file.getncattr(name), value):
                    file.setncattr(name, value)
            return self._copies.publish(self._done)

    def _all_attributes(self) -> dict[str, Any]:
        return {**self._attributes, **self._account.attributes}

    def _write_waiting(self, file: netCDF4.Dataset) -> None:
        write_scalars(file, self._written, self._waiting[: self._done.rows - self._written])
        self._written, self._waiting = self._done.rows, []

    @contextmanager
    def _writing(self) -> Iterator[None]:
        """Let nothing be written any more once that has failed: a torn copy is not published."""
        if self._failed:
            raise OSError(f"{self._path} could not be written before; resume the run from it")
        self._failed = True
        try:
            yield
        except RuntimeError as error:  # what netCDF says where the disk is full
            raise OSError(f"{self._path} cannot be written ({error}); is the disk full?") from error
        self._failed = False
