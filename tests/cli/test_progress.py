"""Lines of progress: when they are printed, and the time that is left."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from closeness import close_to
from viscontact.cli.terminal import progress
from viscontact.cli.terminal.progress import Pace


def test_time_left_follows_from_the_time_since_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(progress, "clock", SimpleNamespace(perf_counter=lambda: now[0]))
    pace = Pace()
    now[0] += 10.0
    assert pace.seconds_left(0.05) is None  # a line for each tenth
    assert pace.seconds_left(0.25) == close_to(30.0)
    now[0] += 10.0
    assert pace.seconds_left(0.5) == close_to(20.0)
    now[0] += 31.0
    assert pace.seconds_left(0.51) == close_to(51.0 * 49 / 51)  # or every half minute
