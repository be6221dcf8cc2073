"""Peak memory of `viscontact run` when all fields of all steps are written during the run.

The paper's roller at e/L = 0.5, with several numbers of cells and steps, each in a new process.
The memory of the program itself (a small grid, two steps) is subtracted. Also printed: the size
of the output on disk, which is not kept in memory, and the memory that `viscontact check` predicts.

    python benchmarks/memory.py [--runs 512x512x120 2048x2048x50]
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

# No NumPy here: the peak memory of a child includes the memory of its parent at the fork.

CASE = "roller-dogbone-e05"
LIMITS = {"512x512x120": 300e6, "2048x2048x50": 16e9}
BARE = "128x32x2"


@dataclass(frozen=True)
class Memory:
    """Largest resident set [bytes], bytes on disk, seconds on the clock."""

    peak: float
    output: float
    seconds: float


def settings(size: str) -> list[str]:
    """Options of the case for "512x512x120": cells along x and y, and steps."""
    nx, ny, steps = size.split("x")
    words = (f"grid.shape=[{nx}, {ny}]", f"time.steps={steps}", "output.fields=all")
    return [each for word in words for each in ("--set", word)]


def measure(case: Path, size: str, directory: Path) -> Memory:
    """Run the case and measure memory, output and time."""
    target = directory / size
    words = ["-m", "viscontact", "run", str(case), *settings(size), "-q", "-o", str(target)]
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
    parser.add_argument("--runs", nargs="+", default=list(LIMITS), metavar="NXxNYxSTEPS")
    sizes = parser.parse_args().runs
    with tempfile.TemporaryDirectory() as name:
        directory = Path(name)
        case = directory / "case.yaml"
        example = [sys.executable, "-m", "viscontact", "example", CASE, "-o", str(case)]
        subprocess.run(example, check=True, capture_output=True)
        bare = measure(case, BARE, directory).peak
        print(f"the program itself takes {bare / 1e6:.0f} MB; additional memory of a run:")
        print(
            f"{'cells and steps':18}{'MB':>7}{'limit':>8}{'predicted':>10}{'output MB':>11}{'s':>7}"
        )
        for size in sizes:
            run = measure(case, size, directory)
            limit = f"{LIMITS[size] / 1e6:.0f}" if size in LIMITS else ""
            print(
                f"{size:18}{(run.peak - bare) / 1e6:7.0f}{limit:>8}{predicted(case, size):>10}"
                f"{run.output / 1e6:11.0f}{run.seconds:7.0f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
