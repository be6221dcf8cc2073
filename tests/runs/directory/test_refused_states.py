"""States and results that are not continued: of other runs, versions, layouts or transforms."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from runs.directory.recorded_sphere import (
    contents,
    finish,
    recorded,
    sphere,
    sphere_run,
    stop_after,
)
from viscontact.backend import compiled, transforms
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.results.run_files import STATE_NAME
from viscontact.runs.directory.checkpoint import (
    LAYOUT,
    Checkpoint,
    load_checkpoint,
    save_checkpoint,
)
from viscontact.runs.directory.npz_archive import read_plain, write_plain
from viscontact.runs.directory.recorded import ChangedCaseError, Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.simulation.transient import frictionless

__all__ = ["recorded"]  # a fixture


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


@pytest.mark.parametrize(
    ("saved", "message"),
    [
        (("0.0.1", LAYOUT), r"was saved by viscontact 0\.0\.1"),
        ((vc.__version__, LAYOUT - 1), r"earlier state of viscontact; .* --overwrite$"),
    ],
    ids=["version", "layout"],
)
def test_state_of_another_version_or_layout_is_refused(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch, saved: tuple[str, int], message: str
) -> None:
    monkeypatch.setattr(Checkpoint.__init__, "__defaults__", saved)
    stop_after(Recorder(recorded), 2)
    with pytest.raises(ValueError, match=message):
        Recorder.resume(recorded)


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
