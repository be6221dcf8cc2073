"""Result of a run on disk, written while the run continues."""

from __future__ import annotations

import shutil
import time as clock
from collections.abc import Mapping
from contextlib import AbstractContextManager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

import netCDF4
import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.state import ADHESION, ContactState, as_event
from viscontact.results.digests import RunningDigests, store_digests
from viscontact.results.enlarged_grid import enlargement
from viscontact.results.seal import seal
from viscontact.results.stored_result import StoredFile, close_written, open_to_append
from viscontact.runs.directory.atomic_files import MAY_BE_HELD, put_in_place
from viscontact.runs.directory.earlier_result import check_result, stored_grid
from viscontact.runs.directory.lock_check import LockCheck, never_lost
from viscontact.runs.directory.netcdf_layout import (
    Contents,
    Extent,
    Layout,
    copy_rows,
    created,
    described_fields,
    read_scalars,
    write_errors,
    write_fields,
    write_scalars,
)
from viscontact.runs.directory.write_guard import WriteGuard
from viscontact.simulation.accuracy.error_bars import ErrorBars
from viscontact.simulation.transient.provenance import (
    JUMP_TIME_ERRORS,
    contact_event_attributes,
    date_and_time,
)

#: Rows of scalars that wait in memory at most.
WAITING = 4096
#: Number and distance [s] of the attempts to replace a result that another program holds open.
TRIES, PAUSE = 40, 0.25
_COUNTS = {"rows": 0, "field_rows": 0, "wall_time": 0.0}
#: Position of a writer in plain data, and that before its first row.
Position = Mapping[str, Any]
START: Position = {**_COUNTS, "warnings": (), "cells": None, "enlarged": ()}


def working_files(path: Path) -> tuple[Path, Path]:
    """Return the hidden files: the one written to, and the one before an enlargement."""
    return path.with_name(f".{path.name}.working"), path.with_name(f".{path.name}.smaller")


