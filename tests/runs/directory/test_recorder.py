"""What a run saves of itself: bits that come back as they were, and damage that is noticed."""

from __future__ import annotations

import dataclasses
import errno
import io
import json
import os
import shutil
import stat
import time as clock
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from viscontact.backend import compiled, transforms
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.problem.kept_fields import NO_FIELDS, KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactState
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory import recorder
from viscontact.runs.directory.checkpoint import (
    LAYOUT,
    Checkpoint,
    load_checkpoint,
    save_checkpoint,
)
from viscontact.runs.directory.npz_archive import read_plain, write_plain
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.recorded import ChangedCaseError, Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.simulation.transient import frictionless
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import RunSetup, prepare_run

COUNT = 12
#: Fields of the first and the last instant.
ENDS = KeptFields([0.0, 1.0])


def sphere_run(force: float = 0.1, count: int = COUNT, kept: KeptFields = ENDS) -> RunSetup:
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    grid, times = vc.Grid((24, 24), (2.4e-3, 2.4e-3)), np.linspace(0.0, 1.0, count)
    return prepare_run(Problem(vc.Sphere(0.01), rubber, vc.step(force), grid, times, kept=kept))


def sphere(directory: Path, run: RunSetup | None = None) -> Recorded:
    """A recorded run without error bars."""
    return Recorded(directory, OverTime(run or sphere_run(), errors=False))


