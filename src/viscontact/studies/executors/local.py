"""Warm worker processes of this machine, as an executor that survives the death of its workers."""

from __future__ import annotations

import multiprocessing
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from multiprocessing import resource_tracker
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.executors.task import ATTEMPTS, RecordedTask, TaskEnd
from viscontact.studies.executors.worker import GROUP_SIGNALS, begin_worker, perform_in_worker

#: Advice for a process that has ended without an answer.
BEHIND_MAIN = 'in a script, make this call behind `if __name__ == "__main__":`'

#: A fork would copy threads' locks.
_SPAWN = multiprocessing.get_context("spawn")


@dataclass
class _Call:
    """Call that waits for a worker, or is being computed by one."""

    future: Future[Any]
    run: Callable[[], Any]
    attempts: int = 0


class LocalWorkers(Executor):
    """Executor with warm worker processes."""

    # Each worker is the only process of an executor of its own: a killed one takes no other call
    # with it. It is replaced, and its call is repeated once.

    def __init__(self, count: int) -> None:
        self._count = count
        self._idle: list[_Worker] = []
        self._busy: list[_Worker] = []
        self._waiting: deque[_Call] = deque()
        self._closed = self._unawaited = self._killed = self._stopping = False
        self._changed = threading.Condition(threading.RLock())
        self._unstartable: RuntimeError | None = None  # why no process can be started

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call a function in the next worker that is free."""
        call = _Call(Future(), partial(fn, *args, **kwargs))
        with self._changed:
            if self._closed:
                raise RuntimeError("cannot schedule new futures after shutdown")
            self._waiting.append(call)
            self._dispatch()
        return call.future

    def ask_to_stop(self) -> None:
        """Request that tasks finish their step, save and end; at once with the second request."""
        with self._changed:
            self._stopping = True
            for worker in (*self._idle, *self._busy):
                worker.ask_to_stop()

    def kill(self) -> None:
        """Kill all workers; calls that are not finished end with a BrokenExecutor."""
        with self._changed:
            self._closed = self._killed = True
            while self._waiting:
                call = self._waiting.popleft()
                if call.attempts or call.future.set_running_or_notify_cancel():
                    call.future.set_exception(BrokenExecutor("the workers have been killed"))
            for worker in (*self._idle, *self._busy):
                worker.kill()

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End all workers, by default after all calls; without `wait` when they are free."""
        with self._changed:
            self._closed, self._unawaited = True, not wait
            if cancel_futures:
                for call in self._waiting:
                    call.future.cancel()
            if wait:
                self._changed.wait_for(lambda: not self._busy and not self._waiting)
            ending, self._idle = self._idle, []
        for worker in ending:
            worker.close(wait=wait)

    def _dispatch(self) -> None:
        while self._waiting and (self._idle or len(self._busy) < self._count):
            call = self._waiting.popleft()
            if call.attempts or call.future.set_running_or_notify_cancel():
                self._start(call)

    def _start(self, call: _Call) -> None:
        call.attempts += 1
        try:
            if self._unstartable is not None:
                raise self._unstartable
            worker = self._idle.pop() if self._idle else _Worker(stopping=self._stopping)
            running = worker.submit(call.run)
        except BrokenExecutor:  # killed while it was idle
            call.attempts -= 1
            self._waiting.appendleft(call)
            return
        except (OSError, RuntimeError) as error:  # no process, pipe or thread can be started
            call.future.set_exception(error)
            return
        self._busy.append(worker)
        running.add_done_callback(partial(self._end, worker, call))

    def _end(self, worker: _Worker, call: _Call, running: Future[Any]) -> None:
        error = running.exception()
        is_killed = isinstance(error, BrokenExecutor)
        if is_killed and worker.failed_to_start:
            error = self._unstartable = RuntimeError(f"a new process failed: {BEHIND_MAIN}")
        with self._changed:
            self._busy.remove(worker)
            if is_killed:
                worker.close(wait=False)
            else:
                self._idle.append(worker)
            if is_killed and call.attempts < ATTEMPTS and not (self._killed or self._unstartable):
                self._waiting.appendleft(call)
            elif error is not None:
                call.future.set_exception(error)
            else:
                call.future.set_result(running.result())
            self._dispatch()
            if self._unawaited and not self._waiting:
                while self._idle:
                    self._idle.pop().close(wait=False)
            self._changed.notify_all()


class _Worker:
    """Warm process, and the pipe of the requests to stop."""

    def __init__(self, *, stopping: bool) -> None:
        self._receiver, self._sender = _SPAWN.Pipe(duplex=False)
        if stopping:
            self.ask_to_stop()
        self._pool = ProcessPoolExecutor(
            1, mp_context=_SPAWN, initializer=begin_worker, initargs=(self._receiver,)
        )
        self._process: Any = None

    @property
    def failed_to_start(self) -> bool:
        """True if the process has ended by itself, as if the script that it imports has failed."""
        if self._process is not None:
            self._process.join(1.0)  # it is over, but may not have been waited for
        return self._process is not None and self._process.exitcode == 1

    def submit(self, run: Callable[[], Any]) -> Future[Any]:
        """Start a call; the first one starts the process."""
        if self._process is not None:
            return self._pool.submit(run)
        before = set(multiprocessing.active_children())
        with signals_blocked():  # until it handles them
            started = self._pool.submit(run)
        self._process = next(iter(set(multiprocessing.active_children()) - before), None)
        self._receiver.close()
        return started

    def ask_to_stop(self) -> None:
        """Send a request to stop."""
        with suppress(OSError):  # it has been killed
            self._sender.send_bytes(b"stop")

    def kill(self) -> None:
        """Kill the process."""
        if self._process is not None:
            self._process.kill()

    def close(self, *, wait: bool) -> None:
        """End the process when it is free."""
        self._pool.shutdown(wait=wait)
        if wait:
            self._sender.close()


@contextmanager
def signals_blocked(numbers: Iterable[int] = GROUP_SIGNALS) -> Iterator[None]:
    """Let processes and threads that are started meanwhile begin with blocked signals."""
    with ExitStack() as restored:
        if hasattr(signal, "pthread_sigmask"):
            resource_tracker.ensure_running()  # it would unblock signals when it starts
            before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
            restored.callback(signal.pthread_sigmask, signal.SIG_SETMASK, before)
        yield


@dataclass(frozen=True)
class LocalTasks:
    """Tasks on the warm workers of this machine."""

    workers: LocalWorkers
    count: int
    remedy: str = "continue with --resume, and with fewer runs at a time"

    @property
    def most(self) -> int:
        """As many tasks as workers, and one more that need not wait for its submission."""
        return self.count + 1

    def submit(self, task: RecordedTask, memory: float) -> Future[TaskEnd]:
        """Submit a task."""
        return self.workers.submit(perform_in_worker, task)

    def ask_to_stop(self) -> None:
        """Request that all tasks finish their step, save and end; then at once."""
        self.workers.ask_to_stop()

    def failure(self, error: BaseException) -> tuple[str, str]:
        """One word and the reason for a task that has ended without an outcome."""
        if isinstance(error, BrokenExecutor):
            return "killed", (
                f"the process of the run was killed {ATTEMPTS} times, as happens when memory runs "
                f"out; {self.remedy}"
            )
        return "stopped", f"the run cannot be started: {error}"
