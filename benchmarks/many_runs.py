"""Cost of many short runs: two warm workers compared with one process, files included.

The runs are those of a sweep of a sphere over its force, about 0.05 s each without files. First
they are computed one after the other in this process, after a first one that imports everything;
then by the two workers of the command line, whose start counts. Both write the same files. The
promise: the workers take at most 1.3 times half of the time of the one process.

    python benchmarks/many_runs.py [--runs 1000] [--workers 2]
"""

from __future__ import annotations

import argparse
import os
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from viscontact.cli import main as viscontact
from viscontact.runs.processes.request import RunRequest
from viscontact.studies.executors.local import LocalWorkers
from viscontact.studies.executors.task import Task, perform

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 8}
grid: {shape: [48, 48], size: [4 mm, 4 mm]}
output: {fields: none, errors: false}
"""


def forces(count: int) -> list[str]:
    return [f"{2 + 2 * n / count:.6f}N" for n in range(count)]


def in_one_process(case: Path, directory: Path, count: int) -> tuple[float, float]:
    """Wall-clock and CPU time [s] of all runs in this process."""
    settings = [f"load.force={force}" for force in forces(count)]
    names = [f"case_force={force}" for force in forces(count)]
    directory.mkdir()
    perform(Task(RunRequest(case, settings=("load.force=1N",)), directory / "first", ""))
    began, used = time.perf_counter(), time.process_time()
    for name, setting in zip(names, settings, strict=True):
        done = perform(Task(RunRequest(case, settings=(setting,)), directory / name, ""))
        assert done.word == "done", done
    return time.perf_counter() - began, time.process_time() - used


def by_workers(case: Path, directory: Path, count: int, workers: int) -> tuple[float, float]:
    """Wall-clock and CPU time [s] of the command, the start of its workers included."""
    varied = ["--vary", f"load.force={','.join(forces(count))}"]
    began, used = time.perf_counter(), sum(os.times()[:4])
    code = viscontact(["run", str(case), *varied, "-o", str(directory), "-j", str(workers), "-q"])
    assert code == 0
    return time.perf_counter() - began, sum(os.times()[:4]) - used


def empty_calls(count: int, workers: int) -> float:
    """Wall-clock time [s] of calls that do nothing, the start of the workers not included."""
    with LocalWorkers(workers) as pool:
        for future in [pool.submit(time.sleep, 0.5) for _ in range(workers)]:
            future.result()
        began = time.perf_counter()
        for future in [pool.submit(abs, -1) for _ in range(count)]:
            future.result()
        return time.perf_counter() - began


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args()
    with TemporaryDirectory() as folder:
        case = Path(folder, "case.yaml")
        case.write_text(CASE, encoding="utf-8")
        one, one_cpu = in_one_process(case, Path(folder, "one"), given.runs)
        print(f"one warm process   {one:8.2f} s, {one_cpu:8.2f} s of CPU", flush=True)
        many, many_cpu = by_workers(case, Path(folder, "many"), given.runs, given.workers)
        print(f"{given.workers} workers          {many:8.2f} s, {many_cpu:8.2f} s of CPU")
        ratio = many * given.workers / one
        print(
            f"ratio to 1/{given.workers} of it  {ratio:8.2f}, {many_cpu / one_cpu:8.2f} by CPU time"
        )
    print(f"{given.runs} empty calls   {empty_calls(given.runs, given.workers):8.2f} s")


if __name__ == "__main__":
    main()
