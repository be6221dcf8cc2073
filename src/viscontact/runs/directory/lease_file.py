"""Lease file: its contents, and the process that has written it."""

from __future__ import annotations

import hashlib
import os
import re
import time as clock
from contextlib import suppress
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.run_files import LOCK_NAME

#: Time without renewal after which a lease may be taken over [s].
DURATION = 60.0
#: Longest duration that is read from a file [s], and longest contents [bytes].
_LONGEST, _SIZE = 3600.0, 1000
_TOKEN = re.compile("[0-9a-f]{32}")


@dataclass(frozen=True)
class LeaseFile:
    """Contents of a lease file; one of other contents counts as a lease that is never renewed."""

    path: Path
    text: str

    @property
    def owner(self) -> str:
        """Process and its machine, as ``4711 on node7``."""
        return self._line(0)

    @property
    def token(self) -> str:
        """Random token of the holder."""
        token = self._line(1)
        return token if _TOKEN.fullmatch(token) else hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def duration(self) -> float:
        """Time without renewal after which the lease may be taken over [s]."""
        with suppress(ValueError):
            if 0 < (duration := float(self._line(2))) <= _LONGEST:
                return duration
        return DURATION

    @property
    def mark(self) -> str:
        """Mark of the process on its machine; empty if it is not known."""
        return self._line(3)

    @property
    def is_lease(self) -> bool:
        """True if the contents are those of a lease."""
        return _TOKEN.fullmatch(self._line(1)) is not None

    def _line(self, number: int) -> str:
        lines = self.text.split("\n")
        return lines[number] if number < len(lines) else ""


def header(token: str, owner: str, duration: float) -> str:
    """Contents of a lease file of this process, without the number of renewals."""
    return f"{owner}\n{token}\n{duration}\n{process_mark(os.getpid())}\n"


def current_lease(directory: Path) -> LeaseFile | None:
    """Last lease of the chain of successors in a directory; None if there is no lease."""
    last, path = None, directory / LOCK_NAME
    while (found := _read_lease(path)) is not None:
        last, path = found, successor(found)
    return last


def successor(lease: LeaseFile) -> Path:
    """Path of the lease that takes another one over, before it replaces that."""
    return lease.path.with_name(f"{LOCK_NAME}.{lease.token}")


def seems_renewed(lease: LeaseFile) -> bool:
    """True if a lease has been renewed within its duration, by the clocks of the machines."""
    # Clocks that differ by more tell nothing; a run takes a lease by its renewals, not by times.
    if is_gone(lease):
        return False
    try:
        return abs(clock.time() - lease.path.stat().st_mtime) < lease.duration
    except OSError:  # released in the meantime
        return False


def is_gone(lease: LeaseFile) -> bool:
    """True if the process of a lease was one of this machine, and has ended."""
    number = lease.owner.partition(" on ")[0]
    here, _, _ = process_mark(os.getpid()).rpartition(" ")
    machine, _, _ = lease.mark.rpartition(" ")
    if not here or machine != here or not number.isdecimal():
        return False
    try:
        os.kill(int(number), 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError):  # of another user
        return False
    return process_mark(int(number)) not in ("", lease.mark)


def process_mark(number: int) -> str:
    """Unique mark of a Linux process: boot, process space, start or ``ended``; else empty."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
        space = Path("/proc/self/ns/pid").readlink()
        status = Path(f"/proc/{number}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    # The second field, the name in brackets, may contain anything.
    state, *fields = status.rpartition(")")[2].split()
    return f"{boot} {space} {'ended' if state in 'ZX' else fields[18]}"


def _read_lease(path: Path) -> LeaseFile | None:
    try:
        with path.open("rb") as file:
            return LeaseFile(path, file.read(_SIZE).decode("utf-8", errors="replace"))
    except FileNotFoundError:
        return None
