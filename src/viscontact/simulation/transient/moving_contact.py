"""Scalars of a moving contact: position, resistance, friction, work of the motion, heat."""

from __future__ import annotations

import math

import numpy as np

from viscontact.bodies.loads.clock import Clock
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.mechanics.contact.resistance import (
    is_even,
    reaches_end,
    resistance_by_displacement,
    resistance_by_slope,
)
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.plan import HereditaryPlan
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.checks.motion import (
    edge_warnings,
    loss_shares,
    retardation_warnings,
    way_warnings,
)
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution

#: Way during the retardation time, over half the contact's extent, from which the resistance is
#: taken from the displacement: it is small then, and from the slopes a difference of large numbers.
LONG_WAY = 10.0

#: Part of the extent of the largest contact from which steps count for warnings.
LARGE_CONTACT = 0.5


class StandingContact:
    """Contact of a body that stays where it is, which does no work of the motion."""

    work = added = 0.0

    def continue_on(self, run: RunSetup) -> None:
        """Continue on a larger grid, as on any other."""

    def evaluate(self, step: TimeStep, solution: StepSolution) -> dict[str, float]:
        """Return no scalars."""
        return {}

    def warnings(self) -> dict[str, str]:
        """No warnings."""
        return {}

    def restart_data(self) -> None:
        """Return nothing, as nothing is accumulated."""

    def restore(self, restart_data: None) -> None:
        """Continue from nothing."""


