"""The result of a run on disk: whole at every moment, whatever happens to its writer."""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.mechanics.problem.kept_fields import NO_FIELDS, KeptFields
from viscontact.results.variables import FIELDS, LINES, scalars_of
from viscontact.runs.directory import result_writer
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.result_writer import ResultWriter
from written_states import GRID, SOME, TIMES, begun, faults_of, names, resumed, state, write

ROWS = len(TIMES)
NAME = "result.nc"
#: Asked-for fields, and the instants that `faults_of` expects them at.
FIELDS_ASKED: list[tuple[Any, list[float] | None]] = [("all", None), (SOME, SOME), ("none", [])]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a result goes; nothing is there."""
    return tmp_path / NAME


@pytest.fixture(autouse=True)
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Do not wait for the disk: nothing here cuts the power."""
    monkeypatch.setattr(os, "fsync", lambda descriptor: None)


def content(path: Path) -> dict[str, Any]:
    """All that a file says, but for its date and the time it took."""
    with netCDF4.Dataset(str(path)) as file:
        file.set_auto_maskandscale(False)
        said: dict[str, Any] = {name: file.getncattr(name) for name in file.ncattrs()}
        for name, variable in file.variables.items():
            attributes = {key: str(variable.getncattr(key)) for key in variable.ncattrs()}
            data = variable[:].tobytes()
            said[name] = (variable.dtype, variable.dimensions, variable.shape, attributes, data)
    del said["wall_time"], said["started"]
    return said


# --- what is in the file ----------------------------------------------------------------------


@pytest.mark.parametrize(("fields", "some"), FIELDS_ASKED, ids=["all", "some", "none"])
def test_result_holds_every_bit_at_each_publication(
    fields: Any, some: list[float] | None, path: Path
) -> None:
    with begun(path, fields) as writer:
        assert writer.publish()
        assert faults_of(path, 0, some) == []
        for row in range(ROWS):
            writer.append(state(row))
            if row % 3 == 1:
                assert writer.publish()
                assert faults_of(path, row + 1, some) == []
        writer.finish()
    assert faults_of(path, ROWS, some) == []
    assert names(path) == [NAME]


@pytest.mark.parametrize(("tolerance", "kind"), [(1e-6, "f4"), (6e-7, "f4"), (5e-7, "f8")])
def test_fields_are_stored_in_the_precision_that_the_tolerance_needs(
    tolerance: float, kind: str, path: Path
) -> None:
    contents = Contents(GRID, TIMES, tolerance=tolerance)
    with ResultWriter(path, contents) as writer:
        writer.append(state(0))
        writer.finish()
    with netCDF4.Dataset(str(path)) as file:
        for name in (*FIELDS, *LINES):
            assert file.variables[name].dtype == ("i1" if name == "in_contact" else kind)
            found = file.variables[name][0].filled()
            np.testing.assert_array_equal(found, getattr(state(0), name).astype(kind))
        assert file.variables["approach"].dtype == "f8"
    if kind == "f4":
        assert np.finfo(kind).eps / 2 <= tolerance / 10


def test_result_describes_itself(path: Path) -> None:
    with begun(path) as writer:
        write(writer, 5)
        with xr.open_dataset(path) as ds:
            assert ds.attrs["complete"] == 0
        write(writer)
        writer.finish()
    with vc.open_results(path) as ds:
        assert dict(ds.sizes) == {"time": ROWS, "x": 6, "y": 5, "field_time": len(SOME)}
        assert ds.encoding["unlimited_dims"] == {"time", "field_time"}
        for name in (*scalars_of(), *FIELDS, *LINES, "time", "x", "y", "field_time"):
            assert ds[name].attrs["units"]
            assert ds[name].attrs["long_name"]
        meanings = "converged no_contact not_converged pulled_off"
        assert ds["outcome"].attrs["flag_meanings"] == meanings
        assert ds["outcome"].attrs["flag_values"].tolist() == [0, 1, 2, 3]
        assert ds.attrs["complete"] == 1
        assert ds.attrs["title"] == "µ"
        np.testing.assert_array_equal(ds.x, GRID.x)


