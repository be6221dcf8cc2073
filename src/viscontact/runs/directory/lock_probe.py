"""Probe of the locks of a file system."""

from __future__ import annotations

import os
from pathlib import Path
from tempfile import NamedTemporaryFile

from viscontact.runs.machine.system import mounted

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

#: File systems that one machine alone can write to, so that its locks exclude all others.
LOCAL = frozenset({
    "apfs", "bcachefs", "btrfs", "exfat", "ext2", "ext3", "ext4", "f2fs", "fuseblk", "hfs", "jfs",
    "msdos", "nilfs2", "ntfs", "ntfs3", "overlay", "ramfs", "reiserfs", "tmpfs", "ufs", "vfat",
    "xfs", "zfs",
})  # fmt: skip


def has_locks(directory: Path) -> bool:
    """True if locks of files exclude all that reach a directory; OSError if it is read-only."""
    # On a file system of several machines (NFS, Lustre, GPFS, SMB, FUSE and all unknown ones) locks
    # may hold within one machine only, which no probe on that machine can see.
    if fcntl is None:  # locks of Windows are enforced by the server, too
        return True
    return file_system(directory) in LOCAL and _locks_exclude(directory)


def file_system(directory: Path) -> str:
    """Kind of the file system of a directory; empty if the system does not report it."""
    place, found, longest = f"{directory.resolve()}{os.sep}", "", 0
    for at, kind in mounted():
        mount = at.rstrip(os.sep) + os.sep
        # Of several mounts at the same place the last one is visible.
        if len(mount) >= longest and place.startswith(mount):
            found, longest = kind.lower(), len(mount)
    return found


def _locks_exclude(directory: Path) -> bool:
    """True if a lock of a file in a directory excludes another opener of the file."""
    with NamedTemporaryFile(dir=directory, prefix=".lock.") as file:
        second = os.open(file.name, os.O_RDWR)
        try:
            return _locks(file.fileno()) and not _locks(second)
        finally:
            os.close(second)


def _locks(descriptor: int) -> bool:
    """True if an open file can be locked."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
