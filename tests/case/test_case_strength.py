"""Limits of the strength of materials in case files, and limits per unit length."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.strength import onset_ratio
from viscontact.case import CaseError, read_case
from viscontact.cli import main

BALL = """
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, youngs_modulus: 2 MPa, poisson_ratio: 0.3, yield_stress: 60 kPa,
  fatigue_limit: 40 kPa}
indenter_material: {law: elastic, youngs_modulus: 8 MPa, poisson_ratio: 0.4, yield_stress: 90 kPa}
load: {kind: step, force: 20 mN}
time: {end: 1 s, steps: 1}
grid: {shape: [32, 32], size: [3 mm, 3 mm]}
"""
LINE = """
indenter: {shape: cylinder, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.3, fatigue_limit: 30 kPa}
load: {kind: harmonic, line_load: 40 N/m, amplitude: 10 N/m, period: 1 s, cycles: 2}
time: {end: 1 s, steps: 4}
grid: {shape: [1, 64], size: [1 mm, 2 mm], periodic: [true, false]}
allowable: {line_load: 60 N/m, strip_width: 0.1 mm}
"""


def case(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "case.yaml"
    path.write_text(text)
    return path


def test_a_result_is_compared_with_the_yield_stresses(tmp_path: Path) -> None:
    path = case(tmp_path, BALL.replace("force: 20 mN", "force: 400 mN"))
    assert main(["run", str(path), "--quiet"]) == 0
    with vc.open_results(tmp_path / "case") as ds:
        limits = json.loads(ds.attrs["allowable"])
        warned = str(ds.attrs["warnings"])
        peak = float(ds.peak_pressure[0])
    assert limits["von_mises"]["limit"] == 60e3
    assert limits["peak_pressure"]["limit"] == close_to(onset_ratio(0.4) * 90e3, rel=1e-9)
    # Hertz: the von Mises stress is the peak pressure over the onset.
    assert limits["von_mises"]["value"] == close_to(peak / onset_ratio(0.3), rel=0.03)
    # Between the onsets of the two bodies.
    assert 60e3 * onset_ratio(0.3) < peak < 90e3 * onset_ratio(0.4)
    judged = {name: each["verdict"] for name, each in limits.items()}
    assert judged == {"von_mises": "failed", "peak_pressure": "passed"}
    assert "yield stress of the half-space material, 60 kPa" in warned
    assert "yield stress of the indenter material" not in warned
    assert "fatigue" not in warned


def test_allowable_values_take_the_place_of_those_of_the_material(tmp_path: Path) -> None:
    path = case(tmp_path, BALL)
    given = read_case(path, ["allowable.von_mises=50 kPa"]).allowable
    assert given["von_mises"] == 50e3
    assert set(given) == {"von_mises", "peak_pressure"}


@pytest.mark.parametrize(
    ("settings", "limit"),
    [
        ([], 60e3),
        (["load={kind: harmonic, mean: 20 mN, amplitude: 5 mN, period: 1 s, cycles: 3}"], 40e3),
        (["motion={kind: travel, points: [[0 s, 0 mm], [1 s, 1 mm]], along: y}"], 40e3),
    ],
)
def test_the_fatigue_limit_counts_where_the_load_repeats(
    tmp_path: Path, settings: list[str], limit: float
) -> None:
    assert read_case(case(tmp_path, BALL), settings).allowable["von_mises"] == limit


def test_a_harmonic_line_load_acts_on_the_period(tmp_path: Path) -> None:
    load = read_case(case(tmp_path, LINE)).load
    times = np.array([0.0, 0.25, 0.75])
    assert np.asarray(load.level_at(times)) == close_to([0.04, 0.05, 0.03], rel=1e-9)


@pytest.mark.slow
def test_limits_per_length_are_judged(tmp_path: Path) -> None:
    assert main(["run", str(case(tmp_path, LINE)), "--quiet"]) == 0
    with vc.open_results(tmp_path / "case") as ds:
        limits = json.loads(ds.attrs["allowable"])
        warned = str(ds.attrs["warnings"])
        width = float(ds.strip_width.max())
    assert limits["force_per_length"]["value"] == close_to(50.0, rel=1e-6)
    assert limits["force_per_length"]["verdict"] == "passed"
    # a = sqrt(4 F R/(pi E*)), Hertz, with E* = 2 G/(1 - nu).
    assert width == close_to(2 * np.sqrt(4 * 50 * 10e-3 / (np.pi * 2e6 / 0.7)), rel=0.01)
    assert limits["strip_width"]["verdict"] == "failed"
    assert "line contact of Hertz reaches the fatigue limit of the material, 30 kPa" in warned


@pytest.mark.parametrize(
    ("text", "setting", "message"),
    [
        (BALL, "allowable.strip_width=1 mm", "only a line contact has it"),
        (LINE, "allowable.resistance_y_per_length=1 N/m", "only a moving contact has it"),
        (LINE, "allowable.force_per_length=1 N/m", "line_load: is force_per_length; give one"),
        (LINE, "load.amplitude=1 N", "must be a force per length, as the line_load is"),
        (LINE, "load.mean=1 N", "line_load and mean exclude each other"),
        (BALL, "material.yield_strength=1 MPa", "did you mean 'yield_stress'"),
    ],
)
def test_what_does_not_fit_is_refused(
    tmp_path: Path, text: str, setting: str, message: str
) -> None:
    with pytest.raises(CaseError, match=message):
        read_case(case(tmp_path, text), [setting])


def test_a_design_takes_the_limit_of_the_material(tmp_path: Path) -> None:
    path = case(tmp_path, BALL)
    found = vc.design(
        path,
        {"load.force": ("1 mN", "100 mN", "log")},
        maximise="load.force",
        constraints=["peak_pressure<=allowable"],
        settings={"indenter_material.yield_stress": "28 kPa"},
        workers=1,
    )
    # F = pi^3 R^2 p0^3/(6 E*^2) (Hertz), at the onset of yield of the indenter.
    modulus = 1 / ((1 - 0.3**2) / 2e6 + (1 - 0.4**2) / 8e6)
    onset = onset_ratio(0.4) * 28e3
    exact = np.pi**3 * 10e-3**2 * onset**3 / (6 * modulus**2)
    assert float(found.best["load.force"]) == close_to(exact, rel=0.05)
    with pytest.raises(ValueError, match="no allowable approach; it has peak_pressure; write"):
        vc.design(
            path,
            {"load.force": ("1 mN", "100 mN")},
            maximise="load.force",
            constraints=["approach<=allowable"],
            workers=1,
        )


@pytest.mark.parametrize("part", ["layers[0].material", "base"])
@pytest.mark.parametrize("name", ["yield_stress", "fatigue_limit"])
def test_limits_of_parts_of_layers_are_refused_as_nothing_compares_them(
    part: str, name: str, tmp_path: Path
) -> None:
    plain = "law: elastic, youngs_modulus: 2 MPa, poisson_ratio: 0.3"
    limited = f"{plain}, {name}: 1 MPa"
    layer, base = (limited, plain) if part != "base" else (plain, limited)
    path = tmp_path / "covered.yaml"
    path.write_text(
        "indenter: {shape: sphere, radius: 10 mm}\n"
        f"material: {{layers: [{{thickness: 5 mm, {layer}}}], base: {{{base}}}}}\n"
        "load: {kind: step, force: 1 N}\ntime: {end: 1 s, steps: 2}\n",
        encoding="utf-8",
    )
    with pytest.raises(CaseError, match=f"{name}: stresses inside layers are not compared"):
        read_case(path)
    materials = vc.Material(vc.Elastic(1e6), 0.3), vc.Material(vc.Elastic(1e6), 0.3, **{name: 1e6})
    own, beneath = materials if part == "base" else materials[::-1]
    with pytest.raises(ValueError, match="states a yield stress or a fatigue limit"):
        vc.Layered([vc.Layer(5e-3, own)], base=beneath)
