"""The process that waits for the next run of the calculator page, so that it begins at once."""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
import threading
import time as clock
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import psutil
import pytest
import xarray as xr
from fastapi.testclient import TestClient

from viscontact.backend.errors import AccuracyWarning
from viscontact.cli import main
from viscontact.web import calculator
from viscontact.web.runs import queue
from viscontact.web.workspace.folder import Folder
from web.calculator_page import CASE, LONG_CASE, asking, begun, followed, status, until


@pytest.fixture
def client(tmp_path: Path) -> Iterator[TestClient]:
    with asking(tmp_path / "page", keeps_spare=True) as client:
        yield client


def processes() -> list[psutil.Process]:
    """Return the processes of runs that this one has started."""
    found = []
    for child in psutil.Process().children():
        if child.status() != psutil.STATUS_ZOMBIE and any(
            "child_run" in w for w in child.cmdline()
        ):
            found.append(child)
    return found


def spare() -> psutil.Process:
    """Return the only process of a run, once there is one."""
    until(lambda: len(processes()) == 1)
    (found,) = processes()
    return found


@pytest.mark.slow
def test_a_run_is_computed_by_the_process_that_waits_and_gives_the_same_numbers(
    tmp_path: Path,
) -> None:
    with asking(tmp_path / "page", keeps_spare=True) as client:
        waiting = spare()
        run = begun(client)
        assert followed(client, run)[-1]["state"] == "done"
        until(lambda: not waiting.is_running())  # it is used once,
        assert spare().pid != waiting.pid  # and replaced
        (tmp_path / "ours.nc").write_bytes(client.get(f"/api/runs/{run}/result.nc").content)
    assert processes() == []
    (tmp_path / "typed.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(tmp_path / "typed.yaml"), "-q"]) == 0
    with (
        xr.open_dataset(tmp_path / "ours.nc") as ours,
        xr.open_dataset(tmp_path / "typed" / "result.nc") as typed,
    ):
        assert ours.drop_attrs().identical(typed.drop_attrs())


@pytest.mark.slow
def test_a_process_that_was_killed_while_it_waited_is_replaced(client: TestClient) -> None:
    waiting = spare()
    waiting.kill()
    waiting.wait()
    assert followed(client, begun(client, quality="coarse"))[-1]["state"] == "done"


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="there, a killed process has no signal")
def test_a_run_that_is_killed_takes_neither_the_server_nor_the_next_run_with_it(
    client: TestClient,
) -> None:
    waiting = spare()
    run = begun(client, LONG_CASE)
    until(lambda: status(client, run)["step"] > 3)
    waiting.kill()
    assert followed(client, run)[-1]["state"] == "failed"
    assert status(client, run)["resumable"]
    assert followed(client, begun(client))[-1]["state"] == "done"


@pytest.mark.slow
def test_a_run_in_the_process_that_waited_is_cancelled_as_any_other(client: TestClient) -> None:
    spare()
    run = begun(client, LONG_CASE)
    until(lambda: status(client, run)["step"] > 3)
    client.post(f"/api/runs/{run}/cancel")
    last: dict[str, Any] = followed(client, run)[-1]
    assert (last["state"], last["resumable"]) == ("cancelled", True)


@pytest.mark.slow
def test_no_process_is_started_beside_the_first_seconds_of_a_run(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its start would take a processor from a run whose user waits."""
    monkeypatch.setattr(queue, "_UNDISTURBED", 1e9)
    waiting = spare()
    run = begun(client, LONG_CASE)
    until(lambda: status(client, run)["step"] > 8)
    assert [each.pid for each in processes()] == [waiting.pid]
    monkeypatch.setattr(queue, "_UNDISTURBED", 0.0)
    until(lambda: len(processes()) == 2)
    client.post(f"/api/runs/{run}/cancel")


def test_the_end_of_a_run_is_told_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(calculator, "EVENT_INTERVAL", 1e6)
    with asking(tmp_path / "page") as client:
        told = followed(client, begun(client, quality="coarse"))
    assert [each["stage"] for each in told][-1] == "over"


def test_the_last_event_is_that_of_the_end_also_if_the_run_ends_while_another_is_sent(
    tmp_path: Path,
) -> None:
    page = calculator.Calculator(Folder(tmp_path / "page"), at_once=0)  # every run waits
    run = page.queue.add(*page.cases.new_run(CASE, "coarse"))

    async def told() -> list[str]:
        states = []
        async for event in page.events(run):
            states.append(json.loads(event.removeprefix("data:"))["state"])
            if not run.is_over:
                run.set_state("cancelled")
        return states

    assert asyncio.run(told()) == ["waiting", "cancelled"]


def test_a_server_uses_what_an_answer_needs_before_the_first_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, recwarn: pytest.WarningsRecorder
) -> None:
    used: list[bool] = []
    use_first = calculator._use_first

    def noted() -> None:
        use_first()
        used.append(True)

    monkeypatch.setattr(calculator, "_FIRST_USE", 0.0)
    monkeypatch.setattr(calculator, "_use_first", noted)
    with asking(tmp_path / "page", keeps_spare=True):
        until(lambda: bool(used))
    with asking(tmp_path / "other"):
        pass
    assert used == [True]
    assert not [str(each.message) for each in recwarn if each.category is AccuracyWarning]


def test_a_server_that_closes_waits_for_what_its_thread_still_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two threads in HDF5 at once may end the process."""
    begun, ended = threading.Event(), threading.Event()

    def long_task() -> None:
        begun.set()
        clock.sleep(0.3)
        ended.set()

    monkeypatch.setattr(calculator, "_FIRST_USE", 0.0)
    monkeypatch.setattr(calculator, "_use_first", long_task)
    with asking(tmp_path / "page", keeps_spare=True):
        assert begun.wait(60)
        assert not ended.is_set()
    assert ended.is_set()


def test_a_task_whose_client_has_gone_keeps_its_turn_until_it_ends(tmp_path: Path) -> None:
    page = calculator.Calculator(Folder(tmp_path / "page"), at_once=0)
    at_work: list[str] = []

    def long_task() -> None:
        at_work.append("first")
        clock.sleep(0.3)
        at_work.remove("first")

    async def asked() -> list[str]:
        first = asyncio.create_task(page.do(long_task))
        while not at_work:
            await asyncio.sleep(0.01)
        first.cancel()
        return await page.do(lambda: list(at_work))

    assert asyncio.run(asked()) == []


# A parent that has ended, also within the line.
@pytest.mark.parametrize("line", [b"", pytest.param(b'["run"', marks=pytest.mark.slow)])
def test_a_process_that_waits_ends_with_its_parent(line: bytes) -> None:
    command = [sys.executable, "-P", "-m", "viscontact.cli.child_run"]
    done = subprocess.run(command, input=line, capture_output=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, b"", b"")


LATE_IMPORTS = """\
import sys
from viscontact.cli import child_run, main

child_run._import_run()
before = set(sys.modules)
assert main(["run", "case.yaml", "-q"]) == 0
print(sorted(name for name in set(sys.modules) - before if name.startswith("viscontact")))
"""


def test_process_that_waits_has_imported_all_that_a_run_needs(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "-c", LATE_IMPORTS], cwd=tmp_path, capture_output=True, text=True
    )
    assert ended.stdout.splitlines()[-1:] == ["[]"], ended.stderr
