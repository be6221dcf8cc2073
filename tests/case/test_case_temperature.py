"""The `temperature` of case files, `ageing` of materials, and their mistakes at their keys."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.case.test_case_loads import problem, read

import viscontact as vc
from closeness import close_to
from viscontact.case import Case, CaseError, case_schema, read_case
from viscontact.web.cases.case_reader import form_values

WLF = {"kind": "wlf", "reference_temperature": "20 degC", "c1": 8.86, "c2": "101.6 K"}
FLUID = {"law": "maxwell", "shear_modulus": "1 MPa", "viscosity": "1 MPa s", "poisson_ratio": 0.5}
WARMED = {**FLUID, "shift": WLF}
CYCLE = {"mean": "15 degC", "amplitude": "10 K", "period": "24 h"}
BASE = {"layers": [{"thickness": "1 mm", "material": WARMED}], "base": FLUID}
HELD = [["0 s", "20 degC"], ["2 h", "60 degC"], ["10 h", "60 degC"], ["11 h", "20 degC"]]


def warmed(folder: Path, temperature: object, **sections: Any) -> Case:
    """The case of a material with a shift at a temperature."""
    return read(folder, **({"material": WARMED, "temperature": temperature} | sections))


def refusal(folder: Path, temperature: object, **sections: Any) -> str:
    """The one problem of such a case."""
    return problem(folder, **({"material": WARMED, "temperature": temperature} | sections))


# --- what is meant ----------------------------------------------------------------------------


def test_quantity_is_a_constant_temperature(tmp_path: Path) -> None:
    for given in ("40 degC", "313.15 K", "104 degF", {"kind": "constant", "value": "40 degC"}):
        found = warmed(tmp_path, given).temperature
        assert found is not None
        assert found.is_constant
        assert found.range == close_to((313.15, 313.15))
    assert read(tmp_path).temperature is None


def test_points_file_and_sentences_give_the_same_history(tmp_path: Path) -> None:
    points = warmed(tmp_path, {"points": HELD}).temperature
    assert points == vc.TemperatureHistory([0.0, 7200.0, 36000.0, 39600.0], [
        293.15, 333.15, 333.15, 293.15,
    ])  # fmt: skip
    rows = "Zeit [h];Temperatur [°C];Feuchte [%]\n0;20,0;40\n2;60,0;20\n10;60,0;20\n11;20,0;40\n"
    (tmp_path / "day.csv").write_text(rows, encoding="utf-8")
    case = warmed(tmp_path, {"file": "day.csv"})
    assert case.temperature == points
    assert case.files == {("temperature", "file"): tmp_path / "day.csv"}
    assert any("Feuchte" in note for note in case.notes)
    text = "heat to 60 degC in 2 h; hold for 8 h; cool to 20 degC in 1 h"
    for sentences in (
        {"sentences": f"start at 20 degC; {text}"},
        {"sentences": text, "start": "20 degC"},
        {
            "sentences": [
                "start at 20 degC",
                "heat to 60 degC at 20 K/h; hold until 10 h",
                text[-22:],
            ]
        },
    ):
        assert warmed(tmp_path, sentences).temperature == points


def test_sentences_step_and_repeat(tmp_path: Path) -> None:
    given = "start at 20 degC; heat by 40 K in 1 h; cool by 40 K in 1 h; repeat 2 times; "
    found = warmed(tmp_path, {"sentences": given + "step to 50 degC; hold for 1 h"}).temperature
    assert found is not None
    assert found.kinks.tolist() == [3600.0 * hour for hour in range(8)]
    assert found.at(3600.0 * np.array([1.0, 3.0, 5.0, 6.5])) == close_to([333.15] * 3 + [323.15])
    assert found.jumps.tolist() == [21600.0]


def test_harmonic_temperature_is_exact(tmp_path: Path) -> None:
    given = {"kind": "harmonic", "mean": "15 degC", "amplitude": "10 degC", "period": "24 h"}
    found = warmed(tmp_path, {**given, "cycles": 2, "phase": "30 deg"}).temperature
    assert found == vc.HarmonicTemperature(288.15, 10.0, 86400.0, 2, np.pi / 6)
    times = np.linspace(0.0, 2 * 86400.0, 50)
    expected = 288.15 + 10 * np.sin(2 * np.pi * times / 86400 + np.pi / 6)
    assert found.at(times) == close_to(expected, rel=1e-14)


def test_the_law_is_that_at_the_temperature_of_the_case(tmp_path: Path) -> None:
    top = warmed(tmp_path, "40 degC")
    own = read(tmp_path, material={**WARMED, "temperature": "40 degC"})
    assert top.bodies == own.bodies
    [clock] = warmed(tmp_path, {"points": HELD}).clocks
    shift = vc.WLF(293.15, 8.86, 101.6)
    assert clock.rate(20000.0) == close_to(1 / shift.factor(333.15))


def test_ageing_belongs_to_the_material(tmp_path: Path) -> None:
    ageing = {"age": "1 h", "exponent": 0.8}
    case = read(tmp_path, material={**FLUID, "ageing": ageing})
    assert case.material == vc.Material(vc.Maxwell(1e6, 1e6), 0.5, ageing=vc.Ageing(3600.0, 0.8))
    (tmp_path / "law.yaml").write_text("law: elastic\nshear_modulus: 1 MPa\npoisson_ratio: 0.3\n")
    case = read(tmp_path, material={"file": "law.yaml", "ageing": ageing})
    assert isinstance(case.material, vc.Material)
    assert case.material.ageing == vc.Ageing(3600.0, 0.8)


def test_law_file_takes_the_temperature_of_the_case(tmp_path: Path) -> None:
    text = "law: maxwell\nshear_modulus: 1 MPa\nviscosity: 1 MPa s\npoisson_ratio: 0.5\n"
    shift = "shift: {kind: wlf, reference_temperature: 20 degC, c1: 8.86, c2: 101.6 K}\n"
    (tmp_path / "law.yaml").write_text(text + shift)
    case = read(tmp_path, material={"file": "law.yaml"}, temperature={"points": HELD})
    assert case.clocks == warmed(tmp_path, {"points": HELD}).clocks
    (tmp_path / "law.yaml").write_text(f"{text}{shift}temperature: 30 degC\n")
    assert "material: is 30 °C, and the case gives" in problem(
        tmp_path, material={"file": "law.yaml"}, temperature="40 degC"
    )


def test_settings_replace_the_temperature(tmp_path: Path) -> None:
    given = {"kind": "harmonic", "mean": "15 degC", "amplitude": "10 K", "period": "24 h"}
    warmed(tmp_path, {**given, "cycles": 1})
    path = tmp_path / "case.yaml"
    found = read_case(path, ["temperature.mean=25 degC", "temperature.amplitude=5 K"]).temperature
    assert found == vc.HarmonicTemperature(298.15, 5.0, 86400.0, 1)
    case = read_case(path, ["temperature=40 degC"])
    assert case.temperature == vc.TemperatureHistory([0.0], 313.15)
    again = tmp_path / "again.yaml"
    again.write_text(case.text, encoding="utf-8")
    assert read_case(again).temperature == case.temperature


def test_form_has_the_longest_spelling(tmp_path: Path) -> None:
    for given, spelled in (
        ("40 degC", {"kind": "constant", "value": "40 degC"}),
        ("{points: [[0 s, 20 degC]]}", {"kind": "history", "points": [["0 s", "20 degC"]]}),
    ):
        assert form_values(f"temperature: {given}", tmp_path)["temperature"] == spelled
    # The form begins with the first kind; an example that is a quantity would replace the section.
    assert "examples" not in case_schema()["properties"]["temperature"]


# --- mistakes ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("temperature", "said"),
    [
        ("40 mm", "temperature: cannot read '40 mm' as a temperature (got a length)"),
        ("40", "temperature: 40 has no unit"),
        (40, "temperature: 40 has no unit"),
        ("-300 degC", "temperature: must be above absolute zero, -273.15 °C, got '-300 degC'"),
        ("40 delta_degC", "'delta_degC' is a unit of differences"),
        ("40 Δ°C", "is a unit of differences"),
        ([["0 s", "20 degC"]], "temperature: is a list; write e.g. 'points: [[0 s, 23 degC]"),
        ({}, "temperature: give points (e.g."),
        ({"points": []}, "temperature.points: is empty"),
        ({"points": [["0 s", "20 mm"]]}, "temperature.points[1][2]: cannot read '20 mm'"),
        (
            {"points": [["5 s", "20 degC"], ["1 s", "20 degC"]]},
            "temperature.points: times must not decrease",
        ),
        ({"points": HELD, "file": "a.csv"}, "file or sentences"),
        ({"points": HELD, "start": "20 degC"}, "temperature.start: goes with sentences"),
        ({"sentences": "heat to 60 degC in 1 h"}, "sentences: the first temperature is missing"),
        (
            {"sentences": "start at 20 degC; hold for 1 h", "start": "20 degC"},
            "temperature.sentences: sentence 1, 'start at 20 degC': the key start gives",
        ),
        (
            {"sentences": "start at 80 degC; heat to 60 degC in 1 h"},
            "it is 80 °C by then; write 'cool' in place of 'heat'",
        ),
        ({"sentences": "start at 20 degC; start at 30 degC"}, "only the first sentence starts"),
        ({"sentences": "start at 20 degC; press to 3 kN in 1 s"}, "nothing of it was understood"),
        (
            {"sentences": "start at 20 degC; heat to 60 mm in 1 s"},
            "then expected a temperature, got '60 mm in 1 s' (cannot read '60 mm'",
        ),
        ({"kind": "harmonic", "mean": "15 degC", "period": "24 h", "cycles": 1}, "amplitude: is "),
        (
            {"kind": "harmonic", "mean": "1 K", "amplitude": "5 K", "period": "1 h", "cycles": 1},
            "temperature.amplitude: must be less than the mean",
        ),
        ({"kind": "sine", **CYCLE, "cycles": 1}, "unknown value 'sine'; did you mean 'harmonic'?"),
        ({"points": HELD, "loop": 1}, "temperature.loop: unknown key"),
        ("-90 degC", "temperature: material.shift does not hold at -90 °C: WLF: must be used"),
    ],
)  # fmt: skip
def test_mistakes_are_named_at_their_keys(tmp_path: Path, temperature: object, said: str) -> None:
    assert said in refusal(tmp_path, temperature)


@pytest.mark.parametrize(
    ("lists", "said"),
    [
        ({"temperatures": ["20 degC", "10 degC"]}, "shift.temperatures[2]: must be above the one"),
        ({"factors": [1, 10]}, "shift.factors[2]: must not be above the one before"),
        ({"factors": [1]}, "material.shift: temperatures and factors must have equal lengths"),
        ({"vertical": [1]}, "material.shift: vertical must have one factor for each"),
    ],
)
def test_mistakes_in_the_factors_of_a_shift_are_named_at_their_entries(
    tmp_path: Path, lists: dict[str, object], said: str
) -> None:
    shift = {"kind": "factors", "temperatures": ["10 degC", "20 degC"], "factors": [10, 1]}
    assert said in refusal(tmp_path, "15 degC", material={**WARMED, "shift": shift | lists})


def test_columns_of_a_table_are_required(tmp_path: Path) -> None:
    (tmp_path / "day.csv").write_text("time [h],T [mm]\n0,20\n")
    assert "day.csv" in refusal(tmp_path, {"file": "day.csv"})
    (tmp_path / "day.csv").write_text("time [h],force [N]\n0,20\n")
    assert "the column temperature is missing" in refusal(tmp_path, {"file": "day.csv"})
    (tmp_path / "day.csv").write_text("time [h],T [degC],temperature [K]\n0,20,293\n")
    said = refusal(tmp_path, {"file": "day.csv"})
    assert "leave one out with columns: 'temperature [K]='" in said
    left_out = {"file": "day.csv", "columns": "temperature [K]="}
    assert warmed(tmp_path, left_out).temperature == vc.TemperatureHistory([0.0], [293.15])
    (tmp_path / "day.csv").write_text("time [h],T [degC]\n2,20\n1,20\n")
    assert "day.csv:3: time must not decrease" in refusal(tmp_path, {"file": "day.csv"})


def test_two_temperatures_are_refused(tmp_path: Path) -> None:
    own = {**WARMED, "temperature": "30 degC"}
    said = refusal(tmp_path, "40 degC", material=own)
    assert "material.temperature: is 30 °C, and the case gives the temperature" in said
    layers = {"layers": [{"thickness": "1 mm", "material": own}], "base": "rigid"}
    said = refusal(tmp_path, "40 degC", material=layers)
    assert "material.layers[1].material.temperature: is 30 °C" in said
    beside = {"layers": [{"thickness": "1 mm", **own}], "base": "rigid"}
    said = refusal(tmp_path, "40 degC", material=beside)
    assert "material.layers[1].temperature: is 30 °C" in said


def test_temperature_over_time_is_that_of_all_bodies(tmp_path: Path) -> None:
    said = problem(tmp_path, material={**WARMED, "temperature": {"points": HELD}})
    assert "material.temperature: a temperature over time is that of all bodies" in said


def test_material_that_creeps_needs_a_shift_where_the_temperature_varies(tmp_path: Path) -> None:
    assert "material: creeps, and needs a shift" in refusal(
        tmp_path, {"points": HELD}, material=FLUID
    )
    assert "material.base: creeps, and needs a shift" in refusal(
        tmp_path, {"points": HELD}, material=BASE
    )
    assert warmed(tmp_path, "40 degC", material=FLUID).bodies[0] == vc.Material(
        vc.Maxwell(1e6, 1e6), 0.5
    )
    assert "material.shift: needs a temperature to shift to" in problem(tmp_path, material=WARMED)


def test_steady_motion_has_one_temperature(tmp_path: Path) -> None:
    motion = {"kind": "steady", "speed": "0.1 m/s", "rolling": False}
    steady = {"motion": motion, "time": None, "material": WARMED}
    load = {"kind": "step", "force": "1 N", "tilt_y": 0}
    case = read(tmp_path, temperature="40 degC", load=load, **steady)
    assert case.bodies == warmed(tmp_path, "40 degC").bodies
    said = problem(tmp_path, temperature={"points": HELD}, load=load, **steady)
    assert "temperature: it varies, and a steady motion has one temperature" in said


def test_two_problems_are_two_lines(tmp_path: Path) -> None:
    with pytest.raises(CaseError) as found:
        read(tmp_path, material={**FLUID, "ageing": {"age": "1 mm", "exponent": 2}})
    said = "\n".join(found.value.problems)
    assert "material.ageing.age: cannot read '1 mm' as a time" in said
    assert "material.ageing.exponent: must be less than or equal to 1.5" in said
