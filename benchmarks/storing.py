"""Cost of storing a run, beside the cost of marching it.

The shipped roller of 512 x 128 cells in 150 steps is marched without any output, recorded with
scalars only, and recorded with the fields of all steps, each also without digests and seal; they
take turns. Storing is what a recorded run takes more than the march alone, errors of the scalars
not included. The last lines give the cost of digests and seal: the median, over the repetitions, of
the ratio of a recorded run to the next one without them.

    python benchmarks/storing.py [--repeat 3] [--steps 150] [--cells 512 128]
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from importlib.resources import as_file, files
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from unittest.mock import patch

from viscontact.case import read_case
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.results.digests import RunningDigests
from viscontact.runs.directory import progress_log, result_writer
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.runs.preparation import prepared
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.state_generator import march_run


def roller(steps: int, cells: tuple[int, int]) -> RunSetup:
    settings = [f"time.steps={steps}", f"grid.shape={list(cells)}"]
    with as_file(files("viscontact.case.examples") / "roller-dogbone-e05.yaml") as path:
        setup = prepared(read_case(path, settings)).run.setup
        assert isinstance(setup, RunSetup)
        return setup


def march(run: RunSetup) -> int:
    for _ in march_run(run):
        pass
    return 0


def _keeping(run: RunSetup, fields: str) -> RunSetup:
    return replace(run, problem=replace(run.problem, kept=KeptFields(fields)))


def record(run: RunSetup, fields: str) -> int:
    """Record a run in a directory of its own; return the size of the result [bytes]."""
    with TemporaryDirectory() as folder:
        recording = Recorder(Recorded(Path(folder), OverTime(_keeping(run, fields), errors=False)))
        for _ in recording.steps():
            pass
        recording.finish()
        return (Path(folder) / "result.nc").stat().st_size


@contextmanager
def without_digests() -> Iterator[None]:
    """Write no digests and no seal within the block."""
    with ExitStack() as stack:
        for name in ("add", "replace", "put", "store"):
            patched = patch.object(RunningDigests, name, lambda *_: None)
            stack.enter_context(patched)
        stack.enter_context(patch.object(result_writer, "seal", lambda _: None))
        stack.enter_context(patch.object(progress_log, "with_digest", lambda line: line))
        yield


def record_unchecked(run: RunSetup, fields: str) -> int:
    """Record a run without digests."""
    with without_digests():
        return record(run, fields)


def measured(act: Callable[[], int]) -> tuple[float, float, float, int]:
    """User, system and wall time [s] of one call, and what it returns."""
    before, began = os.times(), time.perf_counter()
    size = act()
    wall, after = time.perf_counter() - began, os.times()
    return after.user - before.user, after.system - before.system, wall, size


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--steps", type=int, default=150)
    parser.add_argument("--cells", type=int, nargs=2, default=(512, 128))
    given = parser.parse_args()
    run = roller(given.steps, tuple(given.cells))
    ways: dict[str, Callable[[], int]] = {
        "march": lambda: march(run),
        "record, no fields": lambda: record(run, "none"),
        "no fields, unchecked": lambda: record_unchecked(run, "none"),
        "record, all fields": lambda: record(run, "all"),
        "all fields, unchecked": lambda: record_unchecked(run, "all"),
    }
    taken: dict[str, list[tuple[float, float, float, int]]] = {name: [] for name in ways}
    for _ in range(given.repeat):
        for name, way in ways.items():
            taken[name].append(measured(way))
    best = {name: min(each) for name, each in taken.items()}
    marching = best["march"][0]
    print(f"{'':22}user s  system s  wall s  storing/marching (user)    MB")
    for name, (user, system, wall, size) in best.items():
        ratio = (user - marching) / marching
        print(f"{name:22}{user:6.2f}{system:10.2f}{wall:8.2f}{ratio:25.2f}{size / 1e6:8.1f}")
    for fields in ("no fields", "all fields"):
        pairs = zip(taken[f"record, {fields}"], taken[f"{fields}, unchecked"], strict=True)
        ratio = median((one[0] + one[1]) / (other[0] + other[1]) for one, other in pairs)
        print(f"digests and seal, {fields}: {ratio - 1:+.2%} of the run (user and system)")


if __name__ == "__main__":
    main()
