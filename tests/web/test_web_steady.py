"""Cases of steady motion on the calculator page: check, run, live numbers, data and files."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

import viscontact as vc
from closeness import close_to
from drawing.plotly.figure_data import array_of
from viscontact import reference
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.plot import COMPARISONS, FIGURES, STEADY_FIGURES
from viscontact.results.run_files import RESULT_NAME
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.pictures import PictureChoice, comparison_of, figure_of
from viscontact.web.workspace.problems import RequestError
from web.calculator_page import asking, begun, followed, status, until

RADIUS = 0.02
# From fast to slow. The law retards within 10 ms: by its modulus 1 MPa and viscosity 10 kPa s.
BALL = """\
title: Ball
indenter: {shape: paraboloid, radius_x: 20 mm, radius_y: 20 mm}
material:
  law: zener
  shear_modulus: 9 MPa
  delayed_modulus: 1 MPa
  viscosity: 10 kPa s
  poisson_ratio: 0.5
load: {kind: step, force: 2 N, tilt_x: 0, tilt_y: 0}
motion: {kind: steady, speed: {from: 1 m/s, to: 10 mm/s, count: 3}, along: y}
grid: {shape: [40, 48], size: [6 mm, 7 mm]}
"""
ON_A_RANGE = "{from: 1 m/s, to: 10 mm/s, count: 3}"


@pytest.fixture
def client(tmp_path: Path) -> Iterator[TestClient]:
    with asking(tmp_path / "page") as client:
        yield client


@pytest.mark.parametrize("speed", ["0.5 m/s", "[1 m/s, 10 mm/s]", ON_A_RANGE])
def test_speeds_go_into_the_form_and_back(client: TestClient, speed: str) -> None:
    text = BALL.replace(ON_A_RANGE, speed)
    given = client.post("/api/case", json={"yaml": text}).json()["case"]
    assert "time" not in given
    written = client.post("/api/yaml", json={"case": given, "yaml": "", "titled": True}).json()
    assert client.post("/api/case", json={"yaml": written["yaml"]}).json()["case"] == given
    checked = client.post("/api/check", json={"yaml": written["yaml"]}).json()
    assert checked["speeds"] == {"0": 1, "[": 2, "{": 3}[speed[0]]
    assert "steps" not in checked


def test_layers_go_into_the_form_and_are_checked(client: TestClient) -> None:
    lines = BALL.splitlines()
    law = ", ".join(each.strip() for each in lines[3:8])
    layered = f"material: {{layers: [{{thickness: 4 mm, {law}}}], base: rigid}}"
    text = "\n".join([*lines[:2], layered.replace("0.5}", "0.45}"), *lines[8:]])
    given = client.post("/api/case", json={"yaml": text}).json()["case"]
    written = client.post("/api/yaml", json={"case": given, "yaml": "", "titled": True}).json()
    checked = client.post("/api/check", json={"yaml": written["yaml"]}).json()
    assert checked["speeds"] == 3
    assert given["material"]["layers"][0]["thickness"] == "4 mm"


def test_example_of_a_rolling_roller_is_checked(client: TestClient) -> None:
    examples = client.get("/api/examples").json()
    (rolling,) = (each["yaml"] for each in examples if each["name"] == "roller-rolling")
    checked = client.post("/api/check", json={"yaml": rolling}).json()
    assert ["speeds", "7, from 1 mm/s to 1 m/s"] in checked["needs"]
    drawn = client.post("/api/drawing", json={"yaml": rolling, "what": "load"})
    assert drawn.status_code == 200


def test_coarse_answer_has_fewer_speeds_and_no_errors(tmp_path: Path) -> None:
    cases = CaseReader(Folder(tmp_path))
    many = BALL.replace("count: 3", "count: 60")
    found, settings = cases.prepared(many, "coarse")
    assert settings == ("motion.speed.count=24", "output.errors=false", "tolerance=0.0001")
    assert isinstance(found.case.motion, SteadyMotion)
    speeds = found.case.motion.speeds
    assert (len(speeds), speeds[0], speeds[-1]) == (24, 1.0, 0.01)
    # Speeds whose fields are asked for are all computed.
    _, kept = cases.prepared(many + "output: {fields: [1 m/s]}\n", "coarse")
    assert kept == settings[1:]


def test_verdicts_on_allowable_values_are_told(client: TestClient) -> None:
    text = BALL.replace(ON_A_RANGE, "1 m/s") + "allowable: {peak_pressure: 1 kPa}\n"
    run = begun(client, text)
    followed(client, run)
    until(lambda: bool(status(client, run)["verdicts"]))
    [found] = status(client, run)["verdicts"]
    assert found["verdict"] == "failed"
    assert found["text"].startswith("peak pressure ")
    assert "allowable 1 kPa, margin −" in found["text"]


def test_run_over_speed_is_followed_and_shown(client: TestClient) -> None:
    run = begun(client, BALL)
    assert client.get(f"/api/runs/{run}").json()["axis"] == "speed"
    *before, last = followed(client, run)
    assert {event["stage"] for event in before} <= {"waiting", "starting", "steps"}
    assert (last["state"], last["step"], last["steps"]) == ("done", 3, 3)
    assert (last["begin"], last["end"], last["reached"]) == (0.01, 1.0, "10 mm/s")
    assert last["message"] == "done: 3 of 3 speeds"
    assert last["fields_text"] == ["10 mm/s", "100 mm/s", "1 m/s"]

    live = client.get(f"/api/runs/{run}/grown").json()
    assert live["speed"] == close_to([1.0, 0.1, 0.01])
    assert "friction_coefficient" in live["scalars"]

    data = client.get(f"/api/runs/{run}/data").json()
    axis, friction = data["axis"], data["scalars"]["friction_coefficient"]
    assert axis["name"] == "speed"
    assert axis["values"] == close_to([0.01, 0.1, 1.0])  # from the slowest
    assert friction["value"] == close_to(live["scalars"]["friction_coefficient"][::-1])
    assert None not in friction["error"]
    # The creep is 9/10 of the compliance, within 10 ms: the mean retardation time is 9 ms.
    figures = client.get(f"/api/runs/{run}/figures").json()
    (drawn,) = figures["friction"]
    slow, fast, curve = drawn["data"]
    assert array_of(slow["y"])[0] == close_to(
        reference.slow_friction_coefficient(RADIUS, 9e-3, 0.01), rel=1e-5
    )
    assert friction["value"][0] == close_to(array_of(slow["y"])[0], rel=0.1)
    assert array_of(curve["y"]) == close_to(friction["value"], rel=1e-6)
    assert fast["name"] == "limit of fast motion"
    shown = [each["layout"]["meta"]["name"] for each in figures["histories"]]
    assert {"history-approach", "history-resistance_y"} <= set(shown)
    assert figures["scale"] == "log"
    shown, _, along, _ = figures["surface"]
    titles = [frame["layout"]["meta"]["title"] for frame in shown["frames"]]
    assert titles == ["10 mm/s", "100 mm/s", "1 m/s"]
    arrows = [frame["layout"]["annotations"][0] for frame in shown["frames"]]
    assert [(arrow["xshift"], arrow["yshift"]) for arrow in arrows] == [(0, close_to(34))] * 3
    edges = [frame["data"][-1]["x"] for frame in along["frames"]]
    assert len(edges) == 3
    assert all(leading > trailing for leading, trailing in edges)

    rows = list(csv.DictReader(io.StringIO(client.get(f"/api/runs/{run}/history.csv").text)))
    assert [float(row["speed [m/s]"]) for row in rows] == live["speed"]
    assert client.get(f"/api/runs/{run}/case.yaml").text == BALL
    assert client.get(f"/api/runs/{run}/result.nc").content[:4] == b"\x89HDF"


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The ball in motion at two speeds, and at rest."""
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    ball, load = vc.Paraboloid(RADIUS, RADIUS), vc.step(2.0, tilt_x=0.0, tilt_y=0.0)
    grid, folder = vc.Grid((32, 32), (4e-3, 4e-3)), tmp_path_factory.mktemp("stored")
    results = {
        "moved": vc.steady(ball, rubber, load, [0.5, 1.0], grid=grid, errors=False),
        "pressed": vc.simulate(ball, rubber, load, grid, [0.0], errors=False),
    }
    for name, ds in results.items():
        (folder / name).mkdir()
        vc.save(ds, folder / name / RESULT_NAME)
    return {name: folder / name for name in results}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("figure", "places", "said"),
    [
        ("friction", {}, ""),
        ("motion-profile", {"speeds": ("1 m/s",)}, ""),
        ("friction", {"speeds": ("1 m/s",)}, "speed: does not apply to the figure friction"),
        (
            "pressure-map",
            {"times": ("1 s",)},
            "time: the run is over speed; give speed in its place",
        ),
        (
            "pressure-map",
            {"speeds": ("2 m/s",)},
            "speed: 2 m/s lies outside the run, which goes from 500 mm/s to 1 m/s",
        ),
        (
            "pressure-map",
            {"speeds": ("1 m/s",), "times": ("1 s",)},
            "time and speed: a run is over one of them; leave out the other",
        ),
    ],
)
def test_figures_over_speed_are_drawn_or_refused_by_name(
    stored: dict[str, Path], figure: str, places: dict[str, tuple[str, ...]], said: str
) -> None:
    choice = PictureChoice(figure, **places)
    if not said:
        assert figure_of(stored["moved"], FIGURES | STEADY_FIGURES, choice).startswith(b"<?xml")
        return
    with pytest.raises(RequestError, match=f"^{re.escape(said)}$"):
        figure_of(stored["moved"], FIGURES | STEADY_FIGURES, choice)


