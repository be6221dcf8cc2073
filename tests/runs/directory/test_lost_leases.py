"""Leases that are replaced, taken over, lapse or are removed: what holder and successor get."""

from __future__ import annotations

import errno
import os
import signal
import time as clock
from pathlib import Path

import pytest

from runs.directory.held_leases import SHORT, holder, left, names
from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory import lease
from viscontact.runs.directory.lease import Lease, LeaseHeld
from viscontact.runs.directory.lease_file import current_lease
from viscontact.runs.directory.lock_check import LockLost

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has locks on all file systems")


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
