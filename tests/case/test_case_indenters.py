"""Indenters of case files: each key arrives as the argument it names, each mistake is reported."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import CaseError, read_case
from viscontact.case.sections import case_schema

CASE = """\
indenter:
  shape: roller
  radius: 5 mm
  half_length: 6 mm
  profile: cylindrical
material: {law: elastic, shear_modulus: 700 MPa, poisson_ratio: 0.3}
load: {kind: step, force: 200 N}
time: {end: 1 s, steps: 2, spacing: uniform}
"""


@pytest.fixture
def case(tmp_path: Path) -> Path:
    path = tmp_path / "case.yaml"
    path.write_text(CASE)
    return path


def refusal(case: Path, *settings: str) -> str:
    with pytest.raises(CaseError) as refused:
        read_case(case, settings)
    return str(refused.value)


# -- profiles of rollers -----------------------------------------------------------------------

DESIGN = {"force": 1000.0, "effective_modulus": 2e9}
PROFILES = {
    "cylindrical": {},
    "{kind: full, crown_radius: 2 m}": {"profile": "full", "crown_radius": 2.0},
    "{kind: partial, crown_radius: 2 m, end_length: 7 mm}": {
        **{"profile": "partial", "crown_radius": 2.0, "end_length": 7e-3}
    },
    "{kind: two-radii, crown_radius: 2 m, crown_length: 1 mm, end_radius: 5 mm}": {
        **{"profile": "two-radii", "crown_radius": 2.0},
        **{"crown_length": 1e-3, "end_radius": 5e-3},
    },
    "{kind: chamfer, angle: 0.5 rad, length: 1 mm, corner_radius: 0.1 mm}": {
        **{"profile": "chamfer", "angle": 0.5, "length": 1e-3, "corner_radius": 1e-4}
    },
    "{kind: logarithmic, amplitude: 1 um, crown_ratio: 0.5, end_drop: 8 um}": {
        **{"profile": "logarithmic", "amplitude": 1e-6, "crown_ratio": 0.5, "end_drop": 8e-6}
    },
    "{kind: lundberg, force: 1 kN, effective_modulus: 2 GPa}": {"profile": "lundberg", **DESIGN},
    "{kind: johns-gohar, force: 1 kN, effective_modulus: 2 GPa}": {
        **{"profile": "johns-gohar", **DESIGN}
    },
    "{kind: fujiwara-kawase, force: 1 kN, effective_modulus: 2 GPa, load_factor: 2.0, "
    "crown_ratio: 0.6, end_drop: 20 um}": {
        **{"profile": "fujiwara-kawase", **DESIGN},
        **{"load_factor": 2.0, "crown_ratio": 0.6, "end_drop": 20e-6},
    },
    "iso-16281": {"profile": "iso-16281"},
    "{kind: table, points: [[0 mm, 0 um], [4 mm, 0 um], [6 mm, 8 um]], interpolation: linear}": {
        "profile": vc.TabulatedProfile([0, 4e-3, 6e-3], [0, 0, 8e-6], "linear")
    },
}


@pytest.mark.parametrize("words", PROFILES)
def test_profile_arrives_as_it_is_written(case: Path, words: str) -> None:
    found = read_case(case, [f"indenter.profile={words}"]).indenter
    wanted = vc.Roller(5e-3, 6e-3, **PROFILES[words])
    assert isinstance(found, vc.Roller)
    assert found.gap([0.0, 4.7e-3, 5.9e-3, 7.1e-3], 1e-3) == close_to(
        wanted.gap([0.0, 4.7e-3, 5.9e-3, 7.1e-3], 1e-3), rel=1e-12
    )
    assert type(found.profile) is type(wanted.profile)


def test_crown_radius_may_stand_with_the_roller(case: Path) -> None:
    settings = ["indenter.profile=full", "indenter.crown_radius=2 m"]
    assert read_case(case, settings).indenter == vc.Roller(5e-3, 6e-3, 2.0, "full")


def test_parabolic_section_is_a_key(case: Path) -> None:
    found = read_case(case, ["indenter.cross_section=parabola"]).indenter
    assert found == vc.Roller(5e-3, 6e-3, cross_section="parabola")


@pytest.mark.parametrize(
    "text",
    [
        "x [mm],drop [um]\n0,0\n4,0\n6,8\n",
        "x [mm];note;height [um]\n0;a;3,5\n4;b;3,5\n6;c;-4,5\n",
        "x\tdrop\nmm\tum\n-6\t8\n-4\t0\n4\t0\n6\t8\n",
    ],
    ids=["half of drops", "heights as measured", "both halves, two rows of header"],
)
def test_profile_is_read_from_a_csv_next_to_the_case(case: Path, text: str) -> None:
    (case.parent / "crown.csv").write_text(text)
    words = "indenter.profile={kind: table, file: crown.csv, interpolation: linear}"
    found = read_case(case, [words])
    assert isinstance(found.indenter, vc.Roller)
    assert found.indenter.drop([-5e-3, 0.0, 6e-3]) == close_to([4e-6, 0, 8e-6], abs=1e-18)
    # The file travels with the run.
    assert found.files == {("indenter", "profile", "file"): case.parent / "crown.csv"}


def test_profile_of_one_shape_in_a_list_keeps_its_place(case: Path) -> None:
    (case.parent / "crown.csv").write_text("x [mm],drop [um]\n0,0\n6,8\n")
    words = (
        "indenter=[{shape: sphere, radius: 1 m}, {shape: roller, radius: 5 mm, half_length: 6 mm, "
        "profile: {kind: table, file: crown.csv}}]"
    )
    found = read_case(case, [words])
    assert list(found.files) == [("indenter", 1, "profile", "file")]
    assert "crown.csv" in found.text


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("profile=full", "indenter.profile: roller profile 'full' needs crown_radius"),
        ("profile=lundberg", "profile.force: is missing; write e.g. 'force: 10 kN'"),
        ("profile=lunberg", "unknown value 'lunberg'; did you mean 'lundberg'? Allowed: cy"),
        ("profile={kind: lundberg, force: 3 mm, effective_modulus: 1 GPa}", "'3 mm' as a force"),
        ("profile={kind: logarithmic, amplitud: 1 um}", "unknown key; did you mean 'amplitude'?"),
        ("profile={kind: full, angle: 1 deg}", "It goes with kind: chamfer"),
        ("profile={kind: chamfer, angle: 95 deg, length: 1 mm}", "profile.angle: must lie betw"),
        ("profile={kind: chamfer, angle: 9 deg, length: 8 mm}", "leaves no straight part"),
        ("profile={kind: table}", "profile: give file (e.g. 'profile.csv') or points"),
        ("profile={kind: table, file: no.csv}", "profile.file: no such file"),
        ("profile={kind: table, points: [[0 mm, 0 um]]}", "profile.points: a line needs at least"),
        (
            "profile={kind: table, points: [[0 mm, 0 um], [3 mm, 1 um]]}",
            "profile.points: x ends at 3 mm from the middle, before the half length",
        ),
        ("profile={kind: table, points: [[0, 0]]}", "profile.points[1][1]: 0 has no unit"),
        (
            "profile={kind: logarithmic, amplitude: 1 um, crown_ratio: 2.0}",
            "profile.crown_ratio: m",
        ),
        ("profile=5", "indenter.profile: must be a section with keys of its own, got 5"),
        ("cross_section=square", "unknown value 'square'. Allowed: circle, parabola"),
    ],
)
def test_slip_in_a_profile_is_reported_at_its_key(case: Path, setting: str, said: str) -> None:
    assert said in refusal(case, f"indenter.{setting}")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "x [mm],z [um]\n0,0\n6,8\n",
            "the columns x and drop (or height) are needed, as 'x [mm], d",
        ),
        ("x [mm],drop [um],height [um]\n0,0,0\n6,8,8\n", "the columns x and drop (or height) are"),
        ("x [mm],drop\n0,0\n6,8\n", "column 'drop': has no unit"),
        ("x [mm],drop [N]\n0,0\n6,8\n", "'N'"),
        ("x [mm],drop [um]\n0,0\n6,much\n", "crown.csv:3"),
        ("x [mm],drop [um]\n0,0\n6,8\n3,1\n", "positions must increase, got 6 mm followed by"),
    ],
)
def test_broken_profile_file_is_reported_at_the_key_file(case: Path, text: str, said: str) -> None:
    (case.parent / "crown.csv").write_text(text)
    found = refusal(case, "indenter.profile={kind: table, file: crown.csv}")
    assert found.startswith("--set indenter.profile.file: ")
    assert said in found


def test_schema_offers_profiles_by_name_and_by_section() -> None:
    schema = case_schema()
    names, sections, _ = schema["$defs"]["Roller"]["properties"]["profile"]["anyOf"]
    assert "fujiwara-kawase" in names["enum"]
    assert sections["discriminator"]["propertyName"] == "kind"
    assert schema["$defs"]["Logarithmic"]["properties"]["end_drop"]["examples"] == ["20 um"]


# -- shapes ------------------------------------------------------------------------------------

SHAPES = {
    "{shape: cylinder, diameter: 120 mm}": vc.Paraboloid(math.inf, 0.06),
    "{shape: cylinder, radius: 60 mm, counter_diameter: 60 mm}": vc.Paraboloid(math.inf, 0.02),
    "{shape: ellipsoid, semi_axis_x: 3 mm, semi_axis_y: 2 mm, semi_axis_z: 1 mm}": (
        vc.Ellipsoid(3e-3, 2e-3, 1e-3)
    ),
    "{shape: wedge, half_angle: 1.2 rad}": vc.Wedge(1.2),
    "{shape: wedge, half_angle: 1.2 rad, half_length: 2 mm}": vc.Wedge(1.2, 2e-3),
    "{shape: pyramid, half_angle: 1.2 rad, faces: 6}": vc.Pyramid(1.2, 6),
    "{shape: vickers}": vc.Pyramid.vickers(),
    "{shape: berkovich}": vc.Pyramid.berkovich(),
    "{shape: cube-corner}": vc.Pyramid.cube_corner(),
    "{shape: torus, ring_radius: 3 mm, tube_radius: 1 mm}": vc.Torus(3e-3, 1e-3),
    "{shape: waviness, amplitude: 1 um, wavelength_x: 1 mm, phase_x: 0.5 rad}": (
        vc.Waviness(1e-6, 1e-3, phase_x=0.5)
    ),
    "{shape: waviness, amplitude: 1 um, wavelength_y: 1 mm}": (
        vc.Waviness(1e-6, wavelength_y=1e-3)
    ),
    "{shape: dimples, depth: 1 um, radius: 40 um, spacing: 0.1 mm, pattern: hexagonal}": (
        vc.Dimples(1e-6, 4e-5, 1e-4, "hexagonal")
    ),
    "{shape: revolved, points: [[0 mm, 0 um], [1 mm, 2 um]], interpolation: linear}": (
        vc.Revolved([0, 1e-3], [0, 2e-6], "linear")
    ),
    "{shape: swept, points: [[-1 mm, 1 um], [0 mm, 0 um], [2 mm, 3 um]], half_length: 4 mm}": (
        vc.Swept([-1e-3, 0, 2e-3], [1e-6, 0, 3e-6], 4e-3)
    ),
    "{shape: sphere, radius: 5 mm, offset_x: 1 mm, offset_y: -2 mm}": (
        vc.Sphere(5e-3).shifted(1e-3, -2e-3)
    ),
    "{shape: vickers, rotation: 0.5 rad, offset_x: 1 mm}": (
        vc.Pyramid.vickers().rotated(0.5).shifted(1e-3)
    ),
}


@pytest.mark.parametrize("words", SHAPES)
def test_shape_arrives_as_it_is_written(case: Path, words: str) -> None:
    """Read into the same object: its arguments agree to the rounding of a unit's factor."""
    found, wanted = read_case(case, [f"indenter={words}"]).indenter, SHAPES[words]
    assert type(found) is type(wanted)
    x, y = [0.0, 0.31e-3, -0.7e-3, 1.9e-3, 1.4e-3], [0.0, 0.2e-3, 0.9e-3, -1e-3, 0.01e-3]
    assert found.gap(x, y) == close_to(wanted.gap(x, y), rel=1e-9, abs=1e-20)


