"""File lock of a run directory, against a second run."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from viscontact.run_files import LOCK_NAME


class DirectoryInUse(RuntimeError):  # noqa: N818 - a state of the directory, no fault
    """Another run writes into the directory."""


@contextmanager
def locked(directory: str | Path) -> Iterator[None]:
    """Lock an existing directory against other runs during a block, without waiting.

    The lock is the operating system's: it ends with its process, however that ends, and a file
    ``.lock`` that is left over locks nothing. DirectoryInUse if another run, of this or another
    process, has locked it; OSError if it may not be written to, or its file system has no locks.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder, locked(folder):
    ...     try:
    ...         with locked(folder):
    ...             pass
    ...     except DirectoryInUse as error:
    ...         "in use by another run" in str(error)
    True
    """
    path = Path(directory) / LOCK_NAME
    # A lock by mere existence of a file would outlast its process.
    lock = FileLock(path, blocking=False, fallback_to_soft=False, on_acquired=_leave_name)
    try:
        Path(directory).stat()  # else the lock would make it
        lock.acquire()
    except Timeout:
        raise DirectoryInUse(
            f"{directory} is in use by another run{_owner(path)}; wait until it is over, or choose "
            "another directory with -o DIR"
        ) from None
    except OSError as error:
        raise OSError(
            f"{directory} cannot be locked against other runs ({error.strerror or error}); "
            "choose a directory on a local disk that you may write to, with -o DIR"
        ) from error
    try:
        yield
    finally:
        # While it is locked no other process can get this file; Windows removes it by itself.
        with suppress(OSError):
            path.unlink()
        lock.release()


def is_locked(directory: Path) -> bool:
    """True if another run has locked the directory."""
    if not (directory / LOCK_NAME).exists():
        return False
    try:
        with suppress(OSError), locked(directory):
            return False
    except DirectoryInUse:
        return True
    return False


def _leave_name(descriptor: int) -> None:
    """Write the process into the locked file; only a hint, so that it may fail."""
    with suppress(OSError):
        os.ftruncate(descriptor, 0)
        os.write(descriptor, f"{os.getpid()} on {platform.node()}\n".encode())


def _owner(path: Path) -> str:
    """Return the process that holds the lock, in brackets; empty if it is not known."""
    try:
        with path.open(encoding="utf-8") as file:
            said = file.read(200).strip()
    except (OSError, ValueError):  # Windows refuses to read a locked file
        return ""
    number, _, host = said.partition(" on ")
    return f" (process {number} on {host})" if number.isdecimal() and host.isprintable() else ""
