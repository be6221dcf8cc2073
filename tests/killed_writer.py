"""A program that writes a result as fast as it can and is killed, again and again.

`python killed_writer.py RESULT KILLS SEED`: each writer goes on from what the one before it has
published, and is killed at a random moment; in the meantime its result is opened and read as fast
as that goes. `KILLS` is the least number of them. Prints a line of JSON: how many writers were
killed, how many readings there were, and everything that was not as it should be.
"""

from __future__ import annotations

import json
import os
import random
import signal
import sys
import time as clock
from pathlib import Path

import numpy as np
import xarray as xr

import viscontact as vc
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter
from written_states import GRID, faults_of, state

ROWS = 3000
TIMES = np.arange(ROWS) / 7.0
SOME = [float(time) for time in TIMES[::5]]
CONTENTS = Contents(GRID, TIMES, KeptFields(SOME))


def write(path: Path, place: Path) -> None:
    """Write from the last position on, one publication a row; note the position after each."""
    position = json.loads(place.read_text()) if place.exists() else None
    if position is None:
        writer = ResultWriter(path, CONTENTS)
        writer.publish()
    else:
        writer = ResultWriter.resume(path, CONTENTS, position)
    with writer:
        for row in range(position["rows"] if position else 0, ROWS):
            writer.append(state(row, times=TIMES))
            writer.publish()
            aside = place.with_suffix(".aside")
            aside.write_text(json.dumps(writer.position))
            aside.replace(place)
        writer.finish()


def read(path: Path, until: float, faults: list[str]) -> int:
    """Open and read the result until an instant, as a user would; return how often."""
    readings = rows = 0
    while clock.monotonic() < until:
        if not path.exists():
            continue
        try:
            with vc.open_results(path) as ds:
                ds.load()
        except (OSError, ValueError, RuntimeError) as error:
            faults.append(f"reading: {error!r}")
            continue
        if not np.array_equal(ds.time, TIMES[: ds.sizes["time"]]) or ds.sizes["time"] < rows:
            faults.append(f"read {ds.sizes['time']} rows after {rows}")
        rows = ds.sizes["time"]
        readings += 1
    return readings


def main(path: Path, kills: int, seed: int) -> None:
    """Kill writers at random moments and judge what they have left."""
    chance, place = random.Random(seed), path.with_name("position.json")
    faults: list[str] = []
    killed = readings = done = 0
    # A busy machine needs more writers until there are more rows and readings than kills.
    while killed < kills or (min(done, readings) <= kills and killed < 10 * kills):
        killed += 1
        child = os.fork()
        if not child:
            try:
                write(path, place)
            finally:
                os._exit(1)
        readings += read(path, clock.monotonic() + chance.uniform(0.005, 0.3), faults)
        os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
        if not os.WIFSIGNALED(status):
            faults.append("the writer ended by itself")
        if place.exists():
            done = json.loads(place.read_text())["rows"]
        if path.exists():
            faults += faults_of(path, done, SOME, times=TIMES)
            xr.open_dataset(path).close()
        elif done:
            faults.append("there is no result")
    print(json.dumps({"killed": killed, "rows": done, "readings": readings, "faults": faults}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
