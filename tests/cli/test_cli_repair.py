"""Runs of a sweep that have failed, and are computed with other settings."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.cli import main
from viscontact.cli.sweep import single_task
from viscontact.cli.terminal.messages import INTERRUPTED, stop
from viscontact.results.run_files import MANIFEST_NAME, RESULT_NAME
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.sweep.manifest import read_manifest

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.2 N}
time: {end: 1 s, steps: 1}
grid: {shape: [24, 24], size: [5 mm, 5 mm]}
output: {errors: false, fields: none}
"""
LARGER = ["--set", "grid.size=[10 mm, 10 mm]"]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "ball.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def sweep(*words: str) -> int:
    return main(["run", "ball.yaml", "-o", "out", "-q", *words])


def tasks(design: list[str], *codes: int) -> None:
    """Compute the runs of a design one by one, in this process, which end with some codes."""
    Path("a.sbatch").unlink(missing_ok=True)
    assert sweep(*design, "--array", "a.sbatch") == 0
    for number, code in enumerate(codes):
        assert main(["run", "-q", "--task", f"{number}", "out"]) == code


def written() -> list[int]:
    return [path.stat().st_mtime_ns for path in sorted(Path("out").rglob(RESULT_NAME))]


def test_a_setting_of_one_task_repairs_its_run_alone(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Hertz (1882): the approach of a sphere grows with F**(2/3)."""
    vary = ["--vary", "load.force=0.2 N,9 N,0.4 N"]
    task = ["run", "-q", "--task", "1", "out/runs.jsonl"]
    assert sweep(*vary) == 1  # the second contact reaches the border
    said = capsys.readouterr().err.splitlines()
    path = Path("out") / MANIFEST_NAME
    change = f"viscontact run --task 1 {path} --set KEY=VALUE"
    again = "repeat the command with another value and --resume"
    correct = f"to correct the load.force of ball_force=9N: {again}"
    assert said[-3:] == [
        "1 of 3 runs failed: ball_force=9N",
        correct,
        f"to change only ball_force=9N: {change}",
    ]
    done = written()
    assert sweep(*vary, *LARGER, "--resume") == 2
    first, *others = capsys.readouterr().err.splitlines()
    assert "ball_force=0.2N has results with the grid.size of its case, not [10 mm, 10 mm]" in first
    assert others == [correct, f"to change only ball_force=9N: {change}"]
    kept = path.read_bytes()
    assert main([*task, "--set", "grid.sizes=[10 mm, 10 mm]"]) == 2
    assert main([*task, "--set", "load.force=1 N"]) == 2
    assert "--set load.force: differs between the runs of this sweep" in capsys.readouterr().err
    assert path.read_bytes() == kept
    assert main([*task, *LARGER]) == 0
    assert sweep(*vary, "--resume") == 0
    assert written()[:-1] == done
    run = list(read_manifest(path))[1]
    assert (run.settings["grid.size"], run.changed) == ("[10 mm, 10 mm]", ("grid.size",))
    ds = vc.open_many("out")
    assert float(ds.approach[1, -1] / ds.approach[0, -1]) == close_to(45 ** (2 / 3), rel=0.03)


def test_results_are_not_replaced_by_those_of_other_settings(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tasks(["--vary", "load.force=0.2 N,0.4 N"], 0, 0)
    kept, task = Path("out/runs.jsonl").read_bytes(), ["run", "-q", "--task", "0", "out"]
    assert main([*task, *LARGER]) == 2
    assert "has results with other settings; replace them with --over" in capsys.readouterr().err
    assert main([*task, "--set", "load=5 N"]) == 2
    assert Path("out/runs.jsonl").read_bytes() == kept
    assert "changed" not in vc.open_many("out")
    assert main(["collect", "out", "-o", "a.csv", "-q"]) == main(["status", "out"]) == 0
    assert "own" not in capsys.readouterr().out
    assert ",changed," not in Path("a.csv").read_text(encoding="utf-8")
    assert main([*task, *LARGER, "--overwrite"]) == 0
    assert main([*task, "--set", "grid.size=[1 cm, 1cm]"]) == 0  # the same lengths
    assert vc.open_results("out/ball_force=0.2N").sizes["time"] == 2


def test_runs_with_settings_of_their_own_are_marked(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tasks(["--vary", "load.force=0.2 N,0.4 N"], 0)
    assert main(["run", "-q", "--task", "1", "out", "--set", "material.shear_modulus=2 MPa"]) == 0
    own = "material.shear_modulus=2 MPa"
    assert vc.open_many("out").changed.values.tolist() == ["", own]
    assert main(["collect", "out", "-o", "a.csv", "-q"]) == 0
    head, *rows = csv.reader(Path("a.csv").read_text(encoding="utf-8").splitlines())
    assert [row[head.index("changed")] for row in rows] == ["", own]
    assert main(["collect", "out", "-o", "a.nc", "-q"]) == main(["status", "out"]) == 0
    assert capsys.readouterr().out.splitlines()[-2:] == [
        "1 run has settings of its own:",
        f"  force=0.4N  {own}",
    ]
    with xr.open_dataset("a.nc") as ds:
        assert ds.changed.values.tolist() == ["", own]
    assert main(["plot", "out", "response", "-o", "a.png"]) == 0
    assert "out: 1 run has settings of its own; `viscontact status" in capsys.readouterr().err
    assert main(["report", "out"]) == 0
    assert f"force=0.4N: with its own {own}" in Path("out/report.html").read_text(encoding="utf-8")


def test_advice_to_add_runs_is_given_where_it_works(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "disc.yaml").write_text(CASE.replace("10 mm", "9 mm"), encoding="utf-8")
    tasks(["--vary", "load.force=0.2 N,0.4 N"], 0)
    other = ["--vary", "load.force=0.3 N"]
    capsys.readouterr()
    assert sweep(*other) == 2
    assert "or add runs to it: with --resume, and all values of both" in capsys.readouterr().err
    assert main(["run", "disc.yaml", "-o", "out", *other]) == 2
    assert sweep("--vary", "grid.tolerance=1 %") == sweep(*LARGER, *other) == 2
    said = capsys.readouterr().err
    assert "holds another sweep" in said
    assert "add runs" not in said


def test_an_interrupted_task_is_continued_by_its_number(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    tasks(["--vary", "load.force=0.2 N,0.4 N"], 0)

    def interrupted(request: RunRequest) -> None:
        stop("interrupted", f"continue with: {request.resuming}", code=INTERRUPTED)

    monkeypatch.setattr(single_task, "execute", interrupted)
    task = ["run", "--task", "1", "out/runs.jsonl"]
    for options in ([], ["--threads", "2", "--quiet", "--resume"]):
        capsys.readouterr()
        assert main([*task, *options]) == INTERRUPTED
        words = " ".join(["viscontact run --task 1", str(Path("out/runs.jsonl")), *options])
        assert capsys.readouterr().err.splitlines()[-1] == f"continue with: {words}"


def test_a_row_of_a_table_is_corrected_in_the_table(folder: Path) -> None:
    plan = Path("plan.csv")
    plan.write_text("load.force [N]\n0.2\n9\n", encoding="utf-8")
    tasks(["--table", "plan.csv"], 0, 1)
    done = written()
    plan.write_text("load.force [N]\n0.2\n0.4\n", encoding="utf-8")
    tasks(["--table", "plan.csv", "--resume"], 0, 0)
    assert written()[:1] == done
    assert vc.open_many("out")["load.force"].values.tolist() == [0.2, 0.4]


def test_a_grid_for_a_single_run_replaces_the_common_cells(folder: Path) -> None:
    case = "\n".join(line for line in CASE.splitlines() if not line.startswith("grid"))
    (folder / "ball.yaml").write_text(case, encoding="utf-8")
    vary = ["--vary", "load.force=0.2 N,0.4 N"]
    tasks(vary, 0)
    grid = ["--set", "grid.shape=[24, 24]", "--set", "grid.size=[5 mm, 5 mm]"]
    assert main(["run", "-q", "--task", "1", "out", *grid]) == 0
    first, second = read_manifest(Path("out/runs.jsonl"))
    assert "grid.largest_cell" in first.settings
    assert "grid.largest_cell" not in second.settings
    tasks([*vary, "--resume"])
    assert list(read_manifest(Path("out/runs.jsonl"))) == [first, second]
