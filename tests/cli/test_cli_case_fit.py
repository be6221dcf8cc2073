"""Command `fit --case`: its files, its messages, and how it goes on."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.studies.calibration.experiments import ELASTIC_BALL, hertz_depth

from closeness import close_to
from viscontact.case import read_case
from viscontact.cli.entry import main
from viscontact.cli.studies import case_fit
from viscontact.studies.calibration.fit_case import fit_case

COMMAND = ("fit", "a.csv", "--case", "ball.yaml")
OF_RUNS = (("--rows", "9"), ("--jobs", "1"), ("--resume",), ("--overwrite",))
MODULUS = ("--change", "material.shear_modulus=0.5 MPa:9 MPa:log")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(ELASTIC_BALL)
    force = np.linspace(0.0, 0.1, 7)
    rows = zip(np.arange(7.0), force, 1e6 * hertz_depth(force) + 2.0, strict=True)
    lines = [f"{time:.6g}, {load:.6g}, {depth:.6g}\n" for time, load, depth in rows]
    Path("a.csv").write_text("time [s], force [N], approach [um]\n" + "".join(lines))
    return tmp_path


@pytest.mark.slow
def test_a_fit_prints_draws_and_writes_the_section(capsys: pytest.CaptureFixture[str]) -> None:
    files = ("-o", "fit.png", "--yaml", "found.yaml", "--report", "fit.html")
    assert main([*COMMAND, *MODULUS, "--contact-point", "-9 um:9 um", *files]) == 0
    said = capsys.readouterr().out
    assert said.startswith("CaseFit: 7 rows of 1 record, residual ")
    assert "contact_point = 2" in said
    assert said.endswith("fit.png\nfound.yaml\nfit.html\n")
    assert Path("fit.png").read_bytes().startswith(b"\x89PNG")
    section = Path("found.yaml").read_text()
    assert section in said
    page = Path("fit.html").read_text(encoding="utf-8")
    assert section in page
    value, interval = re.search(r"shear_modulus = (\S+ MPa) \(95%: (.*?);", said).groups()
    assert f"<td>{value}</td><td>{interval}</td>" in page
    assert page.count("data:image/svg+xml") == 1
    Path("whole.yaml").write_text(section + ELASTIC_BALL.replace("material:", "title: x #"))
    found: Any = read_case("whole.yaml").material
    assert found.law.shear_modulus == close_to(2e6, rel=0.02)
    assert not list(Path().glob("*.jsonl"))


def test_an_interrupted_fit_goes_on_with_resume_only(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*given: Any, progress: Any, **named: Any) -> Any:
        def stop(done: int, allowed: int) -> None:
            if done == 4:
                raise KeyboardInterrupt

        return fit_case(*given, progress=stop, **named)

    with monkeypatch.context() as patched:
        patched.setattr(case_fit, "fit_case", interrupted)
        assert main([*COMMAND, *MODULUS, "-q"]) == 130
    said = capsys.readouterr().err
    assert "interrupted; a-fit.jsonl keeps the finished runs" in said
    assert "continue with the same command and --resume" in said
    assert main([*COMMAND, *MODULUS]) == 2
    assert "a-fit.jsonl: holds runs already" in capsys.readouterr().err
    assert main([*COMMAND, "--change", "material.shear_modulus=1 MPa:9 MPa", "--resume"]) == 2
    assert "a-fit.jsonl: holds another fit" in capsys.readouterr().err
    assert main([*COMMAND, *MODULUS, "--resume"]) == 0
    assert not Path("a-fit.jsonl").exists()


@pytest.mark.parametrize(
    ("typed", "reason"),
    [
        ((*COMMAND,), "--change: name an unknown"),
        ((*COMMAND, "--change", "material"), "--change material: write KEY=LOW:HIGH"),
        ((*COMMAND, *MODULUS, *MODULUS), "--change material.shear_modulus: is given twice"),
        ((*COMMAND, "--change", "material.modulus=1 MPa:2 MPa"), "material.modulus: unknown key"),
        ((*COMMAND, "--change", "load.force=1 N:2 N"), "--change: load.force: is no unknown"),
        ((*COMMAND, *MODULUS, "--drive", "moment"), "--drive: must be"),
        ((*COMMAND, *MODULUS, "--contact-point", "1 N:2 N"), "--contact-point: cannot read"),
        ((*COMMAND, *MODULUS, "--runs", "1"), "--runs: 1 are too few for this fit"),
        ((*COMMAND, *MODULUS, "--indenter", "sphere 5 mm"), "--indenter does not go with --case"),
        ((*COMMAND, *MODULUS, "--law", "zener"), "--law does not go with --case"),
        (
            (*COMMAND, *MODULUS, "--thermal-strain", "no"),
            "--thermal-strain does not go with --case",
        ),
        *((("fit", "a.csv", *typed), f"{typed[0]}: needs --case CASE.yaml") for typed in OF_RUNS),
        (("fit", "a.csv", *MODULUS), "--change: needs --case CASE.yaml"),
        (("fit", "a.csv", "--report", "a.html"), "--report: needs --case CASE.yaml"),
        (("fit", "a.csv", "a.csv"), "2 tables: give --indenter"),
        (("fit", "b.csv", "--case", "ball.yaml", *MODULUS), "no such file"),
        (("fit", "a.csv", "--case", "none.yaml", *MODULUS), "none.yaml"),
    ],
)
def test_bad_input_is_refused_in_one_line(
    typed: tuple[str, ...], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(list(typed)) == 2
    said = capsys.readouterr().err
    assert reason in said
    assert len(said.splitlines()) == 1
    assert not list(Path().glob("*.jsonl"))
