"""Atomic and durable replacement of files."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from viscontact.runs.directory.lock_check import LockCheck, never_lost

#: Windows does not replace a file that a program has open.
MAY_BE_HELD = os.name == "nt"


def flush_to_disk(path: Path) -> None:
    """Wait until the contents of a closed file are on the disk."""
    # Windows flushes only files that may be written.
    descriptor = os.open(path, os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def flush_directory(directory: Path) -> None:
    """Wait until the names in a directory are on the disk, where the system has a call for that."""
    # Windows does so by itself; some network file systems refuse the call.
    if os.name == "nt":
        return
    descriptor = os.open(directory, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):
            raise
    finally:
        os.close(descriptor)


def put_in_place(fresh: Path, path: Path, check: LockCheck = never_lost) -> None:
    """Replace a file by a closed one on the same file system, atomically and durably.

    PermissionError on Windows, while a program has the old file open; LockLost of the check.
    """
    flush_to_disk(fresh)
    check()
    fresh.replace(path)
    flush_directory(path.parent)


@contextmanager
def replacing(path: Path, check: LockCheck = never_lost) -> Iterator[BinaryIO]:
    """Open a new hidden file, which replaces another one at the end of a block without failure."""
    fresh = fresh_name(path)
    check()
    # Not written through: it may be a link.
    fresh.unlink(missing_ok=True)
    try:
        with fresh.open("xb") as file:
            yield file
        put_in_place(fresh, path, check)
    except BaseException:
        check()  # else a file of this name is another run's, as may be the cause
        fresh.unlink(missing_ok=True)
        raise


def fresh_name(path: Path) -> Path:
    """Return the name of a new file until it replaces another one."""
    return path.with_name(f".{path.name}.new")
