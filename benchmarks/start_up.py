"""Start-up times: the fastest of several new processes for each command.

Prints wall-clock time and CPU time: on a machine with other work, only the CPU time measures the
program.

    ./go bench start-up [--repeat 10]
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import viscontact

try:
    import resource
except ImportError:  # not on Windows
    resource = None

CASE = Path(viscontact.__file__).parent / "examples" / "roller-dogbone-e05.yaml"
READ = f"from viscontact.case import read_case; read_case({str(CASE)!r})"

FIRST_STEP = """
import os, sys
from viscontact.cli import main
from viscontact.simulation.stepper import Stepper
Stepper.trial = lambda *_: os._exit(0)
main()
"""


@dataclass(frozen=True)
class Start:
    """Command to start, and the limit of its wall-clock time [s]."""

    name: str
    words: tuple[str, ...]
    limit: float | None = None


STARTS = (
    Start("python itself", ("-c", "pass")),
    Start("import numpy", ("-c", "import numpy")),
    Start("import viscontact", ("-c", "import viscontact"), 0.3),
    Start("viscontact --help", ("-m", "viscontact", "--help"), 0.6),
    Start("viscontact run --help", ("-m", "viscontact", "run", "--help"), 0.6),
    Start("first case parsed", ("-c", READ), 1.0),
    Start("viscontact check CASE", ("-m", "viscontact", "check", str(CASE))),
    Start("run, to its first step", ("-c", FIRST_STEP, "run", str(CASE), "--overwrite")),
    Start("viscontact show RUN", ("-m", "viscontact", "show", "run")),
    Start("vc.simulate, imported", ("-c", "import viscontact as vc; vc.simulate")),
)


def processor_time() -> float:
    if resource is None:
        return float("nan")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return float(used.ru_utime + used.ru_stime)


def seconds(words: tuple[str, ...], folder: str) -> tuple[float, float]:
    """Wall-clock time and CPU time [s] of one new process in a folder."""
    before, started = processor_time(), time.perf_counter()
    subprocess.run([sys.executable, *words], check=True, capture_output=True, cwd=folder)
    return time.perf_counter() - started, processor_time() - before


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=10)
    repeat = parser.parse_args().repeat
    print(f"{'':24}{'clock s':>9}{'CPU s':>9}{'limit s':>9}")
    with tempfile.TemporaryDirectory() as folder:
        seconds(("-m", "viscontact", "run", str(CASE), "-o", "run"), folder)
        for start in STARTS:
            each = [seconds(start.words, folder) for _ in range(repeat)]
            clock, processor = (min(times) for times in zip(*each, strict=True))
            limit = "" if start.limit is None else f"{start.limit:.1f}"
            print(f"{start.name:24}{clock:9.2f}{processor:9.2f}{limit:>9}")


if __name__ == "__main__":
    main()
