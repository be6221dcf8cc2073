"""Bad input is refused in words: never a traceback, a hang, or more memory than was announced.

Every family mutates valid input and adds what is none; see the modules beside this one. The
default run tries 100 inputs in this process, the same ones each time. The slow campaign tries
2100 more, or 10 500 in three minutes on two idle cores (`campaigns.py`); its seed is
VISCONTACT_FUZZ_SEED, 6 if that is not set. A case that fails is shrunk by Hypothesis, which prints
it.
"""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.errors import HypothesisWarning

from campaigns import tried
from fuzzing.families import FAMILIES, Family
from fuzzing.places import furnish
from fuzzing.watch import Tally, set_free_memory

SEED = int(os.environ.get("VISCONTACT_FUZZ_SEED", "6"))

#: So many inputs in all.
DEFAULT, SLOW = 100, tried(2100, 10_500)

# What is thrown away is no matter here, and neither is the size of what is made.
_ANY_HEALTH = list(HealthCheck)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working directory with good files and with what is none."""
    monkeypatch.chdir(furnish(tmp_path))
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.delenv("VISCONTACT_TRACEBACK", raising=False)
    set_free_memory(monkeypatch)
    return tmp_path


def _tried(family: Family, count: int, chosen: settings, first: int | None) -> Tally:
    """Give so many inputs of a family to the product."""
    tally = Tally()

    @settings(chosen, max_examples=count, suppress_health_check=_ANY_HEALTH, database=None)
    @given(family.inputs)
    def puts(given_input: Any) -> None:
        family.put(given_input, tally)

    with warnings.catch_warnings():
        # NumPy on numbers at the end of the range, and Hypothesis on long texts.
        warnings.simplefilter("ignore", RuntimeWarning)
        warnings.simplefilter("ignore", UserWarning)
        warnings.simplefilter("ignore", HypothesisWarning)
        (puts if first is None else seed(first)(puts))()
    return tally


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
@pytest.mark.usefixtures("place")
def test_bad_input_is_refused_in_words(family: Family) -> None:
    count = math.ceil(DEFAULT * family.share)
    tally = _tried(family, count, settings(), first=None)
    # Hypothesis stops early only where there is nothing new to try.
    assert sum(tally.endings.values()) >= 0.9 * count


@pytest.mark.slow
@pytest.mark.parametrize("part", [1, 2])
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
@pytest.mark.usefixtures("place")
def test_campaign_of_bad_input(family: Family, part: int, campaign: Callable[[str], None]) -> None:
    count = math.ceil(SLOW * family.share / 2)
    chosen = settings(derandomize=False, phases=(Phase.generate, Phase.shrink))
    tally = _tried(family, count, chosen, first=2 * SEED + part)
    campaign(tally.line(f"{family.name}, part {part} of 2, seed {SEED}"))
    assert sum(tally.endings.values()) >= 0.9 * count
    assert tally.endings["refused"] > 0
    assert tally.endings.total() > tally.endings["refused"], "none was good: nothing is tried"
