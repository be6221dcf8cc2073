"""Studies of the calculator page: their problems, answers, files, and ends."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn, cast

import httpx
import pytest
from fastapi.testclient import TestClient

from closeness import close_to
from viscontact.cli import main
from viscontact.web.runs import study_answers
from viscontact.web.runs.run_figures import look_of
from viscontact.web.runs.study import StudyRun
from viscontact.web.workspace.problems import RequestError
from web.calculator_page import CASE, asking, followed, status, until

FORCES = {"keys": [{"key": "load.force", "values": "2 N, 4 N"}]}
#: Elastic, so that the numbers are those of Hertz.
ELASTIC = """\
title: Elastic ball
indenter: {shape: sphere, radius: 5 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [64, 64], size: [2.4 mm, 2.4 mm]}
output: {errors: false}
"""
#: With so many steps that it lasts until it is stopped.
LONG = CASE.replace("steps: 4", "steps: 600").replace("5 s]}", "5 s], errors: false}")


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with asking(tmp_path_factory.mktemp("page")) as client:
        yield client


def keyed(key: str, values: str) -> dict[str, Any]:
    return {"keys": [{"key": key, "values": values}]}


def design(key: str, values: str, goal: str = "peak_pressure", **more: Any) -> dict[str, Any]:
    return {"kind": "design", "goal": goal, **keyed(key, values), **more}


def begun(client: httpx.Client, text: str, requested: dict[str, Any]) -> str:
    answer = client.post("/api/studies", json={"yaml": text, **requested})
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


@pytest.mark.parametrize(
    ("requested", "path", "message"),
    [
        ({"keys": []}, "keys", "name a key to vary"),
        (keyed("", "1 N"), "keys[1]", "choose a key"),
        (keyed("load.force", ""), "keys[1]", "write values with commas"),
        (keyed("load.force", "2 N,, 3 N"), "keys[1]", "write values with commas"),
        (keyed("load.force", "5, 6 N"), "keys[1]", "5 has no unit"),
        (keyed("load.force", "5 N, 6 m"), "keys[1]", "cannot read '6 m' as a force"),
        (keyed("load.force", "5 N, 5000 mN"), "keys[1]", "are equal; give each once"),
        (keyed("load.frce", "5 N, 6 N"), "keys[1]", "did you mean 'force'?"),
        (keyed("load.force", "1 N:x"), "keys[1]", "'x' is not a number with a unit"),
        (keyed("load.force", "2 N:1 N"), "keys[1]", "the lower bound comes first"),
        (keyed("load.force", "1 N:2 N") | {"runs": "200"}, "runs", "from 1 to 100, got 200"),
        (keyed("load.force", "1 N:2 N") | {"runs": "few"}, "runs", "a whole number, got 'few'"),
        (keyed("time.steps", ", ".join(map(str, range(1, 103)))), "keys[1]", "at most 100 runs"),
        (
            {
                "keys": [
                    {"key": f"load.k{n}", "values": "1, 2, 3, 4, " * 40 + "5"} for n in range(4)
                ]
            },
            "keys[1]",
            "at most 100 runs on the page, got 671898241",  # none of them is made
        ),
        (
            {
                **{"kind": "design", "goal": "peak_pressure"},
                "keys": [{"key": f"load.k{n}", "values": "1:2"} for n in range(5)],
            },
            "keys[5]",
            "at most 4 keys on the page, got 5",
        ),
        (
            design("load.force", ", ".join(f"{n} N" for n in range(1, 102))),
            "keys[1]",
            "at most 100 values to choose from on the page, got 101",
        ),
        ({"keys": 2 * FORCES["keys"]}, "keys[2]", "is given twice"),
        (
            {"keys": [*FORCES["keys"], {"key": "indenter.radius", "values": "1 mm:2 mm"}]},
            "keys[1]",
            "all keys values, or all ranges",
        ),
        (
            keyed("material", "{law: table, file: ../x.csv, poisson_ratio: 0.4}, pmma-paper"),
            "keys[1]",
            "plain name",
        ),
        (design("load.force", "1 N:2 N", ""), "goal", "choose what is to be"),
        (design("load.force", "1 N:2 N", "peak"), "goal", "is no scalar of a result"),
        (design("load.force", "1 N:2 N", "load.force"), "goal", "give a constraint"),
        (design("load.force", "1 N"), "keys[1]", "must list two values or more"),
        (design("time.end", "1 s:2 s"), "keys[1]", "no parameters of a design"),
        (design("load.force", "1 N:2 N", runs="0"), "runs", "must be a whole number"),
        (
            design("load.force", "1 N:2 N", constraints=["approach>=1 um", "peak_pressure<=2"]),
            "constraints[2]",
            "must have a unit of [Pa]",
        ),
    ],
)
def test_a_problem_of_a_study_is_told_at_its_field(
    client: TestClient, requested: dict[str, Any], path: str, message: str
) -> None:
    answer = client.post("/api/studies", json={"yaml": CASE, **requested})
    assert answer.status_code == 422, answer.text
    (problem,) = answer.json()["problems"]
    assert problem["path"] == path, problem
    assert message in problem["message"]
    assert client.get("/api/runs").json() == []  # nothing is left of it


def test_a_problem_of_the_case_is_told_with_its_key(client: TestClient) -> None:
    text = CASE.replace("radius: 10 mm", "radius: 10")
    answer = client.post("/api/studies", json={"yaml": text, **FORCES})
    (problem,) = answer.json()["problems"]
    assert problem["path"] == "indenter.radius"


def test_problems_are_an_answer_for_a_page_that_expects_them(client: TestClient) -> None:
    asked = {"yaml": CASE.replace("4 N", "4 m")}
    refused = client.post("/api/check", json=asked)
    expected = client.post("/api/check", json=asked, headers={"X-Problems": "expected"})
    assert (refused.status_code, expected.status_code) == (422, 200)
    assert expected.json() == refused.json()
    assert (expected.headers["x-problems"], refused.headers.get("x-problems")) == ("422", None)


def test_only_a_fault_of_the_files_is_told_as_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> NoReturn:
        raise ValueError("a fault")

    run = cast(StudyRun, SimpleNamespace(is_sweep=True, directory=tmp_path))
    look = look_of("auto", dark=False)
    monkeypatch.setattr(study_answers, "open_many", lambda _: nullcontext())
    monkeypatch.setattr(study_answers, "_responses", fail)
    with pytest.raises(ValueError, match=r"^a fault"):
        study_answers.study_answer(run, look, dark=False)
    monkeypatch.setattr(study_answers, "open_many", fail)
    with pytest.raises(RequestError, match="the files of this study cannot be read: a fault"):
        study_answers.study_answer(run, look, dark=False)


def test_a_single_run_is_no_study(client: TestClient) -> None:
    assert client.get("/api/studies/none").status_code == 404


@pytest.mark.slow  # runs in processes
def test_a_sweep_ends_in_the_table_of_the_command_line(client: TestClient, tmp_path: Path) -> None:
    name = begun(client, ELASTIC, keyed("load.force", "0.1 N, 0.8 N"))
    events = followed(client, name)
    parts = [each["part"] for each in events]
    assert parts == sorted(parts)
    assert (events[-1]["state"], events[-1]["step"], events[-1]["steps"]) == ("done", 2, 2)
    assert events[-1]["label"] == "Elastic ball: force 0.1 N, 0.8 N"
    found = client.get(f"/api/studies/{name}").json()
    # Hertz: the approach goes with the power 2/3 of the force, on these cells within 2 %.
    column = found["table"]["head"].index("Approach [µm]")
    one, eight = (float(row[column]) for row in found["table"]["rows"])
    assert eight / one == close_to(4.0, rel=2e-2)
    names = [figure["layout"]["meta"]["name"] for figure in found["figures"]]
    assert "response-approach" in names
    assert "<html" in client.get(f"/api/studies/{name}/report.html").text
    case = client.get(f"/api/studies/{name}/runs/1/given").json()["yaml"]
    assert "force: 0.8 N" in case
    assert client.get(f"/api/studies/{name}/runs/2/given").status_code == 404

    (tmp_path / "case.yaml").write_text(ELASTIC, encoding="utf-8")
    typed = ["run", str(tmp_path / "case.yaml"), "--vary", "load.force=0.1 N, 0.8 N", "-q"]
    assert main([*typed, "-o", str(tmp_path / "sweep")]) == 0
    assert main(["collect", str(tmp_path / "sweep"), "-o", str(tmp_path / "all.csv"), "-q"]) == 0
    ours = client.get(f"/api/studies/{name}/table.csv").text
    assert ours == (tmp_path / "all.csv").read_text(encoding="utf-8")


@pytest.mark.slow  # runs in processes
def test_a_design_finds_the_force_of_a_contact_of_given_width(client: TestClient) -> None:
    asked = design(
        "load.force", "0.01 N:0.5 N:log", "approach", sense="maximise",
        constraints=["contact_width<=1.2mm"],
    )  # fmt: skip
    name = begun(client, ELASTIC, asked)
    last = followed(client, name)[-1]
    assert (last["state"], last["steps"]) == ("done", 60)
    assert last["study"] == {"kind": "design", "keys": ["load.force"], "has_answer": True}
    found = client.get(f"/api/studies/{name}").json()
    assert found["headline"].startswith("largest approach: ")
    rows = list(csv.DictReader(io.StringIO(client.get(f"/api/studies/{name}/table.csv").text)))
    best = rows[found["best"]]
    # Hertz: F = 4/3 E* a^3 / R, on these cells within 10 %.
    assert float(best["load.force [N]"]) == close_to(4 / 3 * 4e6 * 0.6e-3**3 / 5e-3, rel=0.1)
    (drawing,) = found["drawings"]
    assert drawing["svg"].startswith("<?xml")
    assert len(found["table"]["rows"]) == len(rows)
    case = client.get(f"/api/studies/{name}/runs/{found['best']}/given").json()["yaml"]
    assert f"force: {best['load.force [N]']} N" in case
    assert "Before and after" in client.get(f"/api/studies/{name}/report.html").text


@pytest.mark.slow  # runs in processes
def test_a_design_without_a_feasible_trial_says_so(client: TestClient) -> None:
    asked = design("load.force", "0.1 N:0.2 N", constraints=["peak_pressure<=1 Pa"], runs="9")
    last = followed(client, begun(client, ELASTIC, asked))[-1]
    assert (last["state"], last["resumable"]) == ("failed", False)
    assert last["message"].startswith("no feasible design in")
    assert client.get(f"/api/studies/{last['id']}").status_code == 409


@pytest.mark.slow  # runs in processes
def test_a_sweep_is_continued_after_a_stop_and_a_new_server(tmp_path: Path) -> None:
    with asking(tmp_path) as client:
        name = begun(client, LONG, keyed("load.force", "2 N, 3 N, 4 N"))
        until(lambda: status(client, name)["step"] == 1)
        cancelled = client.post(f"/api/runs/{name}/cancel").json()
        assert cancelled["state"] == "running"  # until the step is saved
        until(lambda: bool(status(client, name)["over"]))
        found = status(client, name)
        assert (found["state"], found["resumable"]) == ("cancelled", True)
        assert "after 1 of 3 runs; their results are kept" in found["message"]
        rows = client.get(f"/api/studies/{name}").json()["table"]["rows"]
        assert [row[1] for row in rows] == ["done", "stopped", "waiting"]
        assert client.post(f"/api/runs/{name}/resume").json()["state"] == "running"
        until(lambda: status(client, name)["part"] > 0.4)
    with asking(tmp_path) as client:
        found = status(client, name)
        assert (found["state"], found["resumable"]) == ("interrupted", True)
        client.post(f"/api/runs/{name}/resume")
        assert followed(client, name)[-1]["state"] == "done"
        kept = json.loads((tmp_path / "runs" / name / "request.json").read_bytes())
        assert kept["study"]["options"] == ["--vary", "load.force=2 N, 3 N, 4 N"]
        client.delete(f"/api/runs/{name}")
        assert not (tmp_path / "runs" / name).exists()


@pytest.mark.slow  # runs in processes
def test_a_range_is_filled_with_coarse_runs(client: TestClient) -> None:
    asked = keyed("load.force", "1 N:4 N") | {"runs": "3", "quality": "coarse"}
    last = followed(client, begun(client, LONG, asked))[-1]
    assert (last["state"], last["quality"], last["step"]) == ("done", "coarse", 3)
    rows = client.get(f"/api/studies/{last['id']}").json()["table"]["rows"]
    forces = [float(row[2]) for row in rows]
    assert all(1 <= force <= 4 for force in forces)
    assert len(set(forces)) == 3
