"""Files of runs that are damaged at random: no command changes a number in silence."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("there is no fork", allow_module_level=True)

from damaged_files import TRIALS, Campaign


def test_damage_is_noticed_or_without_effect(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    made = Campaign(seed=5)
    quick = ("show", "--resume of a study")
    made.run(10, only=[n for n, each in enumerate(TRIALS) if each.name in quick])
    assert made.lost == []


@pytest.mark.slow
def test_damage_of_all_files_is_noticed_or_without_effect(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, campaign: Callable[[str], None]
) -> None:
    monkeypatch.chdir(tmp_path)
    made = Campaign(seed=6)
    made.run(60)
    campaign(f"files damaged at random, by commands:\n{made.table()}")
    assert made.lost == []
