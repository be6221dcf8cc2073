"""Case files: what they mean, and that each mistake is one clear line at its key."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

import viscontact as vc
from closeness import close_to
from viscontact import tables
from viscontact.case import CaseError, case_schema, read_case
from viscontact.case.quantities import POSITIVE, WithUnit
from viscontact.case.time_grid_output import Cells
from viscontact.case.yaml_source import _QUANTITY, parse, parse_value
from viscontact.units.parsing import parse_quantity

ROLLER = """\
title: Crowned roller on PMMA, load off centre
indenter:
  shape: roller
  radius: 5 mm
  half_length: 9.565 mm
  crown_radius: 75 mm
material:
  law: creep-series
  instant: 5.545e-4 / MPa
  amplitudes: [6.17e-5 / MPa, 8.38e-5 / MPa]
  times: [10 s, 133.87 s]
  data: deviatoric
  poisson_ratio: 0.38
load:
  kind: step
  force: 10 kN
  eccentricity_x: 4.78 mm
time:
  end: 1000 s
  steps: 120
  spacing: log
grid:
  shape: [256, 128]
  size: [50 mm, 5 mm]
output:
  fields: [0 s, 30 s, 240 s, 1000 s]
"""
SPHERE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 N}
time: {end: 1 s, steps: 4}
"""
EXAMPLES = sorted(
    entry.name
    for entry in files("viscontact.case.examples").iterdir()
    if entry.name.endswith(".yaml")
)


def written(folder: Path, text: str, name: str = "case.yaml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def problems(folder: Path, text: str, *overrides: str, name: str = "case.yaml") -> tuple[str, ...]:
    """Problems of a case file, without the folder in front."""
    with pytest.raises(CaseError) as refusal:
        read_case(written(folder, text, name), overrides)
    return tuple(line.replace(f"{folder}{os.sep}", "") for line in refusal.value.problems)


def test_contract_example_is_read_as_it_says(tmp_path: Path) -> None:
    case = read_case(written(tmp_path, ROLLER))
    assert case.title == "Crowned roller on PMMA, load off centre"
    assert case.indenter == vc.Roller(0.005, 0.009565, 0.075)
    series = vc.CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.87])
    assert case.material == vc.Material(series, 0.38)
    assert case.load == vc.step(10e3, eccentricity_x=0.00478)
    assert case.grid == vc.Grid((256, 128), (0.05, 0.005))
    assert case.fields == (0.0, 30.0, 240.0, 1000.0)
    assert case.indenter_material is None
    assert case.tolerance == 1e-6


def test_fields_are_kept_at_the_very_instants_asked_for(tmp_path: Path) -> None:
    case = read_case(written(tmp_path, ROLLER))
    assert {0.0, 30.0, 240.0, 1000.0} <= set(case.times.tolist())
    assert case.times.size == 121 + 2  # 30 s and 240 s are no steps in log time
    assert (np.diff(case.times) > 0).all()


def test_ten_fields_with_first_and_last_are_kept_by_default(tmp_path: Path) -> None:
    case = read_case(written(tmp_path, SPHERE), ["time.steps=40"])
    assert len(case.fields) == 10
    assert (case.fields[0], case.fields[-1]) == (0.0, 1.0)
    assert case.times.size == 41


@pytest.mark.parametrize("name", EXAMPLES)
def test_shipped_case_is_valid_and_documented(name: str) -> None:
    with as_file(files("viscontact.case.examples") / name) as path:  # data may lie beside it
        text, case = path.read_text(encoding="utf-8"), read_case(path)
    assert case.title
    assert text.startswith("# yaml-language-server: $schema=viscontact.schema.json\n")
    assert f"viscontact example {name.removesuffix('.yaml')} -o my.yaml" in text
    of_paper = name.startswith(
        ("roller-as-printed", "roller-dogbone", "sphere-maxwell", "sphere-z")
    )
    if of_paper:
        assert case.times.size == 121  # 120 steps, none added for the fields
    if name.startswith("roller") and of_paper:
        assert case.grid is not None
        assert np.prod(case.grid.shape) == 2**16
        # Spinu & Cerlinca 2018, eq. 15, at 0, 10, 1000 s
        t = np.array([0.0, 10.0, 1000.0])
        phi = 7e-4 - 6.17e-5 * np.exp(-0.1 * t) - 8.38e-5 * np.exp(-7.47e-3 * t)
        # The last of the printed digits of 1/7.47e-3 s is 1e-7 of it.
        np.testing.assert_allclose(case.material.law(t), phi * 1e-6, rtol=1e-7)


