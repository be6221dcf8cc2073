"""The `material:` section of `viscontact fit` is valid in a case file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from viscontact import reference
from viscontact.case import read_case
from viscontact.cli import main

T = np.linspace(0.0, 4.0, 41)
APPROACH = 1e-6 * np.minimum(T, 4 - T) / 2
CASE = """\
indenter: {shape: sphere, radius: 10 mm}
load: {kind: ramp, force: 1 N, duration: 1 s}
time: {end: 2 s, steps: 4}
"""
INDENTED = {
    "elastic": vc.Elastic(1e6),
    "maxwell": vc.Maxwell(1e6, 2e6),
    "zener": vc.Zener(2e6, 1e6, 1e6),
    "burgers": vc.Burgers(2e6, 1e7, 1e6, 1e6),
    "creep-series": vc.CreepSeries(3e-7, [2e-7], [1.0]),
    "power-law": vc.PowerLaw(3e-7, 0.3, 1.0),
    "power-law-with-instant": vc.PowerLaw(3e-7, 0.3, 1.0, 2e-7),
}


def written(path: Path, heads: str, *columns: np.ndarray) -> str:
    rows = [",".join(f"{value:.12g}" for value in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([heads, *rows]) + "\n", encoding="utf-8")
    return str(path)


def pasted(folder: Path, printed: str) -> vc.Material:
    """Return the material of a case into which what was printed last is pasted."""
    section = printed[printed.index("material:\n") :]
    path = folder / "case.yaml"
    path.write_text(CASE + section, encoding="utf-8")
    return read_case(path).material


#: Those with more parameters than a law of their kind beside them.
LONGER = {"burgers", "power-law-with-instant"}


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=pytest.mark.slow) if name in LONGER else name for name in INDENTED],
)
def test_a_law_found_by_indentation_can_be_pasted_into_a_case(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    material = vc.Material(INDENTED[name], 0.45)
    force = reference.press_axisymmetric(
        reference.SphereProfile(5e-6),
        T,
        approach=APPROACH,
        creep_compliance=material.contact_compliance(),
    ).force
    heads = "time [s],approach [um],force [uN]"
    file = written(tmp_path / "record.csv", heads, T, 1e6 * APPROACH, 1e6 * force)
    options = ["--indenter", "sphere 5 um", "--law", name, "--poisson-ratio", "0.45"]
    assert main(["fit", file, *options]) == 0
    found = pasted(tmp_path, capsys.readouterr().out)
    assert type(found.law) is type(material.law)
    assert found.poisson_ratio == 0.45
    # Steps of 0.1 s in the fit's quadrature; the instants before say nothing.
    t = T[1:]
    np.testing.assert_allclose(found.law(t), material.law(t), rtol=1e-3)


@pytest.mark.parametrize(
    ("volume", "options"),
    [
        ({"poisson_ratio": 0.4}, ["--poisson-ratio", "0.4"]),
        ({"bulk_modulus": 4e9}, ["--bulk-modulus", "4 GPa"]),
    ],
)
@pytest.mark.parametrize("data", ["shear", "uniaxial"])
def test_a_relaxation_series_can_be_pasted_into_a_case(
    data: str,
    volume: dict[str, float],
    options: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    terms = (1e9, [2e9], [5.0])
    law = vc.RelaxationSeries.from_shear(*terms)
    if data == "uniaxial":
        law = vc.RelaxationSeries.from_uniaxial(*terms, **volume)
    t = np.geomspace(0.1, 100.0, 25)
    modulus = 1e9 + 2e9 * np.exp(-t / 5.0)
    heads = "time [s],relaxation_modulus [Pa]"
    file = written(tmp_path / "table.csv", heads, t, modulus)
    assert main(["fit", file, "--data", data, *options]) == 0
    found = pasted(tmp_path, capsys.readouterr().out)
    assert {name: getattr(found, name) for name in volume} == volume
    np.testing.assert_allclose(found.law.relaxation(t), law.relaxation(t), rtol=1e-4)


@pytest.mark.parametrize("fluid", [False, True])
@pytest.mark.parametrize("data", ["shear", "uniaxial", "deviatoric"])
def test_a_creep_series_can_be_pasted_into_a_case(
    data: str, fluid: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    t = np.geomspace(0.1, 100.0, 25)
    compliance = 1e-9 + 2e-9 * (1 - np.exp(-t / 5.0)) + (1e-11 * t if fluid else 0.0)
    factor = {"shear": 0.5, "uniaxial": 1.4, "deviatoric": 1.0}[data]  # to Phi
    file = written(tmp_path / "table.csv", "time [s],creep_compliance [1/Pa]", t, compliance)
    options = ["--data", data, "--poisson-ratio", "0.4", *(["--fluid"] if fluid else [])]
    assert main(["fit", file, *options]) == 0
    found = pasted(tmp_path, capsys.readouterr().out)
    assert isinstance(found.law, vc.CreepSeries)
    np.testing.assert_allclose(found.law(t), factor * compliance, rtol=1e-4)


def test_of_data_in_shear_alone_the_section_asks_for_the_volume(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    t = np.geomspace(0.1, 100.0, 25)
    file = written(tmp_path / "table.csv", "time [s],G [Pa]", t, 1e9 + 2e9 * np.exp(-t / 5.0))
    assert main(["fit", file]) == 0
    printed = capsys.readouterr().out
    assert "# the data are of shear alone: add poisson_ratio, or bulk_modulus" in printed
    assert pasted(tmp_path, f"{printed}  poisson_ratio: 0.3\n").poisson_ratio == 0.3
    assert main(["fit", file, "--poisson-ratio", "0.7"]) == 2
    assert "0.7" in capsys.readouterr().err
