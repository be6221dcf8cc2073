"""The section `leakage` of a case: read, checked, kept by the run, and used by what reads it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from viscontact.case import CaseError, case_schema, read_case
from viscontact.cli import main
from viscontact.report import write_report
from viscontact.results.leakage.of_case import case_leakage

CASE: dict[str, Any] = {
    "title": "Seal",
    "indenter": {"shape": "waviness", "amplitude": "1 um", "wavelength_y": "0.1 mm"},
    "material": {"law": "elastic", "shear_modulus": "80 GPa", "poisson_ratio": 0.3},
    "load": {"kind": "ramp", "mean_pressure": "1 GPa", "duration": "1 s"},
    "time": {"end": "1 s", "steps": 2, "spacing": "uniform"},
    "grid": {"shape": [6, 32], "size": ["0.1 mm", "0.1 mm"], "periodic": True},
    "output": {"fields": "all", "errors": False},
    "leakage": {"viscosity": "1 mPa s", "pressure_difference": "1 bar", "along": "both"},
}


def written(folder: Path, **changes: Any) -> Path:
    path = folder / "seal.yaml"
    path.write_text(json.dumps({**CASE, **changes}), encoding="utf-8")
    return path


def test_settings_are_read_in_si_units(tmp_path: Path) -> None:
    case = read_case(written(tmp_path))
    assert case.leakage == {"viscosity": 1e-3, "pressure_difference": 1e5, "along": "both"}
    without = {key: value for key, value in CASE.items() if key != "leakage"}
    (tmp_path / "plain.yaml").write_text(json.dumps(without), encoding="utf-8")
    assert read_case(tmp_path / "plain.yaml").leakage == {}
    assert "leakage" in case_schema()["properties"]


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no unit": ({"leakage": {"viscosity": 1e-3}}, "leakage.viscosity"),
    "another unit": ({"leakage": {"viscosity": "1 bar"}}, "leakage.viscosity"),
    "none": ({"leakage": {"along": "x"}}, "leakage.viscosity"),
    "negative": (
        {"leakage": {"viscosity": "1 mPa s", "pressure_difference": "-1 bar"}},
        "leakage.pressure_difference: must be more than zero",
    ),
    "direction": ({"leakage": {"viscosity": "1 mPa s", "along": "z"}}, "leakage.along"),
    "misspelt": ({"leakage": {"viscosity": "1 mPa s", "lenght": "1 mm"}}, "length"),
    "no fields": ({"output": {"fields": "none"}}, "leakage: it needs the gap"),
    "gas": ({"leakage": {"viscosity": "1 mPa s", "gas": "1 bar"}}, "leakage.gas: it needs"),
    "no period": (
        {
            "grid": {**CASE["grid"], "periodic": False},
            "load": {"kind": "ramp", "force": "1 N", "duration": "1 s"},
            "leakage": {"viscosity": "1 mPa s", "ends": "period"},
        },
        "leakage.ends: the grid is not periodic along x",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_settings_are_refused_at_their_key(name: str, tmp_path: Path) -> None:
    changes, message = REFUSED[name]
    with pytest.raises(CaseError) as refusal:
        read_case(written(tmp_path, **changes))
    assert len(str(refusal.value).splitlines()) == 1
    assert message in str(refusal.value)


def test_run_prints_reports_and_keeps_the_leakage_of_its_result(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = tmp_path / "run"
    assert main(["run", str(written(tmp_path)), "-o", str(run)]) == 0
    assert "leakage at t = 1 s along y: closed" in capsys.readouterr().out
    assert main(["leakage", str(run)]) == 0  # with the settings of the case
    assert "leak rate" in capsys.readouterr().out
    with vc.open_results(run) as ds:
        found = case_leakage(ds)
        expected = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e5, along="both")
        assert found is not None
        np.testing.assert_array_equal(found.leak_rate, expected.leak_rate)
        write_report(ds, tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "along x: critical gap" in page
    assert "along y: closed, no channel leads through" in page


def test_viscosity_is_needed_where_the_case_has_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    without = {key: value for key, value in CASE.items() if key != "leakage"}
    (tmp_path / "plain.yaml").write_text(json.dumps(without), encoding="utf-8")
    assert main(["run", str(tmp_path / "plain.yaml"), "-q", "-o", str(tmp_path / "run")]) == 0
    assert main(["leakage", str(tmp_path / "run")]) == 2
    assert "--viscosity is needed" in capsys.readouterr().err
