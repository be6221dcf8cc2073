"""What a run saves of itself, and that it ends in the same bits wherever it is stopped."""

from __future__ import annotations

import errno
import json
import os
import stat
import time as clock
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from runs.directory.recorded_sphere import (
    COUNT,
    contents,
    finish,
    recorded,
    same_bits,
    sphere,
    sphere_run,
    stop_after,
    whole,
)
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactState
from viscontact.results.run_files import PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory import recorder
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import prepare_run

__all__ = ["recorded", "whole"]  # fixtures


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
