"""`viscontact fit --adhesion`: one force curve of an adhering sphere, and many."""

from __future__ import annotations

import csv
import re
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from identification.adhesive_curves import RADIUS, curve_of
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.reference import jkr_sphere, maugis_dugdale

#: Curve of a cell on a JPK CellHesion 200, whose source and licence are beside it.
CELL = Path(__file__).parents[1] / "identification" / "cell.jpk-force"
MODULUS, WORK = 2e6, 0.02
SPRING = 3.0
#: Length (R w²/E*²)^(1/3) [m]: the range over which the Tabor number is 1.
LENGTH = float(np.cbrt(RADIUS * (WORK / MODULUS) ** 2))
TYPED = ("--adhesion", "--indenter", "sphere 5 um", "--poisson-ratio", "0.5")
STIFFNESS = ("--spring-constant", f"{SPRING:g} N/m")


def written(path: Path, tabor: float, noise: float = 0.001) -> Path:
    """Curve of a sphere, by Maugis or, of an infinite Tabor number, by JKR."""
    sphere = jkr_sphere(RADIUS, 1 / MODULUS, WORK)
    if tabor < np.inf:
        sphere = maugis_dugdale(RADIUS, 1 / MODULUS, WORK, LENGTH / tabor)
    curve = curve_of(sphere, SPRING, noise, np.random.default_rng(7), rows=200)
    columns = np.c_[curve.times, 1e6 * curve.position, 1e9 * curve.deflection]
    head = "time [s],position [um],deflection [nm]"
    np.savetxt(path, columns, "%.9g", delimiter=",", header=head, comments="")
    return path


def stated(printed: str, name: str) -> tuple[float, float, float]:
    """Value and interval of a printed parameter."""
    found = re.search(rf"{name} = (\S+) \S+ \(95%: (\S+) to (\S+)\)", printed)
    assert found is not None, printed
    value, low, high = map(float, found.groups())
    return value, low, high


def test_force_curve_gives_work_range_modulus_and_contact_point(tmp_path, capsys):
    path, out = written(tmp_path / "curve.csv", 0.5), tmp_path / "found.yaml"
    command = ["fit", str(path), *TYPED, *STIFFNESS]
    assert main([*command, "-o", str(tmp_path / "fit.png"), "--yaml", str(out)]) == 0
    printed = capsys.readouterr().out
    truth = {"contact_modulus": MODULUS, "work": WORK, "tabor_number": 0.5, "range": 2 * LENGTH}
    for name, value in truth.items():
        found, low, high = stated(printed, name)
        assert low <= value <= high
        assert found == close_to(value, rel=0.05)
    assert "limit: between DMT's limit (below 0.1) and JKR's (above 5)" in printed
    assert re.search(r"contact at (1 µm|99\d\.\d+ nm|1\.00\d+ µm) ", printed)
    assert (tmp_path / "fit.png").stat().st_size > 10_000
    # The sections are those of a case.
    case = tmp_path / "case.yaml"
    rest = "indenter: {shape: sphere, radius: 5 um}\nload: {kind: step, approach: 0.1 um}\n"
    case.write_text(f"{out.read_text()}{rest}time: {{end: 1 s, steps: 2}}\n")
    read = read_case(case)
    assert read.adhesion.work == close_to(WORK, rel=0.05)
    assert read.adhesion.range == close_to(2 * LENGTH, rel=0.05)
    assert read.material.law.shear_modulus == close_to(MODULUS / 4, rel=0.05)


def test_limits_take_the_place_of_a_range_that_the_curve_does_not_tell(tmp_path, capsys):
    path, out = written(tmp_path / "curve.csv", np.inf), tmp_path / "found.yaml"
    assert main(["fit", str(path), *TYPED, *STIFFNESS, "--yaml", str(out)]) == 0
    printed = capsys.readouterr().out
    # JKR is the limit of large Tabor numbers; below one of 0.5 the pull-off differs by a tenth.
    least = re.search(r"tabor_number above (\S+) \(-\) \(95%\)", printed)
    most = re.search(r"range below (\S+) m \(95%\)", printed)
    assert least is not None
    assert most is not None
    assert float(least[1]) * float(most[1]) == close_to(LENGTH, rel=0.05)
    assert "limit: the limit of JKR fits, and so do Tabor numbers down to" in printed
    assert "  # range: the limit of JKR fits" in out.read_text()


