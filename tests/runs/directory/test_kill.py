"""Runs that are killed lose what came after the last checkpoint, and end in the same numbers.

A sample; the whole campaign takes about four minutes on two cores that others use too.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time as clock
from collections.abc import Callable
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("Windows kills in other ways, and has no fork", allow_module_level=True)

import xarray as xr

from campaigns import tried
from forked_run import ForkedRun
from killed_run import complete, differing, lines_of, resumed_after

HERE = Path(__file__).parents[2]
RUBBER = """\
indenter: {shape: sphere, radius: 10 mm}
grid: {shape: [32, 32], size: [3 mm, 3 mm]}
"""
ZENER = """\
material: {law: zener, shear_modulus: 10 MPa, delayed_modulus: 10 MPa, viscosity: 10 MPa s,
  poisson_ratio: 0.5}
"""
SWING = "load: {kind: harmonic, mean: 3 N, amplitude: 1 N, period: 1 s, cycles: 6}\n"
#: Some seconds each, in several hundred steps: of a series, of all earlier steps, of chosen steps.
CASES = {
    "series": ZENER + SWING + "time: {end: 6 s, steps: 300}\noutput: {fields: [0 s, 3 s, 6 s]}\n",
    "power law": """\
material: {law: power-law, compliance: 5e-8 / Pa, exponent: 0.3, reference_time: 1 s,
  instant: 5e-8 / Pa, data: deviatoric, poisson_ratio: 0.5}
load: {kind: ramp, force: 4 N, duration: 2 s}
time: {end: 8 s, steps: 300}
output: {fields: all}
""",
    "adaptive": ZENER
    + SWING
    + "time: {end: 6 s, spacing: adaptive, tolerance: 5e-4}\noutput: {fields: [0 s, 3 s, 6 s]}\n",
}
KILLS = {"series": tried(6, 18), "power law": tried(6, 16), "adaptive": tried(6, 16)}
SHORT = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 10 MPa, delayed_modulus: 10 MPa, viscosity: 10 MPa s,
  poisson_ratio: 0.5}
load: {kind: triangle, force: 4 N, rise: 1 s}
time: {end: 2.5 s, steps: 7}
grid: {shape: [24, 24], size: [3 mm, 3 mm]}
output: {fields: [0 s, 1 s, 2.5 s]}
"""


class RandomKills:
    """Real processes of one case, killed at random moments."""

    def __init__(self, folder: Path, kind: str) -> None:
        self.folder, self.chance = folder, random.Random(f"{kind} 1")
        (folder / "case.yaml").write_text(RUBBER + CASES[kind], encoding="utf-8")
        self.faults: list[str] = []
        self.killed = self.lost = 0
        code, said = self.ended("whole")
        assert (code, resumed_after(said)) == (0, 0)
        with xr.open_dataset(folder / "whole" / "result.nc") as ds:
            self.whole = ds.load()
        self.lines = lines_of(folder / "whole")
        self.size = sum(len(line) + 1 for line in self.lines)

    def ended(self, name: str) -> tuple[int, str]:
        return ForkedRun(self.folder, name).ended()

    def kill(self, name: str, part: float) -> bool:
        """Begin or resume a run, kill it within a part of what is left; say whether it was over."""
        directory = self.folder / name
        progress = directory / "progress.jsonl"
        before = len(lines_of(directory))
        length = progress.stat().st_size if before else 0
        # By what it has done, not by time: that depends on what else the machine does.
        wanted = length + self.chance.random() * part * (self.size - length)
        run = ForkedRun(self.folder, name)
        while not run.is_over() and not (progress.exists() and progress.stat().st_size > wanted):
            clock.sleep(0.001)
        clock.sleep(self.chance.random() * 0.03)
        run.kill()
        code, said = run.ended()
        after = resumed_after(said)
        if after is not None and after < before:
            self.lost = max(self.lost, before - after)
        if code == 0:
            self.faults += [f"{name}: {fault}" for fault in complete(directory, self.whole)]
            return True
        if code != -signal.SIGKILL:
            self.faults.append(f"{name}: ended with {code}: {said}")
        self.killed += 1
        self._judge(name)
        return False

    def _judge(self, name: str) -> None:
        directory = self.folder / name
        if (written := lines_of(directory)) != self.lines[: len(written)]:
            self.faults.append(f"{name}: its progress differs")
        if (directory / "result.nc").exists():
            found = differing(directory / "result.nc", self.whole)
            self.faults += [f"{name}: {fault}" for fault in found]
        elif len(written) > 1:
            self.faults.append(f"{name}: there is no result")

    def finish(self, name: str) -> None:
        code, said = self.ended(name)
        if code:
            self.faults.append(f"{name}: cannot be finished: {said}")
        else:
            self.faults += [f"{name}: {f}" for f in complete(self.folder / name, self.whole)]


