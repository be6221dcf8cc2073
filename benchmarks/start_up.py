"""Start-up times: the fastest of several new processes for each command, up to its end.

Prints wall-clock time and CPU time: on a machine with other work, only the CPU time measures the
program. Byte code is written before it is measured. The work of a command is the CPU time of the
same command the second time in one process; the ratio of both tells what its start adds. Of a run
the parts are printed, too, and of the server the CPU time up to its first page.

    ./go bench start-up [--repeat 10]
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from urllib.request import urlopen

import psutil

import viscontact

try:
    import resource
except ImportError:  # not on Windows
    resource = None

EXAMPLES = Path(viscontact.__file__).parent / "case" / "examples"
CASE = EXAMPLES / "roller-dogbone-e05.yaml"
SPHERE = str(EXAMPLES / "sphere-zener.yaml")
PARTS = Path(__file__).with_name("start_parts.py")
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

# The second time in one process: the work without the start.
AGAIN = """
import sys, time
from viscontact.cli import main
assert main(sys.argv[1:]) == 0
began = time.process_time()
assert main(sys.argv[1:]) == 0
sys.stderr.write(f"\\n{time.process_time() - began}")
"""

#: Environment of the processes: they may write byte code, as installed programs have it.
ENVIRONMENT = {name: each for name, each in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


@dataclass(frozen=True)
class Start:
    """Command to start, and the limit of its wall-clock time [s]."""

    name: str
    words: tuple[str, ...]
    limit: float | None = None

    @property
    def command(self) -> tuple[str, ...] | None:
        """Words of a whole command, which can be given twice in one process; None of others."""
        is_command = self.words[:2] == ("-m", "viscontact") and "--help" not in self.words
        return self.words[2:] if is_command else None


def whole(name: str, *words: str) -> Start:
    """Command up to its end."""
    return Start(name, ("-m", "viscontact", *words))


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
    whole("check CASE", "check", str(CASE)),
    whole("check of a sphere", "check", SPHERE),
    first_step("run, to its first step", "roller-dogbone-e05"),
    first_step("- height map", "rough-ball"),
    whole("run of a sphere", "run", SPHERE, "--overwrite", "-o", "sphere"),
    whole("show RUN", "show", "sphere"),
    whole("plot RUN history", "plot", "sphere", "history"),
    whole("report RUN", "report", "sphere"),
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


def work(words: tuple[str, ...], folder: str) -> float:
    """CPU time of a command the second time in one process [s]."""
    command = [sys.executable, "-c", AGAIN, *words]
    ended = subprocess.run(
        command, check=True, capture_output=True, text=True, cwd=folder, env=ENVIRONMENT
    )
    return float(ended.stderr.rpartition("\n")[2])


def parts(folder: str) -> dict[str, float]:
    """CPU time of the parts of a run [s]."""
    words = ("run", SPHERE, "--overwrite", "-o", "sphere")
    command = [sys.executable, str(PARTS), *words]
    ended = subprocess.run(
        command, check=True, capture_output=True, text=True, cwd=folder, env=ENVIRONMENT
    )
    found: dict[str, float] = json.loads(ended.stderr.rpartition("\n")[2])
    return found


def first_page(folder: str) -> float:
    """CPU time of the server until its first page has been read [s]."""
    words = ("serve", "--no-open", "--port", "0", "--dir", "page")
    command = [sys.executable, "-m", "viscontact", *words]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, cwd=folder, env=ENVIRONMENT
    ) as served:
        assert served.stdout
        address = re.search(r"http://\S+", served.stdout.readline())
        assert address
        urlopen(address[0]).read()
        used = psutil.Process(served.pid).cpu_times()
        served.terminate()
    return float(used.user + used.system)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=10)
    repeat = parser.parse_args().repeat
    print(f"{'':24}{'clock s':>9}{'CPU s':>9}{'work s':>9}{'ratio':>7}{'limit s':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for start in STARTS:
            seconds(start.words, folder)  # writes byte code
            each = [seconds(start.words, folder) for _ in range(repeat)]
            clock, processor = (min(times) for times in zip(*each, strict=True))
            limit = "" if start.limit is None else f"{start.limit:.1f}"
            inside = f"{'':16}"
            if start.command:
                least = min(work(start.command, folder) for _ in range(3))
                inside = f"{least:9.2f}{processor / least:7.1f}"
            print(f"{start.name:24}{clock:9.2f}{processor:9.2f}{inside}{limit:>9}")
        page = min(first_page(folder) for _ in range(repeat + 1))
        print(f"{'serve, to its first page':24}{'':9}{page:9.2f}")
        runs = [parts(folder) for _ in range(repeat)]
        print("\nCPU time of a run of a sphere by its parts, least of each [s]:")
        for part in runs[0]:
            print(f"{part:24}{min(run[part] for run in runs):9.2f}")


if __name__ == "__main__":
    main()
