"""A result outlasts its writer: kills, failures of any call, full disks, readers, interruptions."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest

from viscontact.mechanics.state import ContactState
from viscontact.runs.directory import result_writer
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter
from written_states import GRID, SOME, TIMES, begun, faults_of, names, resumed, state, write

NAME = "result.nc"
#: Rows of the result that is made again for each of some hundred crashes.
ROWS = 5
HERE = Path(__file__).parents[2]
#: Of a process' calls each is tried in the slow tests, by default every sixth.
EVERY = pytest.mark.parametrize("every", [6, pytest.param(1, marks=pytest.mark.slow)])


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a result goes; nothing is there."""
    return tmp_path / NAME


@pytest.fixture(autouse=True)
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Do not wait for the disk: nothing here cuts the power."""
    monkeypatch.setattr(os, "fsync", lambda descriptor: None)


class Killed(BaseException):
    """The process has ended: nothing in it catches this, and nothing more is done."""


class Calls:
    """Everything that changes the disk, with something happening at the n-th call of it."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, at: int, fault: Callable[[], None]) -> None:
        self.count, self._at, self._fault = 0, at, fault
        for name in ("open", "fsync", "replace", "unlink"):
            monkeypatch.setattr(os, name, self._watched(getattr(os, name)))
        monkeypatch.setattr(shutil, "copyfile", self._watched(shutil.copyfile, halves=True))
        monkeypatch.setattr(netCDF4, "Dataset", self._watched(netCDF4.Dataset))

    def _watched(self, call: Callable[..., Any], halves: bool = False) -> Callable[..., Any]:
        def watched(*arguments: Any, **options: Any) -> Any:
            self.count += 1
            if self.count >= self._at:
                if halves:
                    data = Path(arguments[0]).read_bytes()
                    Path(arguments[1]).write_bytes(data[: len(data) // 2])
                self._fault()
            return call(*arguments, **options)

        return watched


def _die() -> None:
    raise Killed


def _until_killed(path: Path, position: dict[str, Any] | None) -> Iterator[dict[str, Any]]:
    """Write on, if a process may; yield each position that is safe."""
    writer = begun(path) if position is None else resumed(path, position)
    yield from ([] if position else [writer.position] if writer.publish() else [])
    for row in range(writer.position["rows"], ROWS):
        writer.append(state(row))
        if row % 2 or row == 2:
            writer.publish()
            yield writer.position
    writer.finish()


@pytest.mark.skipif(os.name == "nt", reason="what the dead writer has open cannot be removed")
@EVERY
@pytest.mark.parametrize(
    "begin", ["anew", pytest.param("over another", marks=pytest.mark.slow), "resumed"]
)
def test_crash_before_any_call_leaves_whole_rows_and_the_run_continues(
    begin: str, every: int, tmp_path: Path
) -> None:
    crashes = 0
    for at in range(1, 1000, every):
        path = tmp_path / str(at) / NAME
        path.parent.mkdir()
        position = None
        if begin == "over another":
            with begun(path, "all") as writer:
                write(writer, 3)
        if begin == "resumed":
            with begun(path) as writer:
                write(writer, 2)
                position = writer.position
                write(writer, 4)
        before = path.read_bytes() if path.exists() else None
        with pytest.MonkeyPatch.context() as patched:
            calls = Calls(patched, at, _die)
            try:
                for safe in _until_killed(path, position):
                    position = safe
            except Killed:
                crashes += 1
        if calls.count < at:
            break
        if position is None:
            # What is there is the earlier result, or the first of the new one.
            found = path.read_bytes() if path.exists() else None
            assert found == before or faults_of(path, 0, SOME) == []
            continue
        assert faults_of(path, position["rows"], SOME) in ([], ["warnings"])
        with resumed(path, position) as writer:
            for row in range(position["rows"], ROWS):
                writer.append(state(row))
            writer.finish()
        assert faults_of(path, ROWS, SOME) == []
        assert names(path) == [NAME]
    assert crashes > 25 / every  # a result of five rows takes some 29 calls


@EVERY
def test_failure_of_any_call_leaves_whole_rows_and_no_litter(every: int, tmp_path: Path) -> None:
    def fail() -> None:
        calls._at = 10**9  # this once
        # netCDF has an error of its own.
        raise (
            RuntimeError("NetCDF: HDF error")
            if failures % 2 == 0
            else OSError(errno.ENOSPC, "no room")
        )

    failures = 0
    for at in range(1, 1000, every):
        path = tmp_path / str(at) / NAME
        path.parent.mkdir()
        position, stopped = None, None
        with pytest.MonkeyPatch.context() as patched:
            calls = Calls(patched, at, fail)
            writer = None
            try:
                with begun(path) as writer:
                    writer.publish()
                    for row in range(ROWS):
                        writer.append(state(row))
                        writer.publish()
                        position = writer.position
                    writer.finish()
            except (OSError, RuntimeError) as error:
                stopped = error
        if calls.count < at and not stopped:
            break
        failures += 1
        if position is None:
            continue
        assert faults_of(path, position["rows"], SOME) == []
        with resumed(path, position) as writer:
            for row in range(position["rows"], ROWS):
                writer.append(state(row))
            writer.finish()
        assert faults_of(path, ROWS, SOME) == []
        assert names(path) == [NAME]
    assert failures > 30 / every


def test_interruption_within_a_row_does_not_publish_a_torn_copy(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: Any) -> None:
        raise KeyboardInterrupt

    with begun(path) as writer:
        write(writer, 4)
        position = writer.position
        with monkeypatch.context() as patched:
            patched.setattr(result_writer, "write_fields", interrupt)
            with pytest.raises(KeyboardInterrupt):
                writer.append(state(4))
        with pytest.raises(OSError, match="could not be written before"):
            writer.append(state(4))
    assert faults_of(path, 4, SOME) == []
    with resumed(path, position) as writer:
        write(writer)
    assert faults_of(path, len(TIMES), SOME) == []


def test_interruption_between_rows_loses_none(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: Any) -> None:
        raise KeyboardInterrupt

    with begun(path) as writer:
        write(writer, 3)
        with monkeypatch.context() as patched:
            patched.setattr(ContactState, "without_fields", interrupt)
            with pytest.raises(KeyboardInterrupt):
                writer.append(state(9))
        assert writer.position["rows"] == 3
        write(writer, 6)
    assert faults_of(path, 6, SOME) == ["warnings"] or faults_of(path, 6, SOME) == []


# --- for real ---------------------------------------------------------------------------------

LIMITED = """
import json, resource, sys
from pathlib import Path
import numpy as np
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter
from viscontact.mechanics.state import ContactState
from written_states import GRID, state
path, room, times, position = Path(sys.argv[1]), int(sys.argv[2]), np.arange(300.0), None
resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
try:
    with ResultWriter(path, Contents(GRID, times)) as writer:
        for row in range(300):
            writer.append(state(row, times=times))
            if row % 10 == 9:
                writer.publish()
                position = writer.position
except OSError as error:
    print(json.dumps([position, str(error)]))
"""


def script(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run Python in the folder of the tests."""
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=HERE,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.mark.parametrize(
    "room",
    [200_000, *(pytest.param(n, marks=pytest.mark.slow) for n in (1_000, 150_000, 300_000))],
)
def test_file_that_may_not_grow_any_more_ends_the_writing_in_order(room: int, path: Path) -> None:
    # The system itself cuts a write short at this size, as on a full disk.
    pytest.importorskip("resource")
    run = script("-c", LIMITED, str(path), str(room))
    assert (run.returncode, run.stderr) == (0, "")
    position, said = json.loads(run.stdout)
    assert str(path) in said
    assert "disk full" in said
    assert bool(position) == (room > 160_000)
    assert names(path) == ([NAME] if position else [])
    if not position:
        return
    times = np.arange(300.0)
    assert faults_of(path, position["rows"], None, times=times) == []
    with ResultWriter.resume(path, Contents(GRID, times), position) as writer:
        for row in range(position["rows"], 300):
            writer.append(state(row, times=times))
        writer.finish()
    assert faults_of(path, 300, None, times=times) == []


UNWRITABLE = """
import resource, sys
from pathlib import Path
from written_states import begun, write
with begun(Path(sys.argv[1])) as writer:
    write(writer, 2)
    writer.publish()
    writer.reopen()
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
print("goes on")
"""


def test_discarding_rows_where_nothing_can_be_written_does_not_end_the_process(path: Path) -> None:
    # HDF5 writes the first bytes of a file when it closes it, even where no rows have been added.
    pytest.importorskip("resource")
    run = script("-c", UNWRITABLE, str(path))
    assert (run.returncode, run.stdout, run.stderr) == (0, "goes on\n", "")
    assert names(path) == [NAME]
    assert faults_of(path, 2, SOME) == []


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="kills its own children")
def test_result_is_whole_and_readable_whenever_its_writer_is_killed(path: Path) -> None:
    run = script("killed_writer.py", str(path), "8", "20240607")
    assert run.returncode == 0, run.stderr
    report = json.loads(run.stdout)
    assert report["faults"] == []
    assert report["rows"] > 8
    assert report["readings"] > 8
