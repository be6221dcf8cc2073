"""`progress=True`: a bar for runs that are started from Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import viscontact as vc
from viscontact.simulation.transient import progress_bar
from viscontact.simulation.transient.progress_bar import ProgressBar

BALL, GRID = vc.Paraboloid(0.01, 0.01), vc.Grid((24, 24), (3e-3, 3e-3))
RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
LOAD = vc.step(0.1, tilt_x=0.0, tilt_y=0.0)


def test_the_bar_is_one_line_that_is_written_over(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    monkeypatch.setattr(progress_bar.clock, "perf_counter", lambda: now[0])
    bar = ProgressBar("step", "errors")
    for done, at in enumerate((2.0, 2.01, 150.0, 200.0), start=1):  # the second one comes too soon
        now[0] = at
        bar(None, done, 4)
    first, third, last = (line.rstrip(" ") for line in capsys.readouterr().err.split("\r")[1:])
    assert first == "step 1/4 [#####               ], about 6 s left"
    assert third == "step 3/4 [###############     ], about 50 s left"
    assert last == "step 4/4 [####################], 3 min, then errors\n"


@pytest.mark.parametrize(
    ("unit", "count", "run"),
    [
        ("step", 2, lambda p: vc.simulate(BALL, RUBBER, LOAD, GRID, [0.0, 1.0], progress=p)),
        ("step", 2, lambda p: list(vc.march(BALL, RUBBER, LOAD, GRID, [0.0, 1.0], progress=p))),
        ("speed", 1, lambda p: vc.steady(BALL, RUBBER, LOAD, 0.01, grid=GRID, progress=p)),
    ],
)
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_runs_show_the_bar_when_asked(
    unit: str, count: int, run: Callable[[Any], Any], capsys: pytest.CaptureFixture[str]
) -> None:
    run(True)
    assert f"{unit} {count}/{count} [" in capsys.readouterr().err
    for nothing in (None, False):
        run(nothing)
        assert capsys.readouterr().err == ""
    with pytest.raises(TypeError, match="progress: wanted True or a function, got 3"):
        run(3)