@pytest.mark.slow
@pytest.mark.parametrize("kind", CASES)
def test_run_that_is_killed_at_random_moments_ends_in_the_same_bits(
    kind: str, tmp_path: Path, campaign: Callable[[str], None]
) -> None:
    kills = RandomKills(tmp_path, kind)
    # Half of them one after the other in few directories, the others anywhere in a fresh run.
    chain = 0
    while kills.killed < KILLS[kind] // 2:
        chain += kills.kill(f"chain {chain}", 0.25)
    kills.finish(f"chain {chain}")
    number = 0
    while kills.killed < KILLS[kind]:
        over = kills.kill(f"fresh {number}", 0.9)
        if not over and number % 4 == 0:
            kills.finish(f"fresh {number}")
        number += 1
    campaign(
        f"{kind}: {kills.killed} runs of {len(kills.lines)} instants killed at random moments: "
        f"computed again {kills.lost} instants at most, faults {len(kills.faults)}"
    )
    assert kills.faults == []


@pytest.mark.slow
@pytest.mark.parametrize("mode", ["lines", "limits", "lines growing", "limits growing"])
def test_run_that_is_killed_within_what_it_writes_ends_in_the_same_bits(
    mode: str, tmp_path: Path, campaign: Callable[[str], None]
) -> None:
    (tmp_path / "case.yaml").write_text(SHORT, encoding="utf-8")
    at, *grows = mode.split()
    command = [sys.executable, str(HERE / "killed_run.py"), at, str(tmp_path), "1", *grows]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    found = json.loads(done.stdout)
    where = {
        "lines": "between two lines of the code that writes",
        "limits": "by the system within a call that writes",
    }
    kind = " whose grid grows" if grows else ""
    campaign(f"{found['killed']} runs{kind} killed {where[at]}: faults {len(found['faults'])}")
    assert found["faults"] == []
    assert (found["grid_enlarged"] != "") == bool(grows)
    assert found["killed"] > (tried(5, 15) if grows else tried(18, 50))


@pytest.mark.slow
def test_disk_that_is_really_full_stops_a_run_which_continues_with_more_space(
    tmp_path: Path, campaign: Callable[[str], None]
) -> None:
    kills = RandomKills(tmp_path, "series")
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("no small disk can be mounted here")
    stops = 0
    try:
        for size in (64, 128, 256, 384, 512, 768, 20_000):
            subprocess.run(["mount", "-o", f"remount,size={size}k", str(disk)], check=True)
            code, said = kills.ended("disk/run")
            if code == 0:
                break
            stops += 1
            assert code in (1, 2), said
            assert len(said.splitlines()) <= 20
            assert "Traceback" not in said
            if code == 1:
                assert "No space left" in said or "is the disk full?" in said
            if (disk / "run" / "result.nc").exists():
                assert differing(disk / "run" / "result.nc", kills.whole) == []
        assert code == 0
        assert complete(disk / "run", kills.whole) == []
    finally:
        subprocess.run(["umount", str(disk)], check=True)
    campaign(f"a disk was full {stops} times: faults 0")
    assert stops > 1
