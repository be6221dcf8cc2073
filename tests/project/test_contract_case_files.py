"""What users rely on of case files: how each section is read."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from project.promised_run import BALL, CASE, GRID
from viscontact.case import read_case


def _read(changes: dict[str, Any]) -> Any:
    """The case with sections replaced; JSON is YAML too."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.yaml"
        path.write_text(json.dumps({**CASE, **changes}), encoding="utf-8")
        (path.parent / "load.csv").write_text("time [ms], force [mN]\n0, 0\n1000, 100\n")
        return read_case(path)


@pytest.mark.parametrize(
    ("section", "given"),
    [
        ({"shape": "sphere", "radius": "10 mm"}, BALL),
        (
            {"shape": "paraboloid", "radius_x": "10 mm", "radius_y": "2 cm"},
            vc.Paraboloid(0.01, 0.02),
        ),
        ({"shape": "cone", "half_angle": "1.2 rad"}, vc.Cone(1.2)),
        ({"shape": "flat-punch", "radius": "1 mm"}, vc.FlatPunch(1e-3)),
        (
            {"shape": "flat-punch", "half_length": "1 mm", "half_width": "2 mm"},
            vc.FlatPunch(half_length=1e-3, half_width=2e-3),
        ),
        (
            {"shape": "roller", "radius": "5 mm", "half_length": "9 mm", "crown_radius": "75 mm"},
            vc.Roller(0.005, 0.009, 0.075),
        ),
        ({"shape": "roller", "radius": "5 mm", "half_length": "9 mm"}, vc.Roller(0.005, 0.009)),
        (
            [{"shape": "sphere", "radius": "10 mm"}, {"shape": "cone", "half_angle": "1.2 rad"}],
            BALL + vc.Cone(1.2),
        ),
    ],
)
def test_case_files_indenter(section: Any, given: Any) -> None:
    assert _read({"indenter": section}).indenter == given


MODULI = {"shear_modulus": "1 MPa"}
KELVIN = {"delayed_modulus": "2 MPa", "viscosity": "3 MPa s"}
TERMS: dict[str, Any] = {
    **{"instant": "1 / MPa", "amplitudes": ["2 / MPa"], "times": ["3 s"]},
    **{"fluidity": "1e-3 / (MPa s)"},
}
PRONY = {"equilibrium": "1 MPa", "moduli": ["2 MPa"], "times": ["3 s"]}
NUMBERS: Any = (1e-6, [2e-6], [3.0], 1e-9)


@pytest.mark.parametrize(
    ("section", "law"),
    [
        ({"law": "elastic", **MODULI}, vc.Elastic(1e6)),
        (
            {"law": "elastic", "youngs_modulus": "3 MPa", "data": "uniaxial"},
            vc.Elastic.from_uniaxial(3e6, poisson_ratio=0.4),
        ),
        ({"law": "maxwell", **MODULI, "viscosity": "3 MPa s"}, vc.Maxwell(1e6, 3e6)),
        ({"law": "zener", **MODULI, **KELVIN}, vc.Zener(1e6, 2e6, 3e6)),
        (
            {"law": "burgers", **MODULI, **KELVIN, "delayed_viscosity": "4 MPa s"},
            vc.Burgers(1e6, 3e6, 2e6, 4e6),
        ),
        ({"law": "creep-series", **TERMS, "data": "deviatoric"}, vc.CreepSeries(*NUMBERS)),
        ({"law": "creep-series", **TERMS, "data": "shear"}, vc.CreepSeries.from_shear(*NUMBERS)),
        (
            {"law": "creep-series", **TERMS, "data": "uniaxial"},
            vc.CreepSeries.from_uniaxial(*NUMBERS, poisson_ratio=0.4),
        ),
        (
            {"law": "relaxation-series", **PRONY, "data": "shear"},
            vc.RelaxationSeries(1e6, [2e6], [3.0]),
        ),
        (
            {"law": "relaxation-series", **PRONY, "data": "uniaxial"},
            vc.RelaxationSeries.from_uniaxial(1e6, [2e6], [3.0], poisson_ratio=0.4),
        ),
    ],
)
def test_case_files_material(section: dict[str, Any], law: Any) -> None:
    case = _read({"material": {**section, "poisson_ratio": 0.4}})
    np.testing.assert_allclose(case.material.law([0.0, 2.0]), law([0.0, 2.0]), rtol=1e-14)
    assert case.material.poisson_ratio == 0.4
    of_indenter = _read({"indenter_material": {**section, "poisson_ratio": 0.4}}).indenter_material
    assert of_indenter.law == case.material.law


