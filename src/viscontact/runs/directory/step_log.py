"""Solved steps, written down one by one as they are taken.

Saving all that a run carries costs more than many a step. So that is done now and then, and in
between each solved step is added to a log: to take it again costs next to nothing. A process that
is killed leaves at most half a record at the log's end, which is left out when it is read.
"""

from __future__ import annotations

import io
import os
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from viscontact.runs.directory.closing import Closing
from viscontact.runs.directory.npz_archive import read_plain, write_plain
from viscontact.simulation.solved_step import StepRecord

#: The log's name in a run directory.
LOG_NAME = "steps.log"

_MAGIC = b"viscontact steps 1\n"

#: Bytes of a count, before a record (its length and its checksum) or at the log's head.
_COUNT = 8


class StepLog(Closing):
    """A log that is being written.

    Parameters
    ----------
    path : Path
        The file; an older log there is replaced, at once.
    token : str
        What tells this run from others.
    first : int
        How many steps the run had taken before those that will be added.
    """

    def __init__(self, path: Path, token: str, first: int) -> None:
        fresh = path.with_name(f".{path.name}.new")
        # What lies there is not written to: it may be a link to anything.
        fresh.unlink(missing_ok=True)
        try:
            # Unbuffered: what is written survives the process, though not a power cut.
            with fresh.open("xb", buffering=0) as begun:
                _write_all(begun, _head(token) + _as_bytes(first))
            fresh.replace(path)
        except BaseException:
            fresh.unlink(missing_ok=True)
            raise
        self._file = path.open("ab", buffering=0)

    def append(self, solved: StepRecord) -> None:
        """Add a step.

        Parameters
        ----------
        solved : StepRecord
            The step.

        Raises
        ------
        OSError
            If it cannot be written whole; then it is as if it had not been tried.
        """
        record = io.BytesIO()
        write_plain(record, solved.plain())
        content = record.getvalue()
        _write_all(self._file, _as_bytes(len(content)) + _as_bytes(zlib.crc32(content)) + content)

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def is_step_log(path: Path) -> bool:
    """Whether a file was begun as a log of steps, of any run.

    Parameters
    ----------
    path : Path
        The file, if there is one.
    """
    try:
        with path.open("rb") as file:
            return file.read(len(_MAGIC)) == _MAGIC
    except OSError:
        return False


def logged_steps(path: Path, token: str, first: int) -> Iterator[StepRecord]:
    """Read a log from some step on, up to where it was last whole.

    Parameters
    ----------
    path : Path
        The log; none at all, or another run's, is an empty one: its steps are solved again then.
    token : str
        What tells this run from others.
    first : int
        How many steps are known already: so many of the run's are left out.

    Yields
    ------
    StepRecord
        The steps after those, in order; none if the log begins later.
    """
    if not path.is_file():
        return
    with path.open("rb") as file:
        head = _head(token)
        if file.read(len(head)) != head:
            return
        begins = int.from_bytes(file.read(_COUNT), "little")
        if begins > first:
            return
        for count, record in enumerate(_records(file), begins):
            if count >= first:
                yield StepRecord.from_plain_data(read_plain(io.BytesIO(record)))


def _records(file: BinaryIO) -> Iterator[bytes]:
    """Records up to the first that is not whole."""
    size = os.fstat(file.fileno()).st_size
    while True:
        length, checksum = (int.from_bytes(file.read(_COUNT), "little") for _ in range(2))
        if not 0 < length <= size - file.tell():
            return
        record = file.read(length)
        if zlib.crc32(record) != checksum:
            return
        yield record


def _head(token: str) -> bytes:
    return _MAGIC + token.encode() + b"\n"


def _as_bytes(count: int) -> bytes:
    return count.to_bytes(_COUNT, "little")


def _write_all(file: BinaryIO, content: bytes) -> None:
    """Write it whole or not at all; a full disk takes a part first."""
    before, left = file.tell(), memoryview(content)
    try:
        while left:
            left = left[file.write(left) :]
    except OSError:
        file.truncate(before)
        raise
