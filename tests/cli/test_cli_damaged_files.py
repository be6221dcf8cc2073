"""Damaged files of a run are refused, and everything is left as it is."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
import xarray as xr

from cli.stopped_runs import said_in_lines, stopped, stopped_once
from interrupted_runs import at_instant, contents, folder, kill, same_bits, whole
from viscontact.cli import main
from viscontact.results.line_digests import with_digest

__all__ = ["folder", "stopped", "stopped_once", "whole"]  # fixtures


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def _empty(path: Path) -> None:
    path.write_bytes(b"")


def _garbage(path: Path) -> None:
    path.write_bytes(bytes(range(256)) * 40)


def _text(path: Path) -> None:
    path.write_text("notes\n" * 9, encoding="utf-8")


def _foreign(path: Path) -> None:
    path.unlink()
    xr.Dataset({"a": ("time", [1.0, 2.0])}).to_netcdf(path)


def _directory(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _link_to_nowhere(path: Path) -> None:
    path.unlink()
    path.symlink_to("nowhere")


DAMAGES = (_cut, _empty, _garbage, _text, _foreign, _directory)


def hashes(directory: Path) -> dict[str, bytes | None]:
    return {
        str(path): path.read_bytes() if path.is_file() else None for path in directory.rglob("*")
    }


@pytest.mark.parametrize("damage", [*DAMAGES, Path.unlink])
@pytest.mark.parametrize("name", ["result.nc", "state.npz", "progress.jsonl"])
def test_damaged_file_is_refused_and_everything_left_as_it_is(
    name: str,
    damage: Callable[[Path], None],
    stopped: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    damage(stopped / name)
    before = hashes(stopped)
    assert main(["run", "case.yaml", "--resume"]) == 2
    lines = said_in_lines(capsys)
    assert len(lines) == 1
    assert name in lines[0]
    assert "--overwrite" in lines[0] or "-o DIR" in lines[0]
    assert hashes(stopped) == before
    assert main(["show", "case"]) in (0, 2)
    said_in_lines(capsys)
    # what can be read of it is not overwritten without being asked either
    assert main(["run", "case.yaml", "-q"]) == (
        0 if damage is Path.unlink and name == "result.nc" else 2
    )


def test_course_of_another_run_is_not_continued(
    stopped: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = stopped / "progress.jsonl"
    lines = [line.rpartition(b', "digest": ')[0] + b"}" for line in path.read_bytes().splitlines()]
    later = [with_digest(line.replace(b'"time": ', b'"time": 1')) for line in lines]
    path.write_bytes(b"\n".join(later) + b"\n")
    before = hashes(stopped)
    assert main(["run", "case.yaml", "--resume"]) == 2
    assert "progress.jsonl is not the course of this run so far" in said_in_lines(capsys)[0]
    assert hashes(stopped) == before


@pytest.mark.parametrize(
    "damage",
    [
        *(pytest.param(each, marks=pytest.mark.slow) for each in (_cut, _empty, _garbage, _text)),
        _foreign,
        _directory,
    ],
)
def test_overwrite_replaces_a_damaged_result(
    damage: Callable[[Path], None],
    stopped: Path,
    whole: xr.Dataset,
    capsys: pytest.CaptureFixture[str],
) -> None:
    damage(stopped / "result.nc")
    code = main(["run", "case.yaml", "-q", "--overwrite"])
    if damage is _directory:  # which may hold anything
        assert code == 2
        assert "is a directory, where a run has a file" in said_in_lines(capsys)[0]
        return
    assert code == 0
    assert same_bits("case", whole)


@pytest.mark.parametrize("line", ["[" * 200_000, '{"time": 1' + "0" * 400 + "}", '{"time": 1'])
def test_course_that_cannot_be_read_is_refused_and_the_hidden_copy_stays(
    line: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    kill(4, "-q")
    Path("case/.result.nc.working").write_text("unpublished", encoding="utf-8")
    path = Path("case/progress.jsonl")
    path.write_text(line + "\n" * 20, encoding="utf-8")
    before = contents("case")
    assert main(["run", "case.yaml", "--resume"]) == 2
    (said,) = said_in_lines(capsys)
    assert "progress.jsonl is damaged" in said
    assert contents("case") == before


@pytest.mark.skipif(os.name == "nt", reason="Windows removes no open file")
def test_course_that_is_removed_meanwhile_is_written_anew(
    folder: Path,
    whole: xr.Dataset,
) -> None:
    assert main(["run", "case.yaml", "-q", "-o", "other"]) == 0
    undo = at_instant(4, Path("case/progress.jsonl").unlink)
    try:
        assert main(["run", "case.yaml", "-q"]) == 0
    finally:
        undo()
    assert contents("case")["progress.jsonl"] == contents("other")["progress.jsonl"]
    assert same_bits("case", whole)


def test_case_that_is_no_text_is_replaced_when_asked(
    stopped: Path,
    whole: xr.Dataset,
) -> None:
    (stopped / "case.yaml").write_bytes(b"title: R\xf6lle\n")
    assert main(["run", "case.yaml", "-q", "--overwrite"]) == 0
    assert same_bits("case", whole)
