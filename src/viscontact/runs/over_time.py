"""Analysis over time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from viscontact import results
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactEvent, ContactState, Outcome
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.results.run_axis import TIME
from viscontact.runs.analysis import END_STRESS_LEFT, Analysis
from viscontact.runs.grid_error import grid_error_rows
from viscontact.runs.progress_made import progress_made
from viscontact.runs.run_memory import run_memory
from viscontact.simulation import accuracy, checks, transient
from viscontact.simulation.transient.setup import RunSetup
from viscontact.units.formatting import format_quantity

# Forecasts import what a simulation in Python does without.
if TYPE_CHECKING:
    from viscontact.runs.forecast import Forecast
    from viscontact.simulation.accuracy.coarser_results import History
    from viscontact.simulation.accuracy.error_bars import ErrorBars


class OverTime(Analysis[RunSetup, "transient.March"]):
    """Contact over time, in steps."""

    axis = TIME

    @property
    def contact(self) -> Problem:
        """Bodies, load and requirements."""
        return self.setup.problem

    @property
    def places(self) -> Floats:
        """Instants that are requested [s]."""
        return self.setup.problem.instants

    @property
    def total(self) -> int | None:
        """Number of instants; None where the run chooses its steps."""
        return len(self.places) if self.contact.adaptive is None else None

    @property
    def grows(self) -> bool:
        """True if the grid may be enlarged under way."""
        return self.setup.grows

    @property
    def work(self) -> float:
        """Cells times steps."""
        return self.grid.shape[0] * self.grid.shape[1] * (1.0 + self.contact.step_count)

    @property
    def memory(self) -> float:
        """Memory of the run [bytes]."""
        return run_memory(self.setup) + self.leakage_memory

    @property
    def seconds(self) -> float:
        """Predicted time of the run on this machine [s]."""
        from viscontact.runs.forecast import run_seconds

        return run_seconds(self.setup, errors=self.errors) + self.leakage_seconds

    def forecast(self) -> Forecast:
        """Return the forecast of the run."""
        from viscontact.runs.forecast import forecast

        found = forecast(self.setup, errors=self.errors)
        return replace(found, memory=self.memory, seconds=self.seconds)

    def states(self, saved: RestartData | None = None) -> transient.March:
        """Return the march through the steps."""
        return transient.March(self.setup, saved)

    def part(self, states: transient.March, state: ContactState) -> float:
        """Finished part of the instants, or of the time where steps are adaptive."""
        if state.outcome is Outcome.PULLED_OFF:
            return 1.0
        if self.contact.adaptive is None:
            return min(states.done / len(self.places), 1.0)
        end = self.contact.end
        return min(state.time / end, 1.0) if end > 0 else 0.0

    def is_last(self, state: ContactState) -> bool:
        """True for the state at the end."""
        return state.time >= self.contact.end or state.outcome is Outcome.PULLED_OFF

    def error_bars(
        self,
        states: transient.March,
        history: History,
        grid: Grid,
        issued: Sequence[str],
        on_step: Callable[[], None] | None = None,
    ) -> ErrorBars:
        """Errors of the scalars, from coarser runs."""
        setup = self.setup.on(grid)
        if not self.contact.ended_bodies:
            return accuracy.error_bars.error_bars(setup, history, on_step, issued=issued)
        setup = setup.with_stress_left(states.last_reference)
        bars = accuracy.error_bars.error_bars(setup, history, on_step, issued=issued)
        stated = {**bars.attributes, END_STRESS_LEFT: setup.end_stress_left}
        return replace(bars, attributes=stated)

    def error_bars_so_far(self, states: transient.March, history: History) -> ErrorBars:
        """Errors that are not known before the end."""
        return accuracy.error_bars.unknown_bars(history)

    @property
    def description(self) -> dict[str, Any]:
        """Problem and grid."""
        return transient.describe_problem(self.contact, self.grid)

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes that every result carries."""
        return transient.run_attributes(self.setup)

    def attributes_after(
        self, states: Sequence[ContactState], described: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Enlargements of the grid, and events of bodies that adhere."""
        events = [event for state in states for event in state.events]
        found = {"grid_enlarged": "\n".join(results.enlargements(self.grid, states))}
        return found | self.event_attributes(events, self.attributes | dict(described))

    def event_attributes(
        self, events: Sequence[ContactEvent], described: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Attributes of the events of bodies that adhere, with errors described; none of others."""
        if self.contact.adhesion is None:
            return {}
        return transient.contact_event_attributes(events, described)

    @property
    def longest_creep(self) -> float:
        """Last time of the run [s]."""
        return self.contact.end

    @property
    def extent(self) -> str:
        """Extent of the finished run, in words."""
        return f"up to t = {format_quantity(self.contact.end, 's')}"

    def made(self, rows: int, reached: float | None) -> str:
        """Describe the progress of the run, up to the instant reached [s]."""
        return progress_made(rows, reached, self.places.tolist(), self.contact.adaptive)

    def course(self) -> list[tuple[str, str]]:
        """Time steps, and the error of the grid under their loads."""
        if self.contact.adaptive is None:
            steps = f"{len(self.places) - 1}"
        else:
            steps = f"as needed for an error of {100 * self.contact.adaptive.tolerance:g} %"
        end = format_quantity(self.contact.end, "s")
        run = self.setup
        sticks = (
            []
            if run.law is None
            else checks.adhesive_limits.adhesion_rows(run.law, run.problem, run.grid)
        )
        return [*grid_error_rows(run), ("time steps", f"{steps}, up to t = {end}"), *sticks]
