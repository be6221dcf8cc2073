"""Schema, examples, demo, help, and how the command is called."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import viscontact as vc
from cli.sphere_runs import folder
from viscontact.cli import main
from viscontact.cli.run import execution
from viscontact.runs.processes.request import RunRequest

__all__ = ["folder"]  # a fixture

COMMANDS = (
    *("run", "check", "show", "export", "plot", "compare", "schema", "example", "demo"),
    *("fit", "material", "report", "verify", "doctor", "cite"),
)


def test_schema_is_json_schema(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert schema["$schema"].startswith("https://json-schema.org/")


def test_example_is_copied_with_the_schema_that_editors_need(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["example"]) == 0
    names = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert {"roller-as-printed", "roller-dogbone", "sphere-maxwell", "sphere-zener"} <= set(names)
    assert main(["example", "sphere-zener", "-o", "my.yaml"]) == 0
    assert main(["example", "sphere-zener"]) == 0
    assert Path("my.yaml").read_text(encoding="utf-8") in capsys.readouterr().out
    assert json.loads(Path("viscontact.schema.json").read_text(encoding="utf-8"))
    assert main(["check", "my.yaml"]) == 0
    assert main(["example", "sphere-zener", "-o", "my.yaml"]) == 2
    assert main(["example", "sphere-zenr", "-o", "new.yaml"]) == 2
    assert "did you mean sphere-zener?" in capsys.readouterr().err


@pytest.mark.slow  # 121 instants of 65536 cells
def test_demo_runs_the_shipped_case_to_pictures(folder: Path) -> None:
    # as a process of its own, where NumPy is set to leave short inner products to one thread
    demo = [sys.executable, "-m", "viscontact", "demo", "-q"]
    done = subprocess.run(demo, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    kept = {path.name for path in Path("viscontact-demo").iterdir()}
    assert {"result.nc", "case.yaml", "pressure-map.png", "history.png"} <= kept
    with vc.open_results("viscontact-demo") as ds:
        assert ds.sizes["time"] == 121
        assert ds.sizes["x"] * ds.sizes["y"] == 2**16
        assert (ds.residual <= 1e-6).all()
    assert main(["example", "roller-dogbone-e05", "-o", "my.yaml"]) == 0
    copied = Path("my.yaml").read_bytes()
    assert copied == Path("viscontact-demo/case.yaml").read_bytes()


@pytest.mark.slow
def test_second_demo_replaces_the_first(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = execution.execute

    def coarse(request: RunRequest) -> Path:
        settings = ("grid.shape=[32, 16]", "time.steps=1", "output.errors=false")
        return whole(replace(request, settings=settings))

    monkeypatch.setattr(execution, "execute", coarse)
    two = ("pressure-map", "history")
    monkeypatch.setattr("viscontact.cli.commands.cases.DEMO_FIGURES", two)
    assert main(["demo", "-q"]) == 0
    kept = {path.name for path in Path("viscontact-demo").iterdir()}
    assert {"result.nc", "case.yaml", "pressure-map.png", "history.png"} <= kept
    monkeypatch.setattr("viscontact.cli.commands.cases.DEMO_FIGURES", ())
    assert main(["demo", "-q"]) == 0


def test_demo_names_a_command_that_the_shell_finds(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """After `./go demo` the environment's commands are not on the path."""
    monkeypatch.setattr(execution, "execute", lambda *_, **__: None)
    monkeypatch.setattr("viscontact.cli.commands.cases.DEMO_FIGURES", ())
    monkeypatch.setenv("PATH", str(folder))
    assert main(["demo"]) == 0
    typed = capsys.readouterr().out.splitlines()[-1].partition(": ")[2]
    assert subprocess.run(typed.split(), check=False).returncode == 0
    assert Path("my.yaml").exists()


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command_ends_with_an_example(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command, "--help"]) == 0
    lines = capsys.readouterr().out.strip().splitlines()
    assert "Example:" in " ".join(lines[-3:])
    assert f"viscontact {command}" in " ".join(lines[-3:])


def test_command_is_installed_and_works_as_a_module() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "viscontact", "--version"], capture_output=True, text=True
    )
    assert (done.returncode, done.stdout) == (0, f"viscontact {vc.__version__}\n")
