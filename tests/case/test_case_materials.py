"""The materials of case files: laws by formula, by table, by card, at a temperature."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import Case, CaseError, case_schema, read_case, read_material
from viscontact.case.yaml_source import write
from viscontact.cli import main

PMMA = "time [s]; creep_compliance [1/GPa]\n0; 0,2\n10; 0,3\n1000; 0,5\n"
CARD = """\
*Material, name=A
*Elastic, moduli=INSTANTANEOUS
3000., 0.5
*Viscoelastic, time=PRONY
0.5, 0., 10.
*Trs
25., 17.44, 51.6
"""
TABLE = {
    "law": "table",
    "file": "pmma.csv",
    "quantity": "creep_compliance",
    "data": "shear",
    "poisson_ratio": 0.38,
}
WLF = {"kind": "wlf", "reference_temperature": "25 degC", "c1": 17.44, "c2": "51.6 K"}
MAXWELL = {
    "law": "maxwell",
    "shear_modulus": "1 GPa",
    "viscosity": "10 GPa s",
    "poisson_ratio": 0.3,
}
CARDED = {"law": "card", "file": "a.inp", "modulus_unit": "MPa", "time_unit": "s",
          "temperature_unit": "degC"}  # fmt: skip


def written(folder: Path, material: Any, files: dict[str, str], **others: Any) -> Path:
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    path = folder / "case.yaml"
    case = {
        "indenter": {"shape": "sphere", "radius": "10 mm"},
        "load": {"kind": "ramp", "force": "1 N", "duration": "1 s"},
        "time": {"end": "2 s", "steps": 4},
        "material": material,
        **others,
    }
    path.write_text(write(case), encoding="utf-8")
    return path


def read(folder: Path, material: Any, files: dict[str, str] | None = None, **others: Any) -> Case:
    return read_case(written(folder, material, files or {}, **others))


def problem(folder: Path, material: Any, files: dict[str, str] | None = None) -> str:
    with pytest.raises(CaseError) as refusal:
        read(folder, material, files)
    return refusal.value.problems[0].replace(f"{folder}{os.sep}", "")


@pytest.mark.parametrize(
    ("material", "law"),
    [
        (
            {"law": "power-law", "compliance": "2 / GPa", "exponent": 0.3,
             "reference_time": "1 min", "instant": "1 / GPa", "data": "deviatoric"},
            vc.PowerLaw(2e-9, 0.3, 60.0, 1e-9),
        ),
        (
            {"law": "power-law", "compliance": "2 / GPa", "exponent": 0.3,
             "reference_time": "1 min", "data": "shear"},
            vc.PowerLaw.from_shear(2e-9, 0.3, 60.0),
        ),
        (
            {"law": "power-law", "compliance": "2 / GPa", "exponent": 1,
             "reference_time": "1 min", "data": "uniaxial"},
            vc.PowerLaw.from_uniaxial(2e-9, 1.0, 60.0, poisson_ratio=0.38),
        ),
        (
            {"law": "fractional-maxwell", "shear_modulus": "1 MPa", "time": "5 ms",
             "exponent": 0.4, "second_exponent": 0.1},
            vc.FractionalMaxwell(1e6, 0.005, 0.4, 0.1),
        ),
        (
            {"law": "fractional-maxwell", "youngs_modulus": "1 MPa", "time": "5 ms",
             "exponent": 0.4, "data": "uniaxial"},
            vc.FractionalMaxwell.from_uniaxial(1e6, 0.005, 0.4, poisson_ratio=0.38),
        ),
        (
            {"law": "elastic", "youngs_modulus": "210 GPa"},  # which says that it is uniaxial
            vc.Elastic.from_uniaxial(210e9, poisson_ratio=0.38),
        ),
        (
            {"law": "fractional-zener", "shear_modulus": "3 MPa",
             "equilibrium_modulus": "0 MPa", "time": "2 s", "exponent": 0.5},
            vc.FractionalZener(3e6, 0.0, 2.0, 0.5),
        ),
        (
            {"law": "fractional-zener", "youngs_modulus": "3 MPa",
             "equilibrium_modulus": "1 MPa", "time": "2 s", "exponent": 0.5, "data": "uniaxial"},
            vc.FractionalZener.from_uniaxial(3e6, 1e6, 2.0, 0.5, poisson_ratio=0.38),
        ),
    ],
)  # fmt: skip
def test_law_by_formula_is_the_law_made_by_hand(
    material: dict[str, Any], law: vc.Law, tmp_path: Path
) -> None:
    found = read(tmp_path, {**material, "poisson_ratio": 0.38}).material
    assert found == vc.Material(law, 0.38)


@pytest.mark.parametrize(
    ("data", "factor"), [("deviatoric", 1.0), ("shear", 0.5), ("uniaxial", 1.38)]
)
def test_table_is_used_at_its_own_times_whatever_its_test(
    data: str, factor: float, tmp_path: Path
) -> None:
    # Phi = 1/(2G) is not changed; 1/G is twice Phi; Phi = (1 + nu) D, nu = 0.38.
    law = read(tmp_path, {**TABLE, "data": data}, {"pmma.csv": PMMA}).material.law
    assert isinstance(law, vc.TabulatedCreep)
    np.testing.assert_allclose(
        law([0.0, 10.0, 1000.0]), factor * np.array([2e-10, 3e-10, 5e-10]), rtol=1e-14
    )
    assert law.measured_until == 1000.0


def test_table_of_moduli_and_its_options(tmp_path: Path) -> None:
    text = "t,E_relax\ns,MPa\n1,3000\n10,2000\n"
    material = {**TABLE, "quantity": "relaxation_modulus", "data": "uniaxial",
                "before": "slope", "beyond": "last"}  # fmt: skip
    law = read(tmp_path, material, {"pmma.csv": text}).material.law
    assert law == vc.TabulatedRelaxation.from_uniaxial(
        [1.0, 10.0], [3e9, 2e9], poisson_ratio=0.38, before="slope", beyond="last"
    )


def test_one_set_of_a_table_is_read_by_its_number(tmp_path: Path) -> None:
    text = "t [s], G [Pa], T [C], Set\n1, 3, 20, 7\n2, 2, 20, 7\n1, 5, 0, 8\n2, 4, 0, 8\n"
    material = {**TABLE, "quantity": "relaxation_modulus", "set": 8}
    law = read(tmp_path, material, {"pmma.csv": text}).material.law
    assert law.modulus == (5.0, 4.0)
    del material["set"]
    said = "material.file: pmma.csv has 2 sets; say which with set: 7 (20 °C), 8 (0 °C)"
    assert said in problem(tmp_path, material)
    assert "pmma.csv has no set 9; 7 (20 °C), 8 (0 °C)" in problem(tmp_path, {**material, "set": 9})


def test_columns_of_a_table_are_said_where_their_headings_do_not(tmp_path: Path) -> None:
    text = "t [s], stiffness [MPa]\n1, 3\n2, 2\n"
    material = {**TABLE, "quantity": "relaxation_modulus"}
    assert "column relaxation_modulus is missing; there are time ('t [s]'); not known: " in problem(
        tmp_path, material, {"pmma.csv": text}
    )
    material["columns"] = {"stiffness": "relaxation_modulus"}
    assert read(tmp_path, material).material.law.modulus == (3e6, 2e6)


def test_temperature_shifts_every_time_of_the_law(tmp_path: Path) -> None:
    # Williams, Landel and Ferry 1955: log10 a_T = -17.44 (T - Tg)/(51.6 + T - Tg)
    factor = 10.0 ** (-17.44 * 35 / (51.6 + 35))
    material = {**MAXWELL, "temperature": "60 degC", "shift": WLF, "measured_until": "100 s"}
    found = read(tmp_path, material).material
    t = np.array([0.0, 1e-4, 1.0])
    np.testing.assert_allclose(found.law(t), vc.Maxwell(1e9, 1e10)(t / factor), rtol=1e-12)
    assert found.measured_until == close_to(100 * factor, rel=1e-12)
    at_reference = read(tmp_path, {**material, "temperature": "298.15 K"}).material
    rule = vc.WLF(298.15, 17.44, 51.6)
    assert at_reference == vc.Material(vc.Maxwell(1e9, 1e10), 0.3, measured_until=100.0, shift=rule)
    assert found.shift.factor(298.15) == close_to(1 / factor, rel=1e-12)


def test_arrhenius_and_measured_factors_shift_too(tmp_path: Path) -> None:
    arrhenius = {"kind": "arrhenius", "reference_temperature": "20 degC",
                 "activation_energy": "80 kJ/mol"}  # fmt: skip
    material = {**MAXWELL, "temperature": "30 degC", "shift": arrhenius}
    factor = np.exp(8e4 / 8.31446261815324 * (1 / 303.15 - 1 / 293.15))
    law = read(tmp_path, material).material.law
    assert law(1.0) == close_to(vc.Maxwell(1e9, 1e10)(1 / factor), rel=1e-12)
    material["shift"] = {"kind": "factors", "file": "factors.csv"}
    rows = "T,log_aT\nC,-\n40,-2\n20,0\n"  # as exported: from warm to cold
    found = read(tmp_path, material, {"factors.csv": rows})
    assert found.material.law(1.0) == close_to(vc.Maxwell(1e9, 1e10)(10.0), rel=1e-12)
    assert dict(found.files) == {("material", "shift", "file"): tmp_path / "factors.csv"}


def test_factors_in_the_case_shift_times_and_moduli(tmp_path: Path) -> None:
    shift = {"kind": "factors", "temperatures": ["20 degC", "40 degC"], "factors": [1, 0.01]}
    material = {**MAXWELL, "temperature": "30 degC", "shift": {**shift, "vertical": [1, 1.21]}}
    law = read(tmp_path, material).material.law
    assert law(1.0) == close_to(vc.Maxwell(1e9, 1e10)(10.0) / 1.1, rel=1e-12)
    # With the temperature of the law, a run without another one is computed at it.
    referred = {**shift, "reference_temperature": "20 degC"}
    found = read(tmp_path, {**MAXWELL, "shift": referred}).material
    assert found.law == vc.Maxwell(1e9, 1e10)
    assert found.shift == vc.TabulatedShift([293.15, 313.15], [1.0, 0.01])


def test_card_gives_law_volume_and_shift(tmp_path: Path) -> None:
    found = read(tmp_path, CARDED, {"a.inp": CARD}).material
    plain = vc.Material(vc.RelaxationSeries(0.5e9, [0.5e9], [10.0]), 0.5)
    assert found == replace(plain, shift=vc.WLF(298.15, 17.44, 51.6))
    factor = float(vc.WLF(298.15, 17.44, 51.6).factor(313.15))
    warm = read(tmp_path, {**CARDED, "temperature": "40 degC"}).material
    assert warm.law.times == close_to([10.0 * factor], rel=1e-14)
    ansys = "MP,EX,3,3000\nMP,PRXY,3,0.5\nTB,PRONY,3,1,1,SHEAR\nTBDATA,1,0.5,10\n"
    assert read(tmp_path, {**CARDED, "name": "3"}, {"a.inp": ansys}).material == plain


@pytest.mark.parametrize(
    ("changes", "table", "said"),
    [
        ({"file": "pma.csv"}, PMMA, "material.file: no such file pma.csv; did you mean 'pmm"),
        ({"data": "tensile"}, PMMA, "material.data: unknown value 'tensile'"),
        ({"quantity": "relaxation"}, PMMA, "value 'relaxation'; did you mean 'relaxation_modulus'"),
        ({"quantity": "relaxation_modulus", "data": "deviatoric"}, PMMA,
         "material.data: moduli are shear or uniaxial; deviatoric is a compliance"),
        ({"data": "uniaxial"}, PMMA.replace("creep_compliance", "J"),
         "material.data: uniaxial contradicts pmma.csv, where the column 'J [1/GPa]' is shear"),
        ({}, PMMA.replace("1/GPa", "GPa"), "file: pmma.csv:1: column 'creep_compliance [GPa]'"),
        ({}, PMMA + "2000; 0,4\n",
         "material.file: pmma.csv:5: column 'creep_compliance [1/GPa]': must not fall: a body"),
        ({}, PMMA + "5; 0,6\n", "pmma.csv:5: column 'time [s]': must be after line 4"),
        ({}, PMMA + "2000; nan\n", "pmma.csv:5: column 'creep_compliance [1/GPa]': must be"),
        ({}, PMMA + "2000; -1\n", "column 'creep_compliance [1/GPa]': must be positive"),
        ({"data": "uniaxial", "poisson_ratio": None, "bulk_modulus": "0.4 GPa"},
         PMMA, "pmma.csv:2: column 'creep_compliance [1/GPa]': bulk_modulus 400 MPa is too"),
        ({"columns": {"x": "time"}}, PMMA, "material.columns: pmma.csv has no column 'x'; there"),
        ({"set": 3}, PMMA, "material.file: pmma.csv has no set 3"),
        ({"temperature": "60 degC"}, PMMA, "material.temperature: needs a shift, e.g. '{kind: wlf"),
        ({"shift": WLF}, PMMA, "material.shift: needs a temperature to shift to"),
        ({"temperature": "60 degC", "shift": {**WLF, "kind": "wlff"}}, PMMA,
         "material.shift.kind: unknown value 'wlff'; did you mean 'wlf'? Allowed: wlf, arrhenius"),
        ({"temperature": "60 degC", "shift": {**WLF, "c2": "-5 K"}}, PMMA,
         "material.shift.c2: must be more than zero"),
        ({"temperature": "60 degC", "shift": {"c1": 3}}, PMMA,
         "material.shift.kind: is missing; choose one of: wlf, arrhenius, factors"),
        ({"temperature": "-60 degC", "shift": WLF}, PMMA, "material.shift: must be used above"),
        ({"temperature": "60 degC", "shift": WLF},
         "t [s], J [1/GPa], T [degC]\n1, 1, 40\n2, 2, 40\n",
         "material.shift: its reference_temperature is 25 °C, and pmma.csv was measured at 40 °C"),
        ({"temperature": "60 degC", "shift": {"kind": "factors"}}, PMMA,
         "material.shift: give a file, or temperatures and factors"),
        ({"shift": {"kind": "factors", "temperatures": ["20 degC", "40 degC"], "factors": [1, 0.1],
                    "reference_temperature": "40 degC"}}, PMMA,
         "material.shift.reference_temperature: must be the temperature of the law"),
        ({"temperature": "60 degC", "shift": {"kind": "factors", "file": "pmma.csv"}}, PMMA,
         "material.shift.file: pmma.csv: the column temperature is missing"),
        ({"temperature": "60 °C", "law": "tabel"}, PMMA, "unknown value 'tabel'; did you mean"),
        ({"viscosity": "1 Pa s"}, PMMA, "material.viscosity: unknown key. Allowed: "),
    ],
)  # fmt: skip
def test_bad_table_or_shift_is_refused_at_its_key(
    changes: dict[str, Any], table: str, said: str, tmp_path: Path
) -> None:
    given = {**TABLE, **changes}
    if given["poisson_ratio"] is None:
        del given["poisson_ratio"]
    found = problem(tmp_path, given, {"pmma.csv": table})
    assert found.startswith("case.yaml:")
    assert said in found
    assert "\n" not in found


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"modulus_unit": "mm"}, "material.modulus_unit: cannot read 'mm' as a pressure"),
        ({"temperature_unit": "m"}, "material.temperature_unit: cannot read 'm' as a temperature"),
        ({"temperature_unit": None}, "a.inp:6: has temperatures, and cards do not say their unit"),
        ({"name": "B"}, "material.file: a.inp: has no material 'B'; there are 'A'"),
        ({"poisson_ratio": 0.3}, "material.poisson_ratio: is given in the card; leave it out"),
        ({"shift": WLF, "temperature": "30 degC"}, "material.shift: is given in the card"),
        ({"instant": "1 / MPa"}, "material.instant: unknown key"),
    ],
)
def test_bad_card_is_refused_at_its_key(changes: dict[str, Any], said: str, tmp_path: Path) -> None:
    given = {**CARDED, **changes}
    assert said in problem(tmp_path, given, {"a.inp": CARD})


@pytest.mark.parametrize("material", [MAXWELL, TABLE, CARDED | {"temperature": "40 degC"}])
def test_thickness_is_given_with_any_law(material: dict[str, Any], tmp_path: Path) -> None:
    files = {"pmma.csv": PMMA, "a.inp": CARD}
    case = read(
        tmp_path,
        material | {"thickness": "10 mm"},
        files,
        indenter_material=MAXWELL | {"thickness": "2 cm"},
    )
    assert case.material.thickness == 0.01
    assert case.indenter_material is not None
    assert case.indenter_material.thickness == 0.02
    assert read(tmp_path, material, files).material.thickness is None


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("0 mm", "material.thickness: must be more than zero, got '0 mm'"),
        ("5 N", "material.thickness: cannot read '5 N' as a length"),
        (5, "material.thickness: 5 has no unit"),
    ],
)
def test_thickness_is_a_length(given: object, said: str, tmp_path: Path) -> None:
    assert said in problem(tmp_path, MAXWELL | {"thickness": given})


def test_material_alone_may_be_a_table(tmp_path: Path) -> None:
    (tmp_path / "pmma.csv").write_text(PMMA, encoding="utf-8")
    (tmp_path / "material.yaml").write_text(write(TABLE), encoding="utf-8")
    assert read_material(tmp_path / "material.yaml").law(10.0) == close_to(1.5e-10, rel=1e-14)


def test_files_travel_with_the_run_even_if_they_are_called_alike(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    case = written(
        tmp_path,
        {**TABLE, "file": "data/one.csv", "temperature": "30 degC",
         "shift": {"kind": "factors", "file": "data/case.yaml"}},
        {"data/one.csv": PMMA, "data/case.yaml": "T [degC], aT\n20, 10\n40, 0.1\n",
         "loads/one.csv": "time [s], force [N]\n0, 0\n1, 4\n"},
        load={"kind": "history", "file": "loads/one.csv"},
        indenter_material={**TABLE, "file": "data/one.csv"},
        grid={"shape": [16, 16], "size": ["0.5 mm", "0.5 mm"]},
    )  # fmt: skip
    found = read_case(case)
    assert sorted(found.file_names.values()) == [
        "material-case.yaml", "material-one.csv", "one.csv",
    ]  # fmt: skip
    assert main(["run", str(case), "-q", "-o", "first"]) == 0
    for folder in ("data", "loads"):
        for file in (tmp_path / folder).iterdir():
            file.unlink()
    # the run's own case runs again from where it lies
    assert main(["run", "first/case.yaml", "-q", "-o", "second"]) == 0
    with vc.open_results("first") as first, vc.open_results("second") as second:
        np.testing.assert_array_equal(first.approach, second.approach)


def test_schema_knows_every_law_and_shift() -> None:
    schema = case_schema()
    tagged = next(
        branch for branch in schema["properties"]["material"]["anyOf"] if "discriminator" in branch
    )
    assert {"power-law", "fractional-zener", "table", "card"} <= set(
        tagged["discriminator"]["mapping"]
    )
    table = schema["$defs"]["TableLaw"]
    assert set(table["required"]) == {"law", "file"}  # the headings state the rest
    assert schema["$defs"]["Wlf"]["properties"]["c2"]["examples"] == ["51.6 K"]
    assert table["properties"]["temperature"]["anyOf"][0]["examples"] == ["25 degC"]
