"""Runs of the calculator page: the same numbers as the command line's, followed and stopped."""

from __future__ import annotations

import csv
import io
import json
import os
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import xarray as xr
from fastapi.testclient import TestClient

from closeness import close_to
from drawing.plotly.figure_data import array_of
from viscontact.drawing.content.look import LIGHT
from viscontact.results.run_axis import TIME
from viscontact.units.formatting import format_quantity
from viscontact.web.runs import queue
from viscontact.web.runs.live_scalars import LiveScalars
from viscontact.web.workspace.folder import RunEntry
from web.calculator_page import CASE, LONG_CASE, asking, begun, followed, status, until
from web.run_numbers import by_command_line, client, numbers

__all__ = ["client"]  # a fixture


def strict(text: str) -> Any:
    """Read JSON as browsers do, who know no NaN."""

    def refuse(word: str) -> None:
        raise ValueError(f"{word} is no JSON")

    return json.loads(text, parse_constant=refuse)


def test_a_run_ends_in_the_numbers_of_the_command_line(client: TestClient, tmp_path: Path) -> None:
    run = begun(client)
    events = followed(client, run)
    states = list(dict.fromkeys(event["state"] for event in events))
    assert states[-2:] == ["running", "done"]
    parts = [event["part"] for event in events]
    assert parts == sorted(parts)
    assert parts[-1] == 1
    last = events[-1]
    assert (last["step"], last["steps"], last["reached"]) == (4, 4, "t = 5 s")
    assert last["stage"] == "over"
    assert last["fields_text"] == ["0 s", "5 s"]

    there = client.get(f"/api/runs/{run}/result.nc")
    assert re.search(r'filename="?zener-sphere\.nc', there.headers["content-disposition"])
    (tmp_path / "ours.nc").write_bytes(there.content)
    typed = by_command_line(CASE, tmp_path)
    assert numbers(tmp_path / "ours.nc") == numbers(typed)

    with xr.open_dataset(typed) as ds:
        rows = list(csv.DictReader(io.StringIO(client.get(f"/api/runs/{run}/history.csv").text)))
        pressures = [float(row["peak_pressure [Pa]"]) for row in rows]
        assert pressures == ds["peak_pressure"].values.tolist()
        found = {row["name"]: row for row in last["table"]}
        peak = found["peak_pressure"]
        assert float(peak["end"].split(" ± ")[0]) == close_to(
            float(ds["peak_pressure"][-1]) / 1e6, rel=1e-2
        )
        assert peak["unit"] == "MPa"
        assert peak["error"] != ""
        area = last["scalars"]["contact_area"]
        assert area["value"] == float(ds["contact_area"][-1])
        assert "eccentricity_x" not in last["scalars"]  # 0 but for rounding

        # What is drawn while it is at work, in two parts.
        whole = strict(client.get(f"/api/runs/{run}/grown").text)
        assert whole["scalars"]["peak_pressure"] == pressures
        assert whole["time"] == ds["time"].values.tolist()
        # The numbers in words are those of the last line, and named with its instant.
        at, area = float(ds["time"][-1]), float(ds["contact_area"][-1])
        assert whole["reached"] == f"t = {format_quantity(at, 's', 6)}"
        assert whole["texts"]["contact_area"] == format_quantity(area, "m2", 4)
    lines = (tmp_path / "page" / "runs" / run / "run" / "progress.jsonl").read_bytes()
    after = lines.index(b"\n") + 1
    rest = client.get(f"/api/runs/{run}/grown", params={"after": after}).json()
    assert (rest["begun"], rest["after"]) == (after, len(lines))
    assert rest["time"] == whole["time"][1:]
    # The same as curves: read at once, and line by line as a run writes them.
    drawn = client.get(f"/api/runs/{run}/growing", params={"units": "si"}).json()
    assert drawn["count"] == len(whole["time"])
    assert (drawn["reached"], drawn["texts"]) == (whole["reached"], whole["texts"])
    curve = drawn["figures"]["peak_pressure"]["data"][0]
    assert array_of(curve["x"]) == close_to(whole["time"])
    assert array_of(curve["y"]) == close_to(pressures)
    growing, place = LiveScalars(tmp_path / "half"), tmp_path / "half" / "progress.jsonl"
    place.parent.mkdir()
    place.write_bytes(lines[:after])
    first = growing.drawn(TIME, (0.0, 5.0), LIGHT)
    place.write_bytes(lines)
    assert (first["count"], growing.drawn(TIME, (0.0, 5.0), LIGHT)["count"]) == (1, drawn["count"])
    assert growing.places == whole["time"]
    # A resumed run repeats its last lines; one that is replaced begins anew.
    place.write_bytes(lines + lines[after:])
    growing.drawn(TIME, (0.0, 5.0), LIGHT)
    assert growing.places == whole["time"]
    assert growing.scalars["peak_pressure"] == pressures
    place.write_bytes(lines[:after])
    assert growing.drawn(TIME, (0.0, 5.0), LIGHT)["count"] == 1
    # Positions in a log that was shorter, or longer, before it was replaced.
    for position in (after + 5, len(lines) + 1):
        again = client.get(f"/api/runs/{run}/grown", params={"after": position}).json()
        assert (again["begun"], again["time"]) == (0, whole["time"])

    case = client.get(f"/api/runs/{run}/case.yaml").text
    assert case == CASE
    assert client.get(f"/api/runs/{run}/given").json() == {"yaml": CASE, "quality": "full"}
    data = strict(client.get(f"/api/runs/{run}/data").text)
    assert data["scalars"]["peak_pressure"]["value"] == close_to(pressures, rel=1e-8)
    strict(client.get(f"/api/runs/{run}").text)

    assert client.delete(f"/api/runs/{run}").status_code == 204
    assert client.get(f"/api/runs/{run}").status_code == 404
    assert client.get("/api/runs").json() == []
    assert list((tmp_path / "page" / "runs").iterdir()) == []


