"""Files that change their place at once, and stay changed after a power cut."""

from __future__ import annotations

import errno
import os
from pathlib import Path

#: Windows does not replace a file that a program has open.
MAY_BE_HELD = os.name == "nt"


def flush_to_disk(path: Path) -> None:
    """Wait until what was written to a file is on the disk.

    Parameters
    ----------
    path : Path
        The file; nobody in this process holds it open.
    """
    # Windows flushes only what may be written.
    descriptor = os.open(path, os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def flush_directory(directory: Path) -> None:
    """Wait until the names in a directory are on the disk, where the system can be asked for that.

    Windows does so by itself; some file systems of a network know no such call.

    Parameters
    ----------
    directory : Path
        The directory.
    """
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


def put_in_place(fresh: Path, path: Path) -> None:
    """Put a file in another one's place, all at once and durably.

    Parameters
    ----------
    fresh : Path
        The new file, closed and complete, on the same file system.
    path : Path
        Its place; at any moment the old file or the new one is there, even if the power is cut.

    Raises
    ------
    PermissionError
        On Windows, while a program has the file open that is there.
    """
    flush_to_disk(fresh)
    fresh.replace(path)
    flush_directory(path.parent)
