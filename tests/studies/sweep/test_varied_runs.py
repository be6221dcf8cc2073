"""`vary`: the runs of the command line, from Python."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import CaseError
from viscontact.cli import main
from viscontact.studies.sweep.manifest import SweepRun, read_manifest
from viscontact.studies.sweep.varied_runs import VariedRun, case_name, sweep_run

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 1 s, steps: 1}
output: {errors: false}
"""
SAMPLE = {"design": "sample", "runs": 4}
FORCES = {"load.force": ["0.2 N", "0.4 N"]}


@pytest.fixture
def case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(CASE, encoding="utf-8")
    return Path("ball.yaml")


def lines(runs: list[VariedRun]) -> list[SweepRun]:
    place = Path("out").resolve()
    return [sweep_run(n, run, case_name(run.case, place)) for n, run in enumerate(runs)]


def test_runs_are_those_of_the_command_line(case: Path) -> None:
    runs = vc.vary(case, FORCES, settings={"material.poisson_ratio": 0.4, "grid.tolerance": 0.05})
    assert pickle.loads(pickle.dumps(runs)) == runs
    words = ["--vary", "load.force=0.2 N,0.4 N", "--set", "material.poisson_ratio=0.4"]
    words += ["--set", "grid.tolerance=0.05"]
    assert main(["run", "ball.yaml", "-o", "out", "-q", *words]) == 0
    ours, theirs = lines(runs), list(read_manifest(Path("out/runs.jsonl")))
    assert ours == theirs
    assert "grid.largest_cell" in ours[0].settings  # automatic grids of one size of cells
    for run, line in zip(runs, theirs, strict=True):
        with vc.open_results(f"out/{line.directory}") as ds:
            for name in ("approach", "peak_pressure", "x", "time"):
                np.testing.assert_array_equal(run()[name], ds[name], strict=True)


@pytest.mark.slow
def test_many_are_simulated_in_order(case: Path) -> None:
    """Hertz (1882): the approach grows with F**(2/3)."""
    one, two = vc.simulate_many(vc.vary("ball.yaml", FORCES), workers=2)
    assert float(two.approach[-1] / one.approach[-1]) == close_to(2 ** (2 / 3), rel=2e-3)


@pytest.mark.parametrize("kind", ["zip", "sample", "table"])
def test_other_designs_are_those_of_the_command_line(case: Path, kind: str) -> None:
    settings = {"grid.shape": [16, 16], "grid.size": ["4 mm", "4 mm"]}
    ends = {"time.end": ["1 s", "2 s"]}
    if kind == "zip":
        runs = vc.vary(case, FORCES | ends, design="zip", settings=settings)
        words = ["--vary", "load.force=0.2 N,0.4 N", "--vary", "time.end=1 s,2 s", "--zip"]
    elif kind == "sample":
        ranges = {"load.force": ("0.2 N", "0.4 N", "log")}
        runs = vc.vary(case, ranges, design="sample", runs=3, seed=2, settings=settings)
        words = ["--range", "load.force=0.2 N:0.4 N:log", "--sample", "3", "--seed", "2"]
    else:
        Path("plan.csv").write_text("load.force [N]\n0.2\n0.4\n", encoding="utf-8")
        runs = vc.vary(case, "plan.csv", settings=settings)
        words = ["--table", "plan.csv"]
    fixed = ["--set", "grid.shape=[16, 16]", "--set", 'grid.size=["4 mm", "4 mm"]']
    script = ["-o", "out", "--array", "a.sbatch", "-q"]
    assert main(["run", "ball.yaml", *words, *fixed, *script]) == 0
    assert lines(runs) == list(read_manifest(Path("out/runs.jsonl")))


def test_a_faulty_value_of_a_table_is_named_by_its_line(case: Path) -> None:
    Path("plan.csv").write_text("load.force\n1 N\n2 mm\n", encoding="utf-8")
    with pytest.raises(CaseError, match=r"^plan.csv:3: load.force: cannot read '2 mm' as a force"):
        vc.vary(case, "plan.csv")


def test_values_may_be_numbers_lists_and_paths(case: Path, tmp_path: Path) -> None:
    heights = np.zeros((24, 24))
    heights[12, 12] = 1e-6
    np.save("1e3.npy", heights)
    text = CASE.replace("{shape: sphere, radius: 10 mm}", "{shape: height-map, height_unit: m}")
    case.write_text(text, encoding="utf-8")
    values = {
        "material.poisson_ratio": np.array([0.3]),
        "indenter.spacing": [["1 mm", "1 mm"]],
        "indenter.file": [Path("1e3.npy")],
        "time.steps": [np.int64(2)],
        "grid": ["{shape: [8, 8], size: [8 mm, 8 mm]}"],
    }
    (run,) = vc.vary(case, values)
    assert run.settings["material.poisson_ratio"] == "0.3"
    assert run.settings["time.steps"] == "2"
    assert (
        str(tmp_path.resolve() / "1e3.npy").replace("\\", "\\\\") in run.settings["indenter.file"]
    )


@pytest.mark.parametrize(
    ("values", "options", "said"),
    [
        ({"load.force": "5 N"}, {}, "a list of values, as ['5 kN', '10 kN'], got '5 N'"),
        ({"load.force": []}, {}, "values: load.force: must be a list of values"),
        ({}, {}, "values: name a key"),
        (FORCES, {"design": "random"}, "design: must be 'grid', 'zip' or 'sample'"),
        (FORCES, {"design": "sample"}, "runs: must be the number of runs of the sample"),
        ({"load.force": ["5 N", "6 MPa"]}, {}, "load.force: cannot read '6 MPa' as a force"),
        ({"load.forc": ["5 N"]}, {}, "did you mean 'force'"),
        (FORCES | {"time.end": ["1 s"]}, {"design": "zip"}, "pairs need equal numbers"),
        (FORCES | {"time.end": ["1 s"]}, {"design": "zip"}, "leave design='zip' out"),
        ({"load.force": "1 N"}, SAMPLE, "values: load.force: must be two bounds, as ('9 kN'"),
        (
            {"load.force": ("1 N",)},
            SAMPLE,
            "must be two bounds, as ('9 kN', '11 kN'), and",
        ),
        ({"load.force": ("1 N", "2 N", "lin")}, SAMPLE, "'log' for a logarithmic scale, got ('1"),
        ({"load.force": 5}, SAMPLE, "must be two bounds, as ('9 kN', '11 kN'), and"),
        ({"load.force": ("2 N", "1 N")}, SAMPLE, "values: load.force: the lower bound comes first"),
        (FORCES, SAMPLE | {"runs": 2.5}, "runs must be a whole number from 1 to 1000000, got 2.5"),
        (FORCES, SAMPLE | {"seed": "a"}, "seed must be a whole number"),
        (FORCES, SAMPLE | {"method": "lhs"}, "method: must be 'sobol' or 'latin-hypercube', got"),
        (FORCES, {"runs": 4}, "runs: goes with design='sample'"),
        (FORCES, {"settings": {"load.force": "1 N"}}, "settings: load.force: is varied, too"),
        (["load.force"], {}, "values: name a key"),
    ],
)
def test_faulty_arguments_are_named(
    case: Path, values: Any, options: dict[str, Any], said: str
) -> None:
    with pytest.raises(ValueError, match=r".+") as caught:
        vc.vary(case, values, **options)
    assert said in str(caught.value)
    assert "--set" not in str(caught.value)
    assert isinstance(caught.value, CaseError) is ("MPa" in said or "mean" in said)
