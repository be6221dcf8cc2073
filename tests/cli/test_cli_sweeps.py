"""`status` and `collect` of a sweep at the command line."""

from __future__ import annotations

import csv
import re
import shutil
import signal
import subprocess
import sys
import time as clock
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import viscontact as vc
from closeness import close_to
from swept_runs import sweep_of
from viscontact.cli import main
from viscontact.results.run_files import FAILURE_NAME, STATE_NAME
from viscontact.runs.directory.lock import locked

SCANNED = """\
indenter: {shape: height-map, file: a.x3p, level: none}
material: {law: elastic, shear_modulus: 400 MPa, poisson_ratio: 0.3}
load: {kind: step, force: 20 N}
time: {end: 1 s, steps: 1}
grid: {shape: [36, 36], size: [1.8 mm, 1.8 mm]}
"""
FORCES = ["2 N", "3 N", "4 N"]


@pytest.fixture(scope="module")
def computed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A sweep over three forces, all done."""
    rows = [{"load.force": force} for force in FORCES]
    return sweep_of(tmp_path_factory.mktemp("computed"), rows)


@pytest.fixture
def sweep(computed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it in the working directory."""
    monkeypatch.chdir(tmp_path)
    return shutil.copytree(computed, "sweep")  # type: ignore[type-var]


def fail(place: Path, message: str) -> None:
    (place / FAILURE_NAME).write_text(f'{{"code": 1, "message": ["{message}"]}}')


def lines(capsys: pytest.CaptureFixture[str]) -> list[str]:
    return capsys.readouterr().out.splitlines()


def test_status_of_a_sweep_in_all_states(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["status", "sweep"]) == 0
    assert lines(capsys) == ["sweep: 3 runs: 3 done"]
    (Path(sweep) / "force=3N" / STATE_NAME).touch()
    shutil.rmtree(Path(sweep) / "force=4N")
    assert main(["status", "sweep"]) == 0
    assert lines(capsys) == [
        "sweep: 3 runs: 1 done, 1 stopped, 1 waiting",
        "67% done",
        "  stopped force=3N  100%",
    ]
    with locked(Path(sweep) / "force=3N"):
        assert main(["status", "sweep"]) == 0
    assert lines(capsys)[-1] == "  running force=3N  estimating errors"
    fail(Path(sweep) / "force=2N", "grid: the contact reaches the rim")
    assert main(["status", "sweep/runs.jsonl"]) == 1
    assert lines(capsys)[-1] == "  failed  force=2N  grid: the contact reaches the rim"


def test_status_of_a_single_run(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["status", "sweep/force=2N"]) == 0
    assert lines(capsys) == ["sweep/force=2N: 1 run: 1 done"]


def test_status_of_something_else_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["status", str(tmp_path)]) == 2
    (tmp_path / "runs.jsonl").write_text("{}\n")
    assert main(["status", str(tmp_path)]) == 2
    said = capsys.readouterr().err.splitlines()
    assert "neither a sweep (runs.jsonl) nor a run there" in said[0]
    assert "runs.jsonl:1: run: must be" in said[1]


def test_status_does_not_import_the_libraries_of_results(sweep: Path) -> None:
    code = (
        "import sys; from viscontact.cli import main; main(['status', 'sweep'])\n"
        "print({'xarray', 'netCDF4', 'scipy', 'pint', 'rich'} & set(sys.modules))"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.splitlines()[-1] == "set()"


def watching() -> subprocess.Popen[str]:
    words = [sys.executable, "-m", "viscontact", "status", "sweep", "--watch"]
    pipe = subprocess.PIPE
    return subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True)


def test_watch_prints_changes_until_all_have_ended(
    sweep: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    aside = (Path(sweep) / "force=4N").rename("aside")
    waited = []

    def wait(seconds: float) -> None:
        waited.append(seconds)
        if len(waited) == 2:  # nothing has changed before
            aside.rename(Path(sweep) / "force=4N")

    monkeypatch.setattr(clock, "sleep", wait)
    assert main(["status", "sweep", "--watch"]) == 0
    first, *rest = lines(capsys)
    assert "2 done, 1 waiting" in first
    assert rest == ["67% done", "sweep: 3 runs: 3 done"]
    assert len(waited) == 2


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to a process")
def test_watch_ends_cleanly_on_a_request(sweep: Path) -> None:
    shutil.rmtree(Path(sweep) / "force=4N")
    with watching() as process:
        assert process.stdout is not None
        process.stdout.readline()
        clock.sleep(0.2)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=30)[1]
    assert process.returncode == 130
    assert said == ""


