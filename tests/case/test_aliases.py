"""Other words for keys: aliases, synonyms in messages, and what is refused by name."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
from viscontact.case import Case, CaseError, case_schema, read_case

CASE: dict[str, Any] = {
    "indenter": {"shape": "sphere", "radius": "10 mm"},
    "material": {"law": "elastic", "shear_modulus": "10 MPa", "poisson_ratio": 0.5},
    "load": {"kind": "step", "force": "1 N"},
    "time": {"end": "10 s", "steps": 4},
}
CROWNED = {"shape": "roller", "radius": "5 mm", "crown_radius": "75 mm"}
SHARP = {"shape": "roller", "radius": "5 mm"}
CYCLES = {"kind": "harmonic", "mean": "3 N", "amplitude": "2 N", "cycles": 5}


def read(folder: Path, *settings: str, **sections: Any) -> Case:
    """The case with sections replaced, on a line each; JSON is YAML too."""
    path = folder / "case.yaml"
    text = ",\n".join(f'"{key}": {json.dumps(of)}' for key, of in {**CASE, **sections}.items())
    path.write_text(f"{{{text}}}", encoding="utf-8")
    return read_case(path, settings)


def problems(folder: Path, *settings: str, **sections: Any) -> list[str]:
    """Problems of a case, without the folder in front."""
    with pytest.raises(CaseError) as refusal:
        read(folder, *settings, **sections)
    return [line.replace(f"{folder}{os.sep}", "") for line in refusal.value.problems]


# --- aliases ------------------------------------------------------------------------------------


def test_diameter_is_twice_the_radius_to_the_last_digit(tmp_path: Path) -> None:
    found = read(tmp_path, indenter={"shape": "sphere", "diameter": "19.13 mm"})
    assert found.indenter == vc.Sphere(0.009565)
    assert "radius: 9.565 mm" in found.text
    assert "diameter" not in found.text
    assert found.document.data_as_typed["indenter"]["diameter"] == "19.13 mm"


def test_a_crowned_roller_has_a_total_and_a_straight_length(tmp_path: Path) -> None:
    lengths = {"straight_length": "18 mm", "length": "20 mm"}
    found = read(tmp_path, indenter=CROWNED | lengths).indenter
    assert found == vc.Roller(5e-3, 9e-3, 75e-3, "partial", end_length=10e-3)
    # Beyond 10 mm from its middle there is no body; 1 mm behind the straight part there is.
    assert vc.Roller.gap(found, [9.999e-3, 10.001e-3], 0.0)[1] == float("inf")
    assert 0 < found.gap(9.999e-3, 0.0) < 1e-5


@pytest.mark.parametrize("profile", ["cylindrical", "iso-16281", {"kind": "full"}])
def test_length_of_another_roller_is_twice_its_half_length(profile: Any, tmp_path: Path) -> None:
    crown = {"crown_radius": "2 m"} if profile == {"kind": "full"} else {}
    roller = SHARP | crown | {"profile": profile}
    found = read(tmp_path, indenter=roller | {"length": "20 mm"}).indenter
    assert found == read(tmp_path, indenter=roller | {"half_length": "10 mm"}).indenter
    assert isinstance(found, vc.Roller)
    assert found.end == 0.01


def test_misalignment_is_the_tilt_along_a_roller(tmp_path: Path) -> None:
    roller = SHARP | {"half_length": "10 mm"}
    load = {"kind": "step", "force": "1 N", "misalignment": "0.5 mrad"}
    found = read(tmp_path, indenter=roller, load=load)
    assert found.load == vc.step(1.0, tilt_x=5e-4)
    assert "tilt_x: " in found.text
    assert "misalignment" not in found.text


@pytest.mark.parametrize("section", ["load", "motion"])
def test_frequency_is_the_inverse_of_the_period(section: str, tmp_path: Path) -> None:
    moving = {"kind": "reciprocating", "amplitude": "1 mm", "cycles": 2}
    given: dict[str, Any] = {"load": CYCLES} if section == "load" else {"motion": moving}
    by_frequency = read(tmp_path, **{section: given[section] | {"frequency": "4 Hz"}})
    by_period = read(tmp_path, **{section: given[section] | {"period": "0.25 s"}})
    assert getattr(by_frequency, section) == getattr(by_period, section)


def test_the_text_of_the_case_keeps_order_and_comments(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    text = (
        "indenter:\n  shape: roller\n  diameter: 10 mm  # catalogue\n  length: 20 mm\n"
        "material: pmma-paper\nload: {kind: step, force: 1 N}\ntime: {end: 1 s, steps: 2}\n"
    )
    path.write_text(text, encoding="utf-8")
    stored = text.replace("diameter: 10", "radius: 5").replace("length: 20", "half_length: 10")
    assert [line.split() for line in read_case(path).text.splitlines()] == [
        line.split() for line in stored.splitlines()
    ]


def test_aliases_are_read_in_toml_and_in_sums_of_shapes(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(
        '[[indenter]]\nshape = "sphere"\ndiameter = "2 in"\n'
        '[[indenter]]\nshape = "waviness"\namplitude = "1 um"\nwavelength_x = "1 mm"\n'
        '[material]\nlaw = "elastic"\nshear_modulus = "1 MPa"\npoisson_ratio = 0.5\n'
        '[load]\nkind = "step"\nforce = "1 N"\n[time]\nend = "1 s"\nsteps = 1\n',
        encoding="utf-8",
    )
    expected = vc.Sphere(0.0254) + vc.Waviness(1e-6, 1e-3)
    assert read_case(path).indenter == expected


@pytest.mark.parametrize(
    ("given", "settings", "radius"),
    [
        ({"radius": "10 mm"}, ["indenter.diameter=30 mm"], 15e-3),
        ({"diameter": "10 mm"}, ["indenter.radius=30 mm"], 30e-3),
        ({"diameter": "10 mm"}, ["indenter.diameter=30 mm"], 15e-3),
        ({"diameter": "10 mm"}, ["indenter={shape: sphere, diameter: 8 mm}"], 4e-3),
    ],
)
def test_a_setting_replaces_the_same_quantity(
    given: dict[str, str], settings: list[str], radius: float, tmp_path: Path
) -> None:
    found = read(tmp_path, *settings, indenter={"shape": "sphere", **given})
    assert found.indenter == vc.Sphere(radius)
    again = tmp_path / "again.yaml"
    again.write_text(found.text, encoding="utf-8")
    assert read_case(again).indenter == found.indenter
    assert "diameter" not in found.text
    key, value = (settings[0].split(".")[-1]).split("=")
    if not value.startswith("{"):  # what was typed last
        assert found.document.data_as_typed["indenter"] == {"shape": "sphere", key: value}


def test_a_set_length_of_a_crowned_roller_gets_a_profile(tmp_path: Path) -> None:
    roller = CROWNED | {"half_length": "9 mm"}
    found = read(tmp_path, "indenter.length=20 mm", indenter=roller)
    assert found.indenter == vc.Roller(5e-3, 9e-3, 75e-3, "partial", end_length=10e-3)
    again = tmp_path / "again.yaml"
    again.write_text(found.text, encoding="utf-8")
    assert read_case(again).indenter == found.indenter


def test_runs_may_vary_an_alias(tmp_path: Path) -> None:
    read(tmp_path)
    runs = vc.vary(tmp_path / "case.yaml", {"indenter.diameter": ["10 mm", "20 mm"]})
    radii = [
        read_case(tmp_path / "case.yaml", run.assignments).indenter.radius  # type: ignore[attr-defined]
        for run in runs
    ]
    assert radii == [5e-3, 10e-3]


@pytest.mark.parametrize(
    ("sections", "said"),
    [
        (
            {"indenter": {"shape": "sphere", "radius": "1 mm", "diameter": "2 mm"}},
            "indenter.diameter: diameter and radius exclude each other; give one",
        ),
        (
            {"indenter": SHARP | {"half_length": "1 mm", "length": "2 mm"}},
            "indenter.length: length and half_length exclude each other; give one",
        ),
        (
            {"indenter": CROWNED | {"half_length": "1 mm", "straight_length": "2 mm"}},
            "indenter.straight_length: straight_length and half_length exclude each other",
        ),
        (
            {"indenter": SHARP | {"straight_length": "18 mm"}},
            "indenter.straight_length: goes with circular crowns (crown_radius, or the profiles",
        ),
        (
            {"load": {"kind": "step", "force": "1 N", "misalignment": "1 mrad"}},
            "load.misalignment: is the tilt along a roller, and there is none",
        ),
        ({"load": CYCLES | {"frequency": "4 s"}}, "load.frequency: cannot read '4 s' as a freq"),
        (
            {"indenter": {"shape": "sphere", "diameter": "-3 mm"}},
            "indenter.diameter: must be more than zero, got '-3 mm'",
        ),
        (
            {"indenter": {"shape": "sphere", "diameter": 3}},
            "indenter.diameter: 3 has no unit",
        ),
        (
            {"indenter": CROWNED | {"straight_length": "18 mm", "length": "16 mm"}},
            "indenter.length: ",
        ),
        (
            {"indenter": {"shape": "sphere"}},
            "indenter.radius: is missing; write e.g. 'radius: 5 mm', or 'diameter: 10 mm'",
        ),
    ],
)
def test_a_wrong_alias_is_named_as_it_was_typed(
    sections: dict[str, Any], said: str, tmp_path: Path
) -> None:
    [line] = problems(tmp_path, **sections)
    assert line.split(": ", 1)[1].startswith(said), line


def test_both_on_the_command_line_are_refused(tmp_path: Path) -> None:
    settings = ("indenter.diameter=3 mm", "indenter.radius=3 mm")
    [line] = problems(tmp_path, *settings)
    assert line.endswith("indenter.diameter: diameter and radius exclude each other; give one")


def test_the_schema_lists_aliases_in_place_of_their_keys() -> None:
    sections = case_schema()["$defs"]
    sphere, roller, step = sections["Sphere"], sections["Roller"], sections["Step"]
    assert sphere["properties"]["diameter"]["x-alias-of"] == "radius"
    assert "radius" not in sphere["required"]
    assert sphere["allOf"] == [{"oneOf": [{"required": ["radius"]}, {"required": ["diameter"]}]}]
    lengths = [name for name, of in roller["properties"].items() if "x-alias-of" in of]
    assert lengths == ["diameter", "counter_diameter", "straight_length", "length"]
    assert {"not": {"required": ["tilt_x", "misalignment"]}} in step["allOf"]
    assert "frequency" in sections["Harmonic"]["properties"]
    assert "frequency" in sections["Reciprocating"]["properties"]
    # A chamfer's length and a punch's half length are their own.
    assert "x-alias-of" not in sections["Chamfer"]["properties"]["length"]
    assert "length" not in sections["FlatPunch"]["properties"]


# --- synonyms, and what is not available ----------------------------------------------------------

SERIES = {"law": "creep-series", "instant": "1 / MPa", "amplitudes": [], "times": []}
CARD = {"law": "card", "file": "card.inp", "modulus_unit": "MPa", "time_unit": "s"}
MODULI = {"law": "relaxation-series", "equilibrium": "1 MPa", "moduli": [], "times": []}


@pytest.mark.parametrize(
    ("section", "given", "said"),
    [
        ("material", CASE["material"] | {"nu": 0.3}, "did you mean 'poisson_ratio'?"),
        ("material", CASE["material"] | {"E": "1 GPa"}, "did you mean 'youngs_modulus'?"),
        ("material", CASE["material"] | {"modulus": "1 GPa"}, "did you mean 'youngs_modulus'"),
        ("material", SERIES | {"E": "1 GPa"}, "'instant', its inverse 1/E, with data: uniaxial?"),
        ("material", MODULI | {"E": "1 GPa"}, "'equilibrium', and moduli, with data: uniaxial?"),
        ("material", MODULI | {"G": "1 GPa"}, "'equilibrium', and moduli, with data: shear?"),
        (
            "material",
            MODULI | {"E_inf": "1 GPa"},
            "did you mean 'equilibrium', with data: uniaxial",
        ),
        ("material", MODULI | {"E0": "1 GPa"}, "did you mean 'moduli', [E_1, E_2, ...], which add"),
        ("material", SERIES | {"G0": "1 GPa"}, "did you mean 'instant', its inverse 1/G0, with"),
        ("material", {"law": "relaxation-series"}, "write e.g. 'moduli: [50 MPa, 25 MPa]'"),
        ("material", {"law": "relaxation-series"}, "write e.g. 'data: uniaxial'"),
        ("indenter", {"shape": "pyramid", "half_angle": "35 deg"}, "write e.g. 'faces: 4'"),
        ("material", SERIES | {"Shore": 60}, "Shore: write 'shore_a: 70' or 'shore_d: 45'"),
        ("material", SERIES | {"youngs_modulus": "1 GPa"}, "'instant', its inverse 1/E, with data"),
        ("material", CARD | {"youngs_modulus": "1 GPa"}, "It goes with law: elastic or maxwell"),
        ("material", CARD | {"E": "1 GPa"}, "youngs_modulus goes with law: elastic or maxwell"),
        ("material", SERIES | {"coating": "1 mm"}, "layers goes with law: layered"),
        ("indenter", SHARP | {"nu": 0.3}, "poisson_ratio is a key of material"),
        ("layers", [], "It is a key of material"),
        ("motion", {"kind": "rolling", "speed": "1 m/s"}, "did you mean 'steady'?"),
        ("load", {"kind": "step", "moment": "1 N"}, "'eccentricity_x', or eccentricity_y, moment"),
        ("load", {"kind": "step", "load": "1 N"}, "did you mean 'force'?"),
        ("load", CYCLES | {"period": "1 s", "force": "1 N"}, "did you mean 'mean'?"),
        ("load", {"kind": "step", "force": "1 N", "diameter": "1 m"}, "a key of indenter"),
        ("time", {"end": "1 s", "steps": 3, "spacing": "logarithmic"}, "did you mean 'log'?"),
        ("force", "1 N", "It is a key of load"),
        ("misalignment", "1 mrad", "It is a key of load"),
    ],
)
def test_an_unknown_word_is_answered_by_its_meaning(
    section: str, given: Any, said: str, tmp_path: Path
) -> None:
    assert said in "\n".join(problems(tmp_path, **{section: given}))


def test_the_logarithmic_crown_names_a_size_and_the_designed_crowns(tmp_path: Path) -> None:
    roller = SHARP | {"half_length": "10 mm", "profile": "logarithmic"}
    [line] = problems(tmp_path, indenter=roller)
    assert "write e.g. 'amplitude: 0.5 um'; or choose the profile lundberg or johns-gohar" in line


@pytest.mark.parametrize("word", ["plasticity", "wear"])
@pytest.mark.parametrize("inside", [True, False])
def test_what_is_not_available_is_refused_by_name(word: str, inside: bool, tmp_path: Path) -> None:
    sections = {"load": CASE["load"] | {word: 1}} if inside else {word: 1}
    [line] = problems(tmp_path, **sections)
    assert "not available" in line
    assert "see 'Limits' in the manual" in line
    assert "unknown key" not in line


def test_words_for_friction_name_its_sections(tmp_path: Path) -> None:
    for word in ("friction", "mu", "cof"):
        [line] = problems(tmp_path, load=CASE["load"] | {word: 0.3})
        assert "write 'friction: {coefficient: 0.3}'" in line


def test_words_for_adhesion_name_its_section(tmp_path: Path) -> None:
    for word in ("adhesion", "surface_energy", "jkr"):
        [line] = problems(tmp_path, load=CASE["load"] | {word: "50 mJ/m2"})
        assert "write 'adhesion: {work: 50 mJ/m2, range: 2 nm}'" in line


def test_examples_of_a_value_without_unit_are_of_the_size_of_its_key(tmp_path: Path) -> None:
    roller = SHARP | {"half_length": 10, "profile": {"kind": "logarithmic", "amplitude": 5}}
    length, amplitude = problems(tmp_path, indenter=roller)
    assert length.endswith("half_length: 10 has no unit; a length is expected; write e.g. '5 mm'")
    assert amplitude.endswith("5 has no unit; a length is expected; write e.g. '0.5 um'")


def test_a_key_of_known_meaning_is_not_compared_by_its_spelling(tmp_path: Path) -> None:
    [line] = problems(tmp_path, material=CARD | {"youngs_modulus": "1 GPa"})
    assert "bulk_modulus'" not in line