@pytest.mark.parametrize(("shape", "along"), [("revolved", "r"), ("swept", "y")])
def test_body_is_read_from_a_csv_next_to_the_case(case: Path, shape: str, along: str) -> None:
    (case.parent / "section.csv").write_text(f"{along} [mm],height [um]\n0,2\n1,2\n3,-2\n")
    words = f"indenter={{shape: {shape}, file: section.csv, interpolation: linear}}"
    found = read_case(case, [words])
    assert found.indenter.gap(0.0, [0.5e-3, 2e-3]) == close_to([0, 2e-6], abs=1e-18)
    assert found.files == {("indenter", "file"): case.parent / "section.csv"}


def test_list_of_shapes_is_their_sum_each_in_its_place(case: Path) -> None:
    words = (
        "indenter=[{shape: sphere, radius: 5 mm}, {shape: waviness, amplitude: 1 um, "
        "wavelength_x: 1 mm, rotation: 90 deg}]"
    )
    found = read_case(case, [words]).indenter
    wanted = vc.Sphere(5e-3) + vc.Waviness(1e-6, wavelength_y=1e-3)
    y = [0.0, 0.2e-3, 0.5e-3]
    assert found.gap(1e-4, y) == close_to(wanted.gap(1e-4, y), rel=1e-9)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("{shape: ring, ring_radius: 1 mm}", "unknown value 'ring'; did you mean 'torus'?"),
        ("{shape: vikers}", "did you mean 'vickers'"),
        ("{shape: pyramid, half_angle: 68 deg, faces: 2}", "indenter.faces: must be greater than"),
        (
            "{shape: pyramid, half_angle: 99 deg, faces: 4}",
            "half_angle: must lie between 0 and π/2",
        ),
        ("{shape: waviness, amplitude: 1 um}", "give wavelength_x, wavelength_y or both"),
        ("{shape: dimples, depth: 1 um, radius: 1 mm, spacing: 1 mm}", "indenter.spacing: must be"),
        ("{shape: revolved}", "give file (e.g. 'section.csv') or points"),
        ("{shape: revolved, file: no.csv}", "indenter.file: no such file"),
        ("{shape: sphere, radius: 1 mm, rotation: 5}", "indenter.rotation: 5 has no unit"),
        ("{shape: sphere, radius: 1 mm, faces: 3}", "It goes with shape: pyramid"),
    ],
)
def test_slip_in_a_shape_is_reported_at_its_key(case: Path, words: str, said: str) -> None:
    found = refusal(case, f"indenter={words}")
    assert said in found
    assert "math.radians" not in found
