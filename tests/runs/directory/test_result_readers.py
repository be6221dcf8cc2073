"""A result among its readers, and on file systems that cannot do everything."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr

from viscontact.runs.directory import result_writer
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter
from written_states import GRID, SOME, TIMES, begun, faults_of, names, resumed, state, write

NAME = "result.nc"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a result goes; nothing is there."""
    return tmp_path / NAME


@pytest.fixture(autouse=True)
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Do not wait for the disk: nothing here cuts the power."""
    monkeypatch.setattr(os, "fsync", lambda descriptor: None)


READER = """
import sys
import viscontact as vc
with vc.open_results(sys.argv[1]) as ds:
    print("open", flush=True)
    sys.stdin.readline()
    ds.load().to_netcdf(sys.argv[2])
"""


@pytest.mark.parametrize("locking", ["TRUE", pytest.param("FALSE", marks=pytest.mark.slow)])
def test_reader_continues_with_what_it_has_opened(
    locking: str, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Lazily opened, the file is read long after others have taken its place.
    monkeypatch.setenv("HDF5_USE_FILE_LOCKING", locking)
    times, seen = np.arange(80.0), path.with_name("seen.nc")
    with ResultWriter(path, Contents(GRID, times)) as writer:
        for row in range(20):
            writer.append(state(row, times=times))
        writer.publish()
        command = [sys.executable, "-c", READER, str(path), str(seen)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as reader:
            assert reader.stdin
            assert reader.stdout
            assert reader.stdout.readline() == b"open\n"
            for row in range(20, 80):
                writer.append(state(row, times=times))
                if row % 10 == 0:
                    assert writer.publish()
            writer.finish()
            reader.stdin.write(b"\n")
    assert faults_of(path, 80, None, times=times) == []
    with xr.open_dataset(seen) as old:
        assert old.sizes["time"] == 20
        for row in range(20):
            np.testing.assert_array_equal(old.pressure[row], state(row, times=times).pressure)
    assert names(path) == [NAME, "seen.nc"]


def _holding(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Let files be held as on Windows, where nothing takes the place of an open file."""
    held: list[Path] = []
    replace = os.replace

    def replacing(source: Path, target: Path) -> None:
        if target in held:
            raise PermissionError(errno.EACCES, "The process cannot access the file")
        replace(source, target)

    monkeypatch.setattr(os, "replace", replacing)
    monkeypatch.setattr(result_writer, "MAY_BE_HELD", True)
    monkeypatch.setattr(result_writer, "PAUSE", 0.0)
    return held


def test_result_that_is_held_is_published_later(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = _holding(monkeypatch)
    with begun(path) as writer:
        for row in range(len(TIMES)):
            held[:] = [path] if row % 4 else []
            writer.append(state(row))
            assert writer.publish() is (row % 4 == 0)
            assert faults_of(path, row - row % 4 + 1, SOME) == []
            with netCDF4.Dataset(str(path)) as file:
                assert len(file.dimensions["time"]) == row - row % 4 + 1
        held.clear()
        writer.finish()
    assert faults_of(path, len(TIMES), SOME) == []
    assert names(path) == [NAME]


def test_result_that_is_held_for_ever_is_an_error_at_the_end(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = _holding(monkeypatch)
    with begun(path) as writer:
        write(writer, 3)
        position = writer.position
        held.append(path)
        writer.append(state(3))
        with pytest.raises(PermissionError, match="close that program and resume the run"):
            writer.finish()
    assert faults_of(path, 3, SOME) == []
    held.clear()
    with resumed(path, position) as writer:
        write(writer)
    assert faults_of(path, len(TIMES), SOME) == []


def test_directory_that_may_not_be_written_is_no_reader(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = _holding(monkeypatch)
    monkeypatch.setattr(result_writer, "MAY_BE_HELD", False)
    with begun(path) as writer:
        write(writer, 3)
        held.append(path)
        writer.append(state(3))
        with pytest.raises(PermissionError):
            writer.publish()
    assert faults_of(path, 3, SOME) == []
