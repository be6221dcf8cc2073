"""Designs of layered bodies, and ranges that leave the theory or the grid."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.studies.design.test_arguments import BALL

import viscontact as vc
from viscontact.studies.infeasible import InfeasibleError

COVERED = BALL.replace(
    "{law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}",
    "{layers: [{thickness: 1 mm, law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.45}], "
    "base: rigid}",
).replace("size: [2.4 mm, 2.4 mm]", "size: [3 mm, 3 mm]")


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    path = tmp_path / "ball.yaml"
    path.write_text(BALL)
    return path


@pytest.mark.slow
def test_the_best_cover_of_a_rigid_base_is_the_thickest(tmp_path: Path) -> None:
    path = tmp_path / "cover.yaml"
    path.write_text(COVERED)
    key = "material.layers[1].thickness"
    found = vc.design(path, {key: ("0.5 mm", "4 mm", "log")}, minimise="peak_pressure", runs=20)
    assert any(f"lies at the upper bound of {key}" in note for note in found.notes)
    # A thick cover is a half-space, E* = 2 G / (1 - nu), and p0 = (6 F E*^2 / (pi^3 R^2))^(1/3)
    # (Hertz), to 3 % on ten cells across the contact; a rigid base below makes it stiffer.
    modulus = 2e6 / 0.55
    hertz = (6 * 0.1 * modulus**2 / (math.pi**3 * 5e-3**2)) ** (1 / 3)
    assert 0.97 < float(found.best.peak_pressure) / hertz < 1.1
    thinnest = found.table.isel(trial=int(np.nanargmin(found.table[key].values)))  # 0.7 mm or less
    assert float(thinnest.peak_pressure) > 1.05 * float(found.best.peak_pressure)


def test_a_range_that_leaves_the_theory_is_noted(ball: Path) -> None:
    change = {"indenter.radius": ("0.3 mm", "0.5 mm")}
    found = vc.design(ball, change, minimise="contact_area", runs=6, workers=1)
    # Hertz: a^3 = 3 F R / (4 E*), so that a / R is 0.42 to 0.59.
    assert any("half-space theory is meant for less than 0.3" in note for note in found.notes)


def test_a_range_in_which_every_run_fails_is_refused_with_the_reason(ball: Path) -> None:
    with pytest.raises(InfeasibleError) as refusal:
        vc.design(ball, {"load.force": ("10 N", "40 N")}, minimise="approach", runs=5, workers=1)
    said = str(refusal.value)
    assert said.startswith("no feasible design in 5 runs: every trial failed, the first one with: ")
    assert "the contact reaches the edge of the grid" in said
    assert "\n" not in said
