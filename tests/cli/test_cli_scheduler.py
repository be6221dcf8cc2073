"""`--scheduler`: names that are no scheduler, and what ends while the first worker is awaited."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from viscontact.cli import main

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 1 s, steps: 1}
grid: {shape: [24, 24], size: [5 mm, 5 mm]}
"""


COMMANDS = {
    "run": ("run", "ball.yaml", "--vary", "load.force=1N,2N", "-o", "out"),
    "design": (
        *("design", "ball.yaml", "--change", "load.force=1N,2N", "--minimise", "approach"),
        *("-o", "out"),
    ),
    "profile": ("design", "ball.yaml", "--profile", "free", "-o", "out"),
    "sensitivity": ("sensitivity", "ball.yaml", "--of", "approach", "-o", "out"),
    "fit": ("fit", "a.csv", "--case", "ball.yaml", "--change", "load.force=1N:2N"),
}


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
@pytest.mark.parametrize(
    ("scheduler", "why"),
    [
        ("none.json", "no such file; give an address, as tcp://node17:8786, "),
        ("none", "no such file; give an address, as tcp://node17:8786, "),
        ("ball.yaml", "is not a scheduler file, which `dask scheduler --scheduler-file` writes; "),
        ("other.json", "is not a scheduler file, which `dask scheduler --scheduler-file` writes; "),
    ],
)
def test_other_files_than_those_of_a_scheduler_are_refused_in_one_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    scheduler: str,
    why: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(CASE, encoding="utf-8")
    Path("other.json").write_text('{"address": 5}', encoding="utf-8")
    assert main([*words, "--scheduler", scheduler]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"--scheduler {scheduler}: {why}")
    assert not Path("out").exists()


class Client:
    """Client of a scheduler that answers, but ends before it has a worker."""

    def __init__(self, *_: object, **__: object) -> None:
        pass

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def scheduler_info(self, **_: object) -> dict[str, Any]:
        """Describe no worker."""
        return {"workers": {}}

    def wait_for_workers(self, count: int) -> None:
        """Wait until the connection is closed, which is an OSError in Dask, too."""
        raise OSError("in <TCP (closed)>: Connection reset by peer")


def ended_at_its_start(**_: object) -> None:
    """What Dask raises where the process of a worker is killed before it answers."""
    raise RuntimeError("Nanny failed to start.")


@pytest.mark.parametrize(
    ("scheduler", "why"),
    [
        ("local", "a worker ended while it started (Nanny failed to start.); it was killed, or"),
        ("tcp://127.0.0.1:9", "its scheduler has ended: in <TCP (closed)>: Connection reset"),
    ],
)
def test_what_ends_before_the_first_run_is_named_and_no_fault_of_viscontact(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    scheduler: str,
    why: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(CASE, encoding="utf-8")
    dask = SimpleNamespace(LocalCluster=ended_at_its_start, Client=Client)
    monkeypatch.setitem(sys.modules, "distributed", dask)
    assert main([*COMMANDS["run"], "-q", "--scheduler", scheduler]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"--scheduler {scheduler}: {why}")
    assert "start" in line.rsplit(";", 1)[1]
    assert not Path("out").exists()
