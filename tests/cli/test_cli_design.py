"""Command `design`: its options, its directory, and its messages."""

from __future__ import annotations

from pathlib import Path

import pytest
import xarray as xr
from tests.studies.design.test_arguments import BALL

from viscontact.case import read_case
from viscontact.cli.entry import main
from viscontact.cli.studies.design import design_arguments

COMMAND = ("design", "ball.yaml", "--minimise", "peak_pressure", "-o", "found")
RADIUS = ("--change", "indenter.radius=4 mm,6 mm")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(BALL)
    return tmp_path


def test_a_design_writes_the_best_case_and_the_trials(capsys: pytest.CaptureFixture[str]) -> None:
    scenarios = ("--over", "load.force=50mN,0.1N", "--constraint", "approach<=1mm")
    assert main([*COMMAND, *RADIUS, *scenarios]) == 0
    said = capsys.readouterr().out
    assert said.startswith("least peak_pressure: ")
    assert "at indenter.radius = 6 mm, where the case has" in said
    assert said.endswith("found/best.yaml\n")
    assert (
        read_case("found/best.yaml").indenter
        == read_case("ball.yaml", ["indenter.radius=6 mm"]).indenter
    )
    page = Path("found/report.html").read_text(encoding="utf-8")
    assert "Before and after" in page
    assert page.count("data:image/svg+xml") == 3  # pressure, line load and trials
    with xr.open_dataset("found/trials.nc") as table:
        assert table["indenter.radius"].values.tolist() == [5e-3, 4e-3, 6e-3]
        assert table.peak_pressure.attrs["units"] == "Pa"
        assert table.sizes["scenario"] == 2
        assert table.approach.values.argmax() == 1


def test_the_worst_corner_of_a_scatter_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscontact.cli.studies.execution.write_report", lambda *_: None)
    assert main([*COMMAND, *RADIUS, "--scatter", "load.force=50mN:0.2N", "-q"]) == 0
    with xr.open_dataset("found/trials.nc") as table:
        names = ["as in the case", "with force 0.05 N", "with force 0.2 N"]
        assert [name.replace("50 mN", "0.05 N") for name in table.scenario.values] == names
        assert table.peak_pressure_of_scenarios.values.argmax(axis=1).tolist() == [2, 2, 2]


def test_a_design_is_continued_with_resume_only(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.cli.studies.execution.write_report", lambda *_: None)
    assert main([*COMMAND, *RADIUS, "-q"]) == 0
    trials = Path("found/trials.jsonl").read_text()
    assert main([*COMMAND, *RADIUS]) == 2
    assert "found: holds runs already; continue them with --resume" in capsys.readouterr().err
    assert main([*COMMAND, *RADIUS, "--resume"]) == 0
    assert Path("found/trials.jsonl").read_text() == trials
    assert main([*COMMAND, "--change", "indenter.radius=4 mm,7 mm", "--resume"]) == 2
    assert "holds another design, with a different change" in capsys.readouterr().err
    assert main([*COMMAND, *RADIUS, "--resume", "--overwrite"]) == 2
    assert "give one of them" in capsys.readouterr().err
    assert main([*COMMAND, "--change", "indenter.radius=4 mm", "--overwrite"]) == 2
    assert Path("found/trials.jsonl").read_text() == trials  # refused before it is replaced
    assert main([*COMMAND, "--change", "indenter.radius=4 mm,7 mm", "--overwrite", "-q"]) == 0
    assert "7 mm" in Path("found/trials.jsonl").read_text()


@pytest.mark.slow
def test_a_cluster_computes_the_same_trials() -> None:
    pytest.importorskip("distributed")
    assert main([*COMMAND, *RADIUS, "-q"]) == 0
    before = Path("found").rename("here")
    assert main([*COMMAND, *RADIUS, "-q", "--scheduler", "local", "-j", "2"]) == 0
    lines = [
        sorted(Path(place, "trials.jsonl").read_text().splitlines()) for place in (before, "found")
    ]
    assert lines[0] == lines[1]


def test_an_interrupted_design_says_how_to_continue(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(**arguments: object) -> None:
        Path("found").mkdir()
        Path("found/trials.jsonl").touch()
        raise KeyboardInterrupt

    monkeypatch.setattr("viscontact.cli.studies.design.design", interrupted)
    assert main([*COMMAND, *RADIUS]) == 130
    assert "continue with the same command and --resume" in capsys.readouterr().err


REFUSED = {
    "no parameter": ((), "--change: name a parameter, e.g. --change"),
    "no range": (("--change", "indenter.radius"), "--change indenter.radius: write KEY=VALUE"),
    "twice": ((*RADIUS, *RADIUS), "--change indenter.radius: is given twice"),
    "unit": (("--change", "indenter.radius=1 N:2 N"), "indenter.radius: cannot read"),
    "bound": (
        ("--change", "indenter.radius=-1 mm:2 mm"),
        "indenter.radius: must be more than zero",
    ),
    "reversed": (
        ("--change", "indenter.radius=3 mm:2 mm"),
        "--change: indenter.radius: the lower bound comes first",
    ),
    "constraint": ((*RADIUS, "--constraint", "contact_lenth<=1mm"), "did you mean contact_length?"),
    "contradiction": (
        (*RADIUS, "--constraint", "approach<=1um", "--constraint", "approach>=1mm"),
        "--constraint: approach <= 1 um and approach >= 1 mm contradict each other",
    ),
    "scatter": (
        (*RADIUS, "--scatter", "load.force=2 N:1 N"),
        "--scatter: load.force: the lower bound comes first",
    ),
    "at": ((*RADIUS, "--at", "3"), "--at: write worst, end or a time"),
    "instant": ((*RADIUS, "--at", "3 s"), "--at: 3 s is no instant of the case"),
    "a goal twice": ((*RADIUS, "--maximise", "peak_pressure"), "peak_pressure: is given twice"),
}


@pytest.mark.parametrize(("typed", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_an_option_that_does_not_fit_is_refused_in_one_line(
    typed: tuple[str, ...], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*COMMAND, *typed]) == 2
    said = capsys.readouterr().err
    assert message in said.replace("µ", "u")
    assert said.count("\n") == 1
    assert not Path("found").exists()


@pytest.mark.slow
def test_a_design_that_is_not_feasible_ends_with_the_closest_trial(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.cli.studies.execution.write_report", lambda *_: None)
    assert main([*COMMAND, *RADIUS, "-q", "--constraint", "approach<=1nm"]) == 1
    said = capsys.readouterr().err
    assert said.startswith(
        "no feasible design in 3 runs: approach <= 1 nm is not kept; the closest"
    )
    assert said.endswith("at indenter.radius=6 mm\n") or said.endswith("at indenter.radius=4 mm\n")


def test_values_of_lists_are_no_ranges() -> None:
    typed = {"case": Path("ball.yaml"), "output": Path("found"), "runs": 9, "jobs": 1}
    typed |= {"change": ["grid.size=[1 mm, 1 mm], [2 mm, 2 mm]"], "over": ["load.force=1 N,2 N"]}
    typed |= {"minimise": ["approach"], "at": "10 min"}
    rest = ("maximise", "scatter", "constraint", "settings", "scheduler")
    found = design_arguments({**dict.fromkeys(rest), **typed})
    assert found["change"] == {"grid.size": ["[1 mm, 1 mm]", "[2 mm, 2 mm]"]}
    assert found["at"] == 600.0
