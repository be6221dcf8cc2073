"""Driver of many runs: submits their tasks to an executor, follows and stops them."""

from __future__ import annotations

import time as clock
import uuid
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from contextlib import suppress
from itertools import islice
from queue import Empty, SimpleQueue
from typing import Protocol

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.runs.directory.failure import write_failure
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job
from viscontact.runs.processes.progress import RunProgress
from viscontact.runs.processes.request import INTERRUPTED, STOPPED
from viscontact.studies.executors.task import RecordedTask, Task, TaskEnd

#: Time between two looks at the progress of the runs [s], and number of runs in each look.
PAUSE, LOOKS = 0.05, 64


@dataclass(frozen=True, eq=False)
class Active:
    """Run that has been submitted, and its progress."""

    job: Job
    course: RunProgress
    future: Future[TaskEnd]


class Display(Protocol):
    """Display of the progress of many runs."""

    def update(self, active: Sequence[Active]) -> None:
        """Display the progress of runs."""

    def end(self, ended: Ended) -> None:
        """Display that a run has ended."""


class Workers(Protocol):
    """Executor of tasks."""

    @property
    def most(self) -> int:
        """Largest number of tasks that are submitted at the same time."""

    def submit(self, task: RecordedTask, memory: float) -> Future[TaskEnd]:
        """Submit a task, whose memory is given in bytes."""

    def ask_to_stop(self) -> None:
        """Request that all tasks finish their step, save and end; then at once."""

    def failure(self, error: BaseException) -> tuple[str, str]:
        """One word and the reason for a task that has ended without an outcome."""


#: Task of a job; the second argument identifies the command.
MakeTask = Callable[[Job, str], RecordedTask]


def case_task(job: Job, token: str) -> Task:
    """Task of the case of a job."""
    return Task(job.request, job.directory, token)


def drive(
    jobs: Sequence[Job],
    workers: Workers,
    stops: StopRequests,
    display: Display,
    task_of: MakeTask = case_task,
) -> list[Ended]:
    """Compute all runs, or those that had begun when a stop was requested; return their ends."""
    return _Driver(jobs, workers, stops, display, task_of).run()


class _Driver:
    """Waiting, submitted and ended runs."""

    def __init__(
        self,
        jobs: Sequence[Job],
        workers: Workers,
        stops: StopRequests,
        display: Display,
        task_of: MakeTask,
    ) -> None:
        self._waiting, self._token = deque(jobs), uuid.uuid4().hex
        self._active: dict[Future[TaskEnd], Active] = {}
        self._finished: SimpleQueue[Future[TaskEnd]] = SimpleQueue()
        self._ended: list[Ended] = []
        self._workers, self._stops, self._display = workers, stops, display
        self._task_of = task_of
        self._requests = 0
        self._looked = 0.0

    def run(self) -> list[Ended]:
        """Run all jobs; KeyboardInterrupt counts as a request to stop."""
        while self._active or self._waiting:
            try:
                with self._stops.marching():
                    self._drive()
            except KeyboardInterrupt:
                self._stop()
        return self._ended

    def _drive(self) -> None:
        while self._active or self._waiting:
            if self._stops.requested and not self._requests:
                self._stop()
            with self._stops.postponed():
                while self._waiting and len(self._active) < self._workers.most:
                    self._submit(self._waiting.popleft())
            self._collect()
            self._look()

    def _submit(self, job: Job) -> None:
        task = self._task_of(job, self._token)
        course = RunProgress(job)
        try:
            future = self._workers.submit(task, job.memory)
        except (OSError, RuntimeError) as error:
            why = f"{job.directory}: the run cannot be started: {error}"
            self._end(Ended(job, "stopped", STOPPED, (why,)))
            return
        self._active[future] = Active(job, course, future)
        future.add_done_callback(self._finished.put)

    def _collect(self) -> None:
        """Wait for runs that end, for a moment."""
        with suppress(Empty):
            future = self._finished.get(timeout=PAUSE if self._active else 0.0)
            while True:
                with self._stops.postponed():
                    active = self._active.pop(future)
                    self._end(self._outcome(active))
                future = self._finished.get_nowait()

    def _look(self) -> None:
        """Read and display the progress of some of the runs, at intervals."""
        now = clock.monotonic()
        if now - self._looked < PAUSE:
            return
        self._looked = now
        looked_at = list(islice(self._active, LOOKS))
        for future in looked_at:
            self._active[future].course.look()
        self._display.update([self._active[future] for future in looked_at])
        if len(self._active) > LOOKS:  # the others first the next time
            for future in looked_at:
                self._active[future] = self._active.pop(future)

    def _outcome(self, active: Active) -> Ended:
        future, job = active.future, active.job
        if future.cancelled():
            if self._requests:
                return Ended(job, "interrupted", INTERRUPTED)
            while self._waiting:  # nothing more can be submitted
                self._end(Ended(self._waiting.popleft(), "not begun", STOPPED))
            why = f"{job.directory}: the connection to its worker was lost; continue with --resume"
            return Ended(job, "lost", STOPPED, (why,))
        if (error := future.exception()) is None:
            outcome = future.result()
            return Ended(job, outcome.word, outcome.code, outcome.lines)
        word, reason = self._workers.failure(error)
        why = f"{job.directory}: {reason}"
        write_failure(job.directory, word, STOPPED, (why,))
        return Ended(job, word, STOPPED, (why,))

    def _end(self, ended: Ended) -> None:
        self._ended.append(ended)
        self._display.end(ended)

    def _stop(self) -> None:
        """Submit no further run; let the active ones finish their steps and save, then end."""
        self._requests += 1
        self._waiting.clear()
        if self._requests <= 2:
            self._workers.ask_to_stop()
