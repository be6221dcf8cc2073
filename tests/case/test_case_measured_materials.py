"""Materials that a case names by a file: an oscillation, which is fitted, and a section."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import Case, CaseError, read_case
from viscontact.case.yaml_source import write
from viscontact.cli import main
from viscontact.results.descriptions import rebuild

OMEGA = np.geomspace(1e-2, 1e3, 26)
MODULUS = vc.RelaxationSeries(1e7, [2e9, 1e9], [0.1, 10.0]).complex_modulus(OMEGA)
DMA = {"law": "table", "file": "dma.csv", "poisson_ratio": 0.4}
CREEP = "time [h], creep modulus [MPa]\n1, 2000\n10, 1600\n100, 1300\n"
LAW = """\
material:
  law: zener
  shear_modulus: 1 GPa
  delayed_modulus: 2 GPa
  viscosity: 3 GPa s
  poisson_ratio: 0.3
"""


def dma(loss: float = 1.0, heads: str = "f [Hz], E' [MPa], E'' [MPa]") -> str:
    columns = (OMEGA / (2 * np.pi), MODULUS.real / 1e6, loss * MODULUS.imag / 1e6)
    rows = [", ".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([heads, *rows]) + "\n"


def written(folder: Path, material: Any, **files: str) -> Path:
    for name, text in files.items():
        (folder / name.replace("__", ".")).write_text(text, encoding="utf-8")
    case = {
        "indenter": {"shape": "sphere", "radius": "10 mm"},
        "load": {"kind": "step", "force": "20 N"},
        "time": {"end": "1 s", "steps": 1},
        "grid": {"shape": [24, 24], "size": ["2 mm", "2 mm"]},
        "output": {"errors": False},
        "material": material,
    }
    path = folder / "case.yaml"
    path.write_text(write(case), encoding="utf-8")
    return path


def read(folder: Path, material: Any, **files: str) -> Case:
    return read_case(written(folder, material, **files))


def test_an_oscillation_is_fitted_when_the_case_is_read(tmp_path: Path) -> None:
    """E' and E'' of 2 GPa at 0.1 s and 1 GPa at 10 s give the same series in shear, E/2.8."""
    case = read(tmp_path, DMA, dma__csv=dma())
    law = case.material.law
    assert isinstance(law, vc.RelaxationSeries)
    np.testing.assert_allclose(law.times, [0.1, 10.0], rtol=1e-4)
    np.testing.assert_allclose(law.moduli, [2e9 / 2.8, 1e9 / 2.8], rtol=1e-4)
    [note] = case.notes
    assert note.startswith("the law is a relaxation series of 2 terms, fitted to dma.csv at 0.01 ")
    assert case.material.warning is None
    # The lowest frequency of 0.01 rad/s is the longest time that was measured.
    assert case.material.measured_until == close_to(100.0)
    slow = read(tmp_path, DMA | {"measured_until": "5 s"})
    assert slow.material.measured_until == 5.0


def test_a_run_keeps_the_fitted_law_its_quality_and_its_warning(tmp_path: Path) -> None:
    path = written(tmp_path, DMA, dma__csv=dma(loss=4.0))
    assert main(["run", str(path), "-o", str(tmp_path / "run"), "-q"]) == 0
    with vc.open_results(tmp_path / "run") as ds:
        stored = json.loads(ds.attrs["case"])["material"]
        said = ds.attrs["warnings"]
    assert "dma.csv: the fit misses storage by " in said
    assert "Kramers-Kronig" in said
    found = rebuild(stored)
    assert found == read_case(path).material
    assert found.notes[0].startswith("the law is a relaxation series of ")
    assert (tmp_path / "run" / "dma.csv").read_text(encoding="utf-8") == dma(loss=4.0)
    good = written(tmp_path, DMA, dma__csv=dma())
    assert main(["run", str(good), "-o", str(tmp_path / "good"), "-q"]) == 0
    with vc.open_results(tmp_path / "good") as ds:
        assert "misses" not in ds.attrs["warnings"]
        assert "fitted to dma.csv" in ds.attrs["case"]


def test_a_contact_in_steady_motion_issues_the_warning_of_its_material_too() -> None:
    material = vc.Material(vc.Zener(1e7, 1e7, 1e5), 0.5, warning="the fit misses the loss")
    grid = vc.Grid((24, 24), (4e-3, 4e-3))
    with pytest.warns(vc.AccuracyWarning) as said:
        ds = vc.steady(vc.Sphere(0.01), material, vc.step(1.0), 0.1, grid=grid, errors=False)
    assert "the fit misses the loss" in [str(each.message) for each in said]
    assert "the fit misses the loss" in ds.attrs["warnings"]


def test_the_check_of_a_steady_motion_warns_of_the_material_too(
    tmp_path: Path, capsys: Any
) -> None:
    path = written(tmp_path, {"file": "law.yaml", "warning": "the fit misses E'"}, law__yaml=LAW)
    text = path.read_text(encoding="utf-8").replace("time:\n  end: 1 s\n  steps: 1\n", "")
    path.write_text(f"{text}motion: {{kind: steady, speed: 0.1 m/s, along: y}}\n", encoding="utf-8")
    assert main(["check", str(path)]) == 0
    assert "warning: the fit misses E'" in capsys.readouterr().out


def test_a_shift_moves_the_fitted_law_and_its_range(tmp_path: Path) -> None:
    shift = {"kind": "wlf", "reference_temperature": "20 degC", "c1": 8.86, "c2": "101.6 K"}
    warm = read(tmp_path, DMA | {"temperature": "40 degC", "shift": shift}, dma__csv=dma())
    factor = vc.WLF(293.15, 8.86, 101.6).factor(313.15)
    np.testing.assert_allclose(warm.material.law.times, [0.1 * factor, 10 * factor], rtol=1e-4)
    assert warm.material.measured_until == close_to(100.0 * factor)


