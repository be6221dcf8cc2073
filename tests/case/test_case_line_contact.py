"""Line contact in a case file: periodic along one axis, an infinite radius."""

import math

import pytest

import viscontact as vc
from viscontact.case import CaseError, read_case
from viscontact.cli import main

CASE = """
indenter: {shape: paraboloid, radius_x: infinite, radius_y: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.1 N}
time: {end: 100 s, steps: 4, spacing: log}
grid: {shape: [1, 48], size: [1 mm, 2.4 mm], periodic: [true, false]}
"""


def test_case_file(tmp_path):
    """The same as in Python."""
    path = tmp_path / "case.yaml"
    path.write_text(CASE)
    case = read_case(path)
    assert (case.indenter, case.grid) == (
        vc.Paraboloid(math.inf, 0.01),
        vc.Grid((1, 48), (1e-3, 2.4e-3), periodic=(True, False)),
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[true, false]", "[true, maybe]", r"grid\.periodic\[2\]: must be"),
        ("[true, false]", "[true]", r"grid\.periodic"),
        ("force: 0.1 N", "mean_pressure: 1 kPa", r"a periodic grid \(along both axes\)"),
        ("shape: [1, 48], size: [1 mm, 2.4 mm], ", "", "goes with shape and size, an"),
    ],
)
def test_refused_in_a_case(tmp_path, old, new, message):
    path = tmp_path / "case.yaml"
    path.write_text(CASE.replace(old, new))
    with pytest.raises(CaseError, match=message):
        read_case(path)


@pytest.mark.slow
def test_command_line(tmp_path, monkeypatch, capsys):
    """A run, its check, report and figures without an approach, at a logarithmic time."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.yaml").write_text(CASE)
    assert main(["check", "case.yaml"]) == 0
    checked = capsys.readouterr().out
    assert "periodic along x" in checked
    assert "approach  " not in checked
    assert main(["run", "case.yaml", "--quiet"]) == 0
    assert main(["show", "case"]) == 0
    assert main(["report", "case"]) == 0
    for figure in ("history", "pressure-map", "surface-3d", "contact-area", "stress-section"):
        assert main(["plot", "case", figure]) == 0
    assert main(["plot", "case", "animation", "--seconds", "1", "--fps", "2"]) == 0
    assert main(["plot", "case", "hysteresis"]) == 2


@pytest.mark.parametrize("periodic", [", periodic: false", ""])
@pytest.mark.parametrize("command", ["run", "check"])
def test_a_cylinder_without_period_is_refused(tmp_path, monkeypatch, capsys, command, periodic):
    monkeypatch.chdir(tmp_path)
    text = CASE.replace(", periodic: [true, false]", periodic).replace("[1, 48]", "[8, 48]")
    (tmp_path / "case.yaml").write_text(text)
    assert main([command, "case.yaml"]) == 2
    assert "case.yaml:6: grid.periodic: the body continues along x" in capsys.readouterr().err
