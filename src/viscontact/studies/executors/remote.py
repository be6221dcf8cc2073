"""Tasks on any executor, here or on other machines that see the same disk."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Self

from viscontact.backend.threads import limit_threads
from viscontact.results.run_files import STOP_NAME
from viscontact.studies.executors.task import RecordedTask, TaskEnd, perform

#: Largest number of tasks that are submitted at the same time.
_MOST = 10_000


class RemoteTasks:
    """Tasks on the executor that a function returns for the memory of a run [bytes]."""

    # A file in the directory of the sweep asks all tasks to save and end, wherever they run.

    def __init__(
        self,
        executor: Callable[[float], Executor],
        directory: Path,
        remedy: str = "continue with --resume",
    ) -> None:
        self._remedy = remedy
        self._executor, self._stop = executor, directory.absolute() / STOP_NAME
        self._futures: set[Future[TaskEnd]] = set()
        self._requests = 0

    def __enter__(self) -> Self:
        self._stop.unlink(missing_ok=True)
        return self

    def __exit__(self, *_: object) -> None:
        if not self._futures:
            # Tasks that are still at work have to find it.
            with suppress(OSError):
                self._stop.unlink(missing_ok=True)

    @property
    def most(self) -> int:
        """Largest number of tasks that are submitted at the same time."""
        return _MOST

    def submit(self, task: RecordedTask, memory: float) -> Future[TaskEnd]:
        """Submit a task with absolute paths."""
        whole = task.elsewhere(self._stop)
        future = self._executor(memory).submit(perform_elsewhere, whole, os.getpid())
        self._futures.add(future)
        future.add_done_callback(self._forget)
        return future

    def _forget(self, future: Future[TaskEnd]) -> None:
        if not future.cancelled():  # a cancelled task may be at work
            self._futures.discard(future)

    def ask_to_stop(self) -> None:
        """Request that all tasks finish their step, save and end; then no longer wait for them."""
        self._requests += 1
        if self._requests == 1:
            with suppress(FileNotFoundError):  # removed, together with the runs
                self._stop.touch()
            return
        for future in list(self._futures):
            future.cancel()

    def failure(self, error: BaseException) -> tuple[str, str]:
        """One word and the reason for a task that has ended without an outcome."""
        first = next(iter(str(error).splitlines()), "") or type(error).__name__
        is_killed = isinstance(error, BrokenExecutor) or type(error).__name__ == "KilledWorker"
        if is_killed:
            return "killed", f"the worker of the run was killed: {first}; {self._remedy}"
        return "stopped", f"the run could not be computed: {type(error).__name__}: {first}"


def perform_elsewhere(task: RecordedTask, submitter: int) -> TaskEnd:
    """Perform a task in a process that other work may share, unless it is the submitting one."""
    if os.getpid() == submitter:
        with limit_threads():
            return perform(task)
    _limit_threads_once()
    return perform(task)


@cache
def _limit_threads_once() -> None:
    limit_threads()
