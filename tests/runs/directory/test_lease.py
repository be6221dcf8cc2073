"""The lease of a run's directory, on file systems without locks that hold for all machines."""

from __future__ import annotations

import errno
import os
import random
import select
import signal
import subprocess
import sys
import threading
import time as clock
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import pytest
import xarray as xr

import leased_run
from campaigns import tried
from leased_run import COUNT, leased, opened
from viscontact.results.run_files import LOCK_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory import lease, lease_file, lock_probe
from viscontact.runs.directory.lease import Lease, LeaseHeld
from viscontact.runs.directory.lease_file import LeaseFile, current_lease, header
from viscontact.runs.directory.lock import DirectoryInUse, in_use, is_locked, locked
from viscontact.runs.directory.lock_check import LockLost
from viscontact.runs.directory.lock_probe import file_system, has_locks

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has locks on all file systems")

#: Duration of the leases here [s].
SHORT = 0.6
#: A machine that is not this one.
ELSEWHERE = "0000-boot pid:[1] 77"
HOLDER = """
import sys
from pathlib import Path
from viscontact.runs.directory.lease import Lease
with Lease(Path(sys.argv[1]), float(sys.argv[2])) as lease:
    print("leased", flush=True)
    sys.stdin.readline()
    lease.check()
"""


@contextmanager
def holder(directory: Path, duration: float = SHORT) -> Iterator[subprocess.Popen[str]]:
    """Another process that holds the lease of a directory, and releases it on request."""
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(directory), str(duration)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == "leased\n"
        try:
            yield process
        finally:
            process.kill()


def left(directory: Path, token: str, mark: str = ELSEWHERE, duration: float = SHORT) -> str:
    """Write the lease of a process that has ended, and return its name."""
    text = header(token, "4711 on node7", duration).splitlines()
    text[3] = mark
    (directory / LOCK_NAME).write_text("\n".join([*text, "000000000007\n"]), encoding="ascii")
    return f"{LOCK_NAME}.{token}"


def names(directory: Path) -> list[str]:
    return sorted(path.name for path in directory.iterdir())


