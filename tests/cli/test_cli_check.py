"""What `check` predicts of a run, and of what it warns."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
from cli.sphere_runs import ADAPTIVE, SPHERE, folder
from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.preparation import prepared

__all__ = ["folder"]  # a fixture


def test_check_predicts_grid_steps_memory_time_and_contact(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml"]) == 0
    printed = capsys.readouterr().out
    for expected in ("32 x 32 cells on 3 mm x 3 mm", "6, up to t = 5 s", "GB free", "run time"):
        assert expected in printed
    # Hertz with Phi(5 s): a^3 = 3 R W Phi / 8 (eq. 16 of Spinu & Cerlinca 2018), a = 1.143 mm,
    # peak pressure 3 W / (2 pi a^2) = 1.46 MPa; the estimate is good to a few per cent.
    assert "2.28 mm long, 2.28 mm wide" in printed
    assert "1.46 MPa" in printed
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


@pytest.mark.parametrize(
    ("load", "when"),
    [
        ("{kind: step, force: 4 N}", "at the largest load\n"),
        ("{kind: ramp, force: 4 N, duration: 1 s}", "at the largest load (t = 1 s to 5 s);\n"),
        pytest.param(
            "{kind: harmonic, mean: 3 N, amplitude: 1 N, period: 2 s, cycles: 2}",
            "at the largest load (first at t = 500 ms);\n",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_check_says_when_the_error_of_an_automatic_grid_is_so_small(
    folder: Path, capsys: pytest.CaptureFixture[str], load: str, when: str
) -> None:
    settings = ["--set", f"load={load}", "--set", "grid={tolerance: 5 %}"]
    assert main(["check", "case.yaml", *settings]) == 0
    printed = capsys.readouterr().out
    # Of all three quantities, in one line: no number is torn from its unit.
    assert re.search(r"grid error .*pressure [\d.]+ %, .*area [\d.]+ %, approach [\d.]+ %", printed)
    assert when in re.sub(r" +\n", "\n", printed)
    assert ("more at smaller loads" in printed) == ("step" not in load)
    assert max(len(line.rstrip()) for line in printed.splitlines()) <= 80


def test_check_predicts_an_approach_and_adaptive_steps(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    load = ["--set", "load={kind: ramp, approach: 100 um, duration: 1 s}"]
    assert main(["check", "case.yaml", *ADAPTIVE, *load]) == 0
    printed = capsys.readouterr().out
    assert "as needed for an error of 1 %, up to t = 5 s" in printed
    assert "largest approach, before any creep" in printed
    # Hertz, E* = 4 G: F = (4/3) E* sqrt(R) delta^(3/2) = 5.33 N, a = sqrt(R delta) = 1 mm,
    # p = (2/pi) E* sqrt(delta/R) = 2.55 MPa; the estimate is good to a few per cent.
    found = dict(re.findall(r"(force|peak pressure|contact) +([\d.]+)", printed))
    assert float(found["force"]) == close_to(5.33, rel=0.03)
    assert float(found["peak pressure"]) == close_to(2.55, rel=0.03)
    assert float(found["contact"]) == close_to(2.0, rel=0.03)
    assert "approach   " not in printed


def test_forecast_counts_the_steps_within_swings_and_at_kinks() -> None:
    material, times = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5), [0.0, 10.0]
    grid = vc.Grid((32, 32), (3e-3, 3e-3))

    def steps(load: vc.LoadHistory, times: Any = times) -> float:
        return Problem(vc.Sphere(0.01), material, load, grid, times).step_count

    assert steps(vc.step(0.1)) == 2
    assert steps(vc.triangle(0.1, 1.0)) == 4
    assert steps(vc.harmonic(0.1, 0.05, 1.0, cycles=10)) == 1281
    adaptive = [vc.adaptive_times(10.0, tolerance=tolerance) for tolerance in (1e-3, 1e-4)]
    rough, fine = (steps(vc.step(0.1), each) for each in adaptive)
    assert rough < fine < 3 * rough
    for wanted, guess in zip(adaptive, (rough, fine), strict=True):
        taken = len(list(vc.march(vc.Sphere(0.01), material, vc.step(0.1), grid, wanted)))
        assert guess / 2.5 < taken < guess * 2.5


def test_check_warns_of_a_grid_that_the_contact_will_overrun(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml", "--set", "grid.size=[2.1 mm, 2.1 mm]"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("case.yaml: can be read, but:\n")
    assert "will probably overrun the grid" in printed
    assert main(["check", "case.yaml", "--set", "grid.size=[30 mm, 30 mm]"]) == 0
    assert "fewer than 10 cells across" in capsys.readouterr().out


@pytest.mark.slow
def test_contact_far_from_the_origin_is_checked_and_run_on_a_grid_around_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, _, _ = SPHERE.partition("grid:")
    (folder / "far.yaml").write_text(f"{text}grid: {{tolerance: 20 %}}\n", encoding="utf-8")
    far = ["--set", "indenter.offset_x=8 mm", "--set", "load.force=1 uN"]
    level = ["--set", "load.tilt_x=0 rad", "--set", "load.tilt_y=0 rad"]
    assert main(["check", "far.yaml", *far, *level]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "around x = 8 mm, y = 0 m (automatic)" in printed
    (expected,) = re.findall(r"cells in it \d+ along, (\d+) across", printed)
    quick = ["--set", "time.steps=1", "--set", "output.errors=false"]
    assert main(["run", "far.yaml", *far, *level, *quick, "-q"]) == 0
    ds = vc.open_results("far/result.nc")
    assert float(ds.x.mean()) == close_to(8e-3, rel=1e-6)
    assert int(ds.cells_across.max()) == close_to(int(expected), rel=0.1)
    assert ds.eccentricity_x.values[ds.force > 0] == close_to(8e-3, rel=1e-4)


def test_check_warns_of_a_contact_too_large_for_small_strains(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # Hertz with Phi(5 s): a = 1.143 mm of a radius of 10 mm at 4 N, and a grows with W^(1/3):
    # 4.0 mm at 172 N, of which a sphere's circular section takes 2%. The approach is a^2/R.
    heavy = ["--set", "load.force=172 N", "--set", "grid.size=[12 mm, 12 mm]"]
    assert main(["check", "case.yaml"]) == 0
    assert capsys.readouterr().out.startswith("case.yaml: no problems found\n")
    assert main(["check", "case.yaml", *heavy]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert printed.startswith("case.yaml: can be read, but: warning: ")
    assert "half width will be about 0.39 of the indenter's radius" in printed
    assert "approach will be about 0.1" in printed


def test_a_warning_that_names_its_instant_is_printed_without_it_in_front(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "creep.csv").write_text("time [s], D [1/GPa]\n1, 2\n10, 3\n", encoding="utf-8")
    table = "material={law: table, file: creep.csv, poisson_ratio: 0.4, warning: the data scatter}"
    wide = ["--set", "load.force=2 kN", "--set", "grid.size=[8 mm, 8 mm]"]
    assert main(["run", "case.yaml", "--set", table, *wide]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "warning: at t = 0 s 100% of the load has come within less than 1 s" in printed
    assert re.search(r"warning: t = [\d.]+ s: the approach is", printed)
    assert "warning: the data scatter" in printed  # of the whole run, so without an instant


def test_grid_is_measured_against_the_memory_that_is_free(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run = prepared(read_case(Path("case.yaml"))).run
    needed = run.memory
    monkeypatch.setattr("viscontact.runs.preparation.available_memory", lambda: needed + 1)
    assert main(["run", "case.yaml", "-q", "-o", "fits"]) == 0
    monkeypatch.setattr("viscontact.runs.preparation.available_memory", lambda: needed - 1)
    assert main(["run", "case.yaml", "-q", "-o", "too large"]) == 2
    assert "GB are free; use fewer cells" in capsys.readouterr().err
    assert not Path("too large").exists()
