"""Peak memory of `viscontact run` when all fields of all steps are written during the run.

The paper's roller at e/L = 0.5, and a creeping sphere that is eccentric both ways, so that nothing
is symmetric, with several numbers of cells and steps, each in a new process. The memory of the
program itself (a small grid, two steps) is subtracted. Also printed: the bytes for each cell, the
size of the output on disk, which is not kept in memory, and what `viscontact check` predicts.

    python benchmarks/memory.py [--runs roller:512x512x120 sphere:4096x4096x20] [--threads 2]
"""

from __future__ import annotations

import argparse
import math
import os
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

# No NumPy here: the peak memory of a child includes the memory of its parent at the fork.

ROLLER = "roller-dogbone-e05"
SPHERE = """
indenter: {shape: sphere, radius: 10 mm}
material:
  {law: zener, shear_modulus: 1 MPa, delayed_modulus: 1 MPa, viscosity: 1 MPa s, poisson_ratio: 0.4}
load: {kind: step, force: 81.2 mN, eccentricity_x: 2 um, eccentricity_y: 1.5 um}
time: {end: 2 s, steps: 4, spacing: uniform}
grid: {shape: [64, 64], size: [2 mm, 2 mm]}
output: {errors: false}
"""
LIMITS = {
    "roller:512x512x120": 300e6,
    "roller:2048x2048x50": 16e9,
    "sphere:1024x1024x20": 216 * 2**20,
    "sphere:4096x4096x20": 5e9,
    "sphere:8192x8192x3": 18e9,
}
BARE = "128x32x2"


@dataclass(frozen=True)
class Memory:
    """Largest resident set [bytes], bytes on disk, seconds on the clock."""

    peak: float
    output: float
    seconds: float


def settings(size: str) -> list[str]:
    """Options of the case for "512x512x120": cells along x and y, and steps."""
    nx, ny, steps = map(int, size.split("x"))
    # The fields of all steps on 2^24 cells would fill the disk.
    fields = "all" if nx * ny * steps < 2**28 else "none"
    words = (f"grid.shape=[{nx}, {ny}]", f"time.steps={steps}", f"output.fields={fields}")
    return [each for word in words for each in ("--set", word)]


def measure(case: Path, size: str, directory: Path, threads: int) -> Memory:
    """Run the case and measure memory, output and time."""
    target = directory / f"{case.stem} {size}"
    options = [*settings(size), "-q", "--threads", str(threads), "-o", str(target)]
    words = ["-m", "viscontact", "run", str(case), *options]
    begun = time.perf_counter()
    child = subprocess.Popen([sys.executable, *words])
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise SystemExit(f"{size}: the run ended with status {child.returncode}")
    unit = 1 if sys.platform == "darwin" else 1024
    output = sum(file.stat().st_size for file in target.rglob("*") if file.is_file())
    return Memory(used.ru_maxrss * unit, output, time.perf_counter() - begun)


def predicted(case: Path, size: str) -> str:
    """Memory that `check` predicts for a run."""
    words = ["-m", "viscontact", "check", str(case), *settings(size)]
    done = subprocess.run([sys.executable, *words], text=True, capture_output=True, check=True)
    found = re.search(r"([\d.]+ [MG]B)", done.stdout)
    return found.group(1) if found else "nothing"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    few = [run for run in LIMITS if "4096" not in run and "8192" not in run]
    parser.add_argument("--runs", nargs="+", default=few, metavar="CASE:NXxNYxSTEPS")
    parser.add_argument("--threads", type=int, default=1)
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        directory = Path(name)
        roller, sphere = directory / "roller.yaml", directory / "sphere.yaml"
        example = [sys.executable, "-m", "viscontact", "example", ROLLER, "-o", str(roller)]
        subprocess.run(example, check=True, capture_output=True)
        sphere.write_text(SPHERE)
        bare = measure(roller, BARE, directory, 1).peak
        print(f"the program itself takes {bare / 1e6:.0f} MB; additional memory of a run:")
        print(
            f"{'case, cells and steps':24}{'MB':>7}{'a cell':>8}{'limit':>8}{'predicted':>11}"
            f"{'output MB':>11}{'s':>7}"
        )
        for each in chosen.runs:
            case, size = each.split(":")
            path = directory / f"{case}.yaml"
            run = measure(path, size, directory, chosen.threads)
            cells = math.prod(map(int, size.split("x")[:2]))
            limit = f"{LIMITS[each] / 1e6:.0f}" if each in LIMITS else ""
            print(
                f"{each:24}{(run.peak - bare) / 1e6:7.0f}{(run.peak - bare) / cells:8.0f}"
                f"{limit:>8}{predicted(path, size):>11}{run.output / 1e6:11.0f}{run.seconds:7.0f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
