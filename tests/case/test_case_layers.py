"""Layers of a body in case files: spellings, files, overrides, and errors at their keys."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
from viscontact.case import CaseError, case_schema, read_case
from viscontact.case.single_material import shipped_material
from viscontact.case.yaml_source import write
from viscontact.results.descriptions import describe, rebuild

ZENER = {
    "law": "zener",
    "shear_modulus": "1 MPa",
    "delayed_modulus": "2 MPa",
    "viscosity": "3 MPa s",
    "poisson_ratio": 0.499,
}
STEEL = {"law": "elastic", "shear_modulus": "80 GPa", "poisson_ratio": 0.3}
COVER = {"layers": [{"thickness": "5 mm", **ZENER}], "base": STEEL}

RUBBER = vc.Material(vc.Zener(1e6, 2e6, 3e6), 0.499)
CORE = vc.Material(vc.Elastic(80e9), 0.3)


def written(folder: Path, material: Any, **others: Any) -> Path:
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


def problem(folder: Path, material: Any) -> str:
    with pytest.raises(CaseError) as refused:
        read_case(written(folder, material))
    return "\n".join(line.partition(": ")[2] for line in refused.value.problems)


@pytest.mark.parametrize(
    "layer",
    [
        {"thickness": "5 mm", **ZENER},
        {"thickness": "5 mm", "material": ZENER},
        {"material": ZENER, "thickness": "0.5 cm"},
    ],
)
@pytest.mark.parametrize("named", [{}, {"law": "layered"}])
def test_keys_of_a_layer_are_beside_its_thickness_or_below_material(
    layer: Any, named: Any, tmp_path: Path
) -> None:
    case = read_case(written(tmp_path, {**named, "layers": [layer], "base": STEEL}))
    assert case.material == vc.Layered([vc.Layer(5e-3, RUBBER)], base=CORE)


def test_stack_of_a_case_is_read_from_the_surface_down(tmp_path: Path) -> None:
    layers = [COVER["layers"][0], {"thickness": "2 mm", "material": "epdm-70-25c"}]
    stack = {"layers": layers, "base": "rigid", "bonded": [True, False]}
    case = read_case(written(tmp_path, stack))
    inner = vc.Layer(2e-3, shipped_material("epdm-70-25c"))
    expected = vc.Layered([vc.Layer(5e-3, RUBBER), inner], "rigid", (True, False))
    assert case.material == expected
    assert case.material.layers[1].material.known_until == 15.9


def test_indenter_may_be_covered(tmp_path: Path) -> None:
    case = read_case(written(tmp_path, STEEL, indenter_material=COVER))
    assert case.indenter_material == vc.Layered([vc.Layer(5e-3, RUBBER)], base=CORE)


@pytest.mark.parametrize("base", ["pmma-paper", {"material": "pmma-paper"}])
def test_base_may_be_a_name_of_the_library(base: Any, tmp_path: Path) -> None:
    case = read_case(written(tmp_path, {**COVER, "base": base}))
    assert case.material.base == shipped_material("pmma-paper")


def test_keys_beside_a_name_replace_those_of_the_library(tmp_path: Path) -> None:
    layer = {"thickness": "5 mm", "material": "epdm-70-25c", "bulk_modulus": "2 GPa"}
    case = read_case(written(tmp_path, {"layers": [layer], "base": "rigid"}))
    shipped = shipped_material("epdm-70-25c")
    found = case.material.layers[0].material
    assert (found.law, found.bulk_modulus, found.poisson_ratio) == (shipped.law, 2e9, None)
    single = read_case(written(tmp_path, {"material": "epdm-70-25c", "poisson_ratio": 0.4}))
    assert (single.material.law, single.material.poisson_ratio) == (shipped.law, 0.4)


def test_files_of_layers_are_those_of_the_run(tmp_path: Path) -> None:
    law = tmp_path / "law.yaml"
    law.write_text(write(ZENER), encoding="utf-8")
    table = tmp_path / "base.csv"
    table.write_text("time [s], G [MPa]\n0, 3\n10, 2\n100, 1.5\n", encoding="utf-8")
    layers = [{"thickness": "5 mm", "file": "law.yaml"}]
    base = {"law": "table", "file": "base.csv", "poisson_ratio": 0.4}
    case = read_case(written(tmp_path, {"layers": layers, "base": base}))
    assert case.material.layers[0].material == RUBBER
    assert {key: path.name for key, path in case.files.items()} == {
        ("material", "layers", 0, "file"): "law.yaml",
        ("material", "base", "file"): "base.csv",
    }
    # The case beside the result names the copies, so that it can be run again there.
    copy = tmp_path / "copy"
    copy.mkdir()
    (copy / "case.yaml").write_text(case.text, encoding="utf-8")
    for path, name in case.file_names.items():
        (copy / name).write_bytes(path.read_bytes())
    assert read_case(copy / "case.yaml").material == case.material


def test_file_of_a_layer_is_at_the_key_where_it_is_written(tmp_path: Path) -> None:
    """Beside the thickness or under `material`, where it is replaced by that of a copy."""
    text = "time [s], G [MPa]\n0, 3\n10, 2\n100, 1.5\n"
    (tmp_path / "one.csv").write_text(text, encoding="utf-8")
    text = "f [Hz], G' [MPa], G'' [MPa]\n0.01, 1, 0.2\n0.1, 1.5, 0.4\n1, 2, 0.2\n"
    (tmp_path / "other.csv").write_text(text, encoding="utf-8")
    one, other = (
        {"law": "table", "file": name, "poisson_ratio": 0.4} for name in ("one.csv", "other.csv")
    )
    layers = [{"thickness": "5 mm", **one}, {"thickness": "2 mm", "material": other}]
    case = read_case(written(tmp_path, {"layers": layers, "base": STEEL}))
    assert {key: path.name for key, path in case.files.items()} == {
        ("material", "layers", 0, "file"): "one.csv",
        ("material", "layers", 1, "material", "file"): "other.csv",
    }
    [note] = case.notes
    assert note.startswith("layers.1.material: the law is a relaxation series of ")


def test_recorded_layers_are_rebuilt(tmp_path: Path) -> None:
    found = read_case(written(tmp_path, COVER)).material
    assert rebuild(json.loads(json.dumps(describe(found)))) == found


def test_toml_has_layers(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(
        """
