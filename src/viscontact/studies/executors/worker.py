"""Worker process of this machine: its requests to stop, and its end with its parent."""

from __future__ import annotations

import _thread
import os
import signal
import threading
from multiprocessing.connection import Connection
from types import FrameType

from viscontact.backend.threads import limit_threads
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.studies.executors.task import RecordedTask, TaskEnd, perform

#: Signals that a terminal or a batch system sends to all its processes.
GROUP_SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
    if hasattr(signal, name)
)  # fmt: skip


class WorkerRequests(StopRequests):
    """Requests to stop that the parent process has sent."""

    def __init__(self) -> None:
        super().__init__()
        self.over = True  # until a run begins
        self.idle = threading.Event()
        self.idle.set()
        self._received = self._now = False

    def begin(self) -> None:
        """Begin a run: requests have an effect until it is over."""
        self.idle.clear()
        self.over = False

    def end(self) -> None:
        """End a run."""
        self.over = True
        self.idle.set()

    def ask(self) -> None:
        """Note a request in any thread: the second one stops at once."""
        # A signal that a batch system has sent to this process, too, is not the first of two.
        if self._received:
            self._now = True
            _thread.interrupt_main()
        self._received = self._requested = True

    def interrupt(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal; Ctrl-C at the terminal reaches this process, too, and is ignored."""
        if number != signal.SIGINT:
            self._requested = True
        elif self._now and not self.over:
            self.request()


_REQUESTS = WorkerRequests()


def begin_worker(parent: Connection) -> None:
    """Handle signals and the requests of the parent process; first call in a worker."""
    for number in GROUP_SIGNALS:
        signal.signal(number, _REQUESTS.interrupt)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, GROUP_SIGNALS)
    limit_threads()
    threading.Thread(target=_listen, args=(parent,), daemon=True).start()


def _listen(parent: Connection) -> None:
    try:
        while True:
            parent.recv_bytes()
            _REQUESTS.ask()
    except (EOFError, OSError):
        # The parent has ended. A worker holds both ends of the pipe that it reads runs from, so it
        # would not notice that otherwise.
        if not _REQUESTS.requested:
            _REQUESTS.ask()
        _REQUESTS.idle.wait()
        os._exit(1)


def perform_in_worker(task: RecordedTask) -> TaskEnd:
    """Perform a task, which the parent process may stop."""
    _REQUESTS.begin()
    try:
        return perform(task, _REQUESTS)
    finally:
        _REQUESTS.end()
