"""Processes of runs that are stopped by signals, lose their terminal, or share a directory."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time as clock
from pathlib import Path

import pytest

import viscontact as vc
from interrupted_runs import contents, folder
from viscontact.cli import main
from viscontact.runs.directory.lock import locked

__all__ = ["folder"]  # a fixture


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
def test_real_process_is_stopped_and_resumed(folder: Path) -> None:
    # more than a thousand steps, so that there is time to stop it
    command = [sys.executable, "-m", "viscontact", "run", "case.yaml", "--set", "time.steps=1200"]
    run = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    progress = Path("case/progress.jsonl")
    while not (progress.exists() and progress.read_text(encoding="utf-8").count("\n") > 3):
        assert run.poll() is None
        clock.sleep(0.01)
    # meanwhile no other process may write there; the run waits, as it may end before that is said
    run.send_signal(signal.SIGSTOP)
    other = subprocess.run([*command, "--resume"], capture_output=True, text=True)
    assert other.returncode == 2
    assert "in use by another run" in other.stderr
    assert len(other.stderr.splitlines()) == 1
    run.send_signal(signal.SIGTERM)
    run.send_signal(signal.SIGCONT)
    _, said = run.communicate(timeout=60)
    assert run.returncode == 130
    kept = int(said.split("case keeps ")[1].split(" of 1201 instants")[0])
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == kept == len(progress.read_text(encoding="utf-8").splitlines())


def test_directory_in_use_is_refused_in_one_line(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("case").mkdir()
    with locked(Path("case")):
        assert main(["run", "case.yaml"]) == 2
    message = capsys.readouterr().err
    assert "in use by another run" in message
    assert len(message.splitlines()) == 1
    assert not contents("case")
    # the file that is locked does not make a directory look like a run's
    Path("case/.lock").write_text("", encoding="utf-8")
    assert main(["run", "case.yaml", "-q"]) == 0


def test_run_whose_terminal_is_closed_stops_in_order(folder: Path) -> None:
    pty = pytest.importorskip("pty", reason="no pseudo-terminals of this kind on Windows")
    command = [sys.executable, "-m", "viscontact", "run", "case.yaml", "--set", "time.steps=1200"]
    child, terminal = pty.fork()
    if not child:
        os.execv(sys.executable, command)
    progress = Path("case/progress.jsonl")
    shown = b""
    while not (progress.exists() and progress.read_text(encoding="utf-8").count("\n") > 3):
        shown += os.read(terminal, 4096)  # else the terminal is full, and the run waits
    os.close(terminal)
    _, status = os.waitpid(child, 0)
    assert b"step" in shown
    assert os.waitstatus_to_exitcode(status) == 130
    with vc.open_results("case") as ds:
        assert 3 < ds.sizes["time"] == len(progress.read_text(encoding="utf-8").splitlines()) < 1201


#: A process in which signals come while something is imported, or at its very end.
ASKED = """\
import atexit, signal, sys
class Asking:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            for _ in range({times}):
                signal.raise_signal(signal.{name})
sys.meta_path.insert(0, Asking())
if {module!r} == "exit":
    atexit.register(signal.raise_signal, signal.{name})
sys.argv = ["viscontact", "run", "case.yaml", "-q"]
from viscontact.cli import main
sys.exit(main())
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
@pytest.mark.parametrize(
    ("name", "module"),
    [
        ("SIGINT", "viscontact.cli.plain_words"),
        pytest.param("SIGTERM", "numpy", marks=pytest.mark.slow),
        ("SIGHUP", "exit"),
        *(
            pytest.param(name, module, marks=pytest.mark.slow)
            for module, names in {
                "viscontact.cli.plain_words": ("SIGTERM", "SIGHUP"),
                "numpy": ("SIGINT", "SIGHUP"),
                "exit": ("SIGINT", "SIGTERM"),
            }.items()
            for name in names
        ),
    ],
)
def test_request_during_imports_or_after_the_end_is_met_in_order(
    name: str, module: str, folder: Path
) -> None:
    code = ASKED.format(name=name, module=module, times=2)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    if module == "exit":
        assert (done.returncode, done.stderr) == (0, "")
        assert Path("case/result.nc").exists()
    else:
        assert (done.returncode, done.stderr) == (130, "interrupted\n")
        assert not Path("case").exists()
