"""The shipped calender roll heats up as the manual says."""

from __future__ import annotations

from pathlib import Path

import pytest

from viscontact.cli import main


@pytest.mark.slow
def test_calender_roll_runs_away_at_ten_metres_a_second(tmp_path: Path, capsys) -> None:
    case = tmp_path / "roll.yaml"
    assert main(["example", "calender-roll", "-o", str(case)]) == 0
    assert main(["run", str(case), "--quiet", "--set", "output.errors=false"]) == 0
    air = ["--cooling", "40 W/m2/K", "--ambient", "60 degC", "--conductivity", "0.3 W/m/K"]
    assert main(["heat", str(case.with_suffix("")), *air, "--speed", "5 m/s"]) == 0
    out = capsys.readouterr().out
    assert "thermal runaway at 9.9" in " ".join(out.split())
    assert "unstable" in out
