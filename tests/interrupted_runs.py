"""A case, the bits of its uninterrupted run, and ways to interrupt it at the command line."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import viscontact as vc
from viscontact.cli import main
from viscontact.cli.run import execution
from viscontact.runs.directory import recorder

#: The bodies of a case; load, time and grid are up to who uses them.
BODIES = """\
title: Zener sphere
indenter: {shape: sphere, radius: 10 mm}
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
"""
CASE = (
    BODIES
    + """\
load: {kind: ramp, force: 4 N, duration: 1 s}  # then held
time: {end: 3 s, steps: 6}
grid: {shape: [24, 24], size: [3 mm, 3 mm]}
output: {fields: [0 s, 2 s, 3 s], errors: false}
"""
)
WITH_ERRORS = CASE.replace(", errors: false", "")
COUNT = 7  # instants


class Killed(BaseException):
    """The process is gone."""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory whose name has a space, with a case in it."""
    here = tmp_path / "my runs"
    here.mkdir()
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(here)
    return here


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    """The result of the same run, uninterrupted."""
    here = tmp_path_factory.mktemp("whole")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", str(here / "case.yaml"), "-q"]) == 0
    with xr.open_dataset(here / "case" / "result.nc") as ds:
        return ds.load()


def at_instant(number: int, act: Callable[[], None]) -> Callable[[], None]:
    """Do something when an instant is being shown; return what undoes that."""

    @contextmanager
    def shown(*arguments: Any, **options: Any) -> Iterator[Any]:
        def report(state: vc.ContactState, done: int, total: int) -> None:
            if done == number:
                act()

        yield report

    patched = pytest.MonkeyPatch()
    patched.setattr(execution, "shown_progress", shown)
    return patched.undo


def checkpoints_after_every_step(patched: pytest.MonkeyPatch) -> None:
    """Let no time lie between two checkpoints."""
    patched.setattr(recorder, "PAUSE", 0.0)
    patched.setattr(recorder, "SHARE", 0.0)


def kill(number: int, *words: str) -> None:
    """Let a run end as if it were killed at an instant, with a checkpoint after every step."""

    def die() -> None:
        raise Killed

    undo = at_instant(number, die)
    with pytest.MonkeyPatch.context() as patched:
        checkpoints_after_every_step(patched)
        with pytest.raises(Killed):
            main(["run", "case.yaml", *words])
    undo()


def contents(directory: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path(directory).iterdir()}


def same_bits(directory: str, whole: xr.Dataset) -> bool:
    with xr.open_dataset(Path(directory) / "result.nc") as ds:
        same = ds.sizes == whole.sizes and set(ds.variables) == set(whole.variables)
        return same and all(
            ds[name].values.tobytes() == whole[name].values.tobytes() for name in whole.variables
        )


@contextmanager
def stopped_after(monkeypatch: pytest.MonkeyPatch, states: int = 1) -> Iterator[None]:
    """Ctrl-C as soon as so many states have been recorded, each of which is written at once."""
    monkeypatch.setattr(recorder, "PAUSE", 0.0)
    monkeypatch.setattr(recorder, "SHARE", 0.0)
    found, left = recorder.Recorder._record, states

    def stopped(record: recorder.Recorder, state: vc.ContactState) -> None:
        nonlocal left
        found(record, state)
        left -= 1
        if not left:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(recorder.Recorder, "_record", stopped)
        yield
