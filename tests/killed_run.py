"""A program that lets runs be killed within what they write, and resumes them.

`python killed_run.py lines|limits FOLDER SEED [growing]`: FOLDER holds case.yaml; asked to, its
grid is too small, and grows. Each run is a process of
its own that does what ``viscontact run`` does. With ``lines`` it kills itself before a certain line
of the code that records it, half of the times at a certain line of a resumption as well; with
``limits`` the system kills it within the very call that would make a file longer than a limit,
which is raised from one resumption to the next. Prints a line of JSON: how many were killed, and
everything that was not as it should be.
"""

from __future__ import annotations

import json
import os
import random
import re
import resource
import signal
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np
import xarray as xr

import viscontact
from campaigns import tried
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.cli import main
from viscontact.cli.run import execution
from viscontact.mechanics.problem.problem import Problem
from viscontact.results.line_digests import DIGEST
from viscontact.results.variables import ERRORS
from viscontact.runs import preparation
from viscontact.runs.directory import recorder
from viscontact.simulation.transient.setup import RunSetup, prepare_run

SOURCES = Path(viscontact.__file__).parent
WATCHED = (
    str(SOURCES / "runs" / "directory"),
    str(SOURCES / "runs" / "execution" / "run_directory.py"),
)
#: Runs that are killed at a line, of each kind; the lines are spread evenly.
KILLS = tried(12, 30)
STEP = tried(12288, 6144)  # by which the limit grows [bytes]
#: Entries of the progress that a run adds when it ends.
AT_THE_END = {*ERRORS, "complete", "fields", "all_warnings", DIGEST}


def differing(result: Path, whole: xr.Dataset) -> list[str]:
    """Compare every bit of a result, so far as it goes, with that of the uninterrupted run."""
    try:
        with xr.open_dataset(result) as ds:
            ds.load()
    except (OSError, ValueError, RuntimeError) as error:
        return [f"{result} does not open: {error!r}"]
    faults = [f"has no {name}" for name in set(whole.variables) - set(ds.variables)]
    whole = whole.isel({axis: middle(whole.sizes[axis], ds.sizes[axis]) for axis in ("x", "y")})
    for name, variable in ds.variables.items():
        if name in ERRORS and np.isnan(variable.values).all():
            continue  # they come when all steps are taken
        reference = whole[name].values[: len(variable)]
        if variable.values.tobytes() != reference.tobytes():
            faults.append(f"{name} differs within {len(variable)} rows")
    for name in ("warnings", "grid_enlarged"):
        if not str(whole.attrs[name]).startswith(str(ds.attrs[name])):
            faults.append(f"{name} differ")
    return faults


def middle(whole: int, part: int) -> slice:
    """Where the cells lie of a grid that is still to be enlarged."""
    first = (whole - part) // 2
    return slice(first, first + part)


def complete(directory: Path, whole: xr.Dataset) -> list[str]:
    """Compare a finished run with the uninterrupted one, attributes too."""
    faults = differing(directory / "result.nc", whole)
    with xr.open_dataset(directory / "result.nc") as ds:
        if ds.sizes != whole.sizes:
            faults.append(f"has {dict(ds.sizes)}")
        stored = [name for name in ERRORS if name in whole.variables]
        known = [name for name in stored if not np.isnan(whole[name].values).all()]
        faults += [f"has no {name}" for name in known if np.isnan(ds[name].values).all()]
        named = set(ds.attrs) | set(whole.attrs)
        faults += [
            f"attribute {name} differs"
            for name in named - {"wall_time", "started"}
            if not np.array_equal(ds.attrs.get(name, ()), whole.attrs.get(name, ()))
        ]
    names = {path.name for path in directory.iterdir()}
    return faults + ([] if names == {*FINISHED} else [f"leaves {sorted(names)}"])


FINISHED = ("case.yaml", "progress.jsonl", "result.nc")


def lines_of(directory: Path) -> list[str]:
    """The complete lines of a run's progress, without what its end adds to them."""
    path = directory / "progress.jsonl"
    written = path.read_text(encoding="utf-8") if path.exists() else ""
    found = map(json.loads, written.splitlines()[: written.count("\n")])
    kept = [{name: line[name] for name in line if name not in AT_THE_END} for line in found]
    return [json.dumps(line, ensure_ascii=False) for line in kept]


def resumed_after(said: str) -> int | None:
    """Number of instants after which a run reports to continue; None if it does not report it."""
    if found := re.search(r"continuing after (\d+) ", said):
        return int(found[1])
    return 0 if "starting at the beginning" in said else None


def process(prepare: Callable[[], None], *words: str) -> tuple[int, str]:
    """Run the command in a process of its own; return how it ended, and what it said."""
    said = Path("said.txt")
    child = os.fork()
    if not child:
        code = 70
        try:
            descriptor = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(descriptor, 1)
            os.dup2(descriptor, 2)
            prepare()
            code = main(["run", "case.yaml", *words])
            sys.stdout.flush()
        finally:
            os._exit(code)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status), said.read_text(encoding="utf-8")


def nothing() -> None:
    """Let a run be."""


