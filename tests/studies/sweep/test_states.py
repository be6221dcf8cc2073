"""States of runs in their directories, and the status of a sweep."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path

import pytest

from closeness import close_to
from viscontact.results.run_files import CASE_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import locked
from viscontact.runs.processes.child import Ended
from viscontact.runs.processes.job import Job, RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.sweep.manifest import SweepRun, write_manifest
from viscontact.studies.sweep.states import (
    RunState,
    State,
    finished_part,
    run_state,
    state_at_end,
)
from viscontact.studies.sweep.status import LISTED, SweepStatus, sweep_status


def made(directory: Path, *names: str, part: float | None = None, failure: object = None) -> Path:
    """A run directory with empty files, and a progress log or a failure if given."""
    directory.mkdir(parents=True, exist_ok=True)
    for name in names:
        (directory / name).touch()
    if part is not None:
        lines = [{"time": 0.0, "part": 0.0}, {"time": 1.0, "part": part}]
        text = "".join(json.dumps(line) + "\n" for line in lines) + '{"time": 2.0, "pa'
        (directory / PROGRESS_NAME).write_text(text, encoding="utf-8")
    if failure is not None:
        (directory / "failure.json").write_text(json.dumps(failure), encoding="utf-8")
    return directory


RIM = {"outcome": "stopped", "code": 1, "message": ["grid: the rim", "enlarge it"]}


@pytest.mark.parametrize(
    ("names", "failure", "expected"),
    [
        ((), None, RunState(State.WAITING)),
        ((CASE_NAME,), None, RunState(State.WAITING)),
        ((RESULT_NAME, PROGRESS_NAME), None, RunState(State.DONE)),
        ((RESULT_NAME, PROGRESS_NAME, STATE_NAME), None, RunState(State.STOPPED)),
        ((STATE_NAME, RESULT_NAME), RIM, RunState(State.FAILED, "grid: the rim; enlarge it")),
        ((), RIM, RunState(State.FAILED, "grid: the rim; enlarge it")),
        (
            (STATE_NAME,),
            {"code": 130, "message": "interrupted"},
            RunState(State.STOPPED, "interrupted"),
        ),
    ],
)
def test_state_follows_from_the_files(
    names: tuple[str, ...], failure: object, expected: RunState, tmp_path: Path
) -> None:
    directory = made(tmp_path / "run", *names, failure=failure)
    assert run_state(directory) == expected
    with locked(directory):
        is_done = expected.state is State.DONE
        assert run_state(directory).state is (State.DONE if is_done else State.RUNNING)
    assert run_state(directory) == expected


@pytest.mark.parametrize(
    ("outcome", "code", "expected"),
    [
        ("done", 0, State.DONE),
        ("stopped", 1, State.FAILED),
        ("killed", 1, State.FAILED),
        ("interrupted", 130, State.STOPPED),
        ("lost", 1, State.STOPPED),  # its worker may still compute it
    ],
)
def test_state_at_the_end_of_a_command_is_that_of_its_status(
    tmp_path: Path, outcome: str, code: int, expected: State
) -> None:
    request = RunRequest(tmp_path / "a.yaml", made(tmp_path / "run", STATE_NAME))
    job = Job(request, tmp_path / "run", "run", RunStage.NEW, 3, 1.0, 1.0, 1.0)
    assert state_at_end(Ended(job, outcome, code)) is expected
    never = replace(job, directory=tmp_path / "other")
    assert state_at_end(Ended(never, "not begun", 130)) is State.WAITING


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"message": 5}', "[" * 10**5, "\xff"])
def test_failure_that_cannot_be_read_is_a_failure(text: str, tmp_path: Path) -> None:
    (tmp_path / "failure.json").write_bytes(text.encode("latin-1"))
    found = run_state(tmp_path)
    assert found.state is State.FAILED
    assert "failure.json cannot be read" in found.message


def test_part_is_that_of_the_last_whole_line(tmp_path: Path) -> None:
    assert finished_part(made(tmp_path, part=0.25)) == 0.25
    for text in ("", "\n", "5\n", '{"part": "x"}\n', '{"part": 0.5'):
        (tmp_path / PROGRESS_NAME).write_text(text, encoding="utf-8")
        assert finished_part(tmp_path) == 0.0


def sweep(folder: Path, count: int) -> Path:
    write_manifest(
        folder, (SweepRun(n, f"run {n}", f"{n}", {}, (), "a.yaml", "cases") for n in range(count))
    )
    return folder


def test_status_counts_runs_and_expects_the_time_left(tmp_path: Path) -> None:
    place = sweep(tmp_path, 6)
    for number in range(2):  # of 10 s each
        directory = made(place / f"{number}", CASE_NAME, RESULT_NAME, PROGRESS_NAME)
        os.utime(directory / CASE_NAME, (1000.0, 1000.0))
        os.utime(directory / RESULT_NAME, (1010.0, 1010.0))
    made(place / "2", STATE_NAME, part=0.5)
    made(place / "3", STATE_NAME, part=0.75)
    made(place / "4", failure=RIM)
    with locked(place / "2"):
        status = sweep_status(place)
        assert sweep_status(place / "runs.jsonl").counts == status.counts
    counts = {state.value: count for state, count in status.counts.items()}
    assert counts == {"waiting": 1, "running": 1, "stopped": 1, "failed": 1, "done": 2}
    assert status.part == close_to((2 + 0.5 + 0.75 + 1 + 0) / 6)
    # half a run and a waiting one, one at a time
    assert status.left == close_to(15.0)
    assert not status.has_ended
    assert [each.name for each in status.listed[State.FAILED]] == ["run 4"]


def test_time_left_is_shared_by_the_runs_at_a_time() -> None:
    """Two and a half runs are left, each of 12 s, as the middle one of three."""
    status = SweepStatus(remaining=2.5, durations=[60.0, 10.0, 12.0])
    assert status.left is None
    for running in (1, 2, 3):
        status.counts[State.RUNNING] = running
        assert status.left == close_to(30.0 / running)


def test_status_lists_few_of_many_failed_runs(tmp_path: Path) -> None:
    place = sweep(tmp_path, LISTED + 5)
    for number in range(LISTED + 5):
        made(place / f"{number}", failure=RIM)
    status = sweep_status(place)
    assert status.counts[State.FAILED] == LISTED + 5
    assert len(status.listed[State.FAILED]) == LISTED
    assert status.has_ended
    assert status.left is None


def test_single_run_has_a_status(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"neither a sweep \(runs.jsonl\) nor a run"):
        sweep_status(tmp_path)
    status = sweep_status(made(tmp_path / "ball", STATE_NAME, part=0.5))
    [listed] = status.listed[State.STOPPED]
    assert (listed.name, listed.part, status.total) == ("ball", 0.5, 1)
