"""Start-up times: the fastest of several new processes for each command.

Prints wall-clock time and CPU time: on a machine with other work, only the CPU time measures the
program. Byte code is written before it is measured.

    ./go bench start-up [--repeat 10]
"""

from __future__ import annotations

import argparse
import os
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

EXAMPLES = Path(viscontact.__file__).parent / "case" / "examples"
CASE = EXAMPLES / "roller-dogbone-e05.yaml"
READ = f"from viscontact.case import read_case; read_case({str(CASE)!r})"

# NumPy and the others are imported as the command does it: without threads of linear algebra, which
# take a tenth of a second of CPU time, and without collections.
FIRST_STEP = """
import os
from viscontact.cli.entry import limit_libraries, main
from viscontact.cli.quick_imports import quick_imports
limit_libraries()
with quick_imports():
    from viscontact.simulation.transient.stepper import Stepper
Stepper.trial = lambda *_: os._exit(0)
main()
"""


#: Environment of the processes: they may write byte code, as installed programs have it.
ENVIRONMENT = {name: each for name, each in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


@dataclass(frozen=True)
class Start:
    """Command to start, and the limit of its wall-clock time [s]."""

    name: str
    words: tuple[str, ...]
    limit: float | None = None


def first_step(name: str, example: str) -> Start:
    """Run of an example that ends before its first step."""
    words = ("run", str(EXAMPLES / f"{example}.yaml"), "--overwrite", "-o", example)
    return Start(name, ("-c", FIRST_STEP, *words))


STARTS = (
    Start("python itself", ("-c", "pass")),
    Start("import numpy", ("-c", "import numpy")),
    Start("import viscontact", ("-c", "import viscontact"), 0.3),
    Start("viscontact --help", ("-m", "viscontact", "--help"), 0.6),
    Start("viscontact run --help", ("-m", "viscontact", "run", "--help"), 0.6),
    Start("first case parsed", ("-c", READ), 1.0),
    Start("viscontact check CASE", ("-m", "viscontact", "check", str(CASE))),
    first_step("run, to its first step", "roller-dogbone-e05"),
    first_step("- height map", "rough-ball"),
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
    command = [sys.executable, *words]
    subprocess.run(command, check=True, capture_output=True, cwd=folder, env=ENVIRONMENT)
    return time.perf_counter() - started, processor_time() - before


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=10)
    repeat = parser.parse_args().repeat
    print(f"{'':24}{'clock s':>9}{'CPU s':>9}{'limit s':>9}")
    with tempfile.TemporaryDirectory() as folder:
        seconds(("-m", "viscontact", "run", str(CASE), "-o", "run"), folder)
        for start in STARTS:
            seconds(start.words, folder)  # writes byte code
            each = [seconds(start.words, folder) for _ in range(repeat)]
            clock, processor = (min(times) for times in zip(*each, strict=True))
            limit = "" if start.limit is None else f"{start.limit:.1f}"
            print(f"{start.name:24}{clock:9.2f}{processor:9.2f}{limit:>9}")


if __name__ == "__main__":
    main()
