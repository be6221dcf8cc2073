"""The summary of a run, in readable units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from viscontact.cli.accuracy import accuracy_lines
from viscontact.dataset import SCALARS
from viscontact.run import Run
from viscontact.state import ContactState
from viscontact.units import in_digits, in_words, is_rounding_tilt, readable_unit

_ROWS = (
    *("force", "eccentricity_x", "eccentricity_y", "approach", "tilt_x", "tilt_y"),
    *("contact_area", "contact_length", "contact_width", "peak_pressure", "mean_pressure", "work"),
    "loss_per_cycle",
)
# Exactly centred loads leave eccentricities of rounding size [m].
_NEGLIGIBLE = 1e-12


def print_summary(
    run: Run, states: Sequence[ContactState], directory: Path, seconds: float
) -> None:
    """Print what a run found, what it took, and what to doubt.

    Parameters
    ----------
    run : Run
        The run.
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
    errors = _values(states, "time_error")
    for line in accuracy_lines(errors, run.memory.method, run.compliance.inversion_error):
        console.print(line, highlight=False)
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
        values = _values(states, name)
        largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
        if not _is_rounding(states, name, largest):
            unit = readable_unit(largest, SCALARS[name].units)
            table.add_row(
                f"{name.replace('_', ' ')} [{unit.symbol}]".replace("[", r"\["),
                *(in_digits(value / unit.factor) for value in (values[0], values[-1])),
                in_digits(largest / unit.factor),
            )
    return table


def _values(states: Sequence[ContactState], name: str) -> list[float]:
    return [getattr(state, name) for state in states]


def _is_rounding(states: Sequence[ContactState], name: str, largest: float) -> bool:
    if name.startswith("tilt"):
        lengths, approaches = _values(states, "contact_length"), _values(states, "approach")
        return is_rounding_tilt(_values(states, name), lengths, approaches)
    return largest <= (_NEGLIGIBLE if name.startswith("eccentricity") else 0.0)