@pytest.mark.slow
def test_a_run_is_cancelled_and_continues_to_the_same_numbers(
    client: TestClient, tmp_path: Path
) -> None:
    text = CASE.replace("steps: 4", "steps: 400")
    run = begun(client, text)
    until(lambda: status(client, run)["step"] > 3)
    assert client.get(f"/api/runs/{run}/result.nc").status_code == 409  # it is being written
    client.post(f"/api/runs/{run}/cancel")
    reply = followed(client, run)[-1]
    assert reply["state"] == "cancelled"
    assert reply["resumable"]
    assert 3 < reply["step"] < 400
    assert reply["message"].startswith(f"cancelled after step {reply['step']} of 400, at t = ")
    assert reply["message"].endswith("; its results are kept")
    kept = client.get(f"/api/runs/{run}/history.csv").text
    assert len(kept.splitlines()) == reply["step"] + 2

    assert client.post(f"/api/runs/{run}/resume").json()["state"] in ("waiting", "running")
    assert client.post(f"/api/runs/{run}/resume").status_code == 409  # once is enough
    events = followed(client, run)
    assert events[-1]["state"] == "done"
    stages = list(dict.fromkeys(event["stage"] for event in events))
    assert stages[-3:] == ["steps", "errors", "over"]
    parts = [event["part"] for event in events]
    assert parts == sorted(parts)
    (tmp_path / "ours.nc").write_bytes(client.get(f"/api/runs/{run}/result.nc").content)
    assert numbers(tmp_path / "ours.nc") == numbers(by_command_line(text, tmp_path))


def test_no_more_runs_than_allowed_are_at_work_and_coarse_ones_come_first(tmp_path: Path) -> None:
    with asking(tmp_path / "page", at_once=1) as client:
        first = begun(client, LONG_CASE)
        full, coarse = begun(client, LONG_CASE), begun(client, CASE, "coarse")
        states = [status(client, run)["state"] for run in (first, full, coarse)]
        assert states == ["running", "waiting", "waiting"]
        newest_first = [each["id"] for each in client.get("/api/runs").json()]
        assert newest_first == [coarse, full, first]
        client.post(f"/api/runs/{first}/cancel")
        until(lambda: status(client, first)["over"])
        until(lambda: status(client, coarse)["state"] == "running")
        assert status(client, full)["state"] == "waiting"
        reply = client.post(f"/api/runs/{full}/cancel").json()  # one that has computed nothing
        assert reply["message"] == "cancelled before its first step; there is nothing to show yet"
        assert reply["resumable"]
        client.post(f"/api/runs/{full}/resume")
        client.delete(f"/api/runs/{full}")  # one that waits is forgotten at once
        assert client.get(f"/api/runs/{full}").status_code == 404
        client.delete(f"/api/runs/{coarse}")  # one at work is stopped first
        until(lambda: [path.name for path in (tmp_path / "page" / "runs").iterdir()] == [first])


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="there, sizes of files have no such limit")
class PlannedRun:
    """Run that is started and computes nothing."""

    is_over = is_deleted = is_starting = False
    workers = 1

    def __init__(self, folder: object, name: str, entry: RunEntry) -> None:
        self.entry = entry

    @property
    def is_at_work(self) -> bool:
        return self.entry.state == "running"

    def poll(self) -> None:
        """Nothing happens."""

    def start(self, spare: object) -> None:
        self.entry, self.is_starting = replace(self.entry, state="running"), True


