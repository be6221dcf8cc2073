"""Analysis over the speed of a body in steady motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import ContactState
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.results.run_axis import SPEED
from viscontact.runs.analysis import END_STRESS_LEFT, Analysis
from viscontact.runs.forecast import Forecast
from viscontact.runs.steady_forecast import curve_memory, curve_seconds, steady_forecast
from viscontact.simulation.accuracy.coarser_results import History
from viscontact.simulation.accuracy.error_bars import ErrorBars
from viscontact.simulation.steady_motion.curve import SteadyCurve
from viscontact.simulation.steady_motion.preparation import SteadySetup
from viscontact.simulation.steady_motion.record import (
    describe_steady_problem,
    errors_by_name,
    on_grid,
    steady_attributes,
)
from viscontact.units.formatting import format_quantity


class OverSpeed(Analysis[SteadySetup, SteadyCurve]):
    """Contact in steady motion at several speeds."""

    axis = SPEED

    @property
    def contact(self) -> Problem:
        """Bodies, load and requirements."""
        return self.setup.problem.contact

    @property
    def places(self) -> Floats:
        """The speeds [m/s]."""
        return self.setup.problem.speeds

    @property
    def creepages(self) -> tuple[float, ...]:
        """Creepages at which tractions are found [-]."""
        return self.setup.problem.motion.creepages

    @property
    def work(self) -> float:
        """Cells times speeds."""
        return float(sum(grid.shape[0] * grid.shape[1] for grid in self.setup.grids))

    @property
    def memory(self) -> float:
        """Memory of the run [bytes]."""
        return curve_memory(self.setup) + self.leakage_memory

    @property
    def seconds(self) -> float:
        """Predicted time of the run on this machine [s]."""
        return curve_seconds(self.setup, errors=self.errors) + self.leakage_seconds

    def forecast(self) -> Forecast:
        """Return the forecast of the run."""
        found = steady_forecast(self.setup, errors=self.errors)
        return replace(found, memory=self.memory, seconds=self.seconds)

    def states(self, saved: RestartData | None = None) -> SteadyCurve:
        """Return the loop over the speeds."""
        return SteadyCurve(self.setup, saved, errors=self.errors)

    def recorded_state(self, state: ContactState) -> ContactState:
        """Return a state on the grid of all speeds."""
        return on_grid(state, self.grid)

    def after(self, states: Sequence[ContactState]) -> OverSpeed:
        """Return the analysis on the grid of the first speeds only."""
        first = replace(self.setup, grids=self.setup.grids[: len(states)])
        return OverSpeed(first, self.errors, self.leakage)

    def part(self, states: SteadyCurve, state: ContactState) -> float:
        """Finished part of the speeds."""
        return states.done / len(self.places)

    def is_last(self, state: ContactState) -> bool:
        """True for the last of the speeds, which need not be the fastest."""
        return state.speed == float(self.places[-1])

    def error_bars(
        self,
        states: SteadyCurve,
        history: History,
        grid: Grid,
        issued: Sequence[str],
        on_step: Callable[[], None] | None = None,
    ) -> ErrorBars:
        """Errors of the scalars, which the curve has found with each speed."""
        left = {END_STRESS_LEFT: states.end_stress_left} if self.contact.ended_bodies else {}
        return ErrorBars(errors_by_name(states.bars), (), left)

    def error_bars_so_far(self, states: SteadyCurve, history: History) -> ErrorBars:
        """Errors at the speeds so far."""
        return ErrorBars(errors_by_name(states.bars), ())

    @property
    def description(self) -> dict[str, Any]:
        """Problem and grid."""
        return describe_steady_problem(self.setup.problem, self.grid)

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes that every result carries."""
        return steady_attributes(self.setup, self.grid)

    def field_axis(self, states: Sequence[ContactState]) -> str:
        """Return the dimension of the fields: that of the speeds if all of them have fields."""
        return "speed" if all(state.pressure.size for state in states) else "field_speed"

    @property
    def longest_creep(self) -> float:
        """Time in which the body passes its grid at the slowest speed [s]."""
        return self.grid.size[self.setup.problem.axis] / float(self.places.min())

    @property
    def extent(self) -> str:
        """Extent of the finished run, in words."""
        count = len(self.places)
        return f"at {count} speed{'s' if count > 1 else ''}"

    def made(self, rows: int, reached: float | None) -> str:
        """Describe the progress of the run."""
        return f"{rows} of {len(self.places)} speeds"

    def course(self) -> list[tuple[str, str]]:
        """Number and range of the speeds."""
        low, high = (
            format_quantity(float(each), "m/s") for each in (self.places.min(), self.places.max())
        )
        count, creepages = len(self.places), self.creepages
        rows = [("speeds", f"{count}, from {low} to {high}") if count > 1 else ("speed", low)]
        if creepages:
            ends = f"from {min(creepages):.4g} to {max(creepages):.4g}"
            several = len(creepages) > 1
            rows.append(
                ("creepages", f"{len(creepages)}, {ends}")
                if several
                else ("creepage", f"{creepages[0]:.4g}")
            )
        motion = self.setup.problem.motion
        if motion.lateral_creepage is not None:
            rows.append(("lateral creepage", f"{motion.lateral_creepage:.4g}"))
        if motion.spin is not None:
            rows.append(("spin", format_quantity(motion.spin, "rad/m", 4)))
        return rows
