"""The same run on finer cells in smaller steps, as truth where there is no exact solution."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.exact_run import ExactRun
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactState
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.setup import RunSetup, prepare_run
from viscontact.simulation.transient.state_generator import march_run

Array = np.ndarray


@dataclass(frozen=True, eq=False)
class Marched:
    """States of a run without their fields, and the run as it was set up."""

    setup: RunSetup
    states: Sequence[ContactState]

    def scalars(self, names: Sequence[str], times: Array) -> dict[str, Array]:
        """Scalars at some instants; NaN where the run has no state."""
        at = {state.time: state for state in self.states}  # the later state of a jump
        kept = [at.get(time) for time in times]
        return {
            name: np.array([np.nan if each is None else getattr(each, name) for each in kept])
            for name in names
        }


class FinerRuns:
    """A run on 2 and 3 times its cells in as many parts of its steps, each computed once."""

    def __init__(self, run: ExactRun, scalars: Sequence[str], doubt: float) -> None:
        """Take the compared scalars, and the part of the difference of both that is in doubt."""
        self._run, self._scalars, self._doubt = run, scalars, doubt
        self._found: dict[int, Marched] = {}

    def values(self, times: Array) -> dict[str, Array]:
        """The most exact scalars at some of the run's instants."""
        return self.at(3).scalars(self._scalars, times)

    def uncertainty(self, times: Array) -> dict[str, Array]:
        """How far they may be off."""
        finest, other = (self.at(each).scalars(self._scalars, times) for each in (3, 2))
        return {name: self._doubt * np.abs(finest[name] - other[name]) for name in finest}

    def at(self, factor: int) -> Marched:
        """The run on so many times its cells."""
        if factor not in self._found:
            self._found[factor] = self._marched(factor)
        return self._found[factor]

    def _marched(self, factor: int) -> Marched:
        run, times = self._run, np.asarray(self._run.times)
        parts = np.arange(1, factor + 1) / factor
        inner = times[:-1, None] + np.diff(times)[:, None] * parts
        inner[:, -1] = times[1:]
        grid: Any = run.grid
        shape = grid.shape[0] * factor, grid.shape[1] * factor
        given = run.arguments
        given |= {"grid": replace(grid, shape=shape), "times": np.append(times[0], inner)}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", vc.AccuracyWarning)
            setup = prepare_run(carried_out(Problem(**given)))
            return Marched(setup, [state.without_fields() for state in march_run(setup)])
