"""Standard streams that are closed, full or narrow, and libraries without memory."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import viscontact as vc
from cli.sphere_runs import ERRORS, finished, folder
from viscontact.cli import main

__all__ = ["finished", "folder"]  # fixtures


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full device here")
def test_finished_run_whose_table_is_not_written_says_so(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as output, monkeypatch.context() as patched:
        patched.setattr("sys.stdout", output)
        assert main(["run", "case.yaml", *ERRORS]) == 0
    *_, step, stage, last = capsys.readouterr().err.splitlines()
    why = "No space left on device"
    assert last == f"case: the run is finished; its table cannot be printed: {why}"
    assert stage.startswith("estimating errors")
    assert "step" in step


def _shell(line: str) -> subprocess.CompletedProcess[str]:
    """What a shell makes of a line in which $V is the command."""
    if os.name == "nt":
        pytest.skip("needs a POSIX shell")
    environment = {**os.environ, "V": f"{sys.executable} -m viscontact"}
    return subprocess.run(["bash", "-c", line], capture_output=True, text=True, env=environment)


@pytest.mark.parametrize(
    "closed",
    [
        "<&- >&- 2>&-",
        *(pytest.param(c, marks=pytest.mark.slow) for c in (">&-", "2>&-", ">&- 2>&-")),
    ],
)
def test_run_needs_no_standard_streams(closed: str, folder: Path) -> None:
    assert _shell(f"$V run case.yaml {closed}").returncode == 0
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == 7
    # neither a message nor a table has got into a file of the run
    lines = Path("case/progress.jsonl").read_text(encoding="utf-8").splitlines()
    assert ["time" in json.loads(line) for line in lines] == [True] * 7


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full device here")
@pytest.mark.parametrize(
    ("reader", "buffered"),
    [
        ("| sleep 0; exit ${PIPESTATUS[0]}", "1"),
        *((">/dev/full", ""), (">/dev/full", "1")),
        ("| sleep 0; exit ${PIPESTATUS[0]}", ""),
    ],
)
def test_finished_run_whose_table_is_not_read_is_finished(
    reader: str, buffered: str, folder: Path
) -> None:
    words = " ".join(ERRORS)
    done = _shell(f"export PYTHONUNBUFFERED={buffered}; $V run case.yaml {words} {reader}")
    assert done.returncode == 0
    last = done.stderr.splitlines()[-1]
    assert last.startswith("case: the run is finished; its table cannot be printed: ")
    assert done.stderr.splitlines()[-2].startswith("estimating errors")
    assert "step" in done.stderr.splitlines()[-3]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no full device here")
@pytest.mark.parametrize(
    "words",
    [
        "example",
        *(
            pytest.param(words, marks=pytest.mark.slow)
            for words in (
                *("--help", "--version", "run --help"),
                *("show finished", "check case.yaml", "schema"),
            )
        ),
    ],
)
def test_full_output_is_said_in_one_line(words: str, folder: Path, finished: Path) -> None:
    words = words.replace("finished", str(finished))
    for buffered in ("", "1"):
        done = _shell(f"export PYTHONUNBUFFERED={buffered}; $V {words} >/dev/full")
        assert done.returncode == 1
        assert done.stderr == (
            "viscontact: the output cannot be written: No space left on device\n"
        )
    # messages that cannot be written do not change how a run ends
    assert _shell(f"$V {words} 2>/dev/full").returncode == 0


@pytest.mark.parametrize("kilobytes", [220_000, 250_000, 290_000])
def test_too_little_memory_for_the_libraries_is_said(kilobytes: int, folder: Path) -> None:
    done = _shell(f"ulimit -v {kilobytes} || exit 99; $V run case.yaml")
    if done.returncode == 99:
        pytest.skip("no limit of memory here")
    assert done.returncode == 1
    assert "too little memory" in done.stderr
    assert "fault of viscontact" not in done.stderr
