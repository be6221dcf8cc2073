"""Cases of steady rolling with traction: read, checked, run, resumed, shown and exported."""

import csv
import io
import math
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from interrupted_runs import same_bits, stopped_after
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.results.history_csv import write_history

CASE = """\
title: Drive roller
indenter: {shape: paraboloid, radius_x: infinite, radius_y: 30 mm}
material: {law: zener, shear_modulus: 2 MPa, delayed_modulus: 6 MPa, viscosity: 600 kPa s, \
poisson_ratio: 0.5}
load: {kind: step, force: 200 N, tilt_y: 0}
friction: {coefficient: 0.5}
motion: {kind: steady, speed: [40 mm/s, 10 mm/s], creepage: [1 %, 3 %, -2 %]}
grid: {shape: [1, 40], size: [100 mm, 16 mm], periodic: [true, false]}
"""


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run."""
    here = tmp_path_factory.mktemp("drive")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    return here / "case"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def written(folder: Path, *changes: tuple[str, str]) -> Path:
    text = CASE
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "changed.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_result_is_that_of_steady(finished: Path) -> None:
    rubber = vc.Material(vc.Zener(2e6, 6e6, 6e5), poisson_ratio=0.5)
    with pytest.warns(vc.AccuracyWarning, match="no datum"):
        whole = vc.steady(
            vc.Paraboloid(float("inf"), 0.03),
            rubber,
            vc.step(200.0, tilt_y=0.0),
            [0.04, 0.01],
            grid=vc.Grid((1, 40), (0.1, 0.016), periodic=(True, False)),
            friction=0.5,
            creepage=[0.01, 0.03, -0.02],
        )
    with vc.open_results(finished) as ds:
        assert ds.tangential_force_y.dims == ("speed", "creepage")
        assert ds.traction_y.dims == ("speed", "creepage", "x", "y")
        for name in (
            *("creepage", "tangential_force_y", "tangential_force_y_per_length", "drive_torque"),
            *("friction_power_error", "slip_fraction", "traction_dissipation", "slip_state"),
        ):
            assert np.array_equal(ds[name], whole[name]), name
            assert ds[name].attrs["units"] == whole[name].attrs["units"], name
        assert (ds.tangential_force_y_per_length == ds.tangential_force_y / 0.1).all()


@pytest.fixture(scope="module")
def coupled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A saved result of coupled bodies, each creepage of which has a contact of its own."""
    polymer = vc.Material(vc.Zener(2e6, 6e6, 6e5), poisson_ratio=0.38)
    given = {"friction": 0.5, "creepage": [0.01, 0.03], "errors": False}
    grid = vc.Grid((1, 24), (0.1, 0.016), periodic=(True, False))
    cylinder, load = vc.Paraboloid(float("inf"), 0.03), vc.step(200.0, tilt_y=0.0)
    with pytest.warns(vc.AccuracyWarning):
        ds = vc.steady(cylinder, polymer, load, [0.01, 0.04], grid=grid, **given)
    path = tmp_path_factory.mktemp("coupled") / "saved.nc"
    vc.save(ds, path)
    return path


def test_commands_take_the_contact_at_one_creepage_of_coupled_bodies(
    coupled: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for command in (["show"], ["report"], ["export"], ["plot", "stick-map"]):
        words = [command[0], str(coupled), *command[1:]]
        assert main(words) == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1
        assert "choose one of 1 %, 3 %" in said
        assert "--creepage '1 %'" in said
        into = {"report": ["-o", "a.html"], "plot": ["-o", "a.png"]}.get(command[0], [])
        assert main([*words, "--creepage", "3 %", *into]) == 0
        if command == ["export"]:
            (row, *_) = csv.DictReader(io.StringIO(capsys.readouterr().out))
            with vc.open_results(coupled) as ds:
                peak = float(ds.peak_pressure[0, 1])
            assert float(row["peak_pressure [Pa]"]) == peak
        capsys.readouterr()
    # A figure of all creepages needs no choice.
    assert main(["plot", str(coupled), "traction-creepage", "-o", "b.png"]) == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("2 %", "--creepage: must be one of those of the result (0.01, 0.03), got 0.02"),
        ("2 mm", "--creepage: '2 mm' is no ratio; write e.g. '1 %'"),
        ("much", "--creepage: cannot read 'much' as a number with a unit"),
    ],
)
def test_creepages_that_a_result_does_not_have_are_refused(
    coupled: Path, capsys: pytest.CaptureFixture[str], text: str, said: str
) -> None:
    assert main(["show", str(coupled), "--creepage", text]) == 2
    assert capsys.readouterr().err == f"{said}\n"


def test_saved_result_is_opened_as_it_was(finished: Path, tmp_path: Path) -> None:
    with vc.open_results(finished) as ds:
        vc.save(ds.load(), tmp_path / "again.nc")
        with vc.open_results(tmp_path / "again.nc") as again:
            assert again.equals(ds)