def test_a_run_waits_for_the_memory_that_starting_ones_will_take(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of 10 bytes, 6 are promised to the first run; once it has them, 10 are free beside it."""
    monkeypatch.setattr(queue, "ManagedRun", PlannedRun)
    monkeypatch.setattr(queue, "available_memory", lambda: 10.0)
    runs: Any = queue.RunQueue(SimpleNamespace(runs=list), at_once=3)  # type: ignore[arg-type]
    plan = RunEntry("", "full", "", (), 1, 1.0, 1.0, 6.0, errors=False)
    first = runs.add("first", plan)
    second = runs.add("second", replace(plan, memory=5.0))
    assert (first.is_at_work, second.is_at_work) == (True, False)
    first.is_starting = False
    runs.poll()
    third = runs.add("third", replace(plan, memory=5.0))
    assert (second.is_at_work, third.is_at_work) == (True, True)


def test_runs_whose_cases_have_one_title_are_distinguished(tmp_path: Path) -> None:
    with asking(tmp_path / "page", at_once=0) as client:  # all wait
        stronger = CASE.replace("4 N", "8.5 N")
        other = stronger.replace("steps: 4", "steps: 5").replace("10 mm", "9 mm")
        nameless = CASE.replace("title: Zener sphere\n", "")
        asked = [(LONG_CASE, "full"), (CASE, "coarse"), (stronger, "full"), (stronger, "full")]
        finer = LONG_CASE.replace("shape: [24, 24]", "shape: [32, 24]")
        asked += [(other, "coarse"), (finer, "full"), (nameless, "full")]
        runs = [begun(client, *each) for each in asked]
        labels = [status(client, run)["label"] for run in runs]
        assert labels == [
            "Zener sphere",
            "Zener sphere, steps 4, without errors",
            "Zener sphere, force 8.5 N, steps 4 and 1 more",
            "Zener sphere, force 8.5 N, steps 4 and 1 more (2)",
            "Zener sphere, radius 9 mm, force 8.5 N and 2 more",
            "Zener sphere, cells 32 × 24",
            "Sphere, radius 10 mm, on Zener 10 MPa, 4 N",
        ]
        files = [client.get(f"/api/runs/{run}/case.yaml").headers for run in runs]
        names = [each["content-disposition"] for each in files]
        assert len(set(names)) == len(runs)
        assert "zener-sphere-steps-4-without-errors-coarse.yaml" in names[1]


@pytest.mark.slow
def test_a_coarse_run_hands_out_the_case_that_gives_its_numbers(
    client: TestClient, tmp_path: Path
) -> None:
    run = begun(
        client, CASE.replace("[24, 24]", "[96, 96]").replace("steps: 4", "steps: 90"), "coarse"
    )
    reply = followed(client, run)[-1]
    assert reply["state"] == "done"
    assert reply["steps"] == 24
    assert all(row["error"] == "" for row in reply["table"])
    text = client.get(f"/api/runs/{run}/case.yaml").text
    assert "errors: false" in text
    (tmp_path / "ours.nc").write_bytes(client.get(f"/api/runs/{run}/result.nc").content)
    assert numbers(tmp_path / "ours.nc") == numbers(by_command_line(text, tmp_path))


@pytest.mark.slow
def test_figures_and_reports_of_a_run_can_be_had(client: TestClient) -> None:
    named = CASE.replace("4 N", "2 N").replace("Zener sphere", r"for $4 or \bad{$5")  # no formula
    run, other = begun(client), begun(client, named, "coarse")
    for each in (run, other):
        followed(client, each)
    for figure in status(client, run)["figures"]:
        answer = client.get(f"/api/runs/{run}/figure/{figure}.png")
        # A figure that says nothing of this run, such as hysteresis under one step, says so.
        assert answer.status_code in (200, 422), answer.text
        expected = b"\x89PNG" if answer.status_code == 200 else b'{"problems"'
        assert answer.content.startswith(expected)
    answer = client.get(f"/api/runs/{run}/figure/pressure-map.pdf", params={"time": "5 s"})
    assert answer.content.startswith(b"%PDF")
    for time, why in (("9 s", "lies outside the run"), ("5 N", "cannot read '5 N' as a time")):
        answer = client.get(f"/api/runs/{run}/figure/pressure-map.svg", params={"time": time})
        assert answer.status_code == 422
        assert why in answer.json()["problems"][0]["message"]
    assert client.get(f"/api/runs/{run}/figure/no-such.svg").status_code == 404
    stronger = begun(client, CASE.replace("4 N", "8 N"), "coarse")
    followed(client, stronger)
    both = client.get("/api/compare.svg", params={"runs": f"{run},{other},{stronger}"})
    for name in ("Zener sphere", "for $4 or", "Zener sphere, force 8 N (coarse)"):
        assert name in both.text
    assert both.headers["content-type"] == "image/svg+xml"
    assert client.get("/api/compare.svg", params={"runs": run}).status_code == 422
    assert "<h1>Zener sphere, force 8 N (coarse)</h1>" in client.get(
        f"/api/runs/{stronger}/report.html").text  # fmt: skip
    saved = client.get(f"/api/runs/{run}/report.html")
    assert saved.headers["content-disposition"].startswith("attachment")
    shown = client.get(f"/api/runs/{run}/report.html", params={"view": True})
    assert shown.content == saved.content
    assert "content-disposition" not in shown.headers
    assert shown.headers["content-security-policy"].startswith("sandbox ")
