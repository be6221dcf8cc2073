"""Each mistake in a case file is one clear line at its key."""

from __future__ import annotations

from pathlib import Path

import pytest

from case.written_cases import ROLLER, SPHERE, problems
from viscontact.case import CaseError, read_case


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