def at_each_line(act: Callable[[int], None]) -> Callable[[], None]:
    """Let a run do something before each line of the watched code, with its number as argument."""
    count = 0

    def at_line(frame: FrameType, event: str, argument: Any) -> Any:
        nonlocal count
        if event == "line":
            act(count := count + 1)
        return at_line

    def at_call(frame: FrameType, event: str, argument: Any) -> Any:
        return at_line if frame.f_code.co_filename.startswith(WATCHED) else None

    return lambda: sys.settrace(at_call)


def killing_at(line: int) -> Callable[[], None]:
    """Let a run kill itself when it comes to its n-th line of the watched code."""

    def kill(count: int) -> None:
        if count == line:
            os.kill(os.getpid(), signal.SIGKILL)

    return at_each_line(kill)


def counted_lines(directory: str) -> int:
    """How many lines of the watched code a run comes to, to within a few."""
    read_end, write_end = os.pipe()

    def note(count: int) -> None:
        if count % 10 == 0:
            os.write(write_end, b".")

    process(at_each_line(note), "-o", directory)
    os.close(write_end)
    with os.fdopen(read_end, "rb") as dots:
        return 10 * len(dots.read())


def limiting(size: int) -> Callable[[], None]:
    """Let the system kill a run within the call that makes a file longer than this."""

    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

    return limit


class Campaign:
    """Runs that are killed and resumed, and what was not as it should be."""

    def __init__(self, whole: xr.Dataset, lines: list[str]) -> None:
        self.whole, self.lines = whole, lines
        self.killed, self.may_lose = 0, 0
        self.faults: list[str] = []

    def run(self, name: str, prepare: Callable[[], None]) -> bool:
        """Begin or resume a run, and judge what it says and leaves; return whether it is over."""
        directory = Path(name)
        before = lines_of(directory)
        code, said = process(prepare, "-o", name, "--resume")
        after = resumed_after(said)
        if after is not None and after < len(before) - self.may_lose:
            self.faults.append(f"{name}: {len(before)} instants done, goes on after {after}")
        if (written := lines_of(directory)) != self.lines[: len(written)]:
            self.faults.append(f"{name}: its progress differs")
        if code == 0:
            self.faults += [f"{name}: {fault}" for fault in complete(directory, self.whole)]
            return True
        if code not in (-signal.SIGKILL, -signal.SIGXFSZ):
            self.faults.append(f"{name}: ended with {code}: {said}")
            return True
        self.killed += 1
        if (directory / "result.nc").exists():
            found = differing(directory / "result.nc", self.whole)
            self.faults += [f"{name}: {fault}" for fault in found]
        elif len(written) > 1:
            self.faults.append(f"{name}: there is no result")
        return False


def at_lines(campaign: Campaign, kind: str, chance: random.Random) -> None:
    """Kill runs at lines spread evenly over what is executed, and half the resumptions too."""
    total = counted_lines(f"{kind}-counted")
    for kill in range(KILLS):
        name = f"{kind}-{kill}"
        line = 1 + int((kill + chance.random()) * total / KILLS)
        over = campaign.run(name, killing_at(line))
        if not over and kill % 2:
            over = campaign.run(name, killing_at(1 + chance.randrange(total)))
        if not over and not campaign.run(name, nothing):
            campaign.faults.append(f"{name}: did not come to its end")


def at_limits(campaign: Campaign, kind: str) -> None:
    """Kill a run at each size that a file of its can have, from one resumption to the next."""
    size = 0
    while not campaign.run(f"{kind}-limited", limiting(size)):
        size += STEP


def outgrown(problem: Problem, threads: int = 1) -> RunSetup:
    """Prepare a run on an automatic grid that is too small."""
    run = prepare_run(problem, threads).on(Grid((16, 16), (2e-3, 2e-3)))
    return replace(run, problem=replace(run.problem, grid=AutomaticGrid()))


def judge(mode: str, folder: Path, seed: int, *, growing: bool) -> None:
    """Do all of one mode, with checkpoints after every step, and after the first only."""
    global KILLS, STEP
    os.chdir(folder)
    if growing:
        preparation.prepare_run = outgrown
        KILLS, STEP = KILLS // 3, 3 * STEP  # what else there is to it has been seen without
    os.fsync = lambda descriptor: None  # nothing here cuts the power
    # In this process, so that those that are forked from it have imported everything.
    assert main(["run", "case.yaml", "-o", "whole", "-q"]) == 0
    with xr.open_dataset("whole/result.nc") as ds:
        campaign = Campaign(ds.load(), lines_of(Path("whole")))
    chance = random.Random(seed)
    for kind, pause in (("always", 0.0), ("once", 1e9)):
        recorder.PAUSE, recorder.SHARE = pause, 0.0
        # A step that ends may be killed before its checkpoint.
        campaign.may_lose = 1 if kind == "always" else len(campaign.lines)
        at_lines(campaign, kind, chance) if mode == "lines" else at_limits(campaign, kind)
    enlarged = campaign.whole.attrs["grid_enlarged"]
    found = {"killed": campaign.killed, "faults": campaign.faults, "grid_enlarged": enlarged}
    print(json.dumps(found))


if __name__ == "__main__":
    assert execution  # imported before any of the processes begins
    judge(sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), growing="growing" in sys.argv[4:])
