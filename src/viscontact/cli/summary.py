"""The summary of a run, in readable units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from viscontact.dataset import SCALARS
from viscontact.state import ContactState
from viscontact.units import in_digits, in_words, readable_unit

_ROWS = (
    *("force", "eccentricity_x", "eccentricity_y", "approach", "tilt_x", "tilt_y"),
    *("contact_area", "contact_length", "contact_width", "peak_pressure", "mean_pressure", "work"),
)
# Exactly centred loads leave tilts of rounding size.
_NEGLIGIBLE = {"m": 1e-12, "rad": 1e-9}


def print_summary(states: Sequence[ContactState], directory: Path, seconds: float) -> None:
    """Print what a run found, what it took, and what to doubt.

    Parameters
    ----------
    states : sequence of ContactState
        All states of the run.
    directory : Path
        Where its result is.
    seconds : float
        What it took [s].
    """
    console = Console()
    console.print(_table(states))
    iterations = sum(state.iterations for state in states)
    residual = max(state.residual for state in states)
    console.print(
        f"{len(states)} instants in {in_words(seconds, 's', 3)}, {iterations} iterations, "
        f"residual at most {residual:.1e}"
    )
    for state in states:
        for text in state.warnings:
            console.print(f"[yellow]warning:[/] t = {in_words(state.time, 's')}: {text}")
    console.print(f"{directory / 'result.nc'}", soft_wrap=True, highlight=False)


def _table(states: Sequence[ContactState]) -> Table:
    first, last = states[0], states[-1]
    table = Table()
    table.add_column("")
    for heading in (f"t = {in_words(first.time, 's')}", f"t = {in_words(last.time, 's')}"):
        table.add_column(heading, justify="right")
    table.add_column("largest", justify="right")
    for name in _ROWS:
        values = [getattr(state, name) for state in states]
        largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
        if largest > _NEGLIGIBLE.get(SCALARS[name].units, 0.0):
            unit = readable_unit(largest, SCALARS[name].units)
            table.add_row(
                f"{name.replace('_', ' ')} [{unit.symbol}]".replace("[", r"\["),
                *(in_digits(value / unit.factor) for value in (values[0], values[-1])),
                in_digits(largest / unit.factor),
            )
    return table
