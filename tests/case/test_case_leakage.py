"""The section `leakage` of a case: read, checked, kept by the run, and used by what reads it."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from interrupted_runs import contents, folder, kill, same_bits
from viscontact.case import CaseError, case_schema, read_case
from viscontact.cli import main
from viscontact.report import write_report
from viscontact.results.leakage.of_case import case_leakage, leakage_lines
from viscontact.results.leakage.of_state import leakage_memory
from viscontact.results.shown_scalars import shown_scalars
from viscontact.results.variables import Place
from viscontact.runs.preparation import analysis_of
from viscontact.studies.case_values import result_of
from viscontact.studies.scalars import require_fluid

__all__ = ["folder"]  # a fixture

# Few cells are enough here.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

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


# Rubber that creeps under crossed waves: the contact grows, and closes the valleys along y.
CREEPING: dict[str, Any] = {
    **CASE,
    "indenter": {
        **{"shape": "waviness", "amplitude": "1 um"},
        **{"wavelength_x": "0.1 mm", "wavelength_y": "0.1 mm"},
    },
    "material": {
        **{"law": "zener", "shear_modulus": "80 GPa", "delayed_modulus": "80 GPa"},
        **{"viscosity": "80 GPa s", "poisson_ratio": 0.3},
    },
    "load": {"kind": "ramp", "mean_pressure": "0.5 GPa", "duration": "1 s"},
    "time": {"end": "3 s", "steps": 6, "spacing": "uniform"},
    "grid": {"shape": [16, 16], "size": ["0.1 mm", "0.1 mm"], "periodic": True},
    "output": {"fields": ["1 s", "2 s", "3 s"], "errors": False},
    "leakage": {"viscosity": "1 mPa s", "pressure_difference": "1 bar"},
}


def test_scalars_are_those_of_the_stored_instants(tmp_path: Path) -> None:
    run = tmp_path / "run"
    path = tmp_path / "case.yaml"
    path.write_text(json.dumps(CREEPING), encoding="utf-8")
    assert main(["run", str(path), "-q", "-o", str(run)]) == 0
    with vc.open_results(run) as ds:
        found = vc.leakage(ds, viscosity=1e-3, pressure_difference=1e5)
        stored = np.isin(ds.time, ds.field_time)
        for name in ("transmissivity", "leak_rate", "critical_gap"):
            # Files keep the gap in single precision.
            np.testing.assert_allclose(ds[name][stored], found[name], rtol=1e-5)
            assert np.isnan(ds[name][~stored]).all()
        np.testing.assert_allclose(ds.leak_rate_error[stored], found.leak_rate_error, rtol=1e-4)
        assert (np.diff(ds.leak_rate[stored]) < 0).all()  # creep closes the channels
        line, bare = leakage_lines(ds), ds.drop_vars("transmissivity")
        assert line == leakage_lines(bare)  # computed again from the gap
        assert line[0].startswith("leakage at t = 3 s: critical gap")
        facts = shown_scalars(ds, Place.FACTS)
        assert {"leak_rate", "critical_gap"} <= set(facts)
        undriven = ds.assign(leak_rate=ds.leak_rate * np.nan)
        assert "leak_rate" not in shown_scalars(undriven, Place.FACTS)


def test_flow_along_both_axes_has_the_scalars_of_both(tmp_path: Path) -> None:
    case = read_case(written(tmp_path))
    found = result_of(case)
    both = vc.leakage(found, viscosity=1e-3, pressure_difference=1e5, along="both")
    for name in ("transmissivity", "leak_rate", "critical_gap"):
        for own, axis in ((name, "x"), (f"{name}_y", "y")):
            wanted = both.sel(direction=axis)
            np.testing.assert_allclose(found[own], wanted[name], rtol=1e-7)
            rounding = 1e-9 * float(both[name].max())
            errors = found[f"{own}_error"], wanted[f"{name}_error"]
            np.testing.assert_allclose(*errors, atol=rounding)
    assert float(found.leak_rate[-1]) > 0 == float(found.leak_rate_y[-1])
    require_fluid(case, ["force", "leak_rate", "leak_rate_y"])


def test_scalars_that_a_fluid_does_not_have_are_refused(tmp_path: Path) -> None:
    one = read_case(written(tmp_path, leakage={"viscosity": "1 mPa s"}))
    found = result_of(one)
    assert found.transmissivity.values[0] > 0
    assert "transmissivity_y" not in found
    with pytest.raises(ValueError, match="pressure_difference"):
        require_fluid(one, ["leak_rate"])
    with pytest.raises(ValueError, match=r"critical_gap_y: needs 'along: both' .* critical_gap$"):
        require_fluid(one, ["critical_gap_y"])
    require_fluid(one, ["critical_gap"])
    none = read_case(written(tmp_path, leakage=None))
    with pytest.raises(ValueError, match="leak_rate: needs a section 'leakage'"):
        require_fluid(none, ["leak_rate"])


def test_killed_run_is_resumed_to_the_bit(folder: Path) -> None:
    (folder / "case.yaml").write_text(json.dumps(CREEPING), encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "at once"]) == 0
    with vc.open_results("at once") as ds:
        at_once = ds.load()
    kill(4, "-q")
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] < at_once.sizes["time"]
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", at_once)


@pytest.mark.parametrize("stopped", [True, False])
def test_changed_fluid_is_refused_with_the_remedy(
    stopped: bool, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "case.yaml").write_text(json.dumps(CREEPING), encoding="utf-8")
    if stopped:
        kill(4, "-q")
    else:
        assert main(["run", "case.yaml", "-q"]) == 0
    before = contents("case")
    capsys.readouterr()
    other = ["--set", "leakage.viscosity=2 mPa s"]
    assert main(["run", "case.yaml", "-q", "--resume", *other]) == 2
    said = capsys.readouterr().err
    assert "leakage.viscosity: was 1 mPa s, is now 2 mPa s" in said
    assert "viscontact leakage DIR" in said
    assert contents("case") == before


@pytest.mark.slow
def test_leak_rate_is_a_scalar_of_sweeps(folder: Path) -> None:
    (folder / "case.yaml").write_text(json.dumps(CREEPING), encoding="utf-8")
    vary = ["--vary", "load.mean_pressure=0.2 GPa,0.5 GPa"]
    assert main(["run", "case.yaml", "-q", "-j", "1", *vary, "-o", "both"]) == 0
    with vc.open_many("both") as ds:
        assert ds.leak_rate.dims == ("load.mean_pressure", "time")
        last = ds.leak_rate.isel(time=-1).values
        assert 0 < last[1] < last[0]
        assert (ds.leak_rate_error.isel(time=-1).values < last).all()


@pytest.mark.slow
def test_design_finds_the_least_pressure_that_seals(folder: Path) -> None:
    (folder / "case.yaml").write_text(json.dumps(CREEPING), encoding="utf-8")
    found = vc.design(
        "case.yaml",
        change={"load.mean_pressure": ("0.05 GPa", "2 GPa")},
        minimise="mean_pressure",
        constraints=["leak_rate<=1 mm3/h"],
        runs=14,
    )
    assert float(found.best.leak_rate) < 3e-13


def test_scalars_over_speed_are_those_of_the_result(tmp_path: Path) -> None:
    without = {key: each for key, each in CREEPING.items() if key not in ("time", "load")}
    case = {
        **without,
        "load": {"kind": "step", "mean_pressure": "0.2 GPa", "tilt_x": 0, "tilt_y": 0},
        "motion": {"kind": "steady", "speed": ["1 um/s", "1 mm/s"], "rolling": False},
        "output": {"fields": "all", "errors": False},
    }
    (tmp_path / "case.yaml").write_text(json.dumps(case), encoding="utf-8")
    found = result_of(read_case(tmp_path / "case.yaml"))
    leak = vc.leakage(found, viscosity=1e-3, pressure_difference=1e5)
    np.testing.assert_allclose(found.leak_rate, leak.leak_rate, rtol=1e-12)
    assert (leak.leak_rate > 0).all()
    # A ball has a grid for each speed, on which the gap is not known at the others.
    ball = {key: each for key, each in case.items() if key != "grid"}
    ball |= {"indenter": {"shape": "sphere", "radius": "10 mm"}}
    ball["load"] = {"kind": "step", "force": "1 N", "tilt_x": 0, "tilt_y": 0}
    (tmp_path / "ball.yaml").write_text(json.dumps(ball), encoding="utf-8")
    alone = result_of(read_case(tmp_path / "ball.yaml"))
    known = np.isfinite(alone.gap).all(("x", "y"))
    np.testing.assert_array_equal(np.isfinite(alone.leak_rate), known)


def test_forecast_counts_the_flow(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # A trial solve that takes a second in both, however busy the machine is.
    monkeypatch.setattr("viscontact.runs.forecast.clock.perf_counter", itertools.count().__next__)
    with_flow, alone = (
        analysis_of(read_case(written(tmp_path, leakage=each)), errors=False)
        for each in ({"viscosity": "1 mPa s", "along": "x"}, None)
    )
    assert with_flow.memory == alone.memory + leakage_memory(6 * 32)
    assert with_flow.leakage_seconds > 0 == alone.leakage_seconds
    assert with_flow.seconds == close_to(alone.seconds + with_flow.leakage_seconds)
    assert leakage_memory(10**9) == leakage_memory(10**8)