def test_scalars_do_not_wait_in_memory_for_ever(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(result_writer, "WAITING", 4)
    with begun(path) as writer:
        for row in range(ROWS - 1):
            writer.append(state(row))
            assert len(writer._waiting) < 4
        writer.finish()
    assert faults_of(path, ROWS - 1, SOME) == []


def test_earlier_result_stays_until_the_first_publication(path: Path) -> None:
    path.write_bytes(b"of an earlier run")
    with begun(path) as writer:
        writer.append(state(0))
    assert path.read_bytes() == b"of an earlier run"
    assert names(path) == [NAME]
    with begun(path) as writer:
        writer.append(state(0))
        writer.publish()
        assert faults_of(path, 1, SOME) == []
        write(writer, 3)
    assert faults_of(path, 3, SOME) == []


def test_what_takes_the_place_of_the_result_is_on_the_disk_by_then(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A power cut may lose what was written and not flushed, the change of a name included.
    events: list[tuple[str, int, int]] = []
    replace = os.replace

    def flush(descriptor: int) -> None:
        found = os.fstat(descriptor)
        events.append(("flushed", found.st_ino, found.st_mtime_ns))

    def replacing(source: Path, target: Path) -> None:
        found = Path(source).stat()
        if target == path:
            events.append(("replaced", found.st_ino, found.st_mtime_ns))
        replace(source, target)

    monkeypatch.setattr(os, "fsync", flush)
    monkeypatch.setattr(os, "replace", replacing)
    with begun(path) as writer:
        writer.publish()
        write(writer, 6)
        writer.finish()
    replaced = [at for at, event in enumerate(events) if event[0] == "replaced"]
    assert len(replaced) == 8
    for at in replaced:
        assert events[at - 1] == ("flushed", *events[at][1:])
        if os.name != "nt":
            assert events[at + 1][:2] == ("flushed", path.parent.stat().st_ino)


def test_publishing_again_and_again_does_not_swell_the_file(path: Path) -> None:
    times = np.arange(100.0)
    with ResultWriter(path, Contents(GRID, times, NO_FIELDS)) as writer:
        for row in range(100):
            writer.append(state(row, times=times))
            writer.publish()
        writer.finish()
    # The chunk that each variable begins with, 137 512 bytes, has room for all rows.
    assert path.stat().st_size < 160_000


# --- going on ---------------------------------------------------------------------------------


@pytest.mark.parametrize(("fields", "some"), FIELDS_ASKED, ids=["all", "some", "none"])
def test_result_is_the_same_in_one_go_and_in_many(
    fields: Any, some: list[float] | None, path: Path
) -> None:
    with begun(path.with_name("whole.nc"), fields) as writer:
        write(writer)
        writer.finish()
    with begun(path, fields) as writer:
        write(writer, 2)
        position = json.loads(json.dumps(writer.position))
        write(writer, 4)  # published, but its position got lost
    for end in (3, 3, 7, 11):
        with resumed(path, position, fields) as writer:
            write(writer, end)
            assert faults_of(path, end, some) in ([], ["warnings"])
            position = writer.position
            for row in range(end, ROWS):  # computed, and never published
                writer.append(state(row))
    with resumed(path, position, fields) as writer:
        write(writer)
        writer.finish()
    assert content(path) == content(path.with_name("whole.nc"))
    assert names(path) == [NAME, "whole.nc"]


def test_time_spent_adds_up(path: Path) -> None:
    with begun(path) as writer:
        write(writer, 2)
        position = writer.position
    assert 0 < position["wall_time"] < 60
    with resumed(path, {**position, "wall_time": 1e6}) as writer:
        writer.finish()
    with vc.open_results(path) as ds:
        assert 1e6 < ds.attrs["wall_time"] < 1e6 + 60


def test_a_resumed_run_keeps_its_date(path: Path) -> None:
    with begun(path) as writer:
        write(writer, 2)
        position = writer.position
    with resumed(path, {**position, "started": "2001-02-03T04:05:06+07:00"}) as writer:
        writer.finish()
    with vc.open_results(path) as ds:
        assert ds.attrs["started"] == "2001-02-03T04:05:06+07:00"


def test_rows_that_come_out_differently_end_what_was_there(path: Path) -> None:
    # With other threads the steps a run chooses may differ in the last bit.
    with begun(path) as writer:
        write(writer, 3)
        position = writer.position
        write(writer, 9)
    with resumed(path, position) as writer:
        writer.append(state(4))
        writer.publish()
        with vc.open_results(path) as ds:
            assert ds.time.values.tolist() == [*TIMES[:3], TIMES[4]]
            assert ds.field_time.values.tolist() == [TIMES[0], TIMES[4]]
        writer.append(state(6))
        writer.finish()
    with vc.open_results(path) as ds:
        np.testing.assert_array_equal(ds.time, [*TIMES[:3], TIMES[4], TIMES[6]])
        np.testing.assert_array_equal(ds.pressure[1], state(4).pressure)


def test_rows_beyond_the_end_are_dropped(path: Path) -> None:
    with begun(path) as writer:
        write(writer, 3)
        position = writer.position
        write(writer, 9)
    with resumed(path, position) as writer:
        write(writer, 5)
        writer.finish()
    assert faults_of(path, 5, SOME) == []
    with vc.open_results(path) as ds:
        assert (ds.sizes["time"], ds.sizes["field_time"]) == (5, 2)


def _other(path: Path, grid: vc.Grid = GRID, fields: Any = SOME, rows: int = 5) -> None:
    with ResultWriter(path, Contents(grid, TIMES, KeptFields(fields))) as writer:
        writer.publish()
        if grid is GRID:
            write(writer, rows)


def unsealed_size(path: Path) -> int:
    """Size of a file as HDF5 leaves it: it cuts off what it has not written."""
    with netCDF4.Dataset(str(path), "a"):
        pass
    return path.stat().st_size


SPOILED: dict[str, tuple[Callable[[Path], object], str]] = {
    "missing": (lambda path: path.unlink(), "is missing"),
    "empty": (lambda path: path.write_bytes(b""), "cannot be read"),
    "foreign": (lambda path: path.write_bytes(b"\x89PNG" * 999), "cannot be read"),
    "cut short": (lambda path: os.truncate(path, path.stat().st_size // 2), "cannot be read"),
    "short of a byte": (lambda path: os.truncate(path, unsealed_size(path) - 1), "cannot be read"),
    "other data": (
        lambda path: xr.Dataset({"a": ("time", [1.0])}).to_netcdf(path),
        "is not the result of this run so far: it has no time",
    ),
    "fewer rows": (lambda path: _other(path, rows=4), "it has 4 instants and 1 with fields, and 5"),
    "other grid": (lambda path: _other(path, vc.Grid((6, 5), (2e-3, 2e-3))), "y is another grid's"),
    "other shape": (lambda path: _other(path, vc.Grid((6, 6), (2e-3, 1e-3))), "another grid's"),
    "all fields": (lambda path: _other(path, fields="all"), "it has no field_time"),
    "no fields": (lambda path: _other(path, fields="none"), "it has no field_time"),
}


@pytest.mark.parametrize(("spoil", "said"), SPOILED.values(), ids=SPOILED.keys())
def test_result_that_is_not_this_runs_is_refused_and_left_alone(
    spoil: Callable[[Path], object], said: str, path: Path
) -> None:
    with begun(path) as writer:
        write(writer, 5)
        position = writer.position
    spoil(path)
    before = {file.name: file.read_bytes() for file in path.parent.iterdir()}
    with pytest.raises(ValueError, match=said) as refusal:
        resumed(path, position)
    assert str(path) in str(refusal.value)
    assert str(refusal.value).endswith("start the run again with --overwrite")
    assert {file.name: file.read_bytes() for file in path.parent.iterdir()} == before


def test_disk_without_room_for_a_file_is_not_a_lack_of_permission(path: Path) -> None:
    # netCDF says "Permission denied" wherever HDF5 cannot write its first bytes.
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, before[1]))
    try:
        with pytest.raises(OSError, match="too large") as full:
            begun(path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert full.value.errno == errno.EFBIG
    assert list(path.parent.iterdir()) == []