def test_run_stopped_after_a_speed_is_resumed_to_the_same_bits(
    folder: Path, finished: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with stopped_after(monkeypatch):
        assert main(["run", "case.yaml", "-q"]) == 130
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    with vc.open_results(finished) as whole:
        assert same_bits("case", whole.load())


def test_other_creepages_are_another_run(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "case.yaml", "-q"]) == 0
    assert main(["run", "case.yaml", "-q", "--resume", "--set", "motion.creepage=2 %"]) == 2
    assert "motion.creepage" in capsys.readouterr().err


def test_check_show_and_export_go_by_speed(
    folder: Path, finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "case.yaml"]) == 0
    assert "3, from -0.02 to 0.03" in capsys.readouterr().out
    assert main(["show", str(finished)]) == 0
    assert main(["export", str(finished), "-o", "out.csv"]) == 0
    header, *rows = Path("out.csv").read_text(encoding="utf-8").splitlines()
    assert "friction_coefficient" in header
    assert "tangential_force_y" in header
    assert len(rows) == 2 * 3  # speeds and creepages


def test_show_prints_tractions_over_creepage_and_where_all_slides(
    folder: Path, finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """At 3 % some cells stick; at 10 % none does, and the force is friction times 200 N."""
    assert main(["show", str(finished)]) == 0
    shown = capsys.readouterr().out
    assert "Tangential force along y per length [N/m] at a creepage of" in shown
    with vc.open_results(finished) as ds:
        force = ds.tangential_force_y_per_length.sel(speed=0.01, creepage=0.03)
        assert f"{float(force):.1f} ±" in shown
    assert [line.split()[-1] for line in shown.splitlines() if " 10 mm/s" in line] == ["-"]
    assert main(["run", str(written(folder, ("-2 %", "10 %"))), "-q"]) == 0
    capsys.readouterr()
    assert main(["show", "changed"]) == 0
    [line] = [line for line in capsys.readouterr().out.splitlines() if " 10 mm/s" in line]
    assert line.split()[-2:] == ["10", "%"]
    with vc.open_results("changed") as ds:
        assert float(ds.tangential_force_y.sel(creepage=0.1).max()) == close_to(-0.5 * 200.0)


def test_report_and_figure_show_the_traction_over_creepage(folder: Path, finished: Path) -> None:
    assert main(["report", str(finished), "-o", "report.html"]) == 0
    page = Path("report.html").read_text(encoding="utf-8")
    assert "Traction over creepage" in page
    assert "traction-creepage" in page
    with vc.open_results(finished) as ds:
        rows = page.count("10 mm/s</td>")
        assert rows >= ds.sizes["creepage"]
    assert main(["plot", str(finished), "traction-creepage", "-o", "curve.png"]) == 0
    assert Path("curve.png").stat().st_size > 0


@pytest.mark.parametrize(
    ("creepage", "found"),
    [
        ("3 %", [0.03]),
        ("0.003", [0.003]),
        ("{from: 0.1 %, to: 10 %, count: 3, spacing: log}", [0.001, 0.01, 0.1]),
        ("{from: -1 %, to: 1 %, count: 3}", [-0.01, 0.0, 0.01]),
    ],
)
def test_creepage_is_one_a_list_or_a_range(
    creepage: str, found: list[float], tmp_path: Path
) -> None:
    case = read_case(written(tmp_path, ("[1 %, 3 %, -2 %]", creepage)))
    np.testing.assert_allclose(case.motion.creepages, found, atol=1e-15)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("friction: {coefficient: 0.5}\n", ""), "friction: a creepage needs friction"),
        ((", creepage: [1 %, 3 %, -2 %]", ""), "creepage: under friction a body in steady motion"),
        (("[1 %, 3 %, -2 %]", "[1 %, 0.01]"), "each is needed once, got 0.01 twice"),
        (("[1 %, 3 %, -2 %]", "150 %"), "motion.creepage"),
        (("[1 %, 3 %, -2 %]", "[]"), "motion.creepage"),
        (("[1 %, 3 %, -2 %]", "{from: 0, to: 1 %, count: 3, spacing: log}"), "spacing: log needs"),
        (("creepage:", "rolling: false, creepage:"), "goes with a body that rolls"),
        (("poisson_ratio: 0.5", "poisson_ratio: 0.4"), "creepage: pressure and tractions"),
        (("friction:", "tangential: {kind: step, force_y: 1 N}\nfriction:"), "tangential: a body"),
        (("speed: [40", "speeds: [40"), "speed"),
    ],
)
def test_refused_case_names_its_key(
    change: tuple[str, str],
    message: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["check", str(written(tmp_path, change))]) == 2
    assert message in " ".join(capsys.readouterr().err.split())


