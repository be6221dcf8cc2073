"""Runs at the command line in directories that are leased."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
import xarray as xr

from interrupted_runs import at_instant, contents, folder, kill, same_bits, whole
from viscontact.cli import main
from viscontact.results.run_files import LOCK_NAME
from viscontact.runs.directory import lock
from viscontact.runs.directory.lease_file import header

__all__ = ["folder", "whole"]  # fixtures

pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has locks on all file systems")


@pytest.fixture(autouse=True)
def _no_locks(monkeypatch: pytest.MonkeyPatch) -> None:
    """A file system whose locks do not hold for all machines."""
    monkeypatch.setattr(lock, "has_locks", lambda directory: False)


def leave_lease(directory: Path, duration: float) -> None:
    """Replace the lease of a directory by that of a process of another machine."""
    head = header("a" * 32, "4711 on node7", duration).splitlines()
    head[3] = "another machine"
    fresh = directory / "fresh"
    fresh.write_text("\n".join([*head, "000000000000\n"]), encoding="ascii")
    fresh.replace(directory / LOCK_NAME)


def test_run_under_a_lease_is_killed_and_resumed_to_the_same_bits(
    folder: Path, whole: xr.Dataset
) -> None:
    kill(4, "-q")
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)
    assert sorted(contents("case")) == ["case.yaml", "progress.jsonl", "result.nc"]


def test_run_that_is_taken_over_ends_with_the_reason_and_writes_nothing_more(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    left: dict[str, bytes] = {}

    def take_over() -> None:
        leave_lease(Path("case"), 60.0)
        left.update(files())

    def files() -> dict[str, bytes]:
        # The working file, still open, is not used by a successor.
        return {name: each for name, each in contents("case").items() if "working" not in name}

    undo = at_instant(5, take_over)
    assert main(["run", "case.yaml"]) == 1
    undo()
    assert left
    assert files() == left
    [last] = [line for line in capsys.readouterr().err.splitlines() if "taken over" in line]
    assert last == (
        "case was taken over by another run (4711 on node7), after this one had not renewed its "
        "lease for 60 s; that run continues, and this one has stopped before its next write"
    )


def test_run_says_whose_lease_it_watches_before_it_takes_that_over(
    folder: Path, whole: xr.Dataset, capsys: pytest.CaptureFixture[str]
) -> None:
    kill(4, "-q")
    leave_lease(Path("case"), 0.5)
    assert main(["run", "case.yaml", "--resume"]) == 0
    first, second, *_ = capsys.readouterr().err.splitlines()
    assert first == (
        "case is leased to another run (process 4711 on node7); it is taken over if that does not "
        "renew its lease within 500 ms"
    )
    assert second.startswith("case: continuing after 4 of 7 instants")
    assert same_bits("case", whole)
