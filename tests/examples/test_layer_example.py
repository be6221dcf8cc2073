"""The shipped rubber-covered roll: run as a user does, against an elastic layer's contact."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main

COARSE = ["--set", "time.tolerance=0.05", "--set", "grid.tolerance=6 %"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("covered roll")
    case = folder / "roll.yaml"
    assert main(["example", "rubber-covered-roll", "-o", str(case)]) == 0
    assert main(["run", str(case), "--quiet", *COARSE, "--set", "output.errors=false"]) == 0
    return folder


@pytest.mark.slow
def test_cover_that_was_only_pressed_approaches_as_an_elastic_one(folder: Path) -> None:
    """While the contact grows, the relation of force and approach is an elastic layer's.

    The bulk modulus is 400 times the shear modulus and the core 10^4 times stiffer, so that one
    creep function is left, and Lee & Radok (1960) holds: the shear compliance is the mean of the
    law's over the lags, from the end of the hold to its beginning.
    """
    case = read_case(folder / "roll.yaml")
    rubber = case.material.layers[0].material
    lags = np.linspace(5.0, 5.1, 201)
    shear = 1 / (2 * np.trapezoid(rubber.law(lags), lags) / 0.1)
    relaxed = vc.Material(vc.Elastic(shear), bulk_modulus=rubber.bulk_modulus)
    cover = vc.Layered([vc.Layer(8e-3, relaxed)], base=case.material.base)
    with vc.open_results(folder / "roll") as ds:
        grid = vc.Grid((ds.x.size, ds.y.size), tuple(
            float(axis[1] - axis[0]) * axis.size for axis in (ds.x, ds.y)))  # fmt: skip
        elastic = vc.simulate(
            case.indenter, cover, vc.step(300.0), grid, [0.0], fields="none", errors=False
        )
        held = ds.approach.interp(time=5.1)
        # Not the steps, but Poisson's ratio, 0.4976 at once and 0.4994 at the end.
        assert float(held) == close_to(float(elastic.approach[0]), rel=2e-3)
        pressed = float(ds.pressure.sel(time=5.1, method="nearest").sum()) * grid.cell_area
        assert pressed == close_to(300.0, rel=1e-5)
        # The dent recovers at a fifth of the force, and is deeper than at that force at first.
        assert (np.diff(ds.approach.sel(time=slice(5.2, None))) < 0).all()


@pytest.mark.slow
def test_covered_roll_is_shown_drawn_and_reported(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    directory = str(folder / "roll")
    assert main(["show", directory]) == 0
    assert "error of the layers' creep by its separation: below 0.01 %" in (capsys.readouterr().out)
    for figure in ("creep", "pressure-map", "stress-section"):
        assert main(["plot", directory, figure]) == 0
    assert main(["export", directory, "-o", str(folder / "roll.csv")]) == 0
    assert main(["report", directory]) == 0
    page = (folder / "roll" / "report.html").read_text(encoding="utf-8")
    for text in ("layer 1 thickness", "8 mm relaxation series", "base: elastic", "bonded"):
        assert text in page
    assert "short sum of products of a creep function and an elastic response" in page
    assert "Not drawn" not in page


@pytest.mark.slow  # each run is a process
def test_sweep_over_the_thickness_of_a_cover(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A thinner cover is stiffer: it lies on steel."""
    varied = ["--vary", "material.layers[1].thickness=2mm,8mm"]
    short = ["--set", "load={kind: step, force: 300 N}"]
    short += ["--set", "time={end: 1 s, steps: 1}", "--set", "output={fields: none, errors: false}"]
    command = ["run", str(folder / "roll.yaml"), "-q", *varied, *short]
    assert main([*command, "-o", str(folder / "sweep")]) == 0
    ds = vc.open_many(folder / "sweep")
    thin, thick = ds.approach.isel(time=-1).values
    assert 0 < thin < 0.7 * thick
    assert ds["material.layers[1].thickness"].values.tolist() == [2e-3, 8e-3]