class MovingContact:
    """Accumulates the work of the motion and the heat over the steps."""

    def __init__(self, run: RunSetup) -> None:
        self._run = run
        self._position = np.array(run.position_at(0.0))
        self._resistance = np.zeros(2)
        self.work = self._heat = 0.0
        self.added = 0.0  # work of the motion in the last step [J]
        #: Along x and y: the contact has reached an end of the body, with a force that is unknown.
        self._ends_reached = np.zeros(2, dtype=bool)
        #: Half extent of the largest contact; of the longest steps under at least half of it way
        #: and half extent [m], reduced duration [s] and angular frequency [1/s].
        self._extent, self._way, self._rate = 0.0, (0.0, 1.0), (0.0, 0.0)
        self._pace_of_clock = 1.0  # reduced time per time

    def continue_on(self, run: RunSetup) -> None:
        """Continue the same run on a larger grid."""
        self._run = run

    def evaluate(self, step: TimeStep, solution: StepSolution) -> dict[str, float]:
        """Return the scalars at the end of a step, as in the result; add its work and heat."""
        motion = self._run.problem.motion
        position = np.array(self._run.position_at(step.time))
        way = position - self._position
        self._pace_of_clock = self._clock.rate(step.time)
        resistance = np.array(self._resistance_at(step, solution))
        self._pace(step, solution, float(np.hypot(*way)))
        self.added = float(((self._resistance + resistance) * way)[way != 0].sum()) / 2
        self.work += self.added
        self._heat += solution.heat
        self._position, self._resistance = position, resistance
        force = float(solution.resultants[0])
        velocity = np.array(motion.velocity_at(step.time))
        speed = float(np.hypot(*velocity))
        slides = speed > 0 and force > 0
        return {
            "position_x": float(position[0]),
            "position_y": float(position[1]),
            "resistance_x": float(resistance[0]),
            "resistance_y": float(resistance[1]),
            "friction_coefficient": (
                float((resistance * velocity)[velocity != 0].sum()) / (speed * force)
                if slides
                else math.nan
            ),
            "motion_work": self.work,
            "dissipation": solution.power,
            "heat": self._heat,
        }

    def _resistance_at(self, step: TimeStep, solution: StepSolution) -> tuple[float, float]:
        """Resistance [N] in the form that is more accurate for the material and the speed."""
        grid, extents = self._run.grid, self._half_extents(solution)
        indenter, motion = self._run.indenter_at(step.time), self._run.problem.motion
        # With tractions of coupled bodies it meets the heat of friction better at all speeds, too.
        is_small = self._relaxation_way(max(extents)) > LONG_WAY * max(extents)
        if self._repeats_a_map or is_small or self._run.problem.is_coupled:
            found = resistance_by_displacement(solution.pressure, solution.displacement, grid)
        else:
            tilts = float(solution.motion[1]), float(solution.motion[2])
            found = resistance_by_slope(solution.pressure, grid, indenter, tilts)
        ends, moves = np.array(reaches_end(solution.pressure, grid, indenter)), motion.moves
        unknown = ends & (np.array(moves) | np.logical_not(is_even(solution.pressure)))
        self._ends_reached = self._ends_reached | unknown
        along_x, along_y = np.where(unknown, math.nan, found).tolist()
        return along_x, along_y

    @property
    def _repeats_a_map(self) -> bool:
        """True for a map without end, whose slope is that of chords between its points."""
        run = self._run
        return min(run.problem.indenter.sample_spacing) > 0 and all(run.grid.periodic)

    def _half_extents(self, solution: StepSolution) -> tuple[float, float]:
        """Half the extents of the contact along the axes of motion, 0 along others [m]."""
        motion = self._run.problem.motion
        along_x, along_y = (
            cell * float(np.count_nonzero(solution.pressure.any(axis=1 - axis))) / 2 * moves
            for axis, (cell, moves) in enumerate(
                zip(self._run.grid.cell_size, motion.moves, strict=True)
            )
        )
        return along_x, along_y

    def _relaxation_way(self, half_extent: float) -> float:
        """Way of the body during the retardation time that loses most; inf without loss [m]."""
        motion, law = self._run.problem.motion, self._law
        if half_extent == 0:
            return 0.0
        speed = motion.top_speed / self._pace_of_clock  # [m per reduced time]
        shares = loss_shares(law, speed / half_extent)
        if not shares.sum() > 0:
            return math.inf
        return speed * float(shares @ law.times) / float(shares.sum())

    @property
    def _law(self) -> SeriesCompliance:
        """Creep function of the term that creeps most, as a Prony series."""
        return self._plan.prony_approximation

    @property
    def _clock(self) -> Clock:
        """Clock of that term."""
        return self._plan.clock

    @property
    def _plan(self) -> HereditaryPlan:
        return self._run.plans[self._run.problem.surface.most_creeping]

    def _pace(self, step: TimeStep, solution: StepSolution, way: float) -> None:
        """Keep way and duration of a step of the moving body that counts for the accuracy."""
        extent = max(self._half_extents(solution))
        if way > 0 and extent > 0 and extent >= LARGE_CONTACT * self._extent:
            if extent * LARGE_CONTACT > self._extent:
                self._way, self._rate = (0.0, 1.0), (0.0, 0.0)
            self._extent = max(self._extent, extent)
            self._way = max(self._way, (way, extent), key=lambda each: each[0] / each[1])
            passed = step.duration * self._pace_of_clock
            self._rate = max(self._rate, (passed, way / passed / extent))

    def warnings(self) -> dict[str, str]:
        """Warnings, by kind, about the steps so far."""
        law = self._law
        found = way_warnings(*self._way) | self._edge_warnings()
        if self._rate[0] > 0:
            found |= retardation_warnings(law, self._rate[1], self._rate[0])
        return found

    def _edge_warnings(self) -> dict[str, str]:
        motion = self._run.problem.motion
        along = self._ends_reached & motion.moves
        across = self._ends_reached & ~along
        return edge_warnings(along=bool(along.any()), across=bool(across.any()))

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        return {
            "position": self._position,
            "resistance": self._resistance,
            "work": self.work,
            "heat": self._heat,
            "ends_reached": self._ends_reached,
            "pace": [self._extent, *self._way, *self._rate],
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue the same run from restart data."""
        self._position, self._resistance = restart_data["position"], restart_data["resistance"]
        self.work, self._heat = restart_data["work"], restart_data["heat"]
        self._ends_reached = restart_data["ends_reached"]
        self._extent, way, extent, duration, rate = restart_data["pace"]
        self._way, self._rate = (way, extent), (duration, rate)
