"""Command `sensitivity`: its options, its files, and its messages."""

from __future__ import annotations

from pathlib import Path

import pytest
import xarray as xr
from tests.studies.sensitivity.cases import HERTZ

from viscontact.cli.entry import main

COMMAND = ("sensitivity", "case.yaml", "--change", "load.force", "-o", "found")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("case.yaml").write_text(HERTZ + "output: {errors: false}\n")
    return tmp_path


@pytest.mark.slow
def test_a_sensitivity_writes_table_and_report_and_is_continued(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main([*COMMAND, "--of", "approach"]) == 0
    said = capsys.readouterr()
    assert said.out.startswith("approach = 73.")
    assert "  load.force: 0.66" in said.out
    assert said.out.endswith("found/report.html\nfound/sensitivity.nc\n")
    assert "note: approach: its error is not known" in said.err
    page = Path("found/report.html").read_text(encoding="utf-8")
    assert "Hertz: sensitivity" in page
    assert page.count("data:image/svg+xml") == 1
    assert main([*COMMAND, "--of", "approach"]) == 2
    assert "found: holds runs already; continue them with --resume" in capsys.readouterr().err
    twice = ("--set", "load.force=2 N", "-q")
    assert main([*COMMAND, "--of", "approach", *twice, "--overwrite"]) == 0
    assert capsys.readouterr().out.startswith("approach = 116.")  # Hertz: 2^(2/3) as large
    # Another output needs no other run.
    before = Path("found/load.force+1/result.nc").stat().st_mtime_ns
    assert main([*COMMAND, "--of", "contact_area", *twice, "--resume"]) == 0
    assert Path("found/load.force+1/result.nc").stat().st_mtime_ns == before
    with xr.open_dataset("found/sensitivity.nc") as table:
        assert table["output"].values.tolist() == ["contact_area"]
        assert table["input_units"].values.tolist() == ["N"]


@pytest.mark.slow
def test_scatter_is_sampled_and_more_samples_are_added(capsys: pytest.CaptureFixture[str]) -> None:
    scatter = ("--of", "approach", "--scatter", "load.force=0.9N:1.1N:normal", "-q")
    assert main([*COMMAND, *scatter, "--samples", "3"]) == 0
    said = capsys.readouterr()
    assert "samples: 3 are rounded up to 4, a power of two" in said.err
    assert "  variance by load.force: alone" in said.out
    assert len(list(Path("found").glob("sample-*"))) == 4 * 3
    before = Path("found/sample-A-00003/result.nc").stat().st_mtime_ns
    assert main([*COMMAND, *scatter, "--samples", "8", "--resume"]) == 0
    assert len(list(Path("found").glob("sample-*"))) == 8 * 3
    assert Path("found/sample-A-00003/result.nc").stat().st_mtime_ns == before
    with xr.open_dataset("found/sensitivity.nc") as table:
        low, middle, high = table.percentile.sel(output="approach").values
        assert low < middle < high


def test_an_interrupted_sensitivity_says_how_to_continue(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(**arguments: object) -> None:
        Path("found").mkdir()
        Path("found/runs.jsonl").touch()
        raise KeyboardInterrupt

    monkeypatch.setattr("viscontact.cli.studies.sensitivity.sensitivity", interrupted)
    assert main([*COMMAND, "--of", "approach"]) == 130
    assert "continue with the same command and --resume" in capsys.readouterr().err


REFUSED = {
    "output": (("--of", "aproach"), "--of: 'aproach' is no scalar of a result; did you mean"),
    "key": (
        ("--of", "approach", "--change", "load.farce"),
        "--change: load.farce: the case has no such number; its inputs are",
    ),
    "instant": (("--of", "approach", "--at", "1 mm"), "--at: write worst, end or a time"),
    "setting": (("--of", "approach", "--set", "load.force=1 mm"), "cannot read '1 mm' as a force"),
    "range": (
        ("--of", "approach", "--scatter", "load.force=2N:1N"),
        "--scatter: load.force: the lower bound comes first",
    ),
    "no range": (("--of", "approach", "--scatter", "load.force"), "--scatter load.force: write"),
    "scatter of text": (
        ("--of", "approach", "--scatter", "material.law=a:b"),
        "--scatter: material.law: 'a' is not a number",
    ),
    "samples": (
        ("--of", "approach", "--scatter", "load.force=1N:2N", "--samples", "-4"),
        "samples",
    ),
    "no setting": (("--of", "approach", "--set", "load"), "--set load: write KEY=VALUE"),
}


@pytest.mark.parametrize(("options", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_bad_input_is_refused_in_one_line(
    options: tuple[str, ...], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*COMMAND, *options]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert len(said.splitlines()) == 1
    assert not Path("found").exists()
