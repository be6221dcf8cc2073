"""Runs whose lease is taken over end in the same bits, and disturb no successor."""

from __future__ import annotations

import os
import random
import select
import signal
import subprocess
import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress
from pathlib import Path

import pytest
import xarray as xr

import leased_run
from campaigns import tried
from leased_run import COUNT, leased, opened
from runs.directory.held_leases import SHORT, names
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.lock import DirectoryInUse

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has locks on all file systems")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of the uninterrupted run."""
    directory = tmp_path_factory.mktemp("whole")
    leased_run.main(directory, 60.0, 0.0)
    return directory


def assert_same(directory: Path, whole: Path) -> None:
    """Compare every bit of two finished runs."""
    with (
        xr.open_dataset(directory / RESULT_NAME) as ours,
        xr.open_dataset(whole / RESULT_NAME) as other,
    ):
        assert set(ours.variables) == set(other.variables)
        for name, variable in other.variables.items():
            assert ours[name].values.tobytes() == variable.values.tobytes(), name
        assert ours.attrs["complete"] == 1
    assert (directory / PROGRESS_NAME).read_bytes() == (whole / PROGRESS_NAME).read_bytes()
    assert names(directory) == names(whole)


class Runner:
    """Another process, which computes the run in one directory after another."""

    def __init__(self) -> None:
        command = [sys.executable, leased_run.__file__, str(SHORT / 2), "0.01"]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        pipe = subprocess.PIPE
        # Unbuffered, so that a line that can be read is one that was not read before.
        self.process = subprocess.Popen(
            command, stdin=pipe, stdout=pipe, env=environment, bufsize=0
        )

    def begin(self, directory: Path) -> None:
        """Begin the run, and return after its first step."""
        assert self.process.stdin
        self.process.stdin.write(f"{directory}\n".encode())
        assert self.line() == "begun"

    def line(self) -> str:
        """The next line of its output."""
        assert self.process.stdout
        return self.process.stdout.readline().decode().rstrip("\n")

    def has_ended(self) -> bool:
        """Whether the run has come to its end, which is not read yet."""
        return bool(select.select([self.process.stdout], [], [], 0.0)[0])

    def kill(self) -> None:
        self.process.kill()
        self.process.communicate()


@pytest.fixture(scope="module")
def runner() -> Iterator[Runner]:
    found = Runner()
    yield found
    found.kill()


def taken_over(directory: Path, at: int, act: Callable[[], None]) -> None:
    """Take a run over and finish it; do something at one of its instants."""
    with ExitStack() as held:
        check = None
        while check is None:  # a write that has begun is finished after the signal to stop
            with suppress(DirectoryInUse):
                check = held.enter_context(leased(directory, SHORT))
        record = opened(directory, check)
        begun = record.resumed.rows
        for number, _ in enumerate(record.steps(), start=begun):
            if number == max(at, begun):
                act()
        act()
        record.finish()


def suspended_and_taken_over(runner: Runner, directory: Path, delay: float, at: int) -> bool:
    """Suspend a run, take it over, and let it go on while its successor marches.

    False if the run had ended before.
    """
    runner.begin(directory)
    clock.sleep(delay)
    runner.process.send_signal(signal.SIGSTOP)
    os.waitpid(runner.process.pid, os.WUNTRACED)  # it is suspended now
    # Its restart state is removed last, and after that it only gives its lease back.
    has_ended, ends = runner.has_ended() or not (directory / STATE_NAME).exists(), []

    def resume() -> None:
        if not ends:
            runner.process.send_signal(signal.SIGCONT)
            ends.append(runner.line())

    taken_over(directory, at, resume)
    assert ends[0] == "done" if has_ended else ends[0].count("taken over") == 1, ends
    return not has_ended


@pytest.mark.parametrize(
    ("delay", "at"),
    [
        (0.0, 0),
        *(pytest.param(*each, marks=pytest.mark.slow) for each in ((0.1, 8), (0.15, COUNT))),
    ],
)
def test_run_that_was_suspended_stops_before_its_next_write_and_its_successor_gets_the_same_bits(
    delay: float, at: int, tmp_path: Path, whole: Path, runner: Runner
) -> None:
    assert suspended_and_taken_over(runner, tmp_path, delay, at)
    assert_same(tmp_path, whole)


@pytest.mark.slow
def test_runs_that_are_suspended_at_random_moments_do_not_disturb_their_successors(
    tmp_path: Path, whole: Path, runner: Runner
) -> None:
    chance, suspended = random.Random(20261123), 0
    for number in range(tried(14, 40)):
        directory = tmp_path / str(number)
        directory.mkdir()
        delay, at = chance.uniform(0, 0.3), chance.randrange(COUNT)
        suspended += suspended_and_taken_over(runner, directory, delay, at)
        assert_same(directory, whole)
    assert suspended > tried(10, 30)


def test_killed_run_is_resumed_by_another_process_to_the_same_bits(
    tmp_path: Path, whole: Path
) -> None:
    runner = Runner()
    runner.begin(tmp_path)
    clock.sleep(0.05)
    runner.kill()
    taken_over(tmp_path, 0, lambda: None)
    assert_same(tmp_path, whole)
