"""`viscontact design --profile free`."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import numpy as np
import pytest
import xarray as xr
from tests.studies.design.test_profile_parts import ROLLER

from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main
from viscontact.indenters import Roller

WIDE = ROLLER.replace("radius: 5 mm", "radius: 50 mm") + (
    "grid: {shape: [108, 35], size: [21.6 mm, 2.6 mm]}\noutput: {errors: false}\n"
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working directory with the case of a roller."""
    monkeypatch.chdir(tmp_path)
    Path("roller.yaml").write_text(WIDE)
    return tmp_path


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--profile", "fre"], "--profile fre: write free, free:KNOTS, or free:KNOTS:asymmetric"),
        (["--profile", "free:2"], "knots must be a whole number from 3 to 20, got 2"),
        (["--profile", "free", "--maximise", "force"], "--maximise: does not go with --profile"),
        (
            ["--profile", "free", "--minimise", "approach"],
            "minimises peak_pressure, got approach",
        ),
        (["--profile", "free", "--change", "load.force=1N:2N"], "--change: does not go with"),
        (["--drop-tolerance", "1 um"], "--drop-tolerance: goes with --profile free"),
        (["--profile", "free", "--drop-tolerance", "1"], "--drop-tolerance: 1 has no unit"),
        (["--profile", "free", "--at", "3 s"], "--at: 3 s is no instant of the case"),
        (["--profile", "free", "--set", "load.force=1 mm"], "load.force"),
    ],
)
def test_what_a_profile_cannot_have_is_refused_in_one_line(
    folder: Path, options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["design", "roller.yaml", *options, "-o", "found"]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert len(said.strip().splitlines()) == 1
    assert not Path("found").exists()


@pytest.mark.slow
def test_the_profile_is_written_for_a_case_a_table_and_a_drawing(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["design", "roller.yaml", "--profile", "free:4", "-o", "found", "--drop-tolerance"]
    assert main([*command, "0.2 um"]) == 0
    said = capsys.readouterr()
    assert said.out.startswith("least peak_pressure: ")
    assert "  lundberg     " in said.out
    assert "note: within ± 200 nm of the drop the largest peak pressure is" in said.err
    roller = read_case("found/best.yaml").indenter
    assert isinstance(roller, Roller)
    with xr.open_dataset("found/trials.nc") as table:
        x, drop = table["x"].values, table["drop"].sel(profile="free").values
        peak = float(table.peak_pressure.sel(profile="free"))
    np.testing.assert_allclose(roller.drop(x), drop, atol=1e-10)
    (line,) = ezdxf.readfile("found/profile.dxf").modelspace()
    np.testing.assert_allclose(
        np.array(line.get_points("xy")), np.column_stack([1e3 * x, 50 - 1e3 * drop]), atol=1e-9
    )
    report = Path("found/report.html").read_text(encoding="utf-8")
    assert "crown deeper" in report
    # The best case is a case as any other, with the peak pressure that the table states.
    assert main(["run", "found/best.yaml", "-o", "run", "--quiet"]) == 0
    with xr.open_dataset("run/result.nc") as run:
        assert float(run.peak_pressure.max()) == close_to(peak, rel=1e-5)
    assert main([*command, "0.2 um"]) == 2
    assert "holds runs already; continue them with --resume" in capsys.readouterr().err
    assert main([*command, "0.2 um", "--resume", "--quiet"]) == 0