def test_case_files_material_by_bulk_modulus_and_by_name() -> None:
    section = {"law": "elastic", **MODULI, "bulk_modulus": "4 GPa"}
    assert _read({"material": section}).material == vc.Material(vc.Elastic(1e6), bulk_modulus=4e9)
    for name in ("pmma-paper", "pmma-kumar-2004"):
        assert _read({"material": name}).material.poisson_ratio == 0.38


@pytest.mark.parametrize(
    ("section", "load"),
    [
        ({"kind": "step", "force": "1 kN"}, vc.step(1e3)),
        ({"kind": "ramp", "force": "1 kN", "duration": "2 min"}, vc.ramp(1e3, 120.0)),
        ({"kind": "triangle", "force": "1 N", "rise": "2 s"}, vc.triangle(1.0, 2.0)),
        (
            {"kind": "triangle", "force": "1 N", "rise": "2 s", "fall": "1 h"},
            vc.triangle(1.0, 2.0, 3600.0),
        ),
        (
            {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "100 mN"]]},
            vc.ForceHistory([0, 1], [0, 0.1]),
        ),
        ({"kind": "history", "file": "load.csv"}, vc.ForceHistory([0, 1], [0, 0.1])),
        (
            {
                "kind": "history",
                "sentences": "ramp to 10 kN in 1 s; hold for 240 s; unload in 0.1 s",
            },
            vc.ForceHistory([0, 1, 241, 241.1], [0, 1e4, 1e4, 0]),
        ),
        ({"kind": "step", "approach": "0.1 mm"}, vc.step(approach=1e-4)),
        (
            {"kind": "history", "points": [["0 s", "0 mm"], ["1 s", "0.1 mm"]]},
            vc.ApproachHistory([0, 1], [0, 1e-4]),
        ),
        (
            {"kind": "harmonic", "mean": "2 N", "amplitude": "1 N", "period": "3 s", "cycles": 4},
            vc.harmonic(2.0, 1.0, 3.0, 4),
        ),
        (
            {"kind": "step", "force": "1 N", "eccentricity_x": "-1 mm", "eccentricity_y": "2 mm"},
            vc.step(1.0, eccentricity_x=-1e-3, eccentricity_y=2e-3),
        ),
        (
            {"kind": "step", "force": "1 N", "tilt_x": "1 mrad", "tilt_y": "0 rad"},
            vc.step(1.0, tilt_x=1e-3, tilt_y=0.0),
        ),
    ],
)
def test_case_files_load(section: dict[str, Any], load: vc.LoadHistory) -> None:
    assert _read({"load": section}).load == load


@pytest.mark.parametrize(
    ("section", "times"),
    [
        ({"end": "4 s", "steps": 2}, vc.uniform_times(4.0, 2)),
        ({"end": "4 s", "steps": 2, "spacing": "uniform"}, vc.uniform_times(4.0, 2)),
        (
            {"end": "4 s", "steps": 3, "spacing": "log", "first": "10 ms"},
            vc.log_times(0.01, 4.0, 3),
        ),
    ],
)
def test_case_files_time(section: dict[str, Any], times: Any) -> None:
    np.testing.assert_array_equal(_read({"time": section}).times, times)


def test_case_files_adaptive_time() -> None:
    section = {"end": "4 s", "spacing": "adaptive", "tolerance": 1e-4}
    assert _read({"time": section}).times == vc.adaptive_times(4.0, tolerance=1e-4)


def test_case_files_title_grid_output_and_tolerance() -> None:
    case = _read({"output": {"fields": ["0 s", "1 s"]}, "tolerance": 1e-8})
    assert (case.title, case.grid, case.tolerance) == ("Ball", GRID, 1e-8)
    assert case.fields == (0.0, 1.0)
    assert _read({"output": {"fields": "none"}}).fields == "none"
    assert _read({"grid": None}).grid is None
    many = _read({"output": {}, "time": {"end": "1 s", "steps": 99}}).fields
    assert (len(many), many[0], many[-1]) == (10, 0.0, 1.0)
