"""Lease of a directory: a file that its holder renews, where the file system has no locks.

The lease file ``.lock`` contains a random token of its holder. A process takes an abandoned lease
over by a hard link of its own lease to ``.lock.TOKEN``: one process only can make the successor of
a token, and tokens do not repeat. The successor then replaces ``.lock``.
"""

from __future__ import annotations

import os
import platform
import secrets
import threading
import time as clock
from contextlib import AbstractContextManager, suppress
from pathlib import Path

from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory.lease_file import (
    DURATION,
    LeaseFile,
    current_lease,
    header,
    is_gone,
    successor,
)
from viscontact.runs.directory.lock_check import LockLost
from viscontact.units.formatting import format_quantity

#: Renewals within the duration, and part of it without renewal after which the lease has lapsed:
#: what its holder writes after a check has the other part of the duration to be finished.
_RENEWALS, _LAPSE = 6, 0.5
#: Looks at the lease of another process within its duration.
_LOOKS = 60


class LeaseHeld(Exception):  # noqa: N818 - a state of the directory, no fault
    """Another process holds the lease."""


class Lease(AbstractContextManager["Lease"]):
    """Lease of an existing directory, renewed by a thread until it is released.

    LeaseHeld as soon as another process renews its own; OSError if the directory may not be
    written to, or its file system has no hard links.
    """

    # A lease left by another process is watched for its duration, by the clock of this machine.

    def __init__(self, directory: Path, duration: float = DURATION) -> None:
        self._directory, self._duration = directory, duration
        self._turn, self._over = threading.Lock(), threading.Event()
        self._take_over(_abandoned_lease(directory))
        self._thread = threading.Thread(target=self._renew_until_closed, daemon=True)
        self._thread.start()

    def check(self) -> None:
        """Return if the lease is held for half of its duration from now on; else LockLost."""
        with self._turn:
            self._check()

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._thread.join()
        with suppress(OSError):
            self.check()
            (self._directory / LOCK_NAME).unlink()
        os.close(self._file)

    def _renew_until_closed(self) -> None:
        while not self._over.wait(self._duration / _RENEWALS):
            try:
                with self._turn:
                    self._check()
                    self._renew()
            except LockLost:
                return
            except OSError:  # tried again
                continue

    def _check(self) -> None:
        found = current_lease(self._directory)
        if found is None:
            raise LockLost(f"{self._directory}: the lease of this run has been removed")
        if found.token != self._token:
            raise self._lost_error(f" ({found.owner})")
        if _clock() - self._renewed > _LAPSE * self._duration:
            # Another process may be taking it over at this moment: one of the two succeeds.
            lapsed = self._file
            try:
                self._take_over(found)
            except LeaseHeld:
                raise self._lost_error("") from None
            os.close(lapsed)

    def _lost_error(self, owner: str) -> LockLost:
        return LockLost(
            f"{self._directory} was taken over by another run{owner}, after this one had not "
            f"renewed its lease for {format_quantity(self._duration, 's')}"
        )

    def _renew(self) -> None:
        # Through the open file: the lease of a successor is another file.
        began = _clock()
        self._count += 1
        os.lseek(self._file, len(self._head), os.SEEK_SET)
        os.write(self._file, b"%012d\n" % self._count)
        os.fsync(self._file)
        self._renewed = began

    def _take_over(self, found: LeaseFile | None) -> None:
        """Take a lease that is free, abandoned or this process's own; LeaseHeld if that fails."""
        began, token = _clock(), secrets.token_hex(16)
        head = header(token, f"{os.getpid()} on {platform.node()}", self._duration).encode()
        fresh = self._directory / f"{LOCK_NAME}.{token}.new"
        file = os.open(fresh, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            os.write(file, head + b"%012d\n" % 0)
            os.fsync(file)
            _link(fresh, token, found)
        except BaseException:
            os.close(file)
            raise
        finally:
            fresh.unlink(missing_ok=True)
        self._file, self._head, self._token = file, head, token
        self._count, self._renewed = 0, began


def _link(fresh: Path, token: str, found: LeaseFile | None) -> None:
    """Make a new lease the current one; LeaseHeld if another process has done so before."""
    name = fresh.with_name(LOCK_NAME) if found is None else successor(found)
    try:
        os.link(fresh, name)
        linked = True
    except FileExistsError:  # also the answer of a server that was asked twice
        linked = False
    current = current_lease(fresh.parent)
    if current is None or current.token != token:
        if linked and found is not None:
            name.unlink()  # the lease that it would have succeeded had been replaced before
        raise LeaseHeld("" if current is None else current.owner)
    if found is not None:
        name.replace(fresh.with_name(LOCK_NAME))
        if found.path.name != LOCK_NAME:  # its holder has ended before it replaced its predecessor
            found.path.unlink(missing_ok=True)


def _abandoned_lease(directory: Path) -> LeaseFile | None:
    """Lease that may be taken over, None if there is no lease; LeaseHeld if it is renewed."""
    found = current_lease(directory)
    if found is None or is_gone(found):
        return found
    end = clock.monotonic() + found.duration
    while clock.monotonic() < end:
        clock.sleep(found.duration / _LOOKS)
        now = current_lease(directory)
        if now is None:  # released
            return None
        if now != found:
            raise LeaseHeld(now.owner)
    return found


def _clock() -> float:
    """Time of this machine [s], which on Linux passes while the machine sleeps."""
    if hasattr(clock, "CLOCK_BOOTTIME"):
        return clock.clock_gettime(clock.CLOCK_BOOTTIME)
    return clock.monotonic()