class ResultWriter(AbstractContextManager["ResultWriter"]):
    """Writer of a result that grows by one state at a time and can be read at any moment.

    An OSError of any method leaves the result as it was published last, and the LockLost of
    `check`, which is called before each write, leaves all files to the other run.
    """

    # Rows are written to a hidden working file. `publish` closes it and renames it to the result; a
    # copy of that becomes the next working file. HDF5 leaves a file incomplete that is open for
    # writing when its process is killed, and locks it against readers.

    _layout: Layout
    _digests: RunningDigests

    def __init__(self, path: str | Path, contents: Contents, check: LockCheck = never_lost) -> None:
        self._set_up(Path(path), contents, START, check)
        self._layout = contents.layout(contents.grid)
        with self._guard.writing():
            self._create()

    @classmethod
    def resume(
        cls, path: str | Path, contents: Contents, position: Position, check: LockCheck = never_lost
    ) -> Self:
        """Continue a result from the `position` of an earlier process when it published.

        ValueError if it is unreadable, of another run, or has too few rows; later ones are dropped.
        """
        writer = cls.__new__(cls)
        writer._set_up(Path(path), contents, position, check)
        # The result may be ahead of the position, on a larger grid.
        writer._layout = contents.layout(stored_grid(Path(path), writer.grid))
        check_result(writer._path, writer._layout, writer._done)
        with writer._guard.writing():
            writer._create(writer._path, writer._layout)
        return writer

    def _set_up(self, path: Path, contents: Contents, position: Position, check: LockCheck) -> None:
        self._path, self._contents, self._check = path, contents, check
        self._guard = WriteGuard(path, check)
        self._open: netCDF4.Dataset | None = None
        self._done = Extent(position["rows"], position["field_rows"])
        self._published: Extent | None = None
        self._complete = False
        self.grid = contents.grid.widened(tuple(position["cells"] or contents.grid.shape))
        self._started: float = clock.monotonic() - position["wall_time"]
        # Positions of earlier versions lack it.
        self._date: str = position.get("started") or date_and_time()
        self._warnings, self._enlarged = list(position["warnings"]), list(position["enlarged"])
        # Positions of earlier versions have no events.
        self._events = [as_event(each) for each in position.get("events", ())]
        # States without fields, of rows from `_written` on.
        self._waiting: list[ContactState] = []
        self._written = self._done.rows
        self._kept = contents.kept
        #: Instants or speeds of the fields, where these have an axis of their own.
        self._field_places: list[float] = []

    @property
    def warnings(self) -> tuple[str, ...]:
        """Accuracy warnings of the states so far."""
        return tuple(self._warnings)

    @property
    def position(self) -> dict[str, Any]:
        """Plain data from which `resume` continues, once `publish` has returned True."""
        return {
            **self._done._asdict(),
            "warnings": list(self._warnings),
            "wall_time": clock.monotonic() - self._started,
            "started": self._date,
            "cells": list(self.grid.shape),
            "enlarged": list(self._enlarged),
            "events": [list(event) for event in self._events],
        }

    def append(self, state: ContactState) -> None:
        """Add the next state of the run; it is safe after the next `publish`."""
        rows, field_rows = self._done
        self._make_room(state.grid)
        if self._layout.axis == state.over or getattr(state, state.over) in self._kept:
            with self._guard.writing():
                write_fields(self._file(), self._digests, self._layout, field_rows, state)
            self._field_places[field_rows:] = [getattr(state, state.over)]
            field_rows += 1
        # What an interruption here has left does not count.
        self._waiting[rows - self._written :] = [state.without_fields()]
        if state.grid != self.grid:
            self._enlarged.append(enlargement(state.time, self.grid, state.grid))
            self.grid = state.grid
        self._warnings += state.warnings
        self._events += state.events
        self._done = Extent(rows + 1, field_rows)
        if len(self._waiting) >= WAITING:
            with self._guard.writing():
                self._write_waiting()

    def publish(self) -> bool:
        """Replace the result at once and durably; False if a program holds it on Windows."""
        return self._published == self._done or self._publish()

    def reopen(self) -> None:
        """Make the working file for the next rows."""
        with self._guard.writing():
            self._file()

    def history(self) -> dict[str, Floats]:
        """Return all scalars and instants so far."""
        with self._guard.writing():
            self._write_waiting()
            return read_scalars(self._file())

    def described_fields(self) -> dict[str, Any] | None:
        """Return the description of the stored fields; None without fields."""
        with self._guard.writing():
            self._write_waiting()
            return described_fields(self._file())

    def finish(
        self, bars: ErrorBars | None = None, attributes: Mapping[str, Any] | None = None
    ) -> None:
        """Publish the complete result with errors and these attributes, and close it."""
        found = {} if bars is None else bars.attributes
        described = {**self._contents.attributes, **found, **(attributes or {})}
        self._contents = replace(self._contents, attributes=described)
        if bars is not None:
            with self._guard.writing():
                write_errors(self._file(), self._digests, bars.values)
            self._warnings += bars.warnings
        self._complete = True
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
        """Discard what is not published; never fails, and further calls do nothing."""
        # On a full disk the rows that HDF5 still holds cannot be written.
        with suppress(OSError, RuntimeError):
            self._close()
        for file in working_files(self._path):
            with suppress(OSError):  # LockLost: the file is the other run's
                self._check()
                file.unlink(missing_ok=True)

    def __exit__(self, *_: object) -> None:
        self.close()

    def _create(self, source: Path | None = None, layout: Layout | None = None) -> None:
        """Create the working file, with the rows so far of another file of some layout."""
        self.close()
        try:
            self._open, self._digests = created(self._working, self._layout, self._attributes)
            if source is not None and layout is not None:
                self._copy(source, layout)
        except BaseException:
            self.close()
            raise

    def _copy(self, source: Path, layout: Layout) -> None:
        """Copy the rows so far of another file, of some layout, into the working file."""
        grids = layout, self._layout.grid
        with StoredFile(source) as stored:
            copy_rows(stored, self._file(), self._digests, grids, self._done)
            if layout.axis not in (None, layout.over):
                self._field_places = stored.variables[layout.axis][: self._done.field_rows].tolist()

    def _make_room(self, grid: Grid) -> None:
        """Give the working file a new layout if the run has outgrown the grid of the file."""
        room, layout = self._layout.grid.shape, self._layout
        if grid.shape[0] <= room[0] and grid.shape[1] <= room[1]:
            return
        with self._guard.writing():
            self._write_waiting()
            self._store_digests()
            self._close()
            self._layout = replace(layout, grid=grid)
            _, before = working_files(self._path)
            self._working.replace(before)
            self._open, self._digests = created(self._working, self._layout, self._attributes)
            self._copy(before, layout)
            self._check()
            before.unlink()

    def _publish(self) -> bool:
        with self._guard.writing():
            self._write_waiting()
            file = self._file()
            for name, value in self._attributes.items():
                # What is written again leaves a hole in the file.
                if name not in file.ncattrs() or not np.array_equal(file.getncattr(name), value):
                    file.setncattr(name, value)
            self._store_digests()
            self._close()
            seal(self._working)
            try:
                put_in_place(self._working, self._path, self._check)
                self._published = self._done
            except PermissionError:
                if not MAY_BE_HELD:
                    raise
                self._open = open_to_append(self._working)
        return self._open is None

    @property
    def _working(self) -> Path:
        """Path of the working file, to be used at once."""
        self._check()
        return working_files(self._path)[0]

    @property
    def _has_events(self) -> bool:
        """True for bodies that adhere."""
        return ADHESION in self._contents.parts

    @property
    def _attributes(self) -> dict[str, Any]:
        own = self._contents.attributes
        events = contact_event_attributes(self._events, own) if self._has_events else {}
        return {
            **{name: value for name, value in own.items() if name != JUMP_TIME_ERRORS},
            **events,
            "complete": np.int32(self._complete),
            "warnings": "\n".join(self._warnings),
            "grid_enlarged": "\n".join(self._enlarged),
            "started": self._date,
            "wall_time": clock.monotonic() - self._started,
        }

    def _write_waiting(self) -> None:
        waiting = self._waiting[: self._done.rows - self._written]
        write_scalars(self._file(), self._digests, self._written, waiting)
        self._written, self._waiting = self._done.rows, []

    def _store_digests(self) -> None:
        """Store the digests of all rows in the working file."""
        file, layout = self._file(), self._layout
        if layout.extent_of(file) != self._done:
            # An interruption has left a row that does not count.
            store_digests(file)
            return
        if layout.axis not in (None, layout.over):
            self._digests.replace(layout.axis, self._field_places[: self._done.field_rows])
        self._digests.store(file)

    def _close(self) -> None:
        file, self._open = self._open, None
        if file is not None:
            close_written(file)

    def _file(self) -> netCDF4.Dataset:
        if self._open is None:
            self._working.unlink(missing_ok=True)
            shutil.copyfile(self._path, self._working)
            self._open = open_to_append(self._working)
        return self._open
