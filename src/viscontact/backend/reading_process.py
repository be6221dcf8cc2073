"""Process that reads files, started, watched and ended by the one that needs them."""

from __future__ import annotations

import atexit
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from math import prod
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viscontact.backend.errors import is_lack_of_memory
from viscontact.backend.reading_child import ReadingRequest
from viscontact.backend.reading_limits import End, ReadingLimits
from viscontact.backend.record import Record

#: Directory of the package, which may be on this process's path alone.
_ROOT = Path(__file__).parents[2]
_PROGRAM = (
    f"import sys; sys.path.append({str(_ROOT)!r}); "
    "from viscontact.backend.reading_child import answer_requests; answer_requests()"
)
#: Threads of linear algebra take memory, and the lists of calls of Rust half a second.
_ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1", "RUST_BACKTRACE": "0", "PYTHONIOENCODING": "utf-8"}
#: Time between two looks at the memory of the process [s].
_WATCHED = 0.02
_NOT_STARTED = "the process that reads packed and binary files cannot be started: {why}"
#: Longest error output that is looked at [bytes].
_SAID = 10_000


class UnansweredError(Exception):
    """End of the process without an answer; `how` it crashed."""

    def __init__(self, end: End, how: str = "") -> None:
        super().__init__(end, how)
        self.end, self.how = end, how


class ReadingProcess:
    """Process that waits for files to read; OSError if none can be started."""

    def __init__(self) -> None:
        self.has_answered = False
        with ExitStack() as opened:
            self._error_output = opened.enter_context(tempfile.TemporaryFile())
            # -P: no file of the working directory is imported in place of a library.
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-c", _PROGRAM],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._error_output,
                env={**os.environ, **_ENVIRONMENT},
            )
            assert self._process.stdin is not None
            assert self._process.stdout is not None
            self._requests = opened.enter_context(self._process.stdin)
            self._answers = opened.enter_context(self._process.stdout)
            self._opened = opened.pop_all()

    def is_ready(self, request: ReadingRequest) -> bool:
        """Send a request; False if the process has ended before it could begin."""
        self.has_answered = False
        self._said_before = os.fstat(self._error_output.fileno()).st_size
        with suppress(OSError):
            self._requests.write(pickle.dumps(request))
            self._requests.flush()
            return self._answers.readline() == b"ready\n"
        return False

    def record(self, limits: ReadingLimits) -> Record:
        """Record that was requested; UnansweredError, or ValueError if its reader refuses."""
        with self._watched(limits) as ends:
            head = self._head(limits)
            arrays = None if head is None else self._arrays(head.get("arrays", ()), limits)
            if head is None or arrays is None:
                self._process.wait()
                raise self._unanswered(ends)
        self.has_answered = True
        if "message" in head:
            is_lack = head["lacks memory"]
            raise UnansweredError(End.MEMORY) if is_lack else ValueError(head["message"])
        return Record(head["values"], arrays)

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        with suppress(OSError):  # what has not been sent
            self._opened.close()

    def said(self) -> str:
        """Error output since the last request, once the process has ended."""
        self._process.wait()
        self._error_output.seek(self._said_before)
        return self._error_output.read(_SAID).decode("utf-8", errors="replace")

    def _head(self, limits: ReadingLimits) -> dict[str, Any] | None:
        """Line that describes the answer; None if it is not complete."""
        line = self._answers.readline(limits.memory)
        if len(line) == limits.memory:
            raise UnansweredError(End.MEMORY)
        return json.loads(line) if line.endswith(b"\n") else None

    def _arrays(self, described: Sequence[Any], limits: ReadingLimits) -> dict[str, Any] | None:
        """Arrays of the answer, described by name, type and shape; None if it is not complete."""
        # The sizes come from a file that is not trusted.
        left = limits.memory
        arrays = {}
        for name, kind, shape in described:
            if np.dtype(kind).kind not in "biuf":
                raise UnansweredError(End.CRASH, "an answer that is no array of numbers")
            left -= np.dtype(kind).itemsize * prod(shape)
            if left < 0:
                raise UnansweredError(End.MEMORY)
            array: NDArray[Any] = np.empty(shape, kind)
            if self._answers.readinto(array.reshape(-1).view(np.uint8)) != array.nbytes:  # type: ignore[attr-defined]
                return None
            arrays[name] = array
        return arrays

    @contextmanager
    def _watched(self, limits: ReadingLimits) -> Iterator[list[End]]:
        """Kill the process when it exceeds limits; the list then has the one that it was."""
        import psutil  # 7 ms, where something is read in a process

        ends: list[End] = []
        over = threading.Event()
        process = psutil.Process(self._process.pid)
        deadline = time.monotonic() + limits.seconds

        def watch(most: float) -> None:
            while not over.wait(_WATCHED):
                is_late = time.monotonic() > deadline
                if is_late or process.memory_info().rss > most:
                    ends.append(End.TIME if is_late else End.MEMORY)
                    self._process.kill()
                    return

        def watch_until_it_ends() -> None:
            with suppress(psutil.Error):
                watch(process.memory_info().rss + limits.memory)

        watcher = threading.Thread(target=watch_until_it_ends, daemon=True)
        watcher.start()
        try:
            yield ends
        finally:
            over.set()
            watcher.join()

    def _unanswered(self, ends: Sequence[End]) -> UnansweredError:
        """End of the process, which was killed for one of `ends` or has ended by itself."""
        said = self.said()
        code = self._process.returncode
        if ends:
            return UnansweredError(ends[0])
        if code == -getattr(signal, "SIGXCPU", 0):
            return UnansweredError(End.TIME)
        # The system kills a process where the machine has no memory left.
        if is_lack_of_memory(said) or code == -getattr(signal, "SIGKILL", 0):
            return UnansweredError(End.MEMORY)
        with suppress(ValueError):
            return UnansweredError(End.CRASH, signal.Signals(-code).name)
        return UnansweredError(End.CRASH, f"exit code {code}")


#: A process that waits for the next file, by the process that started it: a fork has none.
_SPARE: dict[int, ReadingProcess] = {}


def read_apart(request: ReadingRequest) -> Record:
    """Record that a request asks for, read by another process; errors are those of its `record`.

    The process is kept for the next file. ValueError if none can be started.
    """
    process = _begun(request)
    try:
        return process.record(request.limits)
    finally:
        # What a large file has left in its memory is given back.
        if not (process.has_answered and request.limits.is_least and _kept(process)):
            process.close()


def _kept(process: ReadingProcess) -> bool:
    return _SPARE.setdefault(os.getpid(), process) is process


def _begun(request: ReadingRequest) -> ReadingProcess:
    spare = _SPARE.pop(os.getpid(), None)
    if spare is not None:
        if spare.is_ready(request):
            return spare
        spare.close()  # it has ended meanwhile
    try:
        process = ReadingProcess()
    except OSError as error:
        raise ValueError(_NOT_STARTED.format(why=error)) from error
    is_ready = False
    try:
        is_ready = process.is_ready(request)
        if not is_ready:
            why = " ".join(process.said().splitlines()[-1:])
            raise ValueError(_NOT_STARTED.format(why=why))
        return process
    finally:
        if not is_ready:
            process.close()


@atexit.register
def _close_spare() -> None:
    spare = _SPARE.pop(os.getpid(), None)
    if spare is not None:
        spare.close()
