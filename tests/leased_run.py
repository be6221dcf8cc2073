"""A run in a directory whose file system has no locks, as a program and for its tests.

`python leased_run.py DURATION PAUSE` reads the names of directories, a line each. In each it begins
or resumes the run under a lease of a duration [s], waits in each step [s], and saves after every
step. It prints ``begun`` after the first step, and at the end ``done``, or the error if it has lost
the lease.
"""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

import viscontact as vc
from viscontact.mechanics.problem.problem import Problem
from viscontact.results.run_files import STATE_NAME
from viscontact.runs.directory import lock, recorder
from viscontact.runs.directory.lock_check import LockCheck, LockLost
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.simulation.transient.setup import RunSetup, prepare_run

COUNT = 20


def sphere_run() -> RunSetup:
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    grid, times = vc.Grid((24, 24), (2.4e-3, 2.4e-3)), np.linspace(0.0, 1.0, COUNT)
    return prepare_run(Problem(vc.Sphere(0.01), rubber, vc.step(0.1), grid, times))


@contextmanager
def leased(directory: Path, duration: float) -> Iterator[LockCheck]:
    """Lock a directory as if its file system had no locks."""
    has_locks, lock.has_locks = lock.has_locks, lambda directory: False
    try:
        with lock.locked(directory, duration) as check:
            yield check
    finally:
        lock.has_locks = has_locks


def opened(directory: Path, check: LockCheck) -> Recorder:
    """The run at its beginning, or at its last checkpoint."""
    recorded = Recorded(directory, OverTime(sphere_run(), errors=False), check=check)
    is_begun = (directory / STATE_NAME).exists()
    return Recorder.resume(recorded) if is_begun else Recorder(recorded)


def main(directory: Path, duration: float, pause: float) -> None:
    recorder.PAUSE, recorder.SHARE = 0.0, 0.0
    with leased(directory, duration) as check:
        record = opened(directory, check)
        try:
            for number, _ in enumerate(record.steps()):
                if number == 0:
                    print("begun", flush=True)
                clock.sleep(pause)
            record.finish()
        finally:
            record.close()


if __name__ == "__main__":
    for line in sys.stdin:
        try:
            main(Path(line.rstrip("\n")), float(sys.argv[1]), float(sys.argv[2]))
            print("done", flush=True)
        except LockLost as error:
            print(error, flush=True)