# --- which directories are leased -----------------------------------------------------------


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, None])
def test_directory_whose_locks_fail_or_exclude_no_other_is_leased(
    number: int | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def flock(*_: object) -> None:
        if number is not None:
            raise OSError(number, os.strerror(number))

    monkeypatch.setattr("fcntl.flock", flock)
    assert not has_locks(tmp_path)
    with locked(tmp_path):
        assert current_lease(tmp_path) is not None
        assert names(tmp_path) == [LOCK_NAME]
    assert names(tmp_path) == []


@pytest.mark.parametrize(
    ("mounts", "expected"),
    [
        ([("/", "ext4"), ("/scratch", "lustre")], "lustre"),
        ([("/scratch", "nfs4"), ("/", "ext4")], "nfs4"),
        ([("/", "nfs"), ("/scratch/node", "xfs")], "nfs"),
        ([("/", "ext4"), ("/scratch", "autofs"), ("/scratch", "nfs4")], "nfs4"),
        ([("/", "ext4"), ("/scratch", "gpfs"), ("/scratch/runs", "XFS")], "xfs"),
        ([("/", "overlay"), ("/scra", "fuse.sshfs")], "overlay"),
        ([], ""),
    ],
)
def test_kind_of_a_file_system_is_that_of_the_deepest_mount(
    mounts: list[tuple[str, str]], expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.lock_probe.mounted", lambda: mounts)
    assert file_system(Path("/scratch/runs/roller")) == expected


@pytest.mark.parametrize("kind", ["nfs4", "lustre", "gpfs", "fuse.sshfs", "9p", "", "cifs", "new"])
def test_file_system_of_several_machines_is_leased_even_if_its_locks_work_here(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert has_locks(tmp_path)
    monkeypatch.setattr(lock_probe, "file_system", lambda directory: kind)
    assert not has_locks(tmp_path)


@pytest.mark.slow
def test_copied_directory_with_a_lease_is_leased_where_locks_work(tmp_path: Path) -> None:
    token = "a" * 32
    left(tmp_path, token)
    with locked(tmp_path, SHORT):
        found = current_lease(tmp_path)
        assert found is not None
        assert found.token != token
    assert names(tmp_path) == []


# --- one holder -------------------------------------------------------------------------------


def test_other_process_is_kept_out_and_named_until_the_end(tmp_path: Path) -> None:
    with holder(tmp_path) as process:
        with (
            pytest.raises(DirectoryInUse, match=f"process {process.pid} on "),
            leased(tmp_path, SHORT),
        ):
            pass
        process.communicate("go on\n", timeout=30)
        assert process.returncode == 0
    with leased(tmp_path, SHORT) as check:
        check()
    assert names(tmp_path) == []


@pytest.mark.slow
def test_lease_is_renewed_while_its_holder_computes(tmp_path: Path) -> None:
    with Lease(tmp_path, SHORT) as held:
        first = current_lease(tmp_path)
        clock.sleep(2 * SHORT)
        held.check()
        last = current_lease(tmp_path)
    assert first is not None
    assert last is not None
    assert (first.token, first.text != last.text) == (last.token, True)


def test_killed_process_of_this_machine_keeps_no_other_out(tmp_path: Path) -> None:
    with holder(tmp_path, 60.0) as process:
        process.kill()
        process.wait(30)
        began = clock.monotonic()
        with Lease(tmp_path):
            assert clock.monotonic() - began < 5
    assert names(tmp_path) == []


def test_killed_process_of_another_machine_keeps_others_out_for_the_duration_of_its_lease(
    tmp_path: Path,
) -> None:
    left(tmp_path, "b" * 32)
    began = clock.monotonic()
    with Lease(tmp_path):  # the duration of its holder counts
        assert SHORT <= clock.monotonic() - began < 3 * SHORT
    assert names(tmp_path) == []


@pytest.mark.parametrize(
    "content",
    [
        b"\xff\n\xfe\n-1\n" * 500,
        *(
            pytest.param(content, marks=pytest.mark.slow)
            for content in (b"", b"4711 on elsewhere\n", b"a\nb\nnan\n\n")
        ),
    ],
    ids=["no text", "empty", "a line", "no duration"],
)
def test_file_of_other_contents_counts_as_a_lease_that_is_not_renewed(
    content: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lease_file, "DURATION", SHORT)
    (tmp_path / LOCK_NAME).write_bytes(content)
    began = clock.monotonic()
    with Lease(tmp_path, SHORT) as held:
        assert clock.monotonic() - began >= SHORT
        held.check()
    assert names(tmp_path) == []


def test_one_of_many_at_once_takes_an_abandoned_lease_over(tmp_path: Path) -> None:
    left(tmp_path, "c" * 32)
    held: list[Lease] = []
    refused: list[str] = []

    def attempt() -> None:
        try:
            held.append(Lease(tmp_path, SHORT))
        except LeaseHeld as error:
            refused.append(str(error))

    threads = [threading.Thread(target=attempt) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert (len(held), len(refused)) == (1, 7)
    held[0].check()
    held[0].__exit__()
    assert names(tmp_path) == []


def test_one_of_many_at_once_holds_the_lease(tmp_path: Path) -> None:
    # As in the test of the same name of the lock: were two in at the same time, a count would be
    # lost.
    program = """
import sys
from pathlib import Path
from leased_run import leased
from viscontact.runs.directory.lock import DirectoryInUse
count, mine = Path(sys.argv[1]) / "count", 0
while mine < 10:
    try:
        with leased(Path(sys.argv[1]), 1.0) as check:
            check()
            count.write_text(str(int(count.read_text()) + 1))
            mine += 1
    except DirectoryInUse:
        pass
"""
    (tmp_path / "count").write_text("0")
    paths = os.pathsep.join(filter(None, [str(Path(leased_run.__file__).parent), *sys.path]))
    command = [sys.executable, "-c", program, str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": paths}
    workers = [subprocess.Popen(command, env=environment) for _ in range(3)]
    assert [worker.wait(120) for worker in workers] == [0, 0, 0]
    assert (tmp_path / "count").read_text() == "30"
    assert names(tmp_path) == ["count"]


# --- races of a takeover, step by step --------------------------------------------------------


def test_late_successor_of_a_lease_that_was_replaced_gets_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    left(tmp_path, "d" * 32)
    seen = current_lease(tmp_path)  # by a process that is suspended now
    with Lease(tmp_path, SHORT) as held:
        monkeypatch.setattr(lease, "_abandoned_lease", lambda directory: seen)
        with pytest.raises(LeaseHeld, match=str(os.getpid())):
            Lease(tmp_path, SHORT)
        held.check()
        assert names(tmp_path) == [LOCK_NAME]


@pytest.mark.parametrize("fails", [False, True])
def test_link_that_a_server_makes_and_reports_as_existing_counts(
    fails: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # NFS repeats a request whose answer was lost.
    link = os.link

    def twice(source: Path, target: Path) -> None:
        link(source, target)
        if fails:
            link(source, target)

    monkeypatch.setattr("os.link", twice)
    with Lease(tmp_path, SHORT) as held:
        held.check()
    assert names(tmp_path) == []


def test_successor_that_was_killed_before_it_replaced_the_lease_is_succeeded(
    tmp_path: Path,
) -> None:
    name = left(tmp_path, "f" * 32)
    (tmp_path / LOCK_NAME).rename(tmp_path / name)
    left(tmp_path, "e" * 32)
    (tmp_path / name).rename(tmp_path / f"{LOCK_NAME}.{'e' * 32}")
    found = current_lease(tmp_path)
    assert found is not None
    assert found.token == "f" * 32
    with Lease(tmp_path, SHORT) as held:
        held.check()
        assert names(tmp_path) == [LOCK_NAME]


# --- a holder that is suspended ---------------------------------------------------------------


def test_lease_that_was_taken_over_is_lost_and_stays_the_successors(tmp_path: Path) -> None:
    with holder(tmp_path) as process:
        process.send_signal(signal.SIGSTOP)
        clock.sleep(0.2)  # a write that has begun is finished after the signal
        with Lease(tmp_path, SHORT) as held:
            process.send_signal(signal.SIGCONT)
            _, said = process.communicate("go on\n", timeout=30)
            assert process.returncode == 1
            assert f"was taken over by another run ({os.getpid()} on " in said
            held.check()
    assert names(tmp_path) == []


def test_lease_that_lapsed_is_taken_again_unless_another_process_did(tmp_path: Path) -> None:
    with holder(tmp_path) as process:
        before = current_lease(tmp_path)
        process.send_signal(signal.SIGSTOP)
        clock.sleep(2 * SHORT)
        process.send_signal(signal.SIGCONT)
        with pytest.raises(LeaseHeld):
            Lease(tmp_path, SHORT)
        after = current_lease(tmp_path)
        process.communicate("go on\n", timeout=30)
        assert process.returncode == 0
    assert before is not None
    assert after is not None
    assert before.token != after.token
    assert names(tmp_path) == []


def test_lease_whose_file_is_removed_is_lost(tmp_path: Path) -> None:
    with Lease(tmp_path, SHORT) as held:
        (tmp_path / LOCK_NAME).unlink()
        with pytest.raises(LockLost, match="removed"):
            held.check()


def test_lease_that_cannot_be_renewed_lapses_before_another_can_take_it_over(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A node that is cut off: its writes fail, and so does the check.
    def fail(*_: object) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    with Lease(tmp_path, SHORT) as held, monkeypatch.context() as patched:
        held.check()
        patched.setattr("os.fsync", fail)
        clock.sleep(0.7 * SHORT)
        with pytest.raises(OSError, match=os.strerror(errno.EIO)):
            held.check()
        patched.undo()
        held.check()


# --- clocks -----------------------------------------------------------------------------------

#: Differences between the clock of this machine and that of its file server [s].
SKEWS = [-1e9, -3600.0, 3600.0, 1e9]


@pytest.mark.parametrize("skew", SKEWS)
def test_lease_is_held_whatever_the_clock_of_the_file_server_shows(
    skew: float, tmp_path: Path
) -> None:
    shown = clock.time() + skew
    with Lease(tmp_path, SHORT) as held:
        os.utime(tmp_path / LOCK_NAME, (shown, shown))
        with pytest.raises(LeaseHeld):
            Lease(tmp_path, SHORT)
        held.check()


@pytest.mark.parametrize(
    "skew", [SKEWS[-1], *(pytest.param(each, marks=pytest.mark.slow) for each in SKEWS[:-1])]
)
def test_abandoned_lease_is_taken_over_whatever_the_clock_of_the_file_server_shows(
    skew: float, tmp_path: Path
) -> None:
    left(tmp_path, "c" * 32, duration=SHORT / 2)
    shown = clock.time() + skew
    os.utime(tmp_path / LOCK_NAME, (shown, shown))
    assert not is_locked(tmp_path)  # no command refuses the directory
    began = clock.monotonic()
    with Lease(tmp_path, SHORT) as held:
        assert clock.monotonic() - began >= SHORT / 2
        held.check()


# --- status -----------------------------------------------------------------------------------


def test_status_of_a_lease_is_known_without_waiting(tmp_path: Path) -> None:
    assert not is_locked(tmp_path)
    with Lease(tmp_path):
        assert f"process {os.getpid()} on " in in_use(tmp_path)
        began = clock.monotonic()
        assert is_locked(tmp_path)
        assert clock.monotonic() - began < 1
    assert not is_locked(tmp_path)
    left(tmp_path, "a" * 32)
    assert is_locked(tmp_path)
    old = clock.time() - 2 * SHORT
    os.utime(tmp_path / LOCK_NAME, (old, old))
    assert not is_locked(tmp_path)
    with holder(tmp_path, 60.0) as process:
        assert is_locked(tmp_path)
        process.kill()
        process.wait(30)
        assert not is_locked(tmp_path)


def test_process_of_another_user_or_machine_is_not_taken_for_an_ended_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def text(owner: str, mark: str) -> LeaseFile:
        return LeaseFile(Path("run/.lock"), f"{owner} on here\n{'a' * 32}\n60.0\n{mark}\n7\n")

    def refuse(*_: object) -> None:
        raise PermissionError

    mine = lease_file.process_mark(os.getpid())
    assert mine
    assert not lease_file.is_gone(text(str(os.getpid()), mine))
    assert not lease_file.is_gone(text("999999999", ELSEWHERE))
    assert not lease_file.is_gone(text("no number", mine))
    assert not lease_file.is_gone(text(str(os.getpid()), ""))
    assert lease_file.is_gone(text("999999999", mine))
    earlier = mine.rpartition(" ")[0] + " 1"  # of the same number, before that was used again
    assert lease_file.is_gone(text(str(os.getpid()), earlier))
    monkeypatch.setattr("os.kill", refuse)
    assert not lease_file.is_gone(text(str(os.getpid()), earlier))


# --- runs -------------------------------------------------------------------------------------


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
