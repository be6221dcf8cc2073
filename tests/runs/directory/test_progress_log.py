"""The log of a run: a line for each state, whatever happens in between."""

from __future__ import annotations

import errno
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from viscontact.mechanics.state import ContactState
from viscontact.results.variables import scalars_of
from viscontact.runs.directory.progress_log import ProgressLog
from written_states import state


def lines_of(path: Path) -> list[dict[str, Any]]:
    """Read the lines as any program would that knows JSON, and nothing but JSON."""

    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is not JSON")

    text = path.read_text(encoding="utf-8")
    assert text == "" or text.endswith("\n")
    lines = [json.loads(line, parse_constant=refuse) for line in text.splitlines()]
    assert all(len(line.pop("digest")) == 8 for line in lines)
    assert [line.pop("row") for line in lines] == list(range(len(lines)))
    return lines


def entries(of: ContactState) -> dict[str, Any]:
    """What a line has to say of a state, read back."""
    found = {name: getattr(of, name) for name in ("time", *scalars_of())}
    known = {k: None if isinstance(v, float) and math.isnan(v) else v for k, v in found.items()}
    outcome = ("converged", "no_contact", "not_converged")[of.outcome]
    return {**known, "outcome": outcome, "warnings": list(of.warnings)}


def test_lines_hold_every_scalar_to_the_last_bit(tmp_path: Path) -> None:
    with ProgressLog(tmp_path / "progress.jsonl") as log:
        for row in range(8):
            log.append(state(row))
            assert log.count == row + 1
            # on its way already: nothing waits in memory
            assert lines_of(tmp_path / "progress.jsonl") == [
                entries(state(k)) for k in range(row + 1)
            ]


def test_whole_numbers_of_numpy_stay_whole(tmp_path: Path) -> None:
    with ProgressLog(tmp_path / "log") as log:
        log.append(ContactState(**{**vars(state(0)), "cells_across": np.int64(7)}))
    assert '"cells_across": 7,' in (tmp_path / "log").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "kept", [*range(2), *(pytest.param(kept, marks=pytest.mark.slow) for kept in range(2, 6))]
)
def test_cut_anywhere_the_log_continues_with_the_same_lines(kept: int, tmp_path: Path) -> None:
    path = tmp_path / "progress.jsonl"
    with ProgressLog(path) as log:
        for row in range(6):
            log.append(state(row))
    whole = path.read_bytes()
    ends = [0, *(at + 1 for at, byte in enumerate(whole) if byte == ord("\n"))]
    # A killed process leaves a part of the line it was at; all parts of it are tried.
    for end in range(ends[kept], len(whole), 13):
        path.write_bytes(whole[:end])
        reached = state(kept - 1).time if kept else None
        with ProgressLog.resume(path, kept, reached) as log:
            assert log.count == kept
            assert path.read_bytes() == whole[:end]  # until the next line
            for row in range(kept, 6):
                log.append(state(row))
        assert path.read_bytes() == whole


LINE = b'{"time": 1.0}\n'


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "is not the course of this run so far"),
        (LINE + LINE + LINE[:-1], "is not the course of this run so far"),
        (LINE + LINE + LINE.replace(b"1", b"2"), "is not the course of this run so far"),
        (LINE + b"{}\n" + LINE, "is damaged"),
        (b"\xff\n" + b"x" * 200_000, "is damaged"),
    ],
)
def test_log_that_lacks_lines_is_refused_and_left_alone(
    content: bytes, reason: str, tmp_path: Path
) -> None:
    path = tmp_path / "progress.jsonl"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=rf"{reason}.*--overwrite"):
        ProgressLog.resume(path, 3, 1.0)
    assert path.read_bytes() == content


def test_log_with_another_digit_or_with_exchanged_lines_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "progress.jsonl"
    with ProgressLog(path) as log:
        for row in range(3):
            log.append(state(row))
    whole = path.read_bytes()
    lines = whole.splitlines(keepends=True)
    for damaged in (whole.replace(b'"row": 1', b'"row": 3'), lines[1] + lines[0] + lines[2]):
        path.write_bytes(damaged)
        with pytest.raises(ValueError, match=r"progress\.jsonl is damaged.*--overwrite"):
            ProgressLog.resume(path, 3, state(2).time)


def test_log_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="cannot be read"):
        ProgressLog.resume(tmp_path / "progress.jsonl", 1, 1.0)
    with pytest.raises(ValueError, match="cannot be read"):
        ProgressLog.resume(tmp_path, 1, 1.0)


def test_line_that_found_no_room_is_taken_back(tmp_path: Path) -> None:
    # A file whose size is limited takes a part of a line, as a disk does that is nearly full.
    resource = pytest.importorskip("resource")
    path = tmp_path / "progress.jsonl"
    with ProgressLog(path) as log:
        log.append(state(0))
        whole = path.read_bytes()
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        for room in (0, 10):
            resource.setrlimit(resource.RLIMIT_FSIZE, (len(whole) + room, before[1]))
            try:
                with pytest.raises(OSError, match=r"could not be written whole|too large") as full:
                    log.append(state(1))
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, before)
            assert full.value.errno in (None, errno.EFBIG)
            assert path.read_bytes() == whole
            assert log.count == 1
        log.append(state(1))
    assert lines_of(path) == [entries(state(0)), entries(state(1))]


def test_finished_log_holds_the_errors_of_each_instant(tmp_path: Path) -> None:
    path = tmp_path / "progress.jsonl"
    with ProgressLog(path) as log:
        for row in range(3):
            log.append(state(row), (row + 1) / 3)
        bars = {
            "force": np.array([0.1, np.nan, np.inf]),
            "approach": np.array([1 / 3, 0.0, 5e-324]),
        }
        for _ in range(2):  # a run that is killed at its end finishes again
            log.finish(bars, {"axis": "time"})
            lines = lines_of(path)
            assert [line.pop("force_error") for line in lines] == [0.1, None, "inf"]
            assert [line.pop("approach_error") for line in lines] == [1 / 3, 0.0, 5e-324]
            assert [line.pop("part") for line in lines] == [1 / 3, 2 / 3, 1.0]
            assert [line.pop("complete", False) for line in lines] == [False, False, True]
            assert lines[-1].pop("fields") == {"axis": "time"}
            assert lines == [entries(state(row)) for row in range(3)]
    assert list(tmp_path.iterdir()) == [path]


def test_log_that_cannot_be_finished_keeps_its_lines(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "progress.jsonl"
    with ProgressLog(path) as log:
        log.append(state(0))
        before = path.read_bytes()

        def fail(path: Path) -> None:
            raise OSError(errno.ENOSPC, "No space left on device")

        monkeypatch.setattr("viscontact.runs.directory.progress_log.flush_to_disk", fail)
        with pytest.raises(OSError, match="No space"):
            log.finish()
        assert path.read_bytes() == before
        log.append(state(1))
    assert len(lines_of(path)) == 2
    assert list(tmp_path.iterdir()) == [path]
