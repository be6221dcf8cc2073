"""A run that was stopped after its fourth instant, and what a command then says."""

from __future__ import annotations

import contextlib
import shutil
import signal
from pathlib import Path

import pytest

from interrupted_runs import CASE, at_instant
from viscontact.cli import main


@pytest.fixture(scope="module")
def stopped_once(tmp_path_factory: pytest.TempPathFactory) -> Path:
    here = tmp_path_factory.mktemp("stopped")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    undo = at_instant(4, lambda: signal.raise_signal(signal.SIGTERM))
    with contextlib.chdir(here):
        assert main(["run", "case.yaml", "-q"]) == 130
    undo()
    return here / "case"


@pytest.fixture
def stopped(folder: Path, stopped_once: Path) -> Path:
    """The directory of a run that was stopped, all saved, after its fourth instant."""
    return Path(shutil.copytree(stopped_once, folder / "case"))


def said_in_lines(capsys: pytest.CaptureFixture[str]) -> list[str]:
    """What was said, without a traceback."""
    message = capsys.readouterr().err
    assert "Traceback" not in message
    assert "fault of viscontact" not in message
    return message.splitlines()
