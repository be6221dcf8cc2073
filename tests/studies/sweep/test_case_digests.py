"""Digests of the cases of a sweep, by which a task notices that its case has been edited."""

from __future__ import annotations

from pathlib import Path

import pytest

from viscontact.studies.sweep.case_digests import changed_since, with_digests
from viscontact.studies.sweep.manifest import SweepRun, read_manifest, write_manifest

CASE = """\
title: a ball
indenter: {shape: profile, file: profile.csv}
material: {law: maxwell, shear_modulus: 10 MPa, viscosity: 1 MPa s, poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 8}
"""
FORCE = {"load.force": "2 N"}
OTHER = {"indenter.file": "other.csv"}


def pinned(folder: Path, settings: dict[str, str]) -> SweepRun:
    """A run of the case, with its digests as the manifest keeps them."""
    (folder / "case.yaml").write_text(CASE, encoding="utf-8")
    for name in ("profile.csv", "other.csv"):
        (folder / name).write_text("1,2\n", encoding="utf-8")
    run = SweepRun(0, "a", "a", settings, tuple(settings), "../case.yaml", "grid")
    path = write_manifest(folder / "sweep", with_digests(folder / "sweep", [run]))
    [found] = read_manifest(path)
    return found


@pytest.mark.parametrize(
    ("before", "now", "parts"),
    [
        ("8}", "8}  # steps", []),
        ("4 N", "4N", []),
        ("steps: 8", "steps: 8.0", []),
        ("{kind: step, force: 4 N}", "\n  force: 4 N\n  kind: step", []),
        ("a ball", "the ball", []),
        ("4 N", "5 N", []),  # the runs have other values
        ("step,", "ramp,", ["load"]),
        ("10 MPa", "20 MPa", ["material"]),
        ("5 s, steps: 8", "6 s, steps: 8}\ntolerance: {time: 1e-3", ["time", "tolerance"]),
        ("time: {end: 5 s, steps: 8}\n", "", ["time"]),
        ("profile.csv", "other.csv", ["indenter", "profile.csv", "other.csv"]),
    ],
)
def test_edit_of_a_case_changes_the_digests_of_its_sections(
    tmp_path: Path, before: str, now: str, parts: list[str]
) -> None:
    run = pinned(tmp_path, FORCE)
    edited = CASE.replace(before, now)
    assert edited != CASE
    (tmp_path / "case.yaml").write_text(edited, encoding="utf-8")
    assert changed_since(tmp_path / "sweep", run) == parts


@pytest.mark.parametrize(("settings", "named"), [(FORCE, "profile.csv"), (OTHER, "other.csv")])
def test_edit_of_a_file_that_the_run_reads_changes_its_digest(
    tmp_path: Path, settings: dict[str, str], named: str
) -> None:
    run = pinned(tmp_path, settings)
    for name in ("profile.csv", "other.csv"):
        (tmp_path / name).write_text("1,3\n", encoding="utf-8")
        assert changed_since(tmp_path / "sweep", run) == ([name] if name == named else [])
        (tmp_path / name).write_text("1,2\n", encoding="utf-8")


def test_runs_without_digests_or_a_case_that_can_be_read_have_no_changes(tmp_path: Path) -> None:
    run = pinned(tmp_path, FORCE)
    (tmp_path / "case.yaml").write_text("load: {", encoding="utf-8")
    assert changed_since(tmp_path / "sweep", run) == []  # the run reports the error
    old = SweepRun(0, "a", "a", FORCE, (), "../case.yaml", "grid")
    [read] = read_manifest(write_manifest(tmp_path / "old", [old]))
    assert "digests" not in (tmp_path / "old" / "runs.jsonl").read_text(encoding="utf-8")
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    assert changed_since(tmp_path / "old", read) == []
    of_python = SweepRun(0, "a", "a", {}, (), "", "cases")
    assert with_digests(tmp_path, [of_python]) == [of_python]


def test_digests_of_ten_thousand_runs_read_each_file_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = pinned(tmp_path, FORCE)
    read = []
    monkeypatch.setattr(
        "viscontact.runs.execution.case_digests.digest", lambda path: read.append(path) or b"1"
    )
    runs = (
        SweepRun(n, "", "", {"load.force": f"{n} N"}, (), run.case, "grid") for n in range(10**4)
    )
    assert (
        len({tuple(each.digests.items()) for each in with_digests(tmp_path / "sweep", runs)}) == 1
    )
    assert read == [tmp_path / "profile.csv"]