indenter = {shape = "sphere", radius = "10 mm"}
load = {kind = "ramp", force = "1 N", duration = "1 s"}
time = {end = "2 s", steps = 4}
[material]
base = {law = "elastic", shear_modulus = "80 GPa", poisson_ratio = 0.3}
[[material.layers]]
thickness = "5 mm"
law = "zener"
shear_modulus = "1 MPa"
delayed_modulus = "2 MPa"
viscosity = "3 MPa s"
poisson_ratio = 0.499
""",
        encoding="utf-8",
    )
    assert read_case(path).material == vc.Layered([vc.Layer(5e-3, RUBBER)], base=CORE)
    thicker = read_case(path, ["material.layers[1].thickness=7 mm"])
    assert thicker.material.layers[0].thickness == 7e-3
    assert "thickness: 7 mm" in thicker.text


def test_override_reaches_a_layer(tmp_path: Path) -> None:
    path = written(tmp_path, COVER)
    changed = read_case(
        path,
        ["material.layers[1].thickness=7mm", "material.layers[1].viscosity=4 MPa s"],
    )
    softer = vc.Material(vc.Zener(1e6, 2e6, 4e6), 0.499)
    assert changed.material == vc.Layered([vc.Layer(7e-3, softer)], base=CORE)
    assert read_case(path, ["material.base=rigid"]).material.base == "rigid"
    with pytest.raises(CaseError, match=r"layers is a list, its entries are \[1\] to \[1\]"):
        read_case(path, ["material.layers[2].thickness=7mm"])


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"thickness": 5}, "material.layers[1].thickness: 5 has no unit"),
        ({"thickness": None}, "material.layers[1].thickness: cannot read"),
        ({"poisson_ratio": 0.7}, "material.layers[1].poisson_ratio: must be less"),
        ({"bulk_modulus": "2 GPa"}, "material.layers[1].poisson_ratio: give poisson_ratio"),
        ({"thicknes": "5 mm"}, "material.layers[1].thicknes: unknown key; did you mean 'thickn"),
        ({"law": "zenner"}, "material.layers[1].law: unknown value 'zenner'; did you mean 'zener'"),
        ({"law": "layered"}, "material.layers[1].law: unknown value 'layered'"),
    ],
)  # fmt: skip
def test_error_in_a_layer_is_at_its_key(change: Any, expected: str, tmp_path: Path) -> None:
    layer = {"thickness": "5 mm", **ZENER, **change}
    assert problem(tmp_path, {**COVER, "layers": [layer]}).startswith(expected)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"layers": []}, "material.layers: has too few entries"),
        ({"layers": {"thickness": "5 mm"}}, "material.layers: must be a list"),
        ({"layers": [ZENER]}, "material.layers[1].thickness: is missing; write e.g. 'thickness: 5"),
        ({"layers": [{"thickness": "5 mm"}]}, "material.layers[1].material: is missing; material"),
        ({"layers": [{"thickness": "5 mm", "shear_modulus": "1 MPa"}]},
         "material.layers[1].law: is missing; choose one of: elastic"),
        ({"layers": [{"thickness": "5 mm", "material": {**ZENER, "thickness": "1 mm"}}]},
         "material.layers[1].material.thickness: belongs to the layer"),
        ({"layers": [{"thickness": "5 mm", "material": "epdm"}]},
         "material.layers[1].material: no shipped material is called 'epdm'; did you mean 'epdm-7"),
        ({"layers": [{"thickness": "5 mm", "material": "epdm-70-25c", "bulk_modulus": 2}]},
         "material.layers[1].bulk_modulus: 2 has no unit"),
        ({"base": "rigd"}, "material.base: no shipped material is called 'rigd'"),
        ({"base": {**STEEL, "thickness": "1 mm"}}, "material.base.thickness: the base is as deep"),
        ({"base": {**STEEL, "poisson_ratio": 2}}, "material.base.poisson_ratio: must be less"),
        ({"bonded": [True, True]},
         "material.bonded: must be true or false, or one of them for each of the 1 layers, got 2"),
        ({"bonded": "yes"}, "material.bonded: must be true or false, or a list of one"),
    ],
)  # fmt: skip
def test_error_in_layers_is_at_its_key(change: Any, expected: str, tmp_path: Path) -> None:
    assert problem(tmp_path, {**COVER, **change}).startswith(expected)


def test_layers_without_base_are_refused(tmp_path: Path) -> None:
    found = problem(tmp_path, {"layers": COVER["layers"]})
    assert (
        found == "material.base: is missing; material beneath the layers, infinitely deep, or "
        "rigid; write e.g. 'base: rigid'"
    )


def test_law_beside_layers_is_refused(tmp_path: Path) -> None:
    assert "material.layers: unknown key." in problem(tmp_path, {**ZENER, **COVER})


def test_schema_has_both_spellings_of_a_layer() -> None:
    defined = case_schema()["$defs"]
    nested, beside = defined["Layers"]["properties"]["layers"]["items"]["anyOf"]
    assert nested == {"$ref": "#/$defs/Layer"}
    assert beside["required"] == ["thickness", "law"]
    assert {"$ref": "#/$defs/Zener"} in beside["oneOf"]
    assert defined["Layer"]["required"] == ["thickness", "material"]
    assert defined["Layers"]["required"] == ["layers", "base"]
    assert {"enum": ["rigid"]} in defined["Layers"]["properties"]["base"]["anyOf"]


@pytest.mark.parametrize("nested", [True, False])
def test_layer_expands_by_keys_beside_its_thickness(nested: bool, tmp_path: Path) -> None:
    heat = {"expansion": "1.8e-4 / K", "expansion_from": "23 degC"}
    layer = {"thickness": "5 mm", **heat, **({"material": ZENER} if nested else ZENER)}
    material = read_case(written(tmp_path, {"layers": [layer], "base": "rigid"})).material
    assert isinstance(material, vc.Layered)
    assert material.layers[0] == vc.Layer(5e-3, RUBBER, expansion=1.8e-4, expansion_from=296.15)
    assert rebuild(json.loads(json.dumps(describe(material)))) == material


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"expansion": "1.8e-4 / K"}, "expansion and expansion_from belong together"),
        ({"expansion_from": "23 degC"}, "expansion and expansion_from belong together"),
        ({"expansion": "1.8e-4", "expansion_from": "23 degC"}, "1.8e-4 / K"),
        ({"expansion": "180 / K", "expansion_from": "23 degC"}, "at most 0.01"),
    ],
)
def test_expansion_of_a_layer_is_checked(keys: Any, message: str, tmp_path: Path) -> None:
    layers = [{"thickness": "5 mm", "material": ZENER, **keys}]
    assert message in problem(tmp_path, {"layers": layers, "base": "rigid"})


def test_half_space_has_no_expansion(tmp_path: Path) -> None:
    found = problem(tmp_path, {**COVER, "base": {**STEEL, "expansion": "1e-5 / K"}})
    assert "expansion" in found