def test_collect_writes_the_joint_result(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["collect", "sweep", "-o", "sweep.nc"]) == 0
    assert lines(capsys) == ["sweep.nc"]
    with xr.open_dataset("sweep.nc") as stored:
        assert "pressure" not in stored
        np.testing.assert_array_equal(stored.approach, vc.open_many("sweep").approach)
    assert main(["collect", "sweep", "-o", "sweep.nc", "--fields"]) == 0
    with xr.open_dataset("sweep.nc") as stored:
        np.testing.assert_array_equal(stored.pressure, vc.open_many("sweep").pressure)


def test_collect_without_some_runs_writes_the_others_and_exits_1(
    sweep: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fail(Path(sweep) / "force=2N", "no")
    shutil.rmtree(Path(sweep) / "force=4N")
    assert main(["collect", "sweep", "-o", "sweep.nc"]) == 1
    assert capsys.readouterr().err.splitlines() == [
        "2 of 3 runs have no result: 1 failed, 1 waiting; `viscontact status sweep` lists them"
    ]
    with xr.open_dataset("sweep.nc") as stored:
        assert stored.state.values.tolist() == ["failed", "done", "waiting"]


def test_table_has_the_last_and_the_largest_values(sweep: Path) -> None:
    fail(Path(sweep) / "force=3N", "grid: the rim, far")
    assert main(["collect", "sweep", "-o", "sweep.csv"]) == 1
    with Path("sweep.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[:5] == ["run", "name", "load.force [N]", "state", "force [N]"]
    assert [row["load.force [N]"] for row in rows] == ["2.0", "3.0", "4.0"]
    assert [row["state"] for row in rows] == ["done", "failed", "done"]
    assert (rows[1]["approach [m]"], rows[1]["message"]) == ("", "grid: the rim, far")
    with vc.open_results("sweep/force=4N") as run:
        # The peak is largest at the start, while the sphere sinks in: eq. of Lee and Radok.
        expected = {
            "peak_pressure [Pa]": run.peak_pressure[-1],
            "error of peak_pressure [Pa]": run.peak_pressure_error[-1],
            "largest peak_pressure [Pa]": run.peak_pressure[0],
            "error of largest peak_pressure [Pa]": run.peak_pressure_error[0],
            "contact_area [m^2]": run.contact_area[-1],
            "largest contact_area [m^2]": run.contact_area[-1],
        }
        assert {key: rows[2][key] for key in expected} == {
            key: repr(float(value)) for key, value in expected.items()
        }


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["sweep", "-o", "sweep.txt"], "name a netCDF, CSV or XLSX file"),
        (["sweep", "-o", "no/sweep.nc"], "there is no directory no"),
        (["sweep/force=2N", "-o", "sweep.nc"], "no sweep there"),
        (["sweep", "-o", "sweep.csv", "--fields"], "a table has no fields"),
    ],
)
def test_collect_refuses(
    sweep: Path, words: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["collect", *words]) == 2
    assert reason in capsys.readouterr().err
    assert sorted(path.name for path in Path().iterdir()) == ["sweep"]


def test_command_with_varied_values_makes_a_sweep(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["example", "sphere-zener", "-o", "ball.yaml"]) == 0
    coarse = [word for text in ("grid.shape=[40, 40]", "time.steps=3") for word in ("--set", text)]
    vary = ["--vary", "load.force=2N,4N", "--vary", "material.delayed_modulus=5MPa,10MPa"]
    assert main(["run", "ball.yaml", *coarse, *vary, "-o", "all", "-q", "-j", "2"]) == 0
    ds = vc.open_many("all")
    assert ds.approach.dims == ("load.force", "material.delayed_modulus", "time")
    assert ds["material.delayed_modulus"].values.tolist() == [5e6, 1e7]
    # Hertz: the approach of a ball is proportional to the force to the power of 2/3.
    growth = (ds.approach[1] / ds.approach[0]).values
    np.testing.assert_allclose(growth, 2 ** (2 / 3), rtol=0.03)  # 40 cells
    assert (ds.approach[:, 0, -1] > ds.approach[:, 1, -1]).all()  # the softer spring


