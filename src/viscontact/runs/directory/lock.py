"""Lock of a run directory, against a second run."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory.lease import Lease, LeaseHeld
from viscontact.runs.directory.lease_file import (
    DURATION,
    current_lease,
    is_gone,
    seems_renewed,
)
from viscontact.runs.directory.lock_check import LockCheck, never_lost
from viscontact.runs.directory.lock_probe import has_locks
from viscontact.units.formatting import format_quantity

#: Time that `locked` waits for a lock, which `in_use` takes for an instant, and between tries [s].
_PATIENCE, _POLL = 0.1, 0.005


class DirectoryInUse(RuntimeError):  # noqa: N818 - a state of the directory, no fault
    """Another run writes into the directory."""


@contextmanager
def locked(directory: str | Path, lease_duration: float = DURATION) -> Iterator[LockCheck]:
    """Lock an existing directory against other runs during a block; yield the check of the lock.

    Call the check immediately before each write: it raises LockLost. DirectoryInUse if another run,
    of this or another process, has locked it; OSError if the directory may not be written to.
    """
    # The lock is the operating system's where a probe shows that it excludes all others: it ends
    # with its process, however that ends, and a file ``.lock`` that is left over locks nothing. On
    # other file systems it is a `Lease` of some duration [s], which another run takes over when its
    # holder has not renewed it for that time.
    place = Path(directory)
    with ExitStack() as held:
        try:
            place.stat()  # else the lock would make it
            if _is_leased(place) or not has_locks(place):
                check = held.enter_context(Lease(place, lease_duration)).check
            else:
                held.enter_context(_file_locked(place, _PATIENCE))
                check = never_lost
        except (Timeout, LeaseHeld):
            raise _in_use_error(place) from None
        except OSError as error:
            raise OSError(
                f"{directory} cannot be locked against other runs ({error.strerror or error}); "
                "choose a directory on a local disk that you may write to, with -o DIR"
            ) from error
        yield check


def in_use(directory: Path) -> str:
    """Message that another run has locked the directory; empty if none has. Never waits."""
    # A lease of another machine counts by the time of its file. So two clocks that differ by more
    # than its duration make the message wrong; `locked` compares no clocks.
    if not (directory / LOCK_NAME).exists():
        return ""
    try:
        if _is_leased(directory):
            lease = current_lease(directory)
            return str(_in_use_error(directory)) if lease and seems_renewed(lease) else ""
        with _file_locked(directory):
            return ""
    except Timeout:
        return str(_in_use_error(directory))
    except OSError:
        return ""


def awaited_lease(directory: Path) -> str:
    """Message about a lease that `locked` has to watch; empty if there is none."""
    lease = current_lease(directory) if _is_leased(directory) else None
    if lease is None or is_gone(lease):
        return ""
    return (
        f"{directory} is leased to another run{_owner(directory / LOCK_NAME)}; it is taken over if "
        f"that does not renew its lease within {format_quantity(lease.duration, 's')}"
    )


def is_locked(directory: Path) -> bool:
    """True if another run has locked the directory."""
    return bool(in_use(directory))


@contextmanager
def _file_locked(directory: Path, patience: float = 0.0) -> Iterator[None]:
    """Lock the file of a directory by the operating system; Timeout after some time [s]."""
    path = directory / LOCK_NAME
    # A lock by mere existence of a file would outlast its process.
    lock = FileLock(path, blocking=False, fallback_to_soft=False, on_acquired=_leave_name)
    lock.acquire(timeout=patience, poll_interval=_POLL, blocking=patience > 0)
    try:
        yield
    finally:
        # While it is locked no other process can get this file; Windows removes it by itself.
        with suppress(OSError):
            path.unlink()
        lock.release()


def _is_leased(directory: Path) -> bool:
    """True if there is a lease, also where the file system has locks: it may be a copy."""
    # Windows, where nothing is leased, lets no process read a locked file.
    lease = None if os.name == "nt" else current_lease(directory)
    return lease is not None and lease.is_lease


def _in_use_error(directory: Path) -> DirectoryInUse:
    return DirectoryInUse(
        f"{directory} is in use by another run{_owner(directory / LOCK_NAME)}; wait until it is "
        "over, or choose another directory with -o DIR"
    )


def _leave_name(descriptor: int) -> None:
    """Write the process into the locked file; only a hint, so that it may fail."""
    with suppress(OSError):
        os.ftruncate(descriptor, 0)
        os.write(descriptor, f"{os.getpid()} on {platform.node()}\n".encode())


def _owner(path: Path) -> str:
    """Return the process that holds the lock, in brackets; empty if it is not known."""
    try:
        with path.open(encoding="utf-8") as file:
            line = file.readline(200).strip()
    except (OSError, ValueError):  # Windows refuses to read a locked file
        return ""
    number, _, host = line.partition(" on ")
    return f" (process {number} on {host})" if number.isdecimal() and host.isprintable() else ""
