"""Check that a run still holds its directory, made before each write."""

from __future__ import annotations

from collections.abc import Callable

#: Check that does nothing while the directory is held; else a LockLost.
LockCheck = Callable[[], None]


class LockLost(OSError):  # noqa: N818 - a state of the directory, no fault
    """Another run has taken the directory over; nothing may be written to it any more."""


def never_lost() -> None:
    """Check of a lock that its process cannot lose."""
