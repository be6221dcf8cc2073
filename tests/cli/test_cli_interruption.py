"""Runs that are interrupted keep their steps, also where the steps are adaptive."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import viscontact as vc
from cli.sphere_runs import ADAPTIVE, ERRORS, folder
from viscontact.cli import main
from viscontact.cli.run import execution
from viscontact.results.formatting import format_percent
from viscontact.simulation.transient import frictionless
from viscontact.units.formatting import format_quantity

__all__ = ["folder"]  # a fixture


def _in_third_step(monkeypatch: pytest.MonkeyPatch, act: Callable[[], None]) -> None:
    """Do something while the third step of a run is being solved."""
    solve, solved = frictionless.solve_contact, []

    def solving(*arguments: Any, **options: Any) -> Any:
        solved.append(1)
        if len(solved) == 3:
            act()
        return solve(*arguments, **options)

    monkeypatch.setattr(frictionless, "solve_contact", solving)


def _presses(times: int) -> None:
    for _ in range(times):
        signal.raise_signal(signal.SIGINT)


def _at_instant(
    monkeypatch: pytest.MonkeyPatch, wanted: Callable[[vc.ContactState, int], bool]
) -> None:
    """Press Ctrl-C when an instant is being reported."""

    @contextmanager
    def shown(*arguments: Any, **options: Any) -> Iterator[Any]:
        def report(state: vc.ContactState, done: int, total: int) -> None:
            if wanted(state, done):
                _presses(1)

        yield report

    monkeypatch.setattr(execution, "shown_progress", shown)


@pytest.mark.parametrize(("presses", "kept"), [(1, 3), (2, 2)])
def test_interruption_keeps_the_completed_steps(
    presses: int,
    kept: int,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    # Once during the third step: it is finished. Twice: it is given up.
    _in_third_step(monkeypatch, lambda: _presses(presses))
    handler = signal.getsignal(signal.SIGINT)
    assert main(["run", "case.yaml", "-q"]) == 130
    assert signal.getsignal(signal.SIGINT) is handler
    message = capsys.readouterr().err
    assert f"keeps {kept} of 7 instants" in message
    assert "--resume" in message
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == kept
    assert main(["show", "case"]) == 0
    assert f"the run stopped at {kept} of 7 instants" in capsys.readouterr().out
    assert main(["plot", "case", "history"]) == 0
    assert f"the run stopped at {kept} of 7 instants" in capsys.readouterr().err


def test_adaptive_run_keeps_every_step_and_goes_to_the_end(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = ["--set", "output.fields=[1 s, 5 s]"]
    assert main(["run", "case.yaml", *ADAPTIVE, *kept, *ERRORS]) == 0
    printed = capsys.readouterr()
    lines = printed.err.splitlines()
    # totals are estimates until the end
    assert lines[0].startswith("step 1 of about ")
    with vc.open_results("case") as ds:
        count = ds.sizes["time"]
        assert lines[-2].startswith(f"step {count}/{count}, ")
        assert lines[-1].startswith("estimating errors")
        assert ds.field_time.values.tolist() == [1.0, 5.0]
        assert ds.time[-1] == 5.0
        assert 5 < count < 60
        largest = float(ds.time_error.max())
    assert 0 < largest <= 0.01
    sentence = f"error due to the time steps: at most {format_percent(largest)} of the pressure"
    assert sentence in printed.out
    assert main(["show", "case"]) == 0
    shown = capsys.readouterr().out
    assert sentence in shown
    assert "stopped" not in shown
    assert (
        main(["run", "case.yaml", "-q", "-o", "all", *ADAPTIVE, "--set", "output.fields=all"]) == 0
    )
    with vc.open_results("all") as ds:
        assert ds.pressure.dims[0] == "time"


def test_interrupted_adaptive_run_says_how_far_it_came_in_time(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _at_instant(monkeypatch, lambda state, done: done == 3)
    # more steps are done by then than instants were asked for
    kept = ["--set", "output.fields=[0 s, 5 s]"]
    assert main(["run", "case.yaml", "-q", *ADAPTIVE, *kept]) == 130
    message = capsys.readouterr().err
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == 3
        reached = f"3 instants, up to t = {format_quantity(float(ds.time[-1]), 's')} of 5 s"
    assert f"case keeps {reached}" in message
    assert main(["show", "case"]) == 0
    assert f"the run stopped at {reached}" in capsys.readouterr().out


def test_interruption_in_the_last_step_of_an_adaptive_run_is_too_late(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _at_instant(monkeypatch, lambda state, done: state.time == 5.0)
    # Nothing comes after the last step where errors are not estimated.
    assert main(["run", "case.yaml", "-q", *ADAPTIVE]) == 0
