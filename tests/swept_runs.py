"""Sweeps of small runs on disk, for tests that read them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from interrupted_runs import BODIES
from viscontact.cli import main
from viscontact.studies.sweep.manifest import SweepRun, write_manifest

CASE = (
    BODIES
    + """\
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 4}
grid: {shape: [24, 24], size: [4 mm, 4 mm]}
output: {fields: [0 s, 5 s]}
"""
)


def sweep_of(
    folder: Path,
    rows: Sequence[Mapping[str, str]],
    design: str = "grid",
    waiting: Collection[int] = (),
) -> Path:
    """Compute the runs of a sweep, but for those that wait, and return its directory."""
    case, sweep = folder / "ball.yaml", folder / "sweep"
    case.write_text(CASE, encoding="utf-8")
    runs = []
    for number, row in enumerate(rows):
        name = "_".join(f"{key.rpartition('.')[2]}={value}" for key, value in row.items())
        name = name.replace(" ", "").replace("/", "-")
        runs.append(SweepRun(number, name, name, row, tuple(row), "../ball.yaml", design))
    write_manifest(sweep, runs)
    for run in runs:
        if run.run not in waiting:
            settings = [word for text in run.assignments for word in ("--set", text)]
            place = str(sweep / run.directory)
            assert main(["run", str(case), "-o", place, "--quiet", *settings]) == 0
    return sweep
