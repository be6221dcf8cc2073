"""State after a step: resultants, sub-cell rim, work, and warnings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from copy import copy
from dataclasses import replace
from typing import Any

from viscontact.backend.transforms import largest_of
from viscontact.bodies.loads.history import LoadPoint
from viscontact.mechanics.contact.body_edge import trace_outline
from viscontact.mechanics.contact.recession import ContactTrend
from viscontact.mechanics.contact.rim import Rim, trace_rim
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation import checks, transient
from viscontact.simulation.checks.adhesion import tail_warnings
from viscontact.simulation.checks.collector import LargestExtents, WarningCollector
from viscontact.simulation.checks.half_space_theory import (
    EXTENTS,
    corner_warnings,
    geometry_warnings,
)
from viscontact.simulation.checks.material import (
    data_warnings,
    early_warnings,
)
from viscontact.simulation.checks.singularities import strain_of
from viscontact.simulation.checks.temperature import diffusion_warnings
from viscontact.simulation.checks.tested_limits import (
    Contact,
    limit_warnings,
    limited_bodies,
    loaded_since,
    repeated,
)
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.largest_contact import LargestContact
from viscontact.simulation.transient.load_cycles import LoadCycleWork
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.solved_state import solved_state
from viscontact.simulation.transient.step_solution import StepSolution
from viscontact.simulation.transient.step_work import first_work, work_of_step
from viscontact.simulation.transient.warning_rules import (
    geometry_of,
    loading_warnings,
    setup_warnings,
)
from viscontact.units.formatting import format_quantity

#: Growth of the largest pressure since the last check for corners that calls for another [-].
PEAK_CHECK_RATIO = 1.1


class Observer:
    """Turns solutions into states; keeps what needs the steps before: work and warnings."""

    def __init__(self, run: RunSetup, *, warns: bool = True) -> None:
        self._warns, self._team = warns, run.team
        self._set_geometry(run)
        stands = run.problem.motion.stands
        self._motion = transient.StandingContact() if stands else transient.MovingContact(run)
        self._warnings, self._extents = WarningCollector(), LargestExtents()
        self._exceeded: dict[str, str] = {}  # extents of the contact, at the last step
        self._open = setup_warnings(run) if warns else {}
        self._since = loaded_since(run.problem.contact_load)
        clocks = run.problem.clocks
        self._limited = limited_bodies(run.problem.bodies, clocks, self._since) if warns else ()
        self._events = None if run.law is None else transient.ContactEvents()
        self._passage = None if run.law is None else transient.ZonePassage()
        self._work = 0.0
        self._before: StepSolution | None = None
        self._point: LoadPoint | None = None
        self._held = False  # the load of the last step
        # Where bodies adhere, the pressure at the rim is the attraction, which tells no recession.
        plain = run.problem.surface.creep.is_elastic or run.law is not None
        self._trend = None if plain else ContactTrend.at_first(run.grid, run.mirrored)
        self._cycles = LoadCycleWork(run.problem.history.load_cycles)
        self._largest = LargestContact()
        self._peak_checked = 0.0

    def copied(self) -> Observer:
        """Return an observer that goes on by itself, for a step that may not be accepted."""
        same = copy(self)
        same._events, same._passage = copy(self._events), copy(self._passage)
        return same

    def _set_geometry(self, run: RunSetup, time: float = 0.0) -> None:
        self._run, self._position, indenter = run, run.position_at(time), run.indenter_at(time)
        open_gap = run.gap_at(time)
        self._outline = trace_outline(indenter, run.grid, open_gap)
        self._geometry = geometry_of(run.problem, open_gap, run.grid, indenter=indenter)

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue the same run on a larger grid."""
        self._set_geometry(run)
        self._motion.continue_on(run)
        if self._before is not None:
            self._before = enlargement.solution(self._before)
        if self._trend is not None:
            self._trend = self._trend.on(enlargement.small.grid, run.grid)

    def evaluate(self, step: TimeStep, point: LoadPoint, solution: StepSolution) -> ContactState:
        """Return the state at the end of a step, still without warnings."""
        if self._run.position_at(step.time) != self._position:
            self._set_geometry(self._run, step.time)
        # Cells in contact, and the rim within cells, from the gap beside them.
        rim = self._rim_of(solution)
        # Work since the step before, and the loss of a cycle that ends here.
        has_datum = self._run.has_datum
        self._work += self._work_of(point, solution) if has_datum else math.nan
        moved: dict[str, Any] = self._motion.evaluate(step, solution)
        moved |= self._run.problem.clock_scalars(step.time)
        if self._run.law is not None:
            moved |= transient.adhesion_scalars(self._run, solution)
        moved |= self._stage_of(point, solution)
        # The surface takes up the work of the load and that of the motion.
        self._work -= 0.0 if self._held else self._motion.added
        self._cycles.record_work(step, self._work + self._motion.work)
        if self._warns:
            self._collect_warnings(step, solution, rim)
        totals = self._work, self._cycles.last_loss
        state = solved_state(self._run, step, solution, rim, totals, moved, self._team)
        self._extents = self._extents.after(self._exceeded, state.contact_area, step.time)
        if self._events is not None:
            self._events.after(state)
        if self._passage is not None:
            passed = self._passage.after(state)
            self.warn(checks.adhesive_limits.front_warnings(passed, self._run.problem.data_times))
        asked = step.time >= self._run.problem.instants[0]
        self._largest = self._largest.after(state, asked=asked)
        self._before = solution
        return state

    def _stage_of(self, point: LoadPoint, solution: StepSolution) -> dict[str, float]:
        """Position of the stage that holds the body by a spring [m]; none without one."""
        spring = self._run.problem.load.stage_stiffness
        if spring is None:
            return {}
        deflected = float(solution.motion[0] + solution.resultants[0] / spring)
        return {"stage_position": deflected if point.approach is None else point.approach}

    def warn(self, found: Mapping[str, str]) -> None:
        """Take further warnings of a step, by kind."""
        if self._warns:
            self._open = {**found, **self._open}

    def _rim_of(self, solution: StepSolution) -> Rim:
        gap, in_contact = solution.gap, solution.in_contact
        recession = None
        if self._trend is not None:
            error = self._run.problem.solver_error * largest_of(solution.displacement)
            self._trend = self._trend.after(gap, solution.pressure, in_contact, error, self._team)
            recession = self._trend.recession(solution.pressure, self._team)
        fields = in_contact, gap, self._outline, recession
        return trace_rim(self._run.grid, *fields, self._team, self._run.mirrored)

    def add_warnings(self, state: ContactState, *, last: bool) -> ContactState:
        """Add the new warnings; at the last state, the mesh is judged by the largest contact."""
        self._largest = self._largest.reported(state)
        of_mesh, at_end = {}, {}
        if last:
            of_mesh = self._largest.mesh_warnings()
            at_end = self._largest.peak_warnings() | self._motion.warnings()
            at_end |= self._extents.at_end()
        found = self._warnings.new(self._open, of_mesh, at_end)
        state = self.with_events(state)
        return replace(state, warnings=found) if found else state

    def with_events(self, state: ContactState) -> ContactState:
        """Add the events of bodies that adhere since the last call."""
        if self._events is None:
            return state
        return replace(state, events=self._events.reported())

    def refuse_coarse_mesh(self) -> None:
        """Raise DomainError at the end if the largest contact had fewer than four cells across."""
        self._largest.refuse_coarse_mesh(self._run.grid)

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        before = self._before
        return {
            "issued": self._warnings.issued,
            "open": self._open,
            "extents": vars(self._extents),
            "work": self._work,
            "before": before and vars(before) | {"outcome": int(before.outcome)},
            "point": self._point and vars(self._point),
            "trend": self._trend and self._trend.restart_data(),
            "cycles": self._cycles.restart_data(),
            "largest": self._largest.restart_data(),
            "peak_checked": self._peak_checked,
            "motion": self._motion.restart_data(),
            "events": self._events and self._events.restart_data(),
            "passage": self._passage and self._passage.restart_data(),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue the same run from restart data."""
        self._warnings.issued = dict(restart_data["issued"])
        self._open, self._work = dict(restart_data["open"]), restart_data["work"]
        self._extents = LargestExtents(**restart_data["extents"])
        before, point = restart_data["before"], restart_data["point"]
        self._before = (
            None
            if before is None
            else StepSolution(**before | {"outcome": Outcome(before["outcome"])})
        )
        self._point = None if point is None else LoadPoint(**point)
        trend = restart_data["trend"]
        self._trend = trend and ContactTrend.from_restart_data(trend)
        self._cycles.restore(restart_data["cycles"])
        self._largest = LargestContact(**restart_data["largest"])
        self._peak_checked = restart_data["peak_checked"]
        self._motion.restore(restart_data["motion"])
        if self._events is not None:
            self._events.restore(restart_data["events"])
        if self._passage is not None:
            self._passage.restore(restart_data["passage"])

    def _collect_warnings(self, step: TimeStep, solution: StepSolution, rim: Rim) -> None:
        problem = self._run.problem
        found = data_warnings(step.time, problem.data_times)
        self._exceeded = {}
        if solution.outcome is not Outcome.NO_CONTACT:
            motion, displacement = solution.motion, solution.displacement
            found = self._corner_warnings(step.time, solution) | found
            exceeded = geometry_warnings(
                *(self._geometry, rim, motion, displacement, solution.pressure)
            )
            self._exceeded = {kind: text for kind, text in exceeded.items() if kind in EXTENTS}
            found = exceeded | found
            load, measured = problem.contact_load, problem.data_times
            found = early_warnings(measured, load, step.time, step.side) | found
            half_width = min(rim.length, rim.width) / 2
            found = diffusion_warnings(problem, half_width) | found
            if self._limited:
                found = self._limit_warnings(step.time, solution, rim) | found
        if self._run.law is not None:
            found = tail_warnings(self._run.law, solution.pressure, self._run.grid) | found
        found = loading_warnings(self._run, step, self._before, solution) | found
        self._open = found | self._open

    def _limit_warnings(self, time: float, solution: StepSolution, rim: Rim) -> dict[str, str]:
        """Warn of strains and stresses beyond those of the tests of the materials."""
        # Under a moving body the material is under load for less than the time of the run; its
        # response at once is the least that it can be.
        loaded = time - self._since if self._run.problem.motion.stands else 0.0
        force, peak = float(solution.resultants[0]), solution.peak
        if peak <= 0:  # pulled all over
            return {}
        contact = Contact(
            force / max(rim.area, force / peak),
            min(rim.length, rim.width) / 2,
            float(solution.motion[0]) if self._run.has_datum else math.nan,
            loaded,
            f"at t = {format_quantity(time, 's')}",
            peak,
            self._run.grid.line_length is not None,
            repeated(self._run.problem),
        )
        return limit_warnings(self._limited, contact)

    def _corner_warnings(self, time: float, solution: StepSolution) -> dict[str, str]:
        """Warn of a largest pressure at a corner, searched again only after the peak has grown."""
        peak = solution.peak
        if peak <= PEAK_CHECK_RATIO * self._peak_checked:
            return {}
        self._peak_checked = peak
        place = self._run.grid.largest_at(solution.pressure)
        strain = strain_of(peak, float(self._run.problem.compliance(time)))
        return corner_warnings(self._geometry, place, strain)

    def _work_of(self, point: LoadPoint, solution: StepSolution) -> float:
        before, held = self._before, self._before is not None and point == self._point
        self._point, self._held = point, held
        if before is None:
            return first_work(self._run, solution)
        return work_of_step(self._run, before, solution, held=held)
