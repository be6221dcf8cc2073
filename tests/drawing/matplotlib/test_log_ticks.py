"""A logarithmic axis has several plain numbers where it has few decades."""

from __future__ import annotations

import pytest

from viscontact.drawing.matplotlib.layout import style
from viscontact.drawing.matplotlib.layout.log_ticks import plain_log_ticks


@pytest.mark.parametrize(
    ("low", "high", "wanted"),
    [
        (0.0055, 0.016, ["0.006", "0.008", "0.01", "0.015"]),  # less than a decade
        (0.8, 21.0, ["1", "2", "5", "10", "20"]),
        (0.009, 11.0, ["0.01", "0.1", "1", "10"]),
        (1e-7, 0.5, [f"10^{{-{power}}}" for power in range(7, 0, -1)]),
    ],
)
def test_ticks_within_the_ends_are_readable(low: float, high: float, wanted: list[str]) -> None:
    axes = style.new_figure(3.5, 2.4).subplots()
    axes.set_yscale("log")
    plain_log_ticks(axes.yaxis)
    axes.set_ylim(low, high)
    axes.figure.draw_without_rendering()
    places = axes.yaxis.get_major_ticks()
    shown = [each.label1.get_text() for each in places if low <= each.get_loc() <= high]
    assert all(word in text for word, text in zip(wanted, shown, strict=True)), shown
