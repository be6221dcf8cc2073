"""`run` with `--zip`, `--table`, `--sample` and wildcards: what runs, and what is refused."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.cli import main
from viscontact.cli.sweep import checks
from viscontact.cli.sweep.plan_options import PlanOptions
from viscontact.cli.sweep.request import ManyRequest
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.runs.processes.job import RunStage
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.sweep.manifest import SweepRun, read_manifest

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [24, 24], size: [5 mm, 5 mm]}
output: {errors: false, fields: none}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "ball.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def idle(monkeypatch: pytest.MonkeyPatch) -> None:
    """No run is started."""

    monkeypatch.setattr("viscontact.cli.sweep.execution.drive", lambda *_: [])


def manifest(directory: str = "out") -> list[SweepRun]:
    return list(read_manifest(Path(directory) / MANIFEST_NAME))


def sweep(*words: str) -> int:
    return main(["run", "ball.yaml", "-o", "out", "-q", *words])


def test_a_table_of_runs_gives_the_results_of_its_rows(folder: Path) -> None:
    """Hertz (1882): the approach of a sphere grows with F**(2/3) and (1/G)**(2/3)."""
    plan = "load.force [mN];material.shear_modulus\n500;1 MPa\n500;8 MPa\n"
    (folder / "plan.csv").write_text(plan, encoding="utf-8")
    assert sweep("--table", "plan.csv") == 0
    assert sorted(path.name for path in Path("out").iterdir()) == [
        "ball_0000",
        "ball_0001",
        MANIFEST_NAME,
    ]
    soft, stiff = (float(vc.open_results(f"out/ball_000{n}").approach[-1]) for n in (0, 1))
    assert soft / stiff == close_to(4.0, rel=0.05)  # few cells across the smaller contact
    first = manifest()[0]
    assert (first.name, first.design) == ("0000", "table")
    assert dict(first.settings) == {"load.force": "500 mN", "material.shear_modulus": "1 MPa"}


@pytest.mark.usefixtures("idle")
def test_zip_pairs_the_values(folder: Path) -> None:
    assert sweep("--vary", "load.force=1N,2N", "--vary", "time.end=1 s,2 s", "--zip") == 130
    assert [each.directory for each in manifest()] == [
        "ball_force=1N_end=1s",
        "ball_force=2N_end=2s",
    ]
    assert {each.design for each in manifest()} == {"zip"}


@pytest.mark.usefixtures("idle")
def test_a_larger_sample_extends_the_smaller_one(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--range", "load.force=0.5 N:2 N:log", "--range", "time.end=1 s:5 s", "--seed", "3"]
    assert sweep("--sample", "3", *words) == 130
    few = manifest()
    Path("out/ball_0001").mkdir()
    Path("out/ball_0001/state.npz").touch()  # has begun
    assert sweep("--sample", "5", *words, "--resume") == 130
    assert manifest()[:3] == few
    assert [each.directory for each in manifest()] == [f"ball_000{n}" for n in range(5)]
    capsys.readouterr()
    assert sweep("--sample", "5", *words[:-1], "4", "--resume") == 2
    assert "repeat the command that began it with its --range, --seed and --method" in (
        capsys.readouterr().err
    )


def test_the_printed_command_names_all_options() -> None:
    options = PlanOptions((), False, None, 8, ("load.force=1 N:2 N",), 4, "latin-hypercube")
    request = ManyRequest((Path("a.yaml"),), RunRequest(Path("a.yaml"), Path("o")), options)
    assert request.resuming.replace('"', "'") == (
        "viscontact run a.yaml -o o --sample 8 --range 'load.force=1 N:2 N' --seed 4 --method "
        "latin-hypercube --resume"
    )
    options = PlanOptions(("a=1,2", "b=3,4"), zipped=True)
    request = ManyRequest((Path("a.yaml"),), RunRequest(Path("a.yaml")), options)
    assert request.resuming.endswith("--vary a=1,2 --vary b=3,4 --zip --resume")
    options = PlanOptions(table=Path("-p.csv"))
    request = ManyRequest((Path("a.yaml"),), RunRequest(Path("a.yaml")), options)
    assert request.resuming.endswith(f"--table .{os.sep}-p.csv --resume")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--table", "plan.csv", "--vary", "a=1,2"], "--vary and --table: give one of them"),
        (["--sample", "4", "--table", "plan.csv"], "--table and --sample: give one of them"),
        (["--zip"], "--zip pairs the values of two --vary or more"),
        (["--zip", "--vary", "load.force=1N,2N"], "--zip pairs the values of two --vary"),
        (["--vary", "a=1,2", "--vary", "b=1", "--zip"], "--zip: pairs need equal numbers"),
        (["--vary", "load.force=1N,2N,1000 mN"], "--vary load.force=1N and load.force=1000 mN are"),
        (
            ["--vary", "load.force=1N,1 N", "--vary", "time.end=1 s,1000 ms", "--zip"],
            "--vary load.force=1N, time.end=1 s and load.force=1 N, time.end=1000 ms are equal",
        ),
        (["--scheduler", ""], "--scheduler: is empty; give the address or the file"),
        (["--sample", "4"], "--sample 4: name a range"),
        (["--range", "a=1:2"], "--range: goes with --sample N"),
        (["--vary", "load.force=1N,2N", "--seed", "0"], "--seed: goes with --sample N"),
        (["--method", "sobol"], "--method: goes with --sample N"),
        (["--sample", "4", "--range", "a=2:1"], "--range a=2:1: the lower bound comes first"),
        (
            ["--sample", "4", "--range", "a=1:2", "--range", "a=1:3"],
            "--range a: is given twice; name one range",
        ),
        (
            ["--sample", "4", "--range", "load.force=1 N:2 N", "--set", "load.force=1 N"],
            "--range load.force: is given twice, also by --set",
        ),
        (
            ["--table", "plan.csv", "--set", "load.force=1 N"],
            "plan.csv: load.force: is given twice",
        ),
        (["--table", "none.csv"], "--table: no such file none.csv"),
        (["--table", "none.xlsx#Runs"], "--table: no such file none.xlsx"),
        (["--vary", "indenter.file=*.x3p"], "--vary indenter.file=*.x3p: no file of that name in"),
        (["--table", "plan.csv"], "cannot read '2 mm' as a force"),
        (["--table", "plan.csv"], "plan.csv:3: column 'load.force': cannot read '2 mm'"),
        (["--table", "empty.csv"], "--table: empty.csv is empty; a table begins with e.g. 'load.f"),
        (["--table", "short.csv"], "short.csv:3: has 1 cell, the header 2; add a value of 'b'"),
        (["--table", "many.csv"], "many.csv:2: column 'load.force': 1 has no unit"),
        (["--table", "many.csv"], "[and in lines 3, 4, 5, 6, 7 and 1 more]"),
        (
            ["--table", "few.csv"],
            "few.csv:2: column 'load.force': 1 has no unit; a force is expect",
        ),
        (["--table", "few.csv"], "[and in line 4]"),
        (
            ["--sample", "200", "--range", "load.force=1 mm:2 mm"],
            "--range load.force: cannot read '",
        ),
        (
            ["--sample", "4", "--range", "load.force=1:4"],
            "--range load.force: 1 has no unit; a force is expected",
        ),
        (
            ["--sample", "16", "--range", "material.poisson_ratio=0.4:0.6"],
            " and 3 more]",
        ),
        (["--sample", "20", "--range", "time.steps=1:9"], "--range time.steps: "),
        (["--sample", "20", "--range", "load.forc=1 N:9 N"], "did you mean 'force'"),
    ],
)
def test_what_cannot_be_designed_is_refused_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    for name, text in {
        "plan": "load.force\n1 N\n2 mm\n",
        "empty": "",
        "short": "load.force [N],b\n1,2\n3\n",
        "many": "load.force\n1\n1\n1\n1\n1\n1\n1\n2 N\n",
        "few": "load.force\n1\n2 N\n1\n",
    }.items():
        Path(f"{name}.csv").write_text(text, encoding="utf-8")
    assert sweep(*words) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said.replace("20 kN", "10 kN") in line
    assert not Path("out").exists()


@pytest.mark.parametrize(
    ("heading", "why"),
    [
        ("load.force [mm]", "cannot read '2 mm' as a force (got a length); write e.g. '10 kN'"),
        ("load.force", "2 has no unit; a force is expected; write e.g. '10 kN'"),
        ("time.steps [s]", "must be a whole number, got '2 s'"),
    ],
)
def test_unit_of_a_heading_is_refused_once_with_the_column(
    folder: Path, capsys: pytest.CaptureFixture[str], heading: str, why: str
) -> None:
    Path("plan.csv").write_text(f"{heading}\n2\n3.50\n-4e1\n", encoding="utf-8")
    assert sweep("--table", "plan.csv") == 2
    assert capsys.readouterr().err == f"plan.csv: column {heading!r}: {why}\n"


def test_tables_and_samples_need_a_directory(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", "ball.yaml", "--sample", "4", "--range", "load.force=1 N:2 N"]) == 2
    assert "--sample: name a directory for the runs, with -o DIR" in capsys.readouterr().err


@pytest.mark.usefixtures("idle")
def test_wildcards_in_names_of_files_are_the_files_next_to_the_case(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "maps").mkdir()
    heights = np.zeros((8, 8))
    heights[4, 4] = 1e-4
    for name in ("b.npy", "a.npy", "1e3.npy"):
        np.save(folder / "maps" / name, heights)
    (folder / "maps" / "other.txt").touch()
    shape = "{shape: height-map, file: a.npy, height_unit: m, spacing: 0.2 mm}"
    text = CASE.replace("{shape: sphere, radius: 10 mm}", shape)
    (folder / "map.yaml").write_text(text, encoding="utf-8")
    (folder / "elsewhere").mkdir()
    monkeypatch.chdir(folder / "elsewhere")
    words = ["run", "../map.yaml", "-o", "out", "-q", "--vary"]
    assert main([*words, "indenter.file=maps/*.npy"]) == 130
    files = [each.settings["indenter.file"] for each in manifest()]
    assert files == ["maps/1e3.npy", "maps/a.npy", "maps/b.npy"]
    assert manifest()[0].directory == "map_file=maps-1e3.npy"


def test_names_that_are_other_values_of_yaml_are_quoted(folder: Path) -> None:
    for name in ("1e3", "a #1", "b"):
        (folder / name).touch()
    design = PlanOptions(("load.file=[1ab]*",)).design(Path("ball.yaml"))
    assert [row[0] for row in design.rows] == ['"1e3"', '"a #1"', "b", "ball.yaml"]
    (folder / "[1]").touch()
    assert PlanOptions(("load.file=[1]",)).design(Path("ball.yaml")).rows == (('"[1]"',),)


@pytest.mark.usefixtures("idle")
def test_beyond_a_number_of_runs_only_some_are_checked(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(checks, "MOST_READ", 150)
    monkeypatch.setattr("viscontact.cli.sweep.jobs.MOST_READ", 150)
    values = [f"{n} mN" for n in range(1, 161)]
    words = ["run", "ball.yaml", "-o", "out", "--vary"]
    assert main([*words, f"load.force={','.join(values[:-1])},5 MPa"]) == 2  # the last one
    assert "--vary load.force: cannot read '5 MPa' as a force" in capsys.readouterr().err
    assert not Path("out").exists()
    values[80] = "5 MPa"
    assert main([*words, f"load.force={','.join(values[:120])}"]) == 2  # all are read
    assert main([*words, f"load.force={','.join(values)}"]) == 130
    assert "of 160 runs, only some are checked now" in capsys.readouterr().err
    assert len(manifest()) == 160


def test_runs_that_are_not_prepared_are_resumed_by_their_files(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "auto.yaml").write_text(CASE.replace("grid:", "title: x #"), encoding="utf-8")
    text = ",".join(f"{n} mN" for n in range(1, 103))
    common = RunRequest(Path("auto.yaml"), Path("out"), resume=True)
    request = ManyRequest((Path("auto.yaml"),), common, PlanOptions((f"load.force={text}",)))
    planned = request.planned()
    runs = [each.request for each in planned]
    assert main(["run", "auto.yaml", "--set", "load.force=5 mN", "-o", "out/auto_force=5mN"]) == 0
    begun = Path("out/auto_force=7mN")
    shutil.copytree("out/auto_force=5mN", begun)
    text = (begun / "case.yaml").read_text(encoding="utf-8")
    (begun / "case.yaml").write_text(text.replace("5 mN", "7 mN"), encoding="utf-8")
    (begun / "state.npz").touch()
    for most in (1000, 100):
        monkeypatch.setattr(checks, "MOST_READ", most)
        jobs = checks.checked_jobs(request, planned, runs)
        standings = {job.name: job.standing for job in jobs}
        assert standings.pop("auto_force=5mN") is RunStage.FINISHED
        assert standings.pop("auto_force=7mN") is RunStage.STOPPED
        assert set(standings.values()) == {RunStage.NEW}
        assert {job.instants for job in jobs} == {2}
