"""Figures of the command line's tests have few pixels: that they are written is tested here."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def few_pixels(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 100)
