"""Bars of progress on a terminal."""

from __future__ import annotations

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn


def run_bar() -> Progress:
    """Bar of one run; its fields are the word for a `row`, and `details` of the last one."""
    return Progress(
        TextColumn("{task.fields[row]}"),
        MofNCompleteColumn(),
        BarColumn(bar_width=16),  # fixed, so that the rest does not jump
        TimeRemainingColumn(),
        TextColumn("left, {task.fields[details]}"),
        console=Console(stderr=True),
    )


def counting_bar(unit: str) -> Progress:
    """Bar of units of some work, which disappears at the end."""
    return Progress(
        *(TextColumn(unit), MofNCompleteColumn(), BarColumn(bar_width=16)),
        *(TimeRemainingColumn(), TextColumn("left")),
        console=Console(stderr=True),
        transient=True,
    )
