"""A folder with everything that a file name may lead to: good files, and what is none."""

from __future__ import annotations

import contextlib
import os
import socket
from pathlib import Path

from fuzzing.cards import CARDS
from fuzzing.tables import TABLES

#: More than any reader takes; sparse, so that it takes no room on the disk.
HUGE = 10 * 10**9


def furnish(folder: Path) -> Path:
    """Put good files, special files and links into a folder, and return it."""
    (folder / "sub").mkdir()
    (folder / "folder").mkdir()
    for name, text in {**TABLES, **CARDS}.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "empty.csv").write_bytes(b"")
    (folder / "binary.csv").write_bytes(bytes(range(256)))
    (folder / "unreadable.csv").write_text(TABLES["load.csv"], encoding="utf-8")
    (folder / "unreadable.csv").chmod(0)
    for name in ("huge.csv", "huge.yaml", "huge.toml", "huge.inp"):
        with (folder / name).open("wb") as file:
            file.truncate(HUGE)
    with contextlib.suppress(OSError, AttributeError):  # not on Windows
        os.mkfifo(folder / "fifo")
        (folder / "loop").symlink_to("loop")
        (folder / "dangling").symlink_to("nowhere")
        (folder / "link.csv").symlink_to("load.csv")
        _socket(folder)
    return folder


def _socket(folder: Path) -> None:
    # The path of a socket is short: it is bound from its own folder.
    here = Path.cwd()
    os.chdir(folder)
    try:
        with socket.socket(socket.AF_UNIX) as listening:
            listening.bind("socket")
    finally:
        os.chdir(here)
