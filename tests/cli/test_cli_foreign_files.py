"""Links, pipes and files of other programs in the directory of a run stay as they are."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

from cli.stopped_runs import said_in_lines, stopped, stopped_once
from interrupted_runs import contents, folder, same_bits, whole
from viscontact.cli import main
from viscontact.runs.directory import recorder

__all__ = ["folder", "stopped", "stopped_once", "whole"]  # fixtures


def test_links_are_replaced_and_not_written_through(
    folder: Path,
    whole: xr.Dataset,
) -> None:
    Path("load.csv").write_text("time [s], force [N]\n0, 0\n1, 4\n", encoding="utf-8")
    load = ["--set", "load={kind: history, file: load.csv}"]
    assert main(["run", "case.yaml", "-q", "-o", "mine", *load]) == 0
    Path("mine", "state.npz").write_text("mine", encoding="utf-8")
    Path("case").mkdir()
    for name in contents("mine"):
        Path("case", name).symlink_to(Path("..", "mine", name))
    before = contents("mine")
    assert main(["run", "case.yaml", "-q", "--overwrite", *load]) == 0
    assert contents("mine") == before
    assert same_bits("case", whole)


def test_result_that_is_a_link_continues_as_a_file(
    stopped: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recorder, "PAUSE", 0.0)
    monkeypatch.setattr(recorder, "SHARE", 0.0)
    store = stopped.parent / "store.nc"
    (stopped / "result.nc").rename(store)
    (stopped / "result.nc").symlink_to(store)
    before = store.read_bytes()
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert store.read_bytes() == before
    assert same_bits("case", whole)


@pytest.mark.parametrize("words", [[], ["--overwrite"], ["--resume"]])
@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("state.npz", "precious"),
        ("progress.jsonl", "{}"),
        ("progress.jsonl", '{"time": 1, "temperature": 20}'),
    ],
)
def test_file_that_no_run_has_written_is_not_replaced(
    name: str,
    content: str,
    words: list[str],
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("d").mkdir()
    for each, text in ((name, content), ("case.yaml", "precious")):
        Path("d", each).write_text(text, encoding="utf-8")
    before = contents("d")
    assert main(["run", "case.yaml", "-q", "-o", "d", *words]) == 2
    (line,) = said_in_lines(capsys)
    assert contents("d") == before
    Path("d/case.yaml").unlink()
    assert main(["run", "case.yaml", "-q", "-o", "d", *words]) == 2
    (line,) = said_in_lines(capsys)
    assert f"d/{name}" in line
    assert "-o DIR" in line
    assert "--overwrite" not in line  # which is refused as well
    assert sorted(contents("d")) == [name]


def test_hidden_files_of_other_programs_stay(folder: Path) -> None:
    Path("d").mkdir()
    Path("d/.result.nc.backup").write_text("precious", encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "d"]) == 0
    Path("d/state.npz").write_text("precious", encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "d", "--resume"]) == 0  # over already
    assert contents("d")[".result.nc.backup"] == contents("d")["state.npz"] == b"precious"


@pytest.mark.parametrize(
    "name",
    [
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in (".state.npz.new", ".case.yaml.new")
        ),
        ".result.nc.working",
    ],
)
def test_link_at_a_temporary_name_is_not_written_through(
    name: str,
    folder: Path,
    whole: xr.Dataset,
) -> None:
    Path("precious.txt").write_text("precious", encoding="utf-8")
    Path("d").mkdir()
    Path("d", name).symlink_to(Path("..", "precious.txt"))
    assert main(["run", "case.yaml", "-q", "-o", "d"]) == 0
    assert Path("precious.txt").read_text(encoding="utf-8") == "precious"
    assert same_bits("d", whole)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no named pipes in directories")
@pytest.mark.parametrize("words", [[], ["--overwrite"], ["--resume"]])
@pytest.mark.parametrize("name", ["result.nc", "state.npz", "progress.jsonl"])
def test_pipe_is_no_file_of_a_run(
    name: str, words: list[str], stopped: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (stopped / name).unlink()
    os.mkfifo(stopped / name)
    with ending_within(10):
        assert main(["run", "case.yaml", *words]) == 2
    (line,) = said_in_lines(capsys)
    assert f"{name}: is not a regular file" in line


@contextmanager
def ending_within(seconds: int) -> Iterator[None]:
    def late(*arguments: Any) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
