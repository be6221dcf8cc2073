"""The `load` and `time` of case files: every way to say them, and every mistake at its key."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from viscontact.case import Case, CaseError, case_schema, read_case
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes

CASE: dict[str, Any] = {
    "indenter": {"shape": "sphere", "radius": "10 mm"},
    "material": {"law": "elastic", "shear_modulus": "10 MPa", "poisson_ratio": 0.5},
    "load": {"kind": "step", "force": "1 N"},
    "time": {"end": "10 s", "steps": 4},
}


def read(folder: Path, **sections: Any) -> Case:
    """The case with sections replaced, on a line each; JSON is YAML too."""
    path = folder / "case.yaml"
    text = ",\n".join(f'"{key}": {json.dumps(of)}' for key, of in {**CASE, **sections}.items())
    path.write_text(f"{{{text}}}", encoding="utf-8")
    return read_case(path)


def problem(folder: Path, **sections: Any) -> str:
    """The one problem of a case, without the folder in front."""
    with pytest.raises(CaseError) as refusal:
        read(folder, **sections)
    [line] = refusal.value.problems
    return line.replace(f"{folder}{os.sep}", "")


# --- what is meant ----------------------------------------------------------------------------

UP_AND_OFF = vc.ForceHistory([0, 1, 3, 3], [0, 10, 10, 0])
IN_AND_OUT = vc.ApproachHistory([0, 1, 3], [0, 2e-6, -1e-6])


@pytest.mark.parametrize(
    ("load", "history"),
    [
        ({"kind": "step", "approach": "2 um"}, vc.step(approach=2e-6)),
        (
            {"kind": "step", "approach": "2 um", "tilt_x": "1 mrad", "tilt_y": "free"},
            vc.step(approach=2e-6, tilt_x=1e-3),
        ),
        ({"kind": "step", "force": "2 N", "tilt_x": "free"}, vc.step(2.0)),
        (
            {"kind": "ramp", "approach": "2 um", "duration": "3 s"},
            vc.ramp(approach=2e-6, duration=3.0),
        ),
        (
            {"kind": "triangle", "approach": "2 um", "rise": "3 s", "fall": "1 s"},
            vc.triangle(approach=2e-6, rise=3.0, fall=1.0),
        ),
        (
            {"kind": "harmonic", "mean": "3 N", "amplitude": "2 N", "period": "4 s", "cycles": 5},
            vc.harmonic(3.0, 2.0, 4.0, 5),
        ),
        (
            {
                **{"kind": "harmonic", "approach": "3 um", "amplitude": "2 um", "period": "1 min"},
                **{"cycles": 5, "phase": "90 deg", "tilt_y": "0 rad"},
            },
            vc.harmonic(
                approach=3e-6, amplitude=2e-6, period=60.0, cycles=5, phase=np.pi / 2, tilt_y=0.0
            ),
        ),
        (
            {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "10 N"]], "tilt_y": "1 mrad"},
            vc.ForceHistory([0, 1], [0, 10], tilt_y=1e-3),
        ),
        (
            {"kind": "history", "points": [["0 s", "0 m"], ["1 s", "2 um"], ["3 s", "-1 um"]]},
            IN_AND_OUT,
        ),
        (
            {"kind": "history", "points": [["0 s", "1 um"]], "tilt_x": "free"},
            vc.ApproachHistory([0], [1e-6], tilt_x=None),
        ),
        (
            {"kind": "history", "sentences": "ramp to 10 N in 1 s; hold for 2 s; unload at once"},
            UP_AND_OFF,
        ),
        (
            {"kind": "history", "sentences": ["ramp to 10 N in 1 s", "hold for 2 s; unload"]},
            UP_AND_OFF,
        ),
        (
            {
                **{"kind": "history", "sentences": ["ramp to 10 N in 1 s"]},
                **{"eccentricity_x": "1 mm", "tilt_y": "0 rad"},
            },
            vc.ForceHistory([0, 1], [0, 10], eccentricity_x=1e-3, tilt_y=0.0),
        ),
        (
            {"kind": "history", "sentences": "press to 2 um in 1 s; withdraw by 3 um in 2 s"},
            IN_AND_OUT,
        ),
    ],
)
def test_load_is_the_load_made_by_hand(load: Any, history: vc.LoadHistory, tmp_path: Path) -> None:
    assert type(history) is type(read(tmp_path, load=load).load)
    assert read(tmp_path, load=load).load == history


@pytest.mark.parametrize(
    ("table", "history"),
    [
        ("time [s],force [N]\n0,0\n1,10\n3,10\n3,0\n", UP_AND_OFF),
        ("time [s]; force [N]\n0; 0\n1,0; 10\n3; 1e1\n3; 0,0\n", UP_AND_OFF),
        ("\ufeff# a probe\ntime [s], approach [um]\n0, 0\n\n1, 2\n3, -1\n", IN_AND_OUT),
        (
            "time [s], approach [um], tilt_x [mrad], tilt_y [rad]\n0, 0, 0, 0\n1, 2, 1, 0\n",
            vc.ApproachHistory([0, 1], [0, 2e-6], tilt_x=[0, 1e-3], tilt_y=[0, 0]),
        ),
        (
            "time [s], force [N], eccentricity_x [mm], tilt_y [rad]\n0, 0, 0, 0\n1, 2, 1, 0\n",
            vc.ForceHistory([0, 1], [0, 2], eccentricity_x=[0, 1e-3], tilt_y=[0, 0]),
        ),
    ],
)
def test_load_from_a_table(table: str, history: vc.LoadHistory, tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text(table, encoding="utf-8")
    found = read(tmp_path, load={"kind": "history", "file": "load.csv"})
    assert type(found.load) is type(history)
    for name, value in vars(history).items():
        theirs = getattr(found.load, name)
        assert (theirs is None) == (value is None)
        if value is not None:
            np.testing.assert_allclose(theirs, value, rtol=1e-14)
    assert found.load_file == tmp_path / "load.csv"


# --- mistakes, each in one line at its key ------------------------------------------------------

SWING = {"kind": "harmonic", "mean": "3 N", "amplitude": "2 N", "period": "4 s", "cycles": 5}
LINE = "case.yaml:3: "


@pytest.mark.parametrize(
    ("load", "said"),
    [
        ({"kind": "step"}, "load.force: is missing; write e.g. 'force: 10 kN', or 'approach: 0.1 "),
        ({"kind": "ramp", "duration": "1 s"}, "load.force: is missing"),
        (
            {"kind": "step", "force": "1 N", "approach": "1 mm"},
            "load.force: force and approach exclude each other; give one of them",
        ),
        ({"kind": "step", "approach": "1 N"}, "load.approach: cannot read '1 N' as a length (got"),
        ({"kind": "step", "approach": 1}, "load.approach: 1 has no unit"),
        (
            {"kind": "step", "approach": "1 mm", "eccentricity_x": "1 mm"},
            "load.eccentricity_x: goes with a force, got 1 mm with an approach",
        ),
        (
            {"kind": "step", "force": "1 N", "tilt_x": "loose"},
            "load.tilt_x: cannot read 'loose' as an angle: no number in front; write e.g. '1 mrad',"
            " or 'free'",
        ),
        (
            {"kind": "step", "force": "1 N", "sentences": "unload"},
            "load.sentences: unknown key. Allowed: approach, eccentricity_x, eccentricity_y, force,"
            " kind, line_load, mean_pressure, misalignment, stage_stiffness, tilt_x, tilt_y. It"
            " goes with kind: history",
        ),
        ({**SWING, "approach": "1 mm"}, "load.mean: mean and approach exclude each other"),
        ({**SWING, "amplitude": "2 mm"}, "load.amplitude: must be a force, as the mean is"),
        (
            {**SWING, "amplitude": "4 N"},
            "load.mean: must be zero or more without adhesion, got -1 N",
        ),
        ({**SWING, "amplitude": "2 Pa"}, "load.amplitude: cannot read '2 Pa' as a force or a leng"),
        ({**SWING, "cycles": 0}, "load.cycles: must be greater than or equal to 1, got 0"),
        ({**SWING, "cycles": 1.5}, "load.cycles: must be a whole number, got 1.5"),
        ({**SWING, "cycles": 10**6}, "load.cycles: must be less than or equal to 100000"),
        ({**SWING, "period": "0 s"}, "load.period: must be more than zero"),
        ({**SWING, "phase": "1 s"}, "load.phase: cannot read '1 s' as an angle"),
        (
            {**SWING, "frequency": "1 Hz"},
            "load.frequency: frequency and period exclude each other; give one",
        ),
        ({"kind": "history"}, "load: give points (e.g. '[[0 s, 0 N], [1 s, 10 kN]]'), mean_pr"),
        (
            {"kind": "history", "points": [["0 s", "1 N"]], "sentences": "unload"},
            "load.points: give points",
        ),
        ({"kind": "history", "points": []}, "load.points: is empty"),
        (
            {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "1 mm"]]},
            "load.points[2]: it is a length, a force in the first point",
        ),
        (
            {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "-1 N"]]},
            "load.points[2]: must be zero or more without adhesion, got -1 N",
        ),
        (
            {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "1 MPa"]]},
            "load.points[2][2]: cannot read '1 MPa' as a force or a length (got a pressure)",
        ),
        (
            {"kind": "history", "points": [["2 s", "0 N"], ["1 s", "1 N"]]},
            "load: times must not decrease, got 2.0 s followed by 1.0 s",
        ),
        (
            {"kind": "history", "points": [["0 s", "1 mm"]], "eccentricity_x": "1 mm"},
            "load.eccentricity_x: goes with a force; with an approach",
        ),
        ({"kind": "history", "sentences": 5}, "load.sentences: must be a text or a list of texts"),
        (
            {"kind": "history", "sentences": ["step to 1 N", "dance"]},
            "load.sentences[2]: sentence 2, 'dance': nothing of it was understood",
        ),
        (
            {"kind": "history", "sentences": ["step to 1 N", 5]},
            "load.sentences[2]: sentence 2, '5': nothing",
        ),
        (
            {"kind": "history", "sentences": ["step to 1 N; hold for 1 s", "ramp by -2 N in 1 s"]},
            "load.sentences[2]: sentence 3, 'ramp by -2 N in 1 s': the force would fall to -1 N",
        ),
        (
            {"kind": "history", "sentences": "step to 1 N; step to 2 N"},
            "load.sentences: sentence 2, 'step to 2 N': there is a jump",
        ),
        (
            {"kind": "history", "sentences": "hold for 2 s"},
            "load.sentences: no sentence says how much",
        ),
    ],
)
def test_bad_load_is_one_line_at_its_key(load: Any, said: str, tmp_path: Path) -> None:
    assert problem(tmp_path, load=load).startswith(f"{LINE}{said}")


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("time [s]\n0\n", "load.csv: the column force is missing, or approach in its place"),
        ("force [N]\n0\n", "load.csv: the column time is missing"),
        ("time [s], force [N], approach [m]\n0, 0, 0\n", "load.csv: the columns force and appr"),
        ("time [s], approach [N]\n0, 0\n", "as a length (got a force)"),
        ("time [s], force [N]\n", "load.csv has a header and no rows"),
        (
            "time [s], force [N]\n0, 1\n\n2, nan\n",
            "load.csv:4: column 'force [N]': must be a finite number, got 'nan'",
        ),
        ("time [s], force [N]\n0, 1\n2, 3\n1, 3\n", "load.csv:4: time must not decrease, got 2 s"),
        ("time [s], force [N]\n-1, 1\n", "load.csv:2: time must not decrease, got 0 s followed by"),
        ("time [s], force [N]\n0, -1\n", "must be zero or more without adhesion, got -1 N"),
        ("time [s], force [N]\n0, 1,5\n", "load.csv:2 has 3 entries, the header 2"),
        (
            "time [s], approach [m], eccentricity_x [m]\n0, 0, 1\n",
            "eccentricity_x goes with a force",
        ),
    ],
)
def test_bad_load_table_is_one_line_with_row_and_column(
    table: str, said: str, tmp_path: Path
) -> None:
    (tmp_path / "load.csv").write_text(table, encoding="utf-8")
    found = problem(tmp_path, load={"kind": "history", "file": "load.csv"})
    assert found.startswith(LINE)
    assert said in found


# --- time -------------------------------------------------------------------------------------


def test_adaptive_spacing_asks_for_a_tolerance_and_no_steps(tmp_path: Path) -> None:
    times = {"end": "10 s", "spacing": "adaptive", "tolerance": 1e-4}
    assert read(tmp_path, time=times).times == vc.adaptive_times(10.0, tolerance=1e-4)
    del times["tolerance"]
    assert read(tmp_path, time=times).times == AdaptiveTimes(10.0, 1e-3)


@pytest.mark.parametrize(
    ("time", "said"),
    [
        ({"end": "1 s"}, "time.steps: is missing; write e.g. 'steps: 120', or 'spacing: adaptive'"),
        ({"end": "1 s", "spacing": "log"}, "time.steps: is missing"),
        (
            {"end": "1 s", "spacing": "adaptive", "steps": 5},
            "time.steps: goes with spacing: uniform or log only; leave it out",
        ),
        (
            {"end": "1 s", "spacing": "adaptive", "first": "1 ms"},
            "time.first: goes with spacing: log only",
        ),
        (
            {"end": "1 s", "steps": 5, "tolerance": 1e-3},
            "time.tolerance: goes with spacing: adaptive only",
        ),
        (
            {"end": "1 s", "spacing": "adaptive", "tolerance": 0.5},
            "time.tolerance: must be less than or equal to 0.1, got 0.5",
        ),
        (
            {"end": "1 s", "spacing": "adaptive", "tolerance": "1 Pa"},
            "time.tolerance: must be a plain number, without a unit",
        ),
    ],
)
def test_bad_time_is_one_line_at_its_key(time: Any, said: str, tmp_path: Path) -> None:
    assert problem(tmp_path, time=time).startswith(f"case.yaml:4: {said}")


def test_adaptive_run_keeps_ten_fields_spread_in_log_time(tmp_path: Path) -> None:
    case = read(tmp_path, time={"end": "10 s", "spacing": "adaptive"})
    assert (len(case.fields), case.fields[0], case.fields[-1]) == (
        10,
        0.0,
        10.0,
    )
    ratios = np.diff(np.log(np.array(case.fields[1:])))
    np.testing.assert_allclose(ratios, np.log(1000) / 8, rtol=1e-12)
    for fields in ("all", "none"):
        adaptive = {"end": "10 s", "spacing": "adaptive"}
        assert read(tmp_path, time=adaptive, output={"fields": fields}).fields == fields


def test_adaptive_run_has_its_fields_at_the_very_instants_asked_for(tmp_path: Path) -> None:
    adaptive = {"end": "10 s", "spacing": "adaptive", "tolerance": 0.01}
    load = {"kind": "triangle", "force": "1 N", "rise": "0.1 s", "fall": "0.2 s"}
    case = read(
        tmp_path,
        load=load,
        time=adaptive,
        grid={"shape": [32, 32], "size": ["1.5 mm", "1.5 mm"]},
        # 0.1 s + 0.2 s, the end of the fall, is 0.30000000000000004 s in floating point
        output={"fields": ["0 s", "0.3 s", "7 s"]},
    )
    arguments = (
        case.indenter,
        case.material,
        case.load,
        case.grid,
        case.times,
    )
    ds = vc.simulate(*arguments, fields=case.fields)
    np.testing.assert_allclose(ds.field_time, [0.0, 0.3, 7.0, 10.0], rtol=1e-12)
    assert ds.time[-1] == 10.0
    late = problem(tmp_path, time=adaptive, output={"fields": ["11 s"]})
    assert "output.fields: the instant 11 s lies after the end of the run, 10 s" in late


# --- schema -----------------------------------------------------------------------------------


def test_schema_knows_every_kind_of_load_and_spacing() -> None:
    schema = case_schema()
    load = schema["properties"]["load"]
    assert set(load["discriminator"]["mapping"]) == {
        *("step", "ramp", "triangle", "harmonic", "history", "program"),
    }
    defs = schema["$defs"]
    assert {"points", "file", "sentences"} <= set(defs["History"]["properties"])
    assert {"force", "approach"} <= set(defs["Triangle"]["properties"])
    spoken = json.dumps(defs["History"]["properties"]["sentences"])
    assert "hold for 240 s" in spoken
    time = defs["Time"]
    assert time["required"] == ["end"]
    assert time["properties"]["spacing"]["enum"] == ["uniform", "log", "adaptive", "cells"]


def test_names_of_the_columns_are_given_where_a_history_has_none(tmp_path: Path) -> None:
    (tmp_path / "bare.csv").write_text("0;0;0\n1;0,5;3\n2;0,5;4\n")
    load = {"kind": "history", "file": "bare.csv", "columns": "time [s];;force [N]"}
    found = read(tmp_path, load=load).load
    assert found.level_at(np.array([0.5, 2.0])).tolist() == [1.5, 4.0]
    with pytest.raises(CaseError, match=r"load\.columns: 2 names, but bare\.csv has 3 columns"):
        read(tmp_path, load=load | {"columns": "time [s], force [N]"})
    with pytest.raises(CaseError, match=r"load\.columns: goes with file"):
        read(tmp_path, load={"kind": "history", "sentences": "hold for 2 s", "columns": "a"})
