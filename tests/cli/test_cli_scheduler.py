"""`--scheduler` with names that are no scheduler, refused before Dask is imported."""

from __future__ import annotations

from pathlib import Path

import pytest

from viscontact.cli import main

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 1 s, steps: 1}
grid: {shape: [24, 24], size: [5 mm, 5 mm]}
"""


COMMANDS = {
    "run": ("run", "ball.yaml", "--vary", "load.force=1N,2N", "-o", "out"),
    "design": (
        *("design", "ball.yaml", "--change", "load.force=1N,2N", "--minimise", "approach"),
        *("-o", "out"),
    ),
    "profile": ("design", "ball.yaml", "--profile", "free", "-o", "out"),
    "sensitivity": ("sensitivity", "ball.yaml", "--of", "approach", "-o", "out"),
    "fit": ("fit", "a.csv", "--case", "ball.yaml", "--change", "load.force=1N:2N"),
}


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
@pytest.mark.parametrize(
    ("scheduler", "why"),
    [
        ("none.json", "no such file; give an address, as tcp://node17:8786, "),
        ("none", "no such file; give an address, as tcp://node17:8786, "),
        ("ball.yaml", "is not a scheduler file, which `dask scheduler --scheduler-file` writes; "),
        ("other.json", "is not a scheduler file, which `dask scheduler --scheduler-file` writes; "),
    ],
)
def test_other_files_than_those_of_a_scheduler_are_refused_in_one_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    scheduler: str,
    why: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(CASE, encoding="utf-8")
    Path("other.json").write_text('{"address": 5}', encoding="utf-8")
    assert main([*words, "--scheduler", scheduler]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"--scheduler {scheduler}: {why}")
    assert not Path("out").exists()
