"""Bars of progress on a terminal."""

from __future__ import annotations

from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskProgressColumn,
    TextColumn,
    TimeRemainingColumn,
)

from viscontact.cli.terminal.console import TextConsole


def run_bar() -> Progress:
    """Bar of one run; its fields are the word for a `row`, and `details` of the last one."""
    return Progress(
        TextColumn("{task.fields[row]}", markup=False),
        MofNCompleteColumn(),
        BarColumn(bar_width=16),  # fixed, so that the rest does not jump
        TimeRemainingColumn(),
        TextColumn("left, {task.fields[details]}", markup=False),
        console=TextConsole(stderr=True),
    )


def counting_bar(unit: str) -> Progress:
    """Bar of units of some work, which disappears at the end."""
    return Progress(
        *(TextColumn(unit), MofNCompleteColumn(), BarColumn(bar_width=16)),
        *(TimeRemainingColumn(), TextColumn("left")),
        console=TextConsole(stderr=True),
        transient=True,
    )


def bars_of_runs() -> Progress:
    """Bars of several runs, with their names and `details`."""
    return Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(bar_width=16),  # fixed, so that the rest does not jump
        TaskProgressColumn(),
        TimeRemainingColumn(),
        TextColumn("left, {task.fields[details]}", markup=False),
        console=TextConsole(stderr=True),
    )