def test_one_long_list_of_everything_that_is_wrong(tmp_path: Path) -> None:
    text = (
        ROLLER.replace("radius: 5 mm", "raduis: 5 mm", 1)
        .replace("kind: step", "kind: stepp")
        .replace("10 kN", "10 MPa")
        .replace("steps: 120", "steps: 1.5")
        .replace("5.545e-4 / MPa", "5.545e-4")
        .replace("[256, 128]", "[256]")
    )
    found = problems(tmp_path, text)
    for expected in (
        "case.yaml:4: indenter.raduis: unknown key; did you mean 'radius'?",
        "case.yaml:3: indenter.radius: is missing",
        "case.yaml:9: material.instant: 0.0005545 has no unit; a compliance is expected",
        "case.yaml:15: load.kind: unknown value 'stepp'; did you mean 'step'?",
        "case.yaml:16: load.force: cannot read '10 MPa' as a force (got a pressure); "
        "write e.g. '10 kN'",
        "case.yaml:20: time.steps: must be a whole number, got 1.5",
    ):
        line = expected.split(": ", 1)[1]
        assert any(line in problem for problem in found), expected
        if "is missing" not in expected:
            assert any(problem.startswith(expected) for problem in found), expected
    assert any("grid.shape" in problem for problem in found)


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("indenter.radius=-5 mm", "indenter.radius: must be more than zero, got '-5 mm'"),
        ("indenter.radius=0 mm", "indenter.radius: must be more than zero"),
        ("indenter.radius=5", "indenter.radius: 5 has no unit"),
        ("indenter.radius=true", "indenter.radius: cannot read True as a length"),
        ("indenter.radius=[5 mm]", "indenter.radius: cannot read ['5 mm'] as a length"),
        ("indenter.radius=.nan", "indenter.radius: 'nan' is not a finite number"),
        ("indenter.profile=logarithmic", "indenter.profile.amplitude: is missing"),
        ("indenter={shape: height-map}", "indenter.file: is missing; NPY, NPZ or a table"),
        ("indenter.shape=5", "indenter.shape: unknown value '5'"),
        ("indenter=[]", "indenter: has too few entries"),
        ("indenter=sphere", "indenter: must be a section with keys of its own, got 'sphere'"),
        ("load.force=-10 N", "load.force: must be zero or more without adhesion, got -10 N"),
        ("load.force=nan N", "load.force: 'nan N' is not a finite number"),
        ("load.force=inf N", "load.force: 'inf N' is not a finite number"),
        ("load.approach=1 mm", "load.force: force and approach exclude each other"),
        ("load.sentences=[ramp to 10 kN in 1 s]", "It goes with kind: history"),
        ("load.kind=sine", "load.kind: unknown value 'sine'; did you mean 'harmonic'?"),
        ("load.tilt_x=1 mrad", "contradict each other"),
        (
            "material.law=power-law",
            "material.compliance: is missing; write e.g. 'compliance: 5.5e-4",
        ),
        (
            "material.law=table",
            "material.file: is missing; table with a header such as: time [s], creep",
        ),
        ("material.law=fractional-zener", "material.equilibrium_modulus: is missing"),
        ("material.times=[1 s]", "must have equal lengths"),
        ("material.times=[1 s, 0 s]", "material.times[2]: must be more than zero"),
        ("material.data=tensile", "material.data: unknown value 'tensile'"),
        ("material.poisson_ratio=0.6", "material.poisson_ratio: must be less than or equal to 0.5"),
        ("material.bulk_modulus=4 GPa", "give poisson_ratio (e.g. 0.38) or bulk_modulus"),
        ("material=pmma", "called 'pmma'; did you mean 'pmma-paper' or 'pmma-kumar-2004'? There"),
        ("material=POM", "called 'POM'; did you mean 'pom-c-23c'? There are pmma-paper"),
        ("material=PEEK", "called 'PEEK'. There are pmma-paper"),
        ("material=PEEK", "or one that creeps: see 'Bring your creep data' in the manual"),
        ("time.steps=0", "time.steps: must be greater than or equal to 1, got 0"),
        ("time.steps=1.5", "time.steps: must be a whole number, got 1.5"),
        ("time.steps=1000000000000", "time.steps: must be less than or equal to 100000"),
        (
            f"grid.shape=[{'9' * 400}, 128]",
            "grid.shape[1]: must be less than or equal to 1000000000",
        ),
        ("grid.size=[1e-99999999999999999999 m, 1 m]", "grid.size[1]: must be more than zero"),
        ("load.force=1e300 N", "load.force: '1e300 N' is beyond what can be computed with"),
        ("load.tilt_x=-1e-300 rad", "load.tilt_x: '-1e-300 rad' is beyond what can be computed"),
        (
            "load.time=1 s",
            "load.time: unknown key. Allowed: approach, eccentricity_x, eccentricity_y, force,",
        ),
        ("load.grid=1", "load.grid: unknown key. Allowed: approach, eccentricity_x, eccentricity"),
        ("material.time=1 s", "material.time: unknown key; did you mean 'times'? Allowed: agei"),
        ("time.output=1", "time.output: unknown key. Allowed: end, first, spacing, steps"),
        ("material.law=prony", "unknown value 'prony'; did you mean 'relaxation-series'?"),
        ("material.law=fractional", "unknown value 'fractional'; did you mean 'fractional-zener'?"),
        ("indenter.shape=wheel", "unknown value 'wheel'; did you mean 'roller'?"),
        ("load.kind=approach", "load.kind: unknown value 'approach'. Allowed: step, ramp"),
        ("time.spacing=adaptive", "time.steps: goes with spacing: uniform or log only"),
        ("time.first=2000 s", "time.first: must be earlier than end"),
        ("grid.shape=[2, 128]", "grid.shape: nx must be a whole number >= 4"),
        ("output.fields=[0 s, 2000 s]", "output.fields: the instant 2000 s lies after the end"),
        ("tolerance=1", "tolerance: must be less than or equal to 0.01"),
        ("loda.force=3 N", "loda: unknown key; did you mean 'load'?"),
        ("title.x=3", "without keys"),
        ("indenter[1].radius=5 mm", "indenter is not a list; leave [1] out"),
        ("[1]=5", "the case file is not a list"),
        ("grid.shape[3]=5", "grid.shape is a list, its entries are [1] to [2]"),
        ("load.force", "write KEY=VALUE"),
    ],
)
def test_bad_value_is_refused_at_its_key(setting: str, said: str, tmp_path: Path) -> None:
    found = problems(tmp_path, ROLLER, setting)
    assert len(found) == 1 or "shape" in setting or "law" in setting or "kind" in setting
    assert any(said in problem for problem in found), found
    # those that were not set stand in the file, on a line
    assert all(problem.startswith(("--set ", "case.yaml:")) for problem in found)