def test_quantity_and_kind_of_test_are_those_of_the_headings(tmp_path: Path) -> None:
    """1/E_c after an hour is 0.5/GPa, and Phi = (1 + ν) D."""
    table = {"law": "table", "file": "creep.csv", "poisson_ratio": 0.4}
    law = read(tmp_path, table, creep__csv=CREEP).material.law
    assert isinstance(law, vc.TabulatedCreep)
    assert law(3600.0) == close_to(1.4 * 0.5e-9, rel=1e-12)


@pytest.mark.parametrize(
    ("keys", "text", "said"),
    [
        ({"quantity": "creep_compliance"}, dma(), "quantity: dma.csv is an oscillation"),
        ({"before": "slope"}, dma(), "before: dma.csv is an oscillation"),
        ({"data": "shear"}, dma(), 'shear contradicts dma.csv, where the column "E\' [MPa]"'),
        (
            {},
            dma(heads="f [Hz], storage modulus [MPa], loss modulus [MPa]"),
            "data: the headings of dma.csv do not state the kind of test",
        ),
        (
            {"data": "deviatoric"},
            dma(heads="f [Hz], storage modulus [MPa], loss modulus [MPa]"),
            "data: moduli are shear or uniaxial",
        ),
        ({}, "f [Hz], E' [MPa], E'' [MPa]\n1, 5, -2\n2, 5, 1\n3, 5, 1\n", "line 2 of dma.csv"),
        ({}, "time [s], stiffness [MPa]\n1, 5\n", "not known: 'stiffness [MPa]'"),
        ({}, "time [s], D [1/GPa], E [GPa]\n1, 1, 1\n", "name one"),
        (
            {},
            "f [Hz], E' [MPa], E'' [MPa], T [°C]\n1, 5, 2, 20\n1, 4, 2, 40\n",
            "; or shift all to one temperature by `viscontact fit dma.csv --yaml law.yaml`",
        ),
    ],
)
def test_tables_that_give_no_law_are_refused(
    keys: dict[str, Any], text: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(CaseError) as refusal:
        read(tmp_path, DMA | keys, dma__csv=text)
    assert said in refusal.value.problems[0]


@pytest.mark.parametrize("section", [{"file": "law.yaml"}, {"law": "file", "file": "law.yaml"}])
def test_a_material_from_a_file_is_that_of_the_section(
    section: dict[str, str], tmp_path: Path
) -> None:
    found = read(tmp_path, section, law__yaml=LAW).material
    assert found == vc.Material(vc.Zener(1e9, 2e9, 3e9), 0.3)


def test_keys_beside_the_file_replace_those_in_it(tmp_path: Path) -> None:
    shift = {
        "kind": "arrhenius",
        "reference_temperature": "20 degC",
        "activation_energy": "80 kJ/mol",
    }
    keys = {"poisson_ratio": 0.45, "thickness": "5 mm", "measured_until": "1 min"}
    found = read(tmp_path, {"file": "law.yaml", **keys}, law__yaml=LAW).material
    law = vc.Zener(1e9, 2e9, 3e9)
    assert found == vc.Material(law, 0.45, thickness=5e-3, measured_until=60.0)
    warm = {"file": "law.yaml", "temperature": "40 degC", "shift": shift}
    factor = vc.Arrhenius(293.15, 80e3).factor(313.15)
    assert read(tmp_path, warm).material.law == law.slowed(factor)


def test_what_the_fit_writes_is_a_material_and_is_kept_with_the_run(tmp_path: Path) -> None:
    """A law in shear lacks the volume, which the case adds."""
    table = tmp_path / "dma.csv"
    table.write_text(dma(heads="f [Hz], G' [MPa], G'' [MPa]"), encoding="utf-8")
    assert main(["fit", str(table), "--yaml", str(tmp_path / "law.yaml")]) == 0
    path = written(tmp_path, {"file": "law.yaml", "poisson_ratio": 0.4})
    np.testing.assert_allclose(read_case(path).material.law.moduli, [2e9, 1e9], rtol=1e-4)
    assert main(["run", str(path), "-o", str(tmp_path / "run"), "-q"]) == 0
    kept = read_case(tmp_path / "run" / "case.yaml")
    assert kept.files == {("material", "file"): tmp_path / "run" / "law.yaml"}
    assert kept.material == read_case(path).material


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (LAW.replace("  viscosity: 3 GPa s\n", ""), "law.yaml: viscosity: Field required"),
        (LAW.replace("3 GPa s", "3"), "law.yaml: viscosity: 3 has no unit"),
        (LAW.replace("  poisson_ratio: 0.3\n", ""), "give poisson_ratio (e.g. 0.38)"),
        ("title: no material\n", "law.yaml has no section material: with a law"),
        ("material: pmma-paper\n", "law.yaml has no section material: with a law"),
        ("material: {file: law.yaml}\n", "law.yaml names another file; write its keys"),
        ("law: table\nfile: a.csv\n", "law.yaml names another file; write its keys"),
    ],
)
def test_files_without_a_material_are_refused(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(CaseError) as refusal:
        read(tmp_path, {"file": "law.yaml"}, law__yaml=text)
    [line] = refusal.value.problems
    assert said in line
    with pytest.raises(CaseError, match="no such file"):
        read(tmp_path, {"file": "none.yaml"})