STEADY = (vc.Paraboloid(0.01, 0.01), vc.Material(vc.Elastic(1e6), 0.5), vc.step(1.0), 1.0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"friction": 0.3}, "^creepage: under friction"),
        ({"creepage": 0.1}, "^friction: a creepage needs friction"),
        ({"friction": 0.3, "creepage": []}, "^creepage: at least one is needed"),
        ({"friction": 0.3, "creepage": [[0.1]]}, "^creepage must be a number or a list"),
        ({"friction": 0.3, "creepage": [0.1, float("nan")]}, "^creepage must be a finite number"),
        ({"friction": 0.3, "creepage": 1.5}, "^creepage must lie between -1 and 1"),
        ({"friction": 0.3, "creepage": 0.1, "rolling": False}, "^creepage goes with a body"),
        ({"friction": 0.3, "lateral_creepage": 0.1}, "^lateral_creepage goes with a creepage"),
        ({"friction": 0.3, "spin": 0.1}, "^spin goes with a creepage"),
        ({"friction": 0.3, "creepage": 0.0, "spin": math.inf}, "^spin must be a finite"),
    ],
)
def test_refused_argument_is_named(given: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        vc.steady(*STEADY, **given)


def test_lateral_creepage_of_a_case_is_in_the_check_and_refused_of_coupled_bodies(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    askew = ", creepage: [1 %, 3 %, -2 %]", ", creepage: 0, lateral_creepage: 0.2 %"
    assert main(["check", str(written(tmp_path, askew))]) == 0
    assert "lateral creepage 0.002" in " ".join(capsys.readouterr().out.split())
    coupled = STEADY[0], vc.Material(vc.Elastic(1e6), 0.3), *STEADY[2:]
    for given, said in (
        ({"lateral_creepage": 0.01}, "a lateral creepage"),
        ({"spin": 1.0}, "spin"),
    ):
        with pytest.raises(ValueError, match=rf"^friction\.coupling: .* under {said}"):
            vc.steady(*coupled, friction=0.3, creepage=0.0, **given)


def test_force_across_the_motion_is_shown_of_a_body_that_rolls_askew(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, (", creepage: [1 %, 3 %, -2 %]", ", creepage: [0, 1 %]"))
    assert main(["run", str(path), "-q", "-o", str(tmp_path / "ahead")]) == 0
    askew = ["--set", "motion.lateral_creepage=1 %", "-o", str(tmp_path / "askew")]
    assert main(["run", str(path), "-q", *askew]) == 0
    capsys.readouterr()
    shown = []
    for name in ("ahead", "askew"):
        assert main(["show", str(tmp_path / name)]) == 0
        shown.append(capsys.readouterr().out)
        assert main(["report", str(tmp_path / name)]) == 0
        capsys.readouterr()
        shown[-1] += (tmp_path / name / "report.html").read_text(encoding="utf-8")
    assert ["force along x per length" in each for each in shown] == [False, True]


def test_spin_of_a_case_is_in_the_check_and_refused_of_bodies_without_end(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    turning = ", creepage: [1 %, 3 %, -2 %]", ", creepage: 0, spin: 2 deg/m"
    assert main(["check", str(written(tmp_path, turning))]) == 2
    assert "spin: a body without end does not turn" in " ".join(capsys.readouterr().err.split())
    roller, ball = "radius_x: infinite, radius_y: 30 mm", "radius_x: 30 mm, radius_y: 30 mm"
    grid = "shape: [1, 40], size: [100 mm, 16 mm], periodic: [true, false]"
    ends = grid, "shape: [40, 40], size: [24 mm, 24 mm]"
    force = "force: 200 N, tilt_y: 0", "force: 200 N, tilt_x: 0, tilt_y: 0"
    assert main(["check", str(written(tmp_path, turning, (roller, ball), ends, force))]) == 0
    assert "spin 34.91 mrad/m" in " ".join(capsys.readouterr().out.split())


def test_coupled_layers_under_friction_are_refused_by_name() -> None:
    rubber = vc.Material(vc.Elastic(1e6), 0.5)
    covered = vc.Layered([vc.Layer(5e-3, rubber)], base="rigid")
    with pytest.raises(ValueError, match=r"^friction\.coupling: .* give coupling=False"):
        vc.steady(STEADY[0], covered, *STEADY[2:], friction=0.3, creepage=0.01)


@pytest.mark.filterwarnings("ignore:load. tilt_y is free:viscontact.AccuracyWarning")
def test_table_of_an_export_has_a_row_for_each_creepage() -> None:
    ds = vc.steady(*STEADY, friction=0.3, creepage=[0.001, 0.01], errors=False)
    written = io.StringIO()
    write_history(ds, written)
    rows = list(csv.DictReader(io.StringIO(written.getvalue())))
    assert [float(row["creepage"]) for row in rows] == ds.creepage.values.tolist()
    for name in ("tangential_force_y [N]", "drive_torque [N m]"):
        values = ds[name.partition(" ")[0]].values.ravel()
        np.testing.assert_array_equal([float(row[name]) for row in rows], values)
    assert {row["speed [m/s]"] for row in rows} == {repr(float(ds.speed[0]))}