def as_jpk(path: Path, curve: vc.ForceCurve) -> Path:
    """Write a curve into the channels of a file of JPK, whose encoders tell their scales."""
    known = vc.read_force_curve(CELL)
    values = {"vDeflection": curve.deflection, "strainGaugeHeight": curve.position}
    given = {"vDeflection": known.deflection, "strainGaugeHeight": known.position}
    with zipfile.ZipFile(CELL) as source, zipfile.ZipFile(path, "w") as target:
        for entry in source.namelist():
            channel = next((name for name in values if entry.endswith(f"{name}.dat")), None)
            data = source.read(entry)
            if channel is not None:
                part = slice(0, 2000) if entry.startswith("segments/0") else slice(2000, 4000)
                raw = np.frombuffer(data, ">i2")
                scale, offset = np.polyfit(raw.astype(float), given[channel][part], 1)
                counts = np.rint((values[channel][part] - offset) / scale)
                assert np.abs(counts).max() < 2**15
                data = counts.astype(">i2").tobytes()
            target.writestr(entry, data)
    return path


@pytest.mark.parametrize("tabor", [0.5, np.inf])
def test_force_curve_of_jpk_gives_work_and_modulus(tmp_path, capsys, tabor):
    pytest.importorskip("afmformats")
    # Soft and weak, as the heights are stored in steps of 3 nm, and bending up to 0.7 µm.
    modulus, work = 2e3, 5e-5
    sphere = jkr_sphere(RADIUS, 1 / modulus, work)
    if tabor < np.inf:
        length = float(np.cbrt(RADIUS * (work / modulus) ** 2))
        sphere = maugis_dugdale(RADIUS, 1 / modulus, work, length / tabor)
    spring = vc.read_force_curve(CELL).spring_constant
    curve = curve_of(sphere, spring, 0.002, np.random.default_rng(5), rows=2000)
    middle = -24.5e-6 - curve.position.mean()
    path = as_jpk(tmp_path / "sticky.jpk-force", replace(curve, position=curve.position + middle))
    assert main(["fit", str(path), *TYPED]) == 0
    printed = capsys.readouterr().out
    for name, value in {"contact_modulus": modulus, "work": work}.items():
        _, low, high = stated(printed, name)
        assert low <= value <= high
        assert high < 1.5 * low
    pull = re.search(r"pull-off force (\S+) nN", printed)
    assert pull is not None
    assert float(pull[1]) == close_to(-1e9 * sphere.pull_off.force, rel=0.01)


@pytest.mark.slow
def test_batch_has_a_row_of_each_curve_and_the_reason_of_none(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    written(Path("a.csv"), np.inf)
    written(Path("b.csv"), 0.5)
    rows = np.linspace(0.0, 1.0, 41)
    record = np.c_[rows, rows, rows]
    heads = {
        "c": "time [s],approach [um],force [nN]",
        "d": "time [s],position [um],deflection [nm]",
    }
    for name, head in heads.items():
        np.savetxt(f"{name}.csv", record, delimiter=",", header=head, comments="")
    files = [f"{name}.csv" for name in "abcd"]
    assert main(["fit", *files, *TYPED, *STIFFNESS, "-o", "fits.png"]) == 0
    said = capsys.readouterr()
    assert "2 of 4 curves" in said.out
    assert "determined by 1 of 2 curves" in said.out
    assert "c.csv: --adhesion goes with a force curve" in said.err
    assert "d.csv: no pull-off is found" in said.err
    with Path("fits.csv").open() as file:
        short, long, *_ = csv.DictReader(file)
    for row in (short, long):
        low, high = (float(row[f"work {end} [J/m^2]"]) for end in ("low", "high"))
        assert low <= WORK <= high
        # Against the exact pull-off forces, with noise of 0.1 % of the pull.
        sphere = jkr_sphere(RADIUS, 1 / MODULUS, WORK)
        if row is long:
            sphere = maugis_dugdale(RADIUS, 1 / MODULUS, WORK, 2 * LENGTH)
        pull = -sphere.pull_off.force
        assert float(row["pull_off_force [N]"]) == close_to(pull, rel=0.02)
        assert float(row["contact_point [m]"]) == close_to(1e-6, rel=0.02)
    assert (short["tabor_number"], short["tabor_number high"]) == ("", "inf")
    assert float(long["range [m]"]) == close_to(2 * LENGTH, rel=0.05)
    assert "pull_off_force low [N]" not in short
    assert Path("fits.png").stat().st_size > 1000


@pytest.mark.parametrize(
    ("typed", "message"),
    [
        (("--indenter", "cone 70 deg", "--poisson-ratio", "0.5"), "must be a Sphere"),
        (("--indenter", "sphere 5 um", "--bulk-modulus", "1 GPa"), "needs --poisson-ratio"),
        ((*TYPED, "--law", "zener"), "--law goes with an indentation"),
        ((*TYPED, "--terms", "2"), "the law of this indentation is elastic"),
    ],
)
def test_what_does_not_go_with_adhesion_is_refused(typed, message, tmp_path, capsys):
    path = written(tmp_path / "curve.csv", np.inf)
    assert main(["fit", str(path), "--adhesion", *STIFFNESS, *typed]) == 2
    assert message in " ".join(capsys.readouterr().err.split())