def test_sweep_stands_for_its_runs_in_a_comparison(
    sweep: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    compared: list[list[str]] = []

    def draw(runs: dict[str, xr.Dataset], **options: object) -> object:
        compared.append(list(runs))
        return Figure()

    monkeypatch.setitem(vc.plot.COMPARISONS, "history", draw)
    names = ["force=2N", "force=3N", "force=4N"]
    assert main(["compare", "sweep", "-o", "a.png"]) == 0
    assert (
        main(["compare", *(f"sweep/{name}" for name in ("runs.jsonl", *names)), "-o", "b.png"]) == 0
    )
    (Path(sweep) / "force=3N" / STATE_NAME).touch()
    assert main(["compare", "sweep", "-o", "c.png"]) == 0
    assert compared == [names, names, ["force=2N", "force=4N"]]
    left_out = capsys.readouterr().err
    assert left_out == (
        "sweep: 1 of 3 runs is not done and left out; `viscontact status sweep` shows their "
        "states\n"
    )
    assert main(["plot", "sweep", "response"]) == 0
    assert capsys.readouterr().err == left_out
    monkeypatch.setattr("viscontact.cli.results.compared_runs.MOST", 1)
    assert main(["compare", "sweep"]) == 2
    assert main(["compare", *(f"sweep/{name}" for name in names)]) == 2
    *_, of_sweep, of_runs = capsys.readouterr().err.splitlines()
    assert "2 runs are too many for a figure, which shows 1 at most" in of_sweep
    assert of_sweep.endswith("viscontact plot sweep response")
    assert "3 runs are too many for a figure" in of_runs


def test_report_and_response_of_a_sweep(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "sweep"]) == 0
    assert main(["plot", "sweep", "response"]) == 0
    assert lines(capsys) == ["sweep/report.html", "sweep/response.png"]
    page = Path("sweep/report.html").read_text(encoding="utf-8")
    [heading] = re.findall("<h1>(.*?)</h1>", page)
    assert heading.endswith("(sweep)")


@pytest.mark.parametrize("words", [["show"], ["export"], ["plot", "history"]])
def test_sweep_in_place_of_a_run_is_refused(
    sweep: Path, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([words[0], "sweep", *words[1:]]) == 2
    assert "is a sweep; name one of its runs" in capsys.readouterr().err


def test_response_of_a_single_run_is_refused(
    sweep: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", "sweep/force=2N", "response"]) == 2
    assert "response is a figure of a sweep" in capsys.readouterr().err
    assert main(["plot", "sweep", "response", "--time", "1 s"]) == 2
    assert "--time: does not apply" in capsys.readouterr().err


@pytest.mark.slow
def test_run_that_fails_is_listed_and_the_others_are_collected(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["example", "sphere-zener", "-o", "ball.yaml"]) == 0
    coarse = [word for text in ("grid.shape=[32, 32]", "time.steps=2") for word in ("--set", text)]
    command = ["run", "ball.yaml", *coarse, "--vary", "load.force=2N,400N,4N", "-o", "all", "-q"]
    command += ["-j", "1"]
    assert main(command) == 1
    capsys.readouterr()
    assert main(["status", "all"]) == 1
    counts, listed = lines(capsys)
    assert counts == "all: 3 runs: 2 done, 1 failed"
    assert listed.startswith("  failed  force=400N  ")
    assert "the contact reaches the edge of the grid" in listed
    ds = vc.open_many("all")
    assert ds.state.values.tolist() == ["done", "failed", "done"]
    assert "the contact reaches the edge of the grid" in ds.message.values[1]
    assert np.isnan(ds.approach).all("time").values.tolist() == [False, True, False]


@pytest.mark.slow
def test_surfaces_of_a_folder_are_texts_along_a_dimension(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = pytest.importorskip("SurfaceTopography", reason="no wheels of it on this system")
    monkeypatch.chdir(tmp_path)
    Path("scans").mkdir()
    x = np.linspace(-1e-3, 1e-3, 41)
    for name, radius in (("a", 8e-3), ("b", 4e-3)):
        heights = -(x[:, None] ** 2 + x**2) / (2 * radius)
        scan = program.Topography(heights, (2.05e-3, 2.05e-3), unit="m")  # 41 pixels of 0.05 mm
        scan.to_x3p(f"scans/{name}.x3p")
    Path("ball.yaml").write_text(SCANNED, encoding="utf-8")
    command = ["run", "ball.yaml", "--vary", "indenter.file=scans/*.x3p", "-o", "all", "-q"]
    assert main([*command, "-j", "1"]) == 0
    ds = vc.open_many("all")
    assert ds["indenter.file"].values.tolist() == ["scans/a.x3p", "scans/b.x3p"]
    # Hertz: the approach of a ball grows as its radius to the power of -1/3.
    growth = float(ds.approach[1, 0] / ds.approach[0, 0])
    assert growth == close_to(2 ** (1 / 3), rel=0.03)
