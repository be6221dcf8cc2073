"""Guard of a file that must not be published after a write to it has failed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from viscontact.runs.directory.lock_check import LockCheck


class WriteGuard:
    """State of the writes to a file: after one that has failed, it is torn."""

    # `check` is called before each write; its LockLost leaves the file to the other run.

    def __init__(self, path: Path, check: LockCheck) -> None:
        self._path, self._check = path, check
        self._failed = False

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Write within the block; OSError if a write fails now, or has failed before."""
        if self._failed:
            raise OSError(f"{self._path} could not be written before; resume the run from it")
        self._check()
        self._failed = True
        try:
            yield
        except (OSError, RuntimeError) as error:
            self._check()  # else the file is another run's, which may be the cause
            if isinstance(error, OSError):
                raise
            # What netCDF says where the disk is full.
            raise OSError(f"{self._path} cannot be written ({error}); is the disk full?") from error
        self._failed = False
