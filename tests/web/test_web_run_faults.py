"""Runs of the calculator page that meet faults: full disks, damaged files, and what is said."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from viscontact.cli import main
from web.calculator_page import CASE, LONG_CASE, asking, begun, followed, status
from web.run_numbers import client

__all__ = ["client"]  # a fixture


def test_a_run_that_met_a_full_disk_goes_on_once_there_is_room(client: TestClient) -> None:
    import resource

    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (250_000, usual[1]))  # of the process of the run, too
    try:
        run = begun(client, LONG_CASE.replace("12000", "700"))
        reply = followed(client, run)[-1]
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, usual)
        signal.signal(signal.SIGXFSZ, before)
    assert (reply["state"], reply["resumable"]) == ("failed", True)
    assert 0 < reply["step"] < 700
    client.post(f"/api/runs/{run}/resume")
    assert followed(client, run)[-1]["state"] == "done"


def test_a_run_whose_case_is_damaged_hinders_none_of_the_same_title(tmp_path: Path) -> None:
    with asking(tmp_path / "page", at_once=0) as client:
        damaged = begun(client, CASE)
        (tmp_path / "page" / "runs" / damaged / "given" / "case.yaml").write_bytes(b"\xff")
        assert status(client, begun(client, CASE))["label"].startswith("Zener sphere")


@pytest.mark.slow
def test_a_run_that_stops_says_why_in_the_words_of_the_command_line(
    client: TestClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = CASE.replace("[4 mm, 4 mm]", "[1 mm, 1 mm]")  # the contact overruns the grid
    reply = followed(client, begun(client, text))[-1]
    assert reply["state"] == "failed"
    assert not reply["resumable"]
    case = tmp_path / "typed.yaml"
    case.write_text(text, encoding="utf-8")
    assert main(["run", str(case), "-q"]) == 1
    first = capsys.readouterr().err.splitlines()[0]
    (problem, *_) = reply["problems"]
    assert first == f"{case}:{problem['line']}: {problem['path']}: {problem['message']}"
    assert reply["message"].endswith(problem["message"])
    # Where the page has buttons, nothing is said of what to type.
    assert not any("run it again" in each["message"] for each in reply["problems"])


def test_nothing_is_shown_of_a_run_before_its_first_step(tmp_path: Path) -> None:
    with asking(tmp_path / "page", at_once=1) as client:
        first, waiting = begun(client, LONG_CASE), begun(client)
        reply = status(client, waiting)
        assert (reply["state"], reply["table"], reply["figures"]) == ("waiting", [], [])
        for name in ("figure/history.svg", "report.html", "history.csv", "data", "result.nc"):
            answer = client.get(f"/api/runs/{waiting}/{name}")
            assert answer.status_code == 409, name
            assert answer.json()["problems"][0]["message"]
        client.delete(f"/api/runs/{waiting}")
        client.delete(f"/api/runs/{first}")


@pytest.mark.skipif(os.name == "nt", reason="there, sizes of files have no such limit")
def test_a_full_disk_is_reported_and_leaves_nothing(client: TestClient, tmp_path: Path) -> None:
    import resource

    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    # What is over the limit fails as on a full disk, with an error of the system.
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, usual[1]))
    try:
        file = client.post("/api/files?name=a.csv", content=b"1" * 1000)
        run = client.post("/api/runs", json={"yaml": CASE})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, usual)
        signal.signal(signal.SIGXFSZ, before)
    assert (file.status_code, run.status_code) == (507, 507)
    assert file.json()["problems"][0]["message"] == "a.csv cannot be stored: File too large"
    assert "cannot be stored" in run.json()["problems"][0]["message"]
    assert list((tmp_path / "page" / "runs").iterdir()) == []
    assert {path.name for path in (tmp_path / "page" / "files").iterdir()} == {"rough-patch.npz"}


def test_a_damaged_run_hides_no_other_one(tmp_path: Path) -> None:
    asked = {
        **{"title": "whole", "quality": "full", "created": "", "settings": [], "instants": 3},
        **{"end": 1.0, "work": 1.0, "memory": 1.0, "errors": False, "state": "done", "said": []},
    }
    damages = ({}, {"title": 5}, {"instants": "x"}, {"settings": 1}, {"end": None})
    for number, damage in enumerate(damages):
        (tmp_path / "runs" / str(number) / "run").mkdir(parents=True)
        text = json.dumps({**asked, **damage})
        (tmp_path / "runs" / str(number) / "request.json").write_text(text, encoding="utf-8")
    (tmp_path / "runs" / "0" / "run" / "progress.jsonl").write_bytes(b"5\n[]\n")
    with asking(tmp_path) as client:
        answer = client.get("/api/runs")
    assert answer.status_code == 200
    assert [(run["title"], run["step"]) for run in answer.json()] == [("whole", 0)]
