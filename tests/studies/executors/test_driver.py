"""Driver of many runs: each task is submitted once, and its end is awaited."""

from __future__ import annotations

import threading
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

from viscontact.results.run_files import STOP_NAME
from viscontact.runs.execution.stop_requests import StopRequests
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import DONE, RunRequest
from viscontact.studies.executors.driver import drive
from viscontact.studies.executors.remote import RemoteTasks
from viscontact.studies.executors.task import TaskEnd


class Late(Executor):
    """Executor of a cluster that answers after a while, the last call first."""

    def __init__(self, calls: int) -> None:
        self.futures: list[Future[Any]] = []
        self._calls = calls

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Return a call that is not finished."""
        self.futures.append(Future())
        if len(self.futures) == self._calls:
            threading.Timer(0.1, self._answer).start()
        return self.futures[-1]

    def _answer(self) -> None:
        for future in reversed(self.futures):
            future.set_result(TaskEnd("done", DONE))


class Ends:
    """Display that notes the ends of runs."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def update(self, active: object) -> None:
        """Display nothing."""

    def end(self, ended: Ended) -> None:
        """Note the name."""
        self.names.append(ended.job.name)


def job(folder: Path, name: str) -> Job:
    place = folder / name
    return Job(RunRequest(folder / "case.yaml", place), place, name, RunStage.NEW, 1, 1.0, 1.0, 1e8)


def test_all_runs_of_a_cluster_are_awaited(tmp_path: Path) -> None:
    executor, shown, names = Late(3), Ends(), ["a", "b", "c"]
    with RemoteTasks(lambda memory: executor, tmp_path) as tasks:
        ended = drive([job(tmp_path, name) for name in names], tasks, StopRequests(), shown)
    assert len(executor.futures) == 3
    assert [each.job.name for each in ended] == shown.names
    assert sorted(shown.names) == names
    assert {each.outcome for each in ended} == {"done"}


def test_request_to_stop_of_an_earlier_command_does_not_hold(tmp_path: Path) -> None:
    (tmp_path / STOP_NAME).touch()
    with RemoteTasks(lambda memory: Late(1), tmp_path) as tasks:
        assert not (tmp_path / STOP_NAME).exists()
        tasks.ask_to_stop()
        assert (tmp_path / STOP_NAME).exists()
    assert not (tmp_path / STOP_NAME).exists()
