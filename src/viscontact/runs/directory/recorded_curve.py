"""Recorded run over speed, of a body in steady motion."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from viscontact.accuracy.error_bars import ErrorBars
from viscontact.backend.arrays import Floats
from viscontact.problem.kept_fields import KeptFields
from viscontact.results.descriptions import describe
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.recorded import Marching, Recorded
from viscontact.runs.directory.recorded_run import fits_single_precision
from viscontact.runs.directory.result_writer import ResultWriter
from viscontact.runs.resources import curve_memory
from viscontact.runs.steady_forecast import curve_seconds
from viscontact.state import ContactState
from viscontact.steady_motion.curve import SteadyCurve
from viscontact.steady_motion.preparation import SteadySetup
from viscontact.steady_motion.record import (
    describe_steady_problem,
    errors_by_name,
    on_grid,
    steady_attributes,
)
from viscontact.time_integration.restart_data import RestartData
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True)
class RecordedCurve(Recorded[SteadySetup]):
    """A run over speed, its directory, and the choice of the quantities that are recorded."""

    row = "speed"

    @property
    def case(self) -> dict[str, Any]:
        """Description of the run as plain data, which a run that is resumed must equal."""
        described = {
            **describe_steady_problem(self.run.problem, self.run.grid),
            "fields": describe(self.fields.requested),
            "errors": self.errors,
        }
        plain: dict[str, Any] = json.loads(json.dumps(described))
        return plain

    @property
    def fields(self) -> KeptFields:
        """Choice of the speeds whose fields are kept."""
        return self.run.problem.contact.kept

    @property
    def contents(self) -> Contents:
        """Contents of the result."""
        case, problem = self.case, self.run.problem
        about = {name: json.dumps(case[name]) for name in ("fields", "errors")}
        from_run = steady_attributes(self.run, self.run.grid)
        attributes = {"title": self.title, **self.filed, **from_run, **about}
        late = self.run.grid.size[problem.axis] / float(problem.speeds.min())
        single = fits_single_precision(problem.contact, late)
        return Contents(
            self.run.grid,
            problem.speeds,
            self.fields,
            attributes,
            self.errors,
            problem.contact.tolerance if single else 0.0,
            over="speed",
        )

    @property
    def total(self) -> int:
        """Number of speeds."""
        return len(self.run.problem.speeds)

    @property
    def work(self) -> float:
        """Cells times speeds."""
        return float(sum(grid.shape[0] * grid.shape[1] for grid in self.run.grids))

    @property
    def memory(self) -> float:
        """Memory of the run [bytes]."""
        return curve_memory(self.run)

    @property
    def seconds(self) -> float:
        """Predicted time of the run on this machine [s]."""
        return curve_seconds(self.run, errors=self.errors)

    @property
    def extent(self) -> str:
        """How far the finished run goes, in words."""
        return f"at {self.total} speed{'s' if self.total > 1 else ''}"

    def march(self, saved: RestartData | None = None) -> Marching:
        """Return the loop over all speeds, or over those after an earlier one."""
        return SteadyCurve(self.run, saved, errors=self.errors)

    def recorded_state(self, state: ContactState) -> ContactState:
        """Return a state on the grid of all speeds."""
        return on_grid(state, self.run.grid)

    def is_last(self, state: ContactState) -> bool:
        """True for the last speed of the run."""
        return state.speed == float(self.run.problem.speeds[-1])

    def part(self, march: Marching, state: ContactState) -> float:
        """Finished part of the speeds."""
        return march.done / self.total

    def made(self, rows: int, reached: float | None) -> str:
        """Describe the progress of the run."""
        return f"{rows} of {self.total} speeds"

    def continued(self, rows: int, reached: float | None) -> str:
        """Describe where the run is resumed: after a speed [m/s]."""
        made = self.made(rows, reached)
        return made if reached is None else f"{made}, {format_quantity(reached, 'm/s')}"

    def error_bars(
        self,
        march: Marching,
        history: Mapping[str, Floats],
        writer: ResultWriter,
        on_step: Callable[[], None] | None = None,
    ) -> ErrorBars:
        """Errors of the scalars, which the curve has found with each speed."""
        assert isinstance(march, SteadyCurve)  # made by `march`
        return ErrorBars(errors_by_name(march.bars), ())