@pytest.mark.parametrize(
    ("material", "said"),
    [
        (
            "{law: maxwell, shear_modulus: 1 MPa, viscosity: 0 Pa s, poisson_ratio: 0.5}",
            "viscosity",
        ),
        ("{law: maxwell, shear_modulus: 1 MPa, poisson_ratio: 0.5}", "viscosity: is missing"),
        (
            "{law: elastic, data: shear, youngs_modulus: 1 MPa, poisson_ratio: 0.5}",
            "youngs_modulus: does not go with data: shear; give shear_modulus",
        ),
        (
            "{law: elastic, shear_modulus: 1 MPa, youngs_modulus: 3 MPa, poisson_ratio: 0.5}",
            "give shear_modulus or youngs_modulus, and only one",
        ),
        ("{law: elastic, poisson_ratio: 0.5}", "or 'youngs_modulus: 1800 MPa'"),
        ("{law: elastic, poisson_ratio: 0.5}", "shear_modulus: is missing"),
        ("{law: elastic, shear_modulus: 1 MPa}", "poisson_ratio"),
        ("{shear_modulus: 1 MPa}", "material.law: is missing"),
        (
            "{law: creep-series, instant: 1 / MPa, amplitudes: [], times: [], poisson_ratio: 0.5}",
            "material.data: is missing",
        ),
    ],
)
def test_bad_material_is_refused_at_its_key(material: str, said: str, tmp_path: Path) -> None:
    assert said in problems(tmp_path, SPHERE, f"material={material}")[0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the file is empty"),
        ("# only a comment\n", "got only comments"),
        ("- a\n- b\n", "got a list"),
        ("5 mm\n", "a case file is a mapping"),
        (SPHERE + "load: {}\n", "case.yaml:5: the key 'load' is given twice"),
        ("load: [1, 2\n", "not valid YAML: while parsing a flow sequence"),
        ("load:\n\tforce: 1 N\n", "case.yaml:2: not valid YAML"),
        ("load: " + "[" * 500 + "]" * 500, "nested too deeply"),
        (
            "a: &a [x, x, x, x, x, x, x, x, x, x]\n"
            + "".join(
                f"{new}: &{new} [{', '.join([f'*{old}'] * 10)}]\n"
                for old, new in zip("abcdef", "bcdefg", strict=True)
            ),
            "expands to more than",
        ),
    ],
)
def test_text_that_is_no_case_is_refused_in_one_line(text: str, said: str, tmp_path: Path) -> None:
    found = problems(tmp_path, text)
    assert len(found) == 1
    assert said in found[0]
    assert "\n" not in found[0]


