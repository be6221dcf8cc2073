"""Case files: what they mean, in YAML and TOML, and what their schema says."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viscontact as vc
from case.written_cases import ROLLER, SPHERE, problems, written
from closeness import close_to
from viscontact import tables
from viscontact.case import CaseError, case_schema, read_case
from viscontact.case.quantities import POSITIVE, WithUnit
from viscontact.case.yaml_source import _QUANTITY, parse, parse_value
from viscontact.units.parsing import parse_quantity

EXAMPLES = sorted(
    entry.name
    for entry in files("viscontact.case.examples").iterdir()
    if entry.name.endswith(".yaml")
)


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


def test_history_by_points_and_from_a_file_are_the_same(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time [ms], force [kN]\n0, 0\n1000, 0.01\n1000, 0.004\n")
    points = "[[0 s, 0 N], [1 s, 10 N], [1 s, 4 N]]"
    by_points = read_case(written(tmp_path, SPHERE), [f"load={{kind: history, points: {points}}}"])
    by_file = read_case(written(tmp_path, SPHERE), ["load={kind: history, file: load.csv}"])
    np.testing.assert_allclose(by_file.load.times, by_points.load.times, rtol=1e-15)
    np.testing.assert_allclose(by_file.load.force, by_points.load.force, rtol=1e-15)


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