@pytest.fixture
def recorded(tmp_path: Path) -> Recorded:
    """A run of a sphere, and an empty directory for it."""
    return sphere(tmp_path)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The directory of the same run, uninterrupted."""
    directory = tmp_path_factory.mktemp("whole")
    finish(Recorder(sphere(directory)))
    return directory


def finish(record: Recorder) -> None:
    for _ in record.steps():
        pass
    record.finish()


def stop_after(record: Recorder, instants: int) -> None:
    """March so far, then leave everything as a process that is killed would."""
    for number, _ in enumerate(record.steps(), record.resumed.rows + 1):
        if number == instants:
            break
    record.close()


def same_bits(one: Path, other: Path) -> bool:
    with xr.open_dataset(one / "result.nc") as a, xr.open_dataset(other / "result.nc") as b:
        same = a.sizes == b.sizes and set(a.variables) == set(b.variables)
        return same and all(a[v].values.tobytes() == b[v].values.tobytes() for v in a.variables)


def contents(directory: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in directory.iterdir()}


# --- plain data -------------------------------------------------------------------------------


def test_who_reads_the_last_line_of_the_log_finds_all_rows_in_the_result(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recorder, "PAUSE", 1e9)  # no checkpoint after the first step
    append, rows = ProgressLog.append, []

    def looked_at(log: ProgressLog, *given: Any) -> None:
        append(log, *given)
        path = recorded.directory / RESULT_NAME
        rows.append(len(vc.open_results(path).time) if path.exists() else 0)

    monkeypatch.setattr(ProgressLog, "append", looked_at)
    finish(Recorder(recorded))
    assert rows == [0] + [1] * (COUNT - 2) + [COUNT]


def test_plain_data_come_back_to_the_last_bit() -> None:
    fixed = np.array([1.5, -0.0, np.nan])
    fixed.flags.writeable = False
    signalling = np.array([0x7FF0000000000001], dtype="u8").view("f8")
    given: dict[str, Any] = {
        "fixed": fixed,
        "payload": signalling,
        "columns": np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        "every other": np.arange(10.0)[::2],
        "empty": np.empty((0, 3)),
        "scalar": np.array(3.0),
        "words": ["ü", None, True, 7, 5e-324, -0.0],
        "deep": {"a": [{"b": fixed}, [fixed]]},
        "not finite": [float("inf"), float("-inf")],
    }
    file = io.BytesIO()
    write_plain(file, given)
    read = read_plain(file)
    assert list(read) == list(given)
    for name in ("fixed", "payload", "columns", "every other", "empty", "scalar"):
        assert read[name].tobytes() == given[name].tobytes()
        assert read[name].shape == given[name].shape
    # of whether a sum over it runs by rows or by columns, its last bits may depend
    assert read["columns"].flags.f_contiguous
    assert read["fixed"].flags.writeable  # who goes on from it may write to it
    assert read["words"] == given["words"]
    assert str(read["words"][-1]) == "-0.0"
    assert read["deep"]["a"][1][0].tobytes() == fixed.tobytes()
    assert read["not finite"] == given["not finite"]


def test_damage_anywhere_is_refused_or_without_effect() -> None:
    given = {"time": 1.5, "field": np.arange(6.0), "past": [np.ones((2, 2)), None]}
    file = io.BytesIO()
    write_plain(file, given)
    whole = file.getvalue()
    refused = 0
    for position in range(len(whole)):
        for changed in (whole[position] ^ 0x01, whole[position] ^ 0xFF):
            damaged = whole[:position] + bytes([changed]) + whole[position + 1 :]
            try:
                read = read_plain(io.BytesIO(damaged))
            except ValueError:
                refused += 1
                continue
            assert read["time"] == 1.5, position
            assert read["field"].tobytes() == given["field"].tobytes(), position
            assert read["past"][0].tobytes() == np.ones((2, 2)).tobytes(), position
    # what is left is padding, dates and the like
    assert refused > len(whole)


def test_plain_data_cut_short_anywhere_are_refused() -> None:
    file = io.BytesIO()
    write_plain(file, {"field": np.arange(6.0)})
    whole = file.getvalue()
    for end in range(len(whole)):
        with pytest.raises(ValueError, match="damaged"):
            read_plain(io.BytesIO(whole[:end]))


def test_pickled_objects_are_never_loaded() -> None:
    file = io.BytesIO()
    np.savez(file, outline=np.array({"a": 1}, dtype=object))
    with pytest.raises(ValueError, match="damaged, or was written by something else"):
        read_plain(file)


# --- a run and its directory ------------------------------------------------------------------


@pytest.mark.parametrize(
    "instants", [1, 7, *(pytest.param(instants, marks=pytest.mark.slow) for instants in (2, COUNT))]
)
def test_run_continues_to_the_same_bits(
    instants: int, recorded: Recorded, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", 0.0)
    monkeypatch.setattr("viscontact.runs.directory.recorder.SHARE", 0.0)
    stop_after(Recorder(recorded), instants)
    record = Recorder.resume(recorded)
    expected = (instants, recorded.run.places[instants - 1])
    assert record.resumed == record.saved == record.shown == expected
    finish(record)
    assert same_bits(recorded.directory, whole)
    lines = [(each / PROGRESS_NAME).read_bytes() for each in (recorded.directory, whole)]
    assert lines[0] == lines[1]
    assert sorted(contents(recorded.directory)) == [PROGRESS_NAME, "result.nc"]


def test_run_that_is_stopped_after_every_step_ends_in_the_same_bits(
    recorded: Recorded, whole: Path
) -> None:
    stop_after(Recorder(recorded), 1)
    for instants in range(2, COUNT + 1):
        stop_after(Recorder.resume(recorded), instants)
    finish(Recorder.resume(recorded))
    assert same_bits(recorded.directory, whole)


@pytest.mark.parametrize("instants", [1, 7, COUNT])
def test_short_run_of_a_batch_is_repeated_to_the_same_bits(
    instants: int, recorded: Recorded, whole: Path
) -> None:
    stop_after(Recorder(recorded, pause=1e9), instants)
    assert (recorded.directory / STATE_NAME).exists()
    record = Recorder.resume(recorded)
    assert record.resumed.rows == 0
    finish(record)
    assert same_bits(recorded.directory, whole)
    assert sorted(contents(recorded.directory)) == [PROGRESS_NAME, "result.nc"]


def test_run_of_a_batch_saves_its_steps_after_a_pause(
    recorded: Recorded, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, saved = [0.0], []
    monkeypatch.setattr("viscontact.runs.directory.recorder.clock.monotonic", lambda: now[0])
    record = Recorder(recorded, pause=5.0)
    for _ in record.steps():
        saved.append(record.saved.rows)
        now[0] += 1.0
    assert saved[:6] == [0, 0, 0, 0, 0, 6]
    record.finish()
    assert same_bits(recorded.directory, whole)


def test_long_first_step_of_a_run_of_a_batch_is_saved(
    recorded: Recorded, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, march = [0.0], March.__iter__

    def slow(this: March) -> Iterator[ContactState | None]:
        for state in march(this):
            now[0] += 60.0
            yield state

    monkeypatch.setattr(March, "__iter__", slow)
    monkeypatch.setattr("viscontact.runs.directory.recorder.clock.monotonic", lambda: now[0])
    stop_after(Recorder(recorded, pause=5.0), 1)
    record = Recorder.resume(recorded)
    assert record.resumed.rows == 1
    finish(record)
    assert same_bits(recorded.directory, whole)


def test_run_of_a_batch_that_saves_its_steps_has_all_before_its_errors_are_estimated(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", 1e9)
    recorded = Recorded(tmp_path, OverTime(sphere_run(), errors=True))
    record = Recorder(recorded, pause=1e-9)
    saved = [record.saved.rows for _ in record.steps()]
    assert saved == [1] * COUNT

    def stop() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        record.estimate_errors(stop)
    record.close()
    record = Recorder.resume(recorded)
    assert record.resumed.rows == COUNT
    record.close()


def test_what_a_checkpoint_saves_is_on_the_disk_in_an_order_that_a_power_cut_respects(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", 0.0)
    monkeypatch.setattr("viscontact.runs.directory.recorder.SHARE", 0.0)
    events: list[tuple[str, int, int]] = []
    replace = os.replace

    def flush(descriptor: int) -> None:
        found = os.fstat(descriptor)
        events.append(("flushed", found.st_ino, found.st_mtime_ns))

    def replacing(source: Path, target: Path) -> None:
        found = Path(source).stat()
        events.append((Path(target).name, found.st_ino, found.st_mtime_ns))
        replace(source, target)

    monkeypatch.setattr(os, "fsync", flush)
    monkeypatch.setattr(os, "replace", replacing)
    record = Recorder(recorded)
    lines = recorded.directory / PROGRESS_NAME
    checked = 0
    for _ in record.steps():
        if record.saved.rows == 1:  # from here on the directory is this run's
            events.clear()
            continue
        names = [name for name, *_ in events]
        saved = names.index(STATE_NAME)
        assert names.index("result.nc") < saved
        assert ("flushed", lines.stat().st_ino, lines.stat().st_mtime_ns) in events[:saved]
        for at in (names.index("result.nc"), saved):
            assert events[at - 1] == ("flushed", *events[at][1:])
        if os.name != "nt":
            assert events[saved + 1][:2] == ("flushed", recorded.directory.stat().st_ino)
        events.clear()
        checked += 1
    assert checked > 1
    record.close()


def test_file_system_that_flushes_no_directories_is_no_obstacle(
    recorded: Recorded, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flush = os.fsync

    def flushing(descriptor: int) -> None:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, "Invalid argument")
        flush(descriptor)

    monkeypatch.setattr(os, "fsync", flushing)
    finish(Recorder(recorded))
    assert same_bits(recorded.directory, whole)


def test_course_of_a_finished_run_is_on_the_disk_before_its_state_is_gone(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    flushed: list[tuple[int, int]] = []

    def flush(descriptor: int) -> None:
        flushed.append((os.fstat(descriptor).st_ino, os.fstat(descriptor).st_size))

    monkeypatch.setattr(os, "fsync", flush)
    finish(Recorder(recorded))
    course = (recorded.directory / PROGRESS_NAME).stat()
    assert (course.st_ino, course.st_size) in flushed


def test_run_that_is_killed_loses_the_steps_since_its_last_checkpoint_only(
    recorded: Recorded, whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", 1e9)  # after the first step
    stop_after(Recorder(recorded), 7)
    assert len((recorded.directory / PROGRESS_NAME).read_bytes().splitlines()) == 7
    record = Recorder.resume(recorded)
    assert record.resumed == record.saved == record.shown == (1, 0.0)
    finish(record)
    assert same_bits(recorded.directory, whole)


def test_state_of_an_older_kind_is_refused_in_one_line(recorded: Recorded) -> None:
    stop_after(Recorder(recorded), 2)
    path = recorded.directory / STATE_NAME
    with path.open("rb") as file:
        saved = read_plain(file)
    with path.open("wb") as file:
        write_plain(file, {**saved, "token": "0123", "steps": 2})
    (recorded.directory / "steps.log").write_bytes(b"viscontact steps 1\n")
    with pytest.raises(ValueError, match=r"another version of viscontact; .* --overwrite$") as info:
        Recorder.resume(recorded)
    assert "\n" not in str(info.value)


def test_first_step_that_fails_changes_nothing(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    stop_after(Recorder(recorded), 3)
    before = contents(recorded.directory)

    solve = frictionless.solve_contact

    def failing(*arguments: Any, **options: Any) -> ContactSolution:
        return dataclasses.replace(solve(*arguments, **options), converged=False)

    other = sphere(recorded.directory, sphere_run(0.2))
    monkeypatch.setattr(frictionless, "solve_contact", failing)
    record = Recorder(other)
    with pytest.raises(vc.ConvergenceError):
        list(record.steps())
    record.close()
    assert contents(recorded.directory) == before


def test_result_of_another_run_is_not_continued(recorded: Recorded, tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    other = sphere(tmp_path / "other", sphere_run(0.2))
    for each in (recorded, other):
        stop_after(Recorder(each), 5)
    shutil.copy(other.directory / "result.nc", recorded.directory / "result.nc")
    shutil.rmtree(other.directory)
    before = contents(recorded.directory)
    with pytest.raises(ValueError, match="belongs to another run than"):
        Recorder.resume(recorded)
    assert contents(recorded.directory) == before


def test_changed_run_is_refused_with_the_difference(recorded: Recorded) -> None:
    stop_after(Recorder(recorded), 2)
    before = contents(recorded.directory)
    with pytest.raises(ChangedCaseError) as refusal:
        Recorder.resume(sphere(recorded.directory, sphere_run(0.2)))
    assert [str(each) for each in refusal.value.changes] == [
        "load.force[1]: was 0.1, is now 0.2",
    ]
    with pytest.raises(ChangedCaseError, match="fields"):
        Recorder.resume(sphere(recorded.directory, sphere_run(kept=NO_FIELDS)))
    assert contents(recorded.directory) == before


def test_state_of_another_version_is_refused(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Checkpoint.__init__, "__defaults__", ("0.0.1", LAYOUT))
    stop_after(Recorder(recorded), 2)
    with pytest.raises(ValueError, match=r"was saved by viscontact 0\.0\.1"):
        Recorder.resume(recorded)


def test_state_of_another_layout_is_refused(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Checkpoint.__init__, "__defaults__", (vc.__version__, LAYOUT - 1))
    stop_after(Recorder(recorded), 2)
    with pytest.raises(ValueError, match=r"earlier state of viscontact; .* --overwrite$"):
        Recorder.resume(recorded)


def test_durations_are_right_when_the_clock_is_set_back(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = iter(range(10**9, 0, -3600))
    monkeypatch.setattr(clock, "time", lambda: float(next(shown)))
    began = clock.monotonic()
    stop_after(Recorder(recorded), 5)
    finish(Recorder.resume(recorded))
    with vc.open_results(recorded.directory) as ds:
        assert 0 < ds.attrs["wall_time"] < clock.monotonic() - began


def test_hard_link_to_a_result_keeps_it_as_it_was(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.runs.directory.recorder.PAUSE", 0.0)
    monkeypatch.setattr("viscontact.runs.directory.recorder.SHARE", 0.0)
    record = Recorder(recorded)
    linked = recorded.directory / "snapshot.nc"
    for _ in record.steps():
        if record.saved.rows == 4:
            linked.hardlink_to(recorded.directory / "result.nc")
            before = linked.read_bytes()
    record.finish()
    assert linked.read_bytes() == before


def test_a_run_stays_with_the_transforms_it_was_begun_with(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = recorded.run.with_libraries("scipy", "numpy")
    begun = Recorder(dataclasses.replace(recorded, run=run))
    next(iter(begun.steps()))
    begun.close()
    monkeypatch.setattr(transforms, "ducc0", object())  # as if it had been installed since
    faster = sphere(recorded.directory)
    assert faster.run.setup.transforms == "ducc0"
    finish(Recorder.resume(faster))
    assert vc.open_results(recorded.directory).attrs["transforms"] == "scipy"


def test_a_run_whose_transforms_are_gone_is_not_continued(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun = Recorder(recorded)
    next(iter(begun.steps()))
    begun.close()
    path = recorded.directory / STATE_NAME
    saved = dataclasses.replace(load_checkpoint(path), transforms="ducc0")
    save_checkpoint(path, saved)
    monkeypatch.setattr(transforms, "ducc0", None)
    with pytest.raises(ValueError, match=r"used the Fourier transforms of ducc0.*fast"):
        Recorder.resume(recorded)


@pytest.mark.skipif(compiled.core is None, reason="no compiled core")
def test_a_run_stays_with_the_inner_loops_it_was_begun_with(recorded: Recorded) -> None:
    run = recorded.run.with_libraries(recorded.run.setup.transforms, "numpy")
    begun = Recorder(dataclasses.replace(recorded, run=run))
    next(iter(begun.steps()))
    begun.close()
    faster = sphere(recorded.directory)
    assert faster.run.setup.inner_loops == "compiled"
    finish(Recorder.resume(faster))
    resumed = vc.open_results(recorded.directory)
    assert resumed.attrs["inner_loops"] == "numpy"
    (directory := recorded.directory.parent / "whole").mkdir()
    whole = Recorder(dataclasses.replace(sphere(directory), run=run))
    finish(whole)
    np.testing.assert_array_equal(resumed.pressure, vc.open_results(directory).pressure)


def test_a_run_whose_compiled_core_is_gone_is_not_continued(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun = Recorder(recorded)
    next(iter(begun.steps()))
    begun.close()
    path = recorded.directory / STATE_NAME
    save_checkpoint(path, dataclasses.replace(load_checkpoint(path), inner_loops="compiled"))
    monkeypatch.setattr(compiled, "core", None)
    with pytest.raises(ValueError, match=r"used .* compiled inner loops.*no compiled core"):
        Recorder.resume(recorded)


@pytest.mark.parametrize(("force", "kind"), [(0.1, "f4"), (1e-30, "f8")])
def test_fields_beyond_single_precision_are_stored_in_double(
    tmp_path: Path, force: float, kind: str
) -> None:
    load, grid = vc.step(force), vc.Grid((16, 16), (2e-3, 2e-3))
    rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    run = prepare_run(Problem(vc.FlatPunch(5e-4), rubber, load, grid, [0.0]))
    finish(Recorder(sphere(tmp_path, run)))
    with xr.open_dataset(tmp_path / RESULT_NAME) as ds:
        assert ds["pressure"].dtype == np.dtype(kind)
        assert float(ds["pressure"].max()) > 0


def test_log_of_a_finished_run_equals_its_result(tmp_path: Path) -> None:
    record = Recorder(Recorded(tmp_path, OverTime(sphere_run(count=4, kept=NO_FIELDS))))
    for _ in record.steps():
        pass
    record.finish(record.estimate_errors())
    lines = [json.loads(line) for line in (tmp_path / PROGRESS_NAME).read_text().splitlines()]
    with xr.open_dataset(tmp_path / RESULT_NAME) as ds:
        for name in ("time", "approach", "approach_error", "peak_pressure_error"):
            logged = np.array([line[name] for line in lines], dtype=np.float64)
            assert logged.tobytes() == ds[name].values.tobytes()
    assert [line["part"] for line in lines] == [0.25, 0.5, 0.75, 1.0]
    assert lines[-1]["complete"]