def test_binary_or_missing_file_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_bytes(bytes(range(256)))
    with pytest.raises(CaseError, match="not a text file"):
        read_case(path)
    path.write_bytes(b"a\x00b: 3")
    with pytest.raises(CaseError, match="not valid YAML"):
        read_case(path)
    with pytest.raises(CaseError, match=r"no such file; did you mean '.*case\.yaml'"):
        read_case(tmp_path / "cas.yaml")
    with pytest.raises(CaseError, match="is a directory"):
        read_case(tmp_path)


def test_history_by_points_and_from_a_file_are_the_same(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time [ms], force [kN]\n0, 0\n1000, 0.01\n1000, 0.004\n")
    points = "[[0 s, 0 N], [1 s, 10 N], [1 s, 4 N]]"
    by_points = read_case(written(tmp_path, SPHERE), [f"load={{kind: history, points: {points}}}"])
    by_file = read_case(written(tmp_path, SPHERE), ["load={kind: history, file: load.csv}"])
    np.testing.assert_allclose(by_file.load.times, by_points.load.times, rtol=1e-15)
    np.testing.assert_allclose(by_file.load.force, by_points.load.force, rtol=1e-15)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("", "load.csv is empty"),
        ("time, force\n0, 1\n", "load.csv:1: column 'time': has no unit"),
        ("time [s], farce [N]\n0, 1\n", "cannot read the column name 'farce [N]'"),
        ("time [s], force [N], T [K]\n0, 1, 3\n", "cannot read the column name 'T [K]'"),
        ("time [s], force [MPa]\n0, 1\n", "as a force (got a pressure)"),
        ("time [s]\n0\n", "the column force is missing"),
        ("time [s], force [N]\n0, x\n", "load.csv:2: column 'force [N]': 'x' is not a number"),
        ("time [s], force [N]\n0\n", "load.csv:2 has 1 entries"),
        ("time [s], force [N]\n0, nan\n", "must be a finite number"),
        ("time [s], force [N]\n2, 1\n1, 1\n", "must not decrease"),
    ],
)
def test_bad_load_table_is_explained(table: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text(table)
    assert said in problems(tmp_path, SPHERE, "load={kind: history, file: load.csv}")[0]


def test_list_of_shapes_is_their_sum_with_errors_counted_from_one(tmp_path: Path) -> None:
    two = "indenter=[{shape: sphere, radius: 5 mm}, {shape: cone, half_angle: 70 deg}]"
    case = read_case(written(tmp_path, SPHERE), [two])
    gap = vc.Sphere(0.005).gap(0.001, 0.0) + vc.Cone(np.radians(70)).gap(0.001, 0.0)
    assert float(case.indenter.gap(0.001, 0.0)) == close_to(float(gap), rel=1e-14)
    found = problems(tmp_path, SPHERE, two.replace("70 deg", "70"))
    assert found[0].startswith("--set indenter[2].half_angle: 70 has no unit")


def test_toml_means_the_same_as_yaml(tmp_path: Path) -> None:
    toml = """
material = {law = "elastic", shear_modulus = "10 MPa", poisson_ratio = 0.5}
[indenter]
shape = "sphere"
radius = "10 mm"
[load]
kind = "step"
force = "1 N"
[time]
end = "1 s"
steps = 4
"""
    ours, theirs = (
        read_case(written(tmp_path, SPHERE)),
        read_case(written(tmp_path, toml, "case.toml")),
    )
    assert (ours.indenter, ours.material, ours.load) == (
        theirs.indenter,
        theirs.material,
        theirs.load,
    )
    found = problems(tmp_path, toml.replace("1 N", "1 m"), name="case.toml")
    assert found[0].startswith("case.toml:8: load.force: cannot read '1 m' as a force")


def test_case_as_run_keeps_comments_and_holds_what_was_set(tmp_path: Path) -> None:
    text = SPHERE + "# keep me\ntolerance: 1e-6  # and me\n"
    assert read_case(written(tmp_path, text)).text == text
    as_run = read_case(written(tmp_path, text), ["load.force=2 N", "output.fields=none"]).text
    assert "# keep me" in as_run
    assert "# and me" in as_run
    again = read_case(written(tmp_path, as_run))
    assert (again.load, again.fields) == (vc.step(2.0), "none")


@pytest.mark.parametrize(
    ("data", "factor"), [("deviatoric", 1.0), ("shear", 0.5), ("uniaxial", 1.38)]
)
def test_data_says_what_a_compliance_means(data: str, factor: float, tmp_path: Path) -> None:
    # CONTRACT 1: Phi = 1/(2G) is not changed; 1/G is twice Phi; Phi = (1 + nu) D, nu = 0.38.
    case = read_case(written(tmp_path, ROLLER), [f"material.data={data}"])
    assert float(case.material.law(0.0)) == close_to(factor * 5.545e-10, rel=1e-14)


def test_shipped_pmma_by_name_is_the_paper_and_the_tensile_data(tmp_path: Path) -> None:
    paper = read_case(written(tmp_path, SPHERE), ["material=pmma-paper"]).material
    tensile = read_case(written(tmp_path, SPHERE), ["material=pmma-kumar-2004"]).material
    # Spinu & Cerlinca 2018, eq. 15 at t = 0, and 1/E(0) of the same data times 1 + nu: the data
    # are rounded to five digits.
    assert float(paper.law(0.0)) == close_to(5.545e-10, rel=1e-12)
    assert float(tensile.law(0.0)) == close_to(1.38 * 5.545e-10, rel=2e-4)
    assert float(tensile.law(1e5)) == close_to(1.38 * 7e-10, rel=2e-4)


def test_schema_names_every_key_and_shows_units() -> None:
    schema = case_schema()
    json.dumps(schema)
    assert set(schema["properties"]) == {
        *("title", "indenter", "material", "indenter_material", "load", "time", "grid", "motion"),
        *("output", "tolerance", "report", "allowable", "temperature", "leakage"),
        *("output", "tolerance", "report", "allowable", "temperature"),
        *("friction", "tangential", "adhesion"),
    }
    radius = schema["$defs"]["Sphere"]["properties"]["radius"]
    assert radius["examples"] == ["5 mm"]
    assert radius["type"] == "string"
    # one shape may stand without the list, and a material may be a name
    assert len(schema["properties"]["indenter"]["anyOf"]) == 2
    names = schema["properties"]["material"]["anyOf"][0]["enum"]
    assert names[:2] == ["pmma-paper", "pmma-kumar-2004"]


def _values_of(key: str, part: object) -> Iterator[Any]:
    """All values of a key, wherever it stands."""
    if isinstance(part, dict):
        yield from [part[key]] if key in part else []
        part = list(part.values())
    for each in part if isinstance(part, list) else []:
        yield from _values_of(key, each)


def test_every_unit_that_the_schema_suggests_is_read() -> None:
    schema = case_schema()
    for dimension, units in schema["x-units"].items():
        assert all(parse_quantity(f"1 {unit}", dimension) > 0 for unit in units)
    asked = list(_values_of("x-dimension", schema["$defs"]))
    assert "length" in asked
    assert ["force", "length", "line load"] in asked  # one of them, as a level of a history
    kinds = {kind for each in asked for kind in ([each] if isinstance(each, str) else each)}
    assert kinds <= set(schema["x-units"])


@pytest.mark.parametrize(
    "tag", ["!!python/object/apply:os.system", "!!python/object/new:os.system", "!call"]
)
def test_tags_that_name_code_do_not_run_it(tag: str, tmp_path: Path) -> None:
    trace = tmp_path / "it-ran"
    case = tmp_path / "case.yaml"
    case.write_text(f'title: {tag} ["touch {trace}"]\n', encoding="utf-8")
    with pytest.raises(CaseError):
        read_case(case)
    assert not trace.exists()


@pytest.mark.parametrize(
    ("grid", "wish"),
    [
        ({"tolerance": "0.5 %", "quantities": ["approach"]}, (0.005, ["approach"])),
        ({"quantities": ["contact_width", "tilt_x"]}, (0.01, ["contact_width", "tilt_x"])),
        ({"tolerance": 0.03}, (0.03, vc.AutomaticGrid().quantities)),
        ({}, (0.01, vc.AutomaticGrid().quantities)),
    ],
)
def test_an_automatic_grid_is_asked_for_in_words(grid, wish):
    assert Cells(**grid).build() == vc.AutomaticGrid(*wish)


def test_a_grid_lies_around_the_centre_that_the_case_gives(tmp_path: Path) -> None:
    place = "grid: {shape: [8, 4], size: [2 mm, 1 mm], centre: [-7 mm, 40 um]}\n"
    assert read_case(written(tmp_path, SPHERE + place)).grid == vc.Grid(
        (8, 4), (2e-3, 1e-3), centre=(-7e-3, 4e-5)
    )
    (found,) = problems(tmp_path, SPHERE + place.replace("40 um", "40"))
    assert found.startswith("case.yaml:5: grid.centre[2]: 40 has no unit; a length is expected")


@pytest.mark.parametrize(
    ("grid", "complaint"),
    [
        ({"tolerance": "2 mm"}, "cannot read '2 mm' as a share; write e.g. '0.5 %'"),
        ({"tolerance": "90 %"}, "less than or equal to 0.5"),
        ({"tolerance": 0.01, "shape": [64, 64]}, "tolerance goes with an automatic grid"),
        ({"shape": [64, 64]}, "size is missing"),
        ({"quantities": []}, "must name some of peak_pressure"),
        ({"centre": ["1 mm", "0 mm"]}, "centre goes with shape and size"),
        ({"centre": ["1 mm", "2 N"]}, "cannot read '2 N' as a length"),
        ({"centre": ["1 mm"]}, "Field required"),
    ],
)
def test_grids_that_are_half_given_are_refused(grid, complaint):
    with pytest.raises(ValidationError, match=re.escape(complaint)):
        Cells(**grid)


def test_every_data_file_of_a_case_is_parsed_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "creep.csv").write_text(
        "time [s], creep_compliance [1/MPa]\n0.1, 1\n1, 2\n10, 3\n", encoding="utf-8"
    )
    (tmp_path / "load.csv").write_text("time [s], force [N]\n0, 0\n1, 5\n", encoding="utf-8")
    text = (
        "indenter: {shape: sphere, radius: 5 mm}\n"
        "material: {law: table, file: creep.csv, quantity: creep_compliance, data: shear,\n"
        "  poisson_ratio: 0.4}\n"
        "load: {kind: history, file: load.csv}\n"
        "time: {end: 1 s, steps: 4}\n"
    )
    parsed: list[str] = []
    read = tables.read_table

    def counting(path: Any, *args: Any, **options: Any) -> Any:
        parsed.append(Path(path).name)
        return read(path, *args, **options)

    monkeypatch.setattr(tables, "read_table", counting)
    read_case(written(tmp_path, text))
    assert sorted(parsed) == ["creep.csv", "load.csv"]


def test_readings_of_one_file_do_not_share_their_values(tmp_path: Path) -> None:
    path = written(tmp_path, ROLLER)
    first = read_case(path, ["load.force=3 N"])
    first.document.data["load"]["force"] = "4 N"
    first.document.lines.clear()
    second = read_case(path)
    assert second.document.data["load"]["force"] != "4 N"
    assert second.document.lines
    assert second.text == path.read_text(encoding="utf-8")
    assert "force: 3 N" in first.text
    path.write_text(ROLLER.replace("title: Crowned", "title: Other"), encoding="utf-8")
    assert read_case(path).title.startswith("Other")


@given(st.from_regex(_QUANTITY, fullmatch=True))
def test_quantities_are_the_texts_that_yaml_reads(text: str) -> None:
    assert parse_value(text) == parse(text)[0] == text.strip()


def test_quantity_of_a_case_is_read_in_si() -> None:
    assert WithUnit("length", POSITIVE).read("5 mm") == 0.005
