"""Whether somebody has a file besides us."""

from __future__ import annotations

import os
import sys
from pathlib import Path

if sys.platform != "win32":
    import fcntl


def is_unread(path: Path) -> bool:
    """Whether nobody has an HDF5 file open or by another name, as far as that can be known.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    bool
        True if it may be written to. HDF5 locks what it reads; where it does not, because the
        file system cannot or the user forbids it, nobody knows, and the answer is False.
    """
    if path.is_symlink() or path.stat().st_nlink > 1:
        return False  # somebody has it by another name, be it to keep it as it was
    if sys.platform == "win32":
        return True  # what is open there cannot have been moved out of the readers' way
    if os.environ.get("HDF5_USE_FILE_LOCKING", "").upper() in ("FALSE", "0"):
        return False
    descriptor = os.open(path, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    finally:
        os.close(descriptor)
    return True
