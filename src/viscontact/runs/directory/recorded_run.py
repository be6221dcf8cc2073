"""Recorded run over time."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from viscontact.accuracy.error_bars import ErrorBars, error_bars
from viscontact.backend.arrays import Floats
from viscontact.grid import Grid
from viscontact.problem.kept_fields import KeptFields
from viscontact.problem.problem import Problem
from viscontact.results.descriptions import describe
from viscontact.runs.directory.netcdf_layout import Contents
from viscontact.runs.directory.progress_log import progress_made
from viscontact.runs.directory.recorded import Marching, Recorded
from viscontact.runs.directory.result_writer import ResultWriter
from viscontact.runs.forecast import run_seconds
from viscontact.runs.resources import run_memory
from viscontact.simulation.march import March
from viscontact.simulation.provenance import describe_problem, run_attributes
from viscontact.simulation.setup import RunSetup
from viscontact.state import ContactState
from viscontact.time_integration.restart_data import RestartData
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True)
class RecordedRun(Recorded[RunSetup]):
    """A run over time, its directory, and the choice of the quantities that are recorded."""

    @property
    def case(self) -> dict[str, Any]:
        """Description of the run as plain data, which a run that is resumed must equal."""
        return plain_case(self.run.problem, self.run.grid, errors=self.errors)

    @property
    def fields(self) -> KeptFields:
        """Choice of the instants whose fields are kept."""
        return self.run.problem.kept

    @property
    def contents(self) -> Contents:
        """Contents of the result."""
        case, problem = self.case, self.run.problem
        about = {name: json.dumps(case[name]) for name in ("fields", "errors")}
        attributes = {"title": self.title, **self.filed, **run_attributes(self.run), **about}
        return Contents(
            self.run.grid,
            problem.instants,
            self.fields,
            attributes,
            self.errors,
            problem.tolerance if fits_single_precision(problem, problem.end) else 0.0,
            moving=not problem.motion.stands,
        )

    @property
    def total(self) -> int | None:
        """Number of instants; None where the run chooses its steps."""
        problem = self.run.problem
        return len(problem.instants) if problem.adaptive is None else None

    @property
    def work(self) -> float:
        """Cells times steps."""
        return self.run.grid.shape[0] * self.run.grid.shape[1] * (1.0 + self.run.problem.step_count)

    @property
    def memory(self) -> float:
        """Memory of the run [bytes]."""
        return run_memory(self.run)

    @property
    def seconds(self) -> float:
        """Predicted time of the run on this machine [s]."""
        return run_seconds(self.run, errors=self.errors)

    @property
    def extent(self) -> str:
        """How far the finished run goes, in words."""
        return f"up to t = {format_quantity(self.run.problem.end, 's')}"

    def march(self, saved: RestartData | None = None) -> Marching:
        """Return the march from the beginning, or from the restart data of an earlier one."""
        return March(self.run, saved)

    def recorded_state(self, state: ContactState) -> ContactState:
        """Return a state as it is."""
        return state

    def is_last(self, state: ContactState) -> bool:
        """True for the last state of the run."""
        return state.time >= self.run.problem.end

    def part(self, march: Marching, state: ContactState) -> float:
        """Finished part of the instants, or of the time where steps are adaptive."""
        problem = self.run.problem
        if problem.adaptive is None:
            return min(march.done / len(problem.instants), 1.0)
        return min(state.time / problem.end, 1.0) if problem.end > 0 else 0.0

    def made(self, rows: int, reached: float | None) -> str:
        """Describe the progress of the run, up to the instant reached [s]."""
        problem = self.run.problem
        return progress_made(rows, reached, problem.instants.tolist(), problem.adaptive)

    def continued(self, rows: int, reached: float | None) -> str:
        """Describe where the run is resumed."""
        made = self.made(rows, reached)
        if reached is None or ", up to t =" in made:
            return made
        return f"{made}, t = {format_quantity(reached, 's')}"

    def error_bars(
        self,
        march: Marching,
        history: Mapping[str, Floats],
        writer: ResultWriter,
        on_step: Callable[[], None] | None = None,
    ) -> ErrorBars:
        """Errors of the scalars, from coarser runs, after each of whose steps `on_step` is called.

        Its exceptions end the estimate.
        """
        run = self.run.on(writer.grid)
        return error_bars(run, history, on_step, issued=writer.warnings)


def plain_case(problem: Problem, grid: Grid | None, *, errors: bool) -> dict[str, Any]:
    """Describe a run as plain data; without a grid, all but the grid."""
    described = {
        **describe_problem(problem, grid),
        "fields": describe(problem.kept.requested),
        "errors": errors,
    }
    plain: dict[str, Any] = json.loads(json.dumps(described))
    if grid is None:
        del plain["grid"]
    return plain


def fits_single_precision(problem: Problem, late: float) -> bool:
    """True if pressures are far from the ends of single precision's range, 1e-38 to 3e38 Pa.

    `late` is a time at which the material has crept [s].
    """
    compliance, level = float(problem.compliance(late)), problem.load.largest_level
    return 1e-20 <= compliance <= 1e10 and 1e-25 <= level <= 1e15
