"""Where nothing can be written: a full disk, a quota, directories that are read-only."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

from cli.stopped_runs import said_in_lines, stopped, stopped_once
from interrupted_runs import contents, folder, same_bits, whole
from viscontact.cli import main
from viscontact.runs.directory import checkpoint, recorder
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.result_writer import ResultWriter

__all__ = ["folder", "stopped", "stopped_once", "whole"]  # fixtures


resource = pytest.importorskip("resource") if os.name != "nt" else None


# --- a full disk ------------------------------------------------------------------------------


def _full(*arguments: Any, **options: Any) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


WRITERS = [
    (ProgressLog, "append"),
    (ResultWriter, "append"),
    (ResultWriter, "publish"),
    (checkpoint, "write_plain"),
    (recorder, "save_checkpoint"),
]


@pytest.mark.parametrize(
    ("where", "name", "calls"),
    [
        (ResultWriter, "finish", 0),  # it is called once
        (ProgressLog, "append", 0),
        *((*each, 4) for each in WRITERS),
        *(pytest.param(*each, 0, marks=pytest.mark.slow) for each in WRITERS[1:]),
        *(pytest.param(*each, 6, marks=pytest.mark.slow) for each in WRITERS),
    ],
)
def test_full_disk_stops_the_run_which_continues_once_there_is_space(
    calls: int,
    where: Any,
    name: str,
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    call, count = getattr(where, name), 0

    def filling(*arguments: Any, **options: Any) -> Any:
        nonlocal count
        count += 1
        return _full() if count > calls else call(*arguments, **options)

    with monkeypatch.context() as patched:
        patched.setattr(recorder, "PAUSE", 0.0)
        patched.setattr(recorder, "SHARE", 0.0)
        patched.setattr(where, name, filling)
        code = main(["run", "case.yaml"])
    lines = said_in_lines(capsys)
    assert code == 1
    why, kept, remedy = lines[-3:]
    assert why == "case: the run stopped: [Errno 28] No space left on device"
    if kept == "case keeps nothing yet: no instant was finished":
        number = 0
    else:
        number = int(kept.removeprefix("case keeps ").split()[0])
        assert kept.startswith(f"case keeps {number} of 7 instants")
        assert number > 0
        _, less, saved = kept.partition("; a resumed run continues after ")
        number = int(saved) if less else number
    words = ["run", "case.yaml", *(["--resume"] if number else [])]
    assert remedy == "after correcting that: " + " ".join(["viscontact", *words])
    assert main(words) == 0
    said = capsys.readouterr().err
    if number:
        assert said.startswith(f"case: continuing after {number} of 7 instants")
    assert same_bits("case", whole)


@pytest.mark.skipif(resource is None, reason="Windows has no quota for a process")
@pytest.mark.parametrize(
    "size", [*(pytest.param(size, marks=pytest.mark.slow) for size in (0, 2_000)), 20_000, 60_000]
)
def test_quota_stops_the_run_which_continues_without_it(
    size: int,
    folder: Path,
    whole: xr.Dataset,
    capsys: pytest.CaptureFixture[str],
) -> None:
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        code = main(["run", "case.yaml", "-q"])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert said_in_lines(capsys)
    if size < 40_000:  # no room for a result without any instant: refused, and nothing created
        assert code == 2
        assert not Path("case").exists()
    else:
        assert code == 1
    if Path("case/result.nc").exists():
        xr.open_dataset("case/result.nc").close()
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


# --- where nothing can be written ---------------------------------------------------------------


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write everywhere")
def test_directory_that_may_not_be_written_to_is_refused(
    stopped: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = contents("case")
    stopped.chmod(0o555)
    try:
        codes = [main(["run", "case.yaml", *words]) for words in (["--resume"], ["--overwrite"])]
        codes.append(main(["run", "case.yaml", "-o", "case/deeper"]))
    finally:
        stopped.chmod(0o755)
    assert codes == [2, 2, 2]
    assert len(said_in_lines(capsys)) == 3
    assert contents("case") == before


@pytest.mark.parametrize("call", ["mkdir", "lock", "working copy"])
def test_directory_that_cannot_be_written_to_is_refused(
    call: str,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def refusing(*arguments: Any, **options: Any) -> Any:
        raise OSError(errno.EROFS, "Read-only file system")

    @contextmanager
    def locking(directory: Path) -> Iterator[None]:
        refusing()
        yield

    with monkeypatch.context() as patched:
        if call == "mkdir":
            patched.setattr(Path, "mkdir", refusing)
        elif call == "lock":
            patched.setattr("viscontact.runs.execution.run_directory.locked", locking)
        else:
            patched.setattr("viscontact.runs.directory.result_writer.created", refusing)
        assert main(["run", "case.yaml"]) == 2
    [line] = said_in_lines(capsys)
    assert "Read-only file system" in line
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_finished_run_on_a_disk_that_is_read_only_is_still_finished(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert main(["run", "case.yaml", "-q"]) == 0

    def refusing(*arguments: Any, **options: Any) -> Any:
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr("viscontact.runs.execution.run_directory.locked", refusing)
    monkeypatch.setattr(Path, "unlink", refusing)
    assert main(["run", "case.yaml", "--resume"]) == 0