def test_runs_over_time_and_over_speed_are_not_compared(stored: dict[str, Path]) -> None:
    choice = PictureChoice("pressure-profile")
    with pytest.raises(RequestError, match=r"^runs over time and runs over speed cannot be"):
        comparison_of(stored, COMPARISONS, choice)
    both = {"one": stored["moved"], "two": stored["moved"]}
    assert comparison_of(both, COMPARISONS, choice).startswith(b"<?xml")


# 40 speeds on many cells, so that the run lasts until it is stopped.
LONG = BALL.replace("count: 3", "count: 40").replace("[40, 48]", "[120, 144]")


@pytest.mark.slow
def test_run_over_speed_is_cancelled_and_continues_to_the_same_numbers(client: TestClient) -> None:
    run = begun(client, LONG)
    until(lambda: status(client, run)["step"] > 2)
    client.post(f"/api/runs/{run}/cancel")
    cancelled = followed(client, run)[-1]
    step = cancelled["step"]
    assert (cancelled["state"], cancelled["resumable"]) == ("cancelled", True)
    assert 2 < step < 40
    found = re.fullmatch(
        r"cancelled after speed (\d+) of 40, at \d.* mm/s; its results are kept",
        cancelled["message"],
    )
    assert found
    assert int(found[1]) == step
    part = client.get(f"/api/runs/{run}/data").json()
    assert len(part["axis"]["values"]) == step
    assert part["notices"] == [
        f"The run ended after {step} of 40 speeds: this page shows what it had completed."
    ]
    assert ">Over speed<" in client.get(f"/api/runs/{run}/report.html").text
    client.post(f"/api/runs/{run}/resume")
    assert followed(client, run)[-1]["message"] == "done: 40 of 40 speeds"
    whole = client.get(f"/api/runs/{run}/data").json()
    for name, scalar in part["scalars"].items():  # from the slowest: the first ones were fast
        assert whole["scalars"][name]["value"][-step:] == scalar["value"]
