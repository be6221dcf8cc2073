"""`viscontact fit --adhesion`: one force curve of an adhering sphere, and many."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from closeness import close_to
from identification.adhesive_curves import RADIUS, curve_of
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.reference import jkr_sphere, maugis_dugdale

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
