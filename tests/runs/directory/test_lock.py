"""The lock of a run's directory is the operating system's."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import threading
import time as clock
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory.lock import DirectoryInUse, locked

HOLDER = """
import sys
from viscontact.runs.directory.lock import locked
with locked(sys.argv[1]):
    print("locked", flush=True)
    sys.stdin.readline()
"""
#: A child that is forked, as workers are, and outlives its parent by as long as it is let.
FORKER = """
import os, sys, time
from viscontact.runs.directory.lock import locked
with locked(sys.argv[1]):
    if os.fork() == 0:
        print("locked", flush=True)  # by the child, which lets go of the lock before fork returns
        os.close(1)
        time.sleep(60)
        os._exit(0)
    sys.stdin.readline()
"""


@contextmanager
def holder(directory: Path, program: str = HOLDER) -> Iterator[subprocess.Popen[str]]:
    """Another process that has locked a directory, and releases it on request."""
    with subprocess.Popen(
        [sys.executable, "-c", program, str(directory)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout
        assert process.stdout.readline() == "locked\n"
        try:
            yield process
        finally:
            process.kill()


def test_other_process_is_kept_out_and_named_until_the_end(tmp_path: Path) -> None:
    with holder(tmp_path) as process:
        with pytest.raises(DirectoryInUse) as refusal, locked(tmp_path):
            pass
        said = str(refusal.value)
        assert str(tmp_path) in said
        assert len(said.splitlines()) == 1
        if os.name != "nt":  # which lets no process read a locked file
            assert f"(process {process.pid} on " in said
        process.communicate("go on\n", timeout=30)
    with locked(tmp_path):
        pass
    assert list(tmp_path.iterdir()) == []


def test_killed_process_locks_no_other_out(tmp_path: Path) -> None:
    with holder(tmp_path) as process:
        process.kill()
        process.wait(30)
        assert os.name == "nt" or (tmp_path / LOCK_NAME).read_text(encoding="utf-8")
        with locked(tmp_path):
            pass


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no processes are forked here")
def test_forked_child_does_not_keep_the_lock_of_its_killed_parent(tmp_path: Path) -> None:
    with holder(tmp_path, FORKER) as process:
        with pytest.raises(DirectoryInUse), locked(tmp_path):
            pass
        os.kill(process.pid, signal.SIGKILL)
        process.wait(30)
        try:
            with locked(tmp_path):
                pass
        finally:
            os.killpg(process.pid, signal.SIGKILL)  # the child, in a session of its own


def test_second_opener_in_the_process_is_kept_out_whatever_its_thread(tmp_path: Path) -> None:
    outcomes: list[str] = []

    def attempt() -> None:
        try:
            with locked(tmp_path):
                outcomes.append("locked")
        except DirectoryInUse as error:
            outcomes.append(str(error))

    with locked(tmp_path):
        attempt()
        thread = threading.Thread(target=attempt)
        thread.start()
        thread.join()
    attempt()
    assert [f"process {os.getpid()}" in said or os.name == "nt" for said in outcomes[:2]] == [
        True
    ] * 2
    assert outcomes[2:] == ["locked"]


@pytest.mark.parametrize("content", [b"", b"4711 on elsewhere\n", b"\xff\x00" * 5000])
def test_left_over_file_locks_nothing(content: bytes, tmp_path: Path) -> None:
    (tmp_path / LOCK_NAME).write_bytes(content)
    with locked(tmp_path):
        pass


def test_lock_is_given_up_when_the_block_fails(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), locked(tmp_path):
        raise KeyboardInterrupt
    with locked(tmp_path):
        pass


def test_one_of_many_at_once_gets_the_lock(tmp_path: Path) -> None:
    # Many processes at once, each of which locks and unlocks, and counts in a file in between:
    # were two of them in at the same time, a count would get lost.
    program = """
import sys
from pathlib import Path
from viscontact.runs.directory.lock import DirectoryInUse, locked
count, mine = Path(sys.argv[1]) / "count", 0
while mine < 50:
    try:
        with locked(sys.argv[1]):
            count.write_text(str(int(count.read_text()) + 1))
            mine += 1
    except DirectoryInUse:
        pass
"""
    (tmp_path / "count").write_text("0")
    command = [sys.executable, "-c", program, str(tmp_path)]
    workers = [subprocess.Popen(command) for _ in range(3)]
    assert [worker.wait(120) for worker in workers] == [0, 0, 0]
    assert (tmp_path / "count").read_text() == "150"


@pytest.mark.skipif(os.name == "nt", reason="flock is POSIX")
def test_file_system_without_locks_and_hard_links_is_named_as_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(errno.ENOTSUP, os.strerror(errno.ENOTSUP))

    monkeypatch.setattr("fcntl.flock", refuse)
    monkeypatch.setattr("os.link", refuse)
    with pytest.raises(OSError, match=r"cannot be locked .*local disk") as said, locked(tmp_path):
        pass
    assert os.strerror(errno.ENOTSUP) in str(said.value)
    assert list(tmp_path.iterdir()) == []


def test_directory_that_is_missing_cannot_be_locked(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="cannot be locked"), locked(tmp_path / "none"):
        pass
    assert list(tmp_path.iterdir()) == []


def test_lock_waits_for_one_that_is_held_for_an_instant(tmp_path: Path) -> None:
    def lock() -> None:
        with locked(tmp_path):
            pass

    with ThreadPoolExecutor(1) as pool, ExitStack() as held:
        # As the status of a sweep holds it, to see whether a run is active.
        held.enter_context(locked(tmp_path))
        waiting = pool.submit(lock)
        clock.sleep(0.02)
        assert not waiting.done()
        held.close()
        waiting.result()
