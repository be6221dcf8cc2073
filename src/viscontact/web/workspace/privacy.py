"""Files and folders that other users of the machine can neither read nor change."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_FOLDER, _FILE, _OTHERS = 0o700, 0o600, 0o077
#: Windows has no such modes; there the folders of a user are closed to others.
_HAS_MODES = os.name != "nt"


@contextmanager
def owner_only() -> Iterator[None]:
    """Within the block, new files and folders are for the owner only, also those of children."""
    before = os.umask(_OTHERS)
    try:
        yield
    finally:
        os.umask(before)


def make_private(path: Path) -> None:
    """Take a folder and all in it from other users; PermissionError if it is not one's own.

    Links are left as they are, and what they lead to.
    """
    if not _HAS_MODES:
        return
    _take(path)
    for place, folders, names in os.walk(path):
        for name in (*folders, *names):
            with suppress(FileNotFoundError):  # removed meanwhile
                _take(Path(place) / name)


def is_private(path: Path) -> bool:
    """True for an own file that no other user can read or change."""
    try:
        found = path.lstat()
    except OSError:
        return False
    if not stat.S_ISREG(found.st_mode):
        return False
    return not _HAS_MODES or (found.st_uid == os.geteuid() and not found.st_mode & _OTHERS)


def write_private(path: Path, text: str) -> None:
    """Write a new file in place of any other; no one else has it open."""
    path.unlink(missing_ok=True)
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, _FILE)
    with os.fdopen(descriptor, "w", encoding="utf-8") as file:
        file.write(text)


def _take(path: Path) -> None:
    found = path.lstat()
    mode = found.st_mode
    if stat.S_ISLNK(mode):
        return
    if found.st_uid != os.geteuid():
        raise PermissionError(errno.EPERM, f"{path.name} belongs to another user")
    if mode & _OTHERS and (stat.S_ISDIR(mode) or stat.S_ISREG(mode)):
        path.chmod(_FOLDER if stat.S_ISDIR(mode) else _FILE)
