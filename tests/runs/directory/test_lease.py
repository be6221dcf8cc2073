"""The lease of a run's directory: which directories have one, its holder, clocks and status."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
import threading
import time as clock
from pathlib import Path

import pytest

import leased_run
from leased_run import leased
from runs.directory.held_leases import ELSEWHERE, SHORT, holder, left, names
from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory import lease_file, lock_probe
from viscontact.runs.directory.lease import Lease, LeaseHeld
from viscontact.runs.directory.lease_file import LeaseFile, current_lease
from viscontact.runs.directory.lock import DirectoryInUse, in_use, is_locked, locked
from viscontact.runs.directory.lock_probe import file_system, has_locks

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has locks on all file systems")


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
