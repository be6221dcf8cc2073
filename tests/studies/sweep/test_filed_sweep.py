"""Title block, dates, input files and allowable values of a sweep, and its report."""

from __future__ import annotations

import hashlib
import json
import shutil
from pathlib import Path

import pytest

import viscontact as vc
from viscontact.cli import main
from viscontact.studies.sweep.filed_sweep import filed_attributes

CASE = """title: Ball on a bench
report: {project: P-7, revision: A}
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 GPa, poisson_ratio: 0.4}
load: {kind: step, force: 5 N}
time: {end: 1 s, steps: 1}
grid: {shape: [32, 32], size: [1.2 mm, 1.2 mm]}
allowable: {peak_pressure: 30 MPa, approach: 1 mm}
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory with two runs that differ in the revision, and in one of the limits."""
    folder = tmp_path_factory.mktemp("filed")
    (folder / "ball.yaml").write_text(CASE, encoding="utf-8")
    values = ["--vary", "report.revision=A,B", "--vary", "allowable.approach=1 mm,1 um", "--zip"]
    assert main(["run", str(folder / "ball.yaml"), *values, "-o", str(folder / "sweep")]) == 0
    return folder


@pytest.fixture
def sweep(made: Path, tmp_path: Path) -> Path:
    """A copy of the sweep."""
    return Path(shutil.copytree(made / "sweep", tmp_path / "sweep"))


def runs(sweep: Path) -> list[Path]:
    """Directories of the runs."""
    return sorted(path for path in sweep.iterdir() if path.is_dir())


def test_only_what_all_runs_share_is_stated(made: Path, sweep: Path) -> None:
    found = filed_attributes(sweep)
    assert found["title"] == "Ball on a bench"
    assert "title_block" not in found  # the revisions differ
    assert json.loads(found["allowable"]) == {"peak_pressure": {"limit": 30e6}}
    starts = [vc.open_results(run).attrs["started"] for run in runs(sweep)]
    assert found["started"] == min(starts)
    # The case file once, and not the case of each run with its settings.
    digest = hashlib.sha256((made / "ball.yaml").read_bytes()).hexdigest()
    [file] = json.loads(found["input_files"])
    assert (file["name"], file["role"], file["sha256"]) == ("ball.yaml", "case file", digest)


def test_runs_without_a_result_are_left_out(sweep: Path) -> None:
    first, second = runs(sweep)
    shutil.rmtree(first)
    assert json.loads(filed_attributes(sweep)["title_block"])["revision"] == "B"
    (second / "result.nc").write_bytes(b"damaged")
    assert filed_attributes(sweep) == {}


def test_report_has_heading_limits_and_files(sweep: Path) -> None:
    shutil.rmtree(runs(sweep)[0])
    assert main(["report", str(sweep)]) == 0
    page = (sweep / "report.html").read_text(encoding="utf-8")
    assert "<h1>Ball on a bench (sweep)</h1>" in page
    for name, value in {"Project": "P-7", "Revision": "B"}.items():
        assert f"<dt>{name}</dt><dd>{value}</dd>" in page
    assert "<dt>First run started</dt>" in page
    assert "<dt>waiting</dt><dd>1</dd>" in page
    assert "Allowable: Peak pressure 30 MPa; Approach 1 µm. The verdict of a run" in page
    # 30 MPa and 1 µm are both exceeded.
    failed = "failed: peak pressure, approach"
    assert page.count(f'<td class="failed" data-head="verdict">{failed}</td>') == 1
    assert page.count("<code>") == 2  # `viscontact collect` and one digest


def test_report_of_a_sweep_without_any_result(
    sweep: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for run in runs(sweep):
        shutil.rmtree(run)
    assert main(["report", str(sweep)]) == 0
    assert "<h1>sweep</h1>" in (sweep / "report.html").read_text(encoding="utf-8")


def test_comparison_names_the_only_run(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first, second = runs(sweep)
    shutil.rmtree(first)
    assert main(["compare", str(sweep)]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert f"compare needs two runs or more, got {second} alone; `viscontact plot DIR`" in said
    shutil.rmtree(second)
    assert main(["compare", str(sweep)]) == 2
    assert "got none with a result" in " ".join(capsys.readouterr().err.split())
