"""Progress of a run in another process, read from its directory."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from os import stat_result
from typing import Any

from viscontact.results.line_digests import read_entries
from viscontact.results.run_files import PROGRESS_NAME
from viscontact.runs.directory.progress_log import reached_in
from viscontact.runs.processes.job import Job, RunStage


class RunProgress:
    """Progress of a run, made before its process is started."""

    def __init__(self, job: Job) -> None:
        # Number of finished instants or speeds, and the last of them [s] or [m/s].
        self.instants, self.time = 0, 0.0
        # Lines of the progress log of the first and last instant; empty without any.
        self.first: Mapping[str, Any] = {}
        self.last: Mapping[str, Any] = {}
        self._job, self._path = job, job.directory / PROGRESS_NAME
        self._file, self._read = 0, 0
        # Lines of an earlier run, which this one replaces, do not count.
        self._earlier = None if job.standing is RunStage.STOPPED else self._marks()
        self.look()

    @property
    def part(self) -> float:
        """Fraction of the run that is finished."""
        job = self._job
        if job.instants is None:
            return min(self.time / job.end, 1.0) if job.end > 0 else 0.0
        return min(self.instants / job.instants, 1.0)

    def look(self) -> None:
        """Read the new lines; what cannot be read yet is left for the next call."""
        marks = self._marks()
        if marks is None or marks == self._earlier:
            return
        file, size, _ = marks
        if file != self._file or size < self._read:
            self._file, self._read, self.instants = file, 0, 0
        with suppress(OSError, ValueError, LookupError, TypeError):
            with self._path.open("rb") as lines:
                lines.seek(self._read)
                whole, newline, _ = lines.read().rpartition(b"\n")
            if newline:
                first = self.first if self._read else _line(whole.partition(b"\n")[0])
                last = _line(whole.rpartition(b"\n")[2])
                self.first, self.last, self.time = first, last, reached_in(last)
                self._read += len(whole) + 1
                self.instants += whole.count(b"\n") + 1

    def _marks(self) -> tuple[int, int, int] | None:
        """Marks that differ between two states of the file; None without a file."""
        with suppress(OSError):
            found: stat_result = self._path.stat()
            return found.st_ino, found.st_size, found.st_mtime_ns
        return None


def _line(text: bytes) -> dict[str, Any]:
    """Parse a line; the caller suppresses the errors of one that is damaged."""
    found = read_entries(text)
    reached_in(found)
    return found
