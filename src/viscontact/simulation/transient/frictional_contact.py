"""Friction over the steps of a run: tractions, slip, heat, and the memory of earlier tractions.

In each step, after the normal contact, the tractions q of the new instant solve a frictional
problem for the pressure found (`mechanics.contact.friction`). The surface moves by

    Σ T_m (b_m q + h_m - r_m)

against where it was before the step, with the weights b_m and the history h_m of the hereditary
integral of q, and its value r_m before. A body without friction has `Frictionless`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.errors import ConvergenceError
from viscontact.backend.transforms import transforms_by
from viscontact.bodies.friction import Friction
from viscontact.bodies.loads.tangential import TangentialLoad, TangentialPoint
from viscontact.mechanics.contact.friction.entry import entry_compliance
from viscontact.mechanics.contact.friction.equilibrium import IMBALANCE, solve_slip
from viscontact.mechanics.contact.friction.problem import (
    ShearBlock,
    SlipProblem,
    SlipSolution,
)
from viscontact.mechanics.contact.friction.region import Region, ShearDomain, ShearSymmetry
from viscontact.mechanics.contact.friction.rigid_shift import ShiftConstraints
from viscontact.mechanics.problem.shear_terms import ShearTerm, shear_terms
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.hereditary_integral import (
    HereditaryIntegral,
    HereditaryResponse,
    response_to,
)
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.checks.friction import Grip, grip_warnings
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution
from viscontact.units.formatting import format_quantity

#: Least displacement that errors are relative to, over friction times that under pressure [-].
LEAST_SHIFT = 0.01

#: Part of what friction carries, and of the displacements of a step, that counts as rounding.
ROUNDING = 1e-9


class Frictionless:
    """Contact without friction, which carries no traction."""

    #: Warnings of the last step, by kind.
    warnings: Mapping[str, str] = {}

    def advance(self, step: TimeStep, solution: StepSolution) -> dict[str, Any]:
        """Return no scalars and fields."""
        return {}

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue on a larger grid, as on any other."""

    def restart_data(self) -> None:
        """Return nothing, as nothing is kept."""

    def restore(self, restart_data: None) -> None:
        """Continue from nothing."""


@dataclass(eq=False)
class SlipState:
    """What a frictional contact keeps from step to step, over the whole grid."""

    traction: Floats  # [Pa], (2, nx, ny)
    slip: Floats  # since the contact of each cell [m], (2, nx, ny)
    work: Floats  # of friction per area since the start [J/m²], (nx, ny)
    pressure: Floats  # at the end of the step before [Pa], (nx, ny)
    gap: Floats  # [m], (nx, ny)
    touched: Bools  # cells that have carried a traction
    motion: Floats  # shifts [m] and rotation [rad] of the body
    forces: Floats  # along x and y [N] and torque [N m]
    heat: float = 0.0  # of friction since the start [J]

    @classmethod
    def at_first(cls, gap: Floats) -> SlipState:
        """State before a run, of bodies that just touch."""
        pair, field = np.zeros((2, *gap.shape)), np.zeros(gap.shape)
        touched = np.zeros(gap.shape, bool)
        motion = np.zeros(3)
        return cls(pair, pair, field, field, gap, touched, motion, np.zeros(3))

    def on(self, enlargement: GridEnlargement) -> SlipState:
        """The same state on a larger grid."""
        small, large = enlargement.small.grid, enlargement.large.grid

        def embedded(field: Any, beyond: Any = 0.0) -> Any:
            if field.ndim == 2:
                return small.embed(field, large, beyond=beyond)
            return np.stack([small.embed(part, large, beyond=beyond) for part in field])

        return replace(
            self,
            traction=embedded(self.traction),
            slip=embedded(self.slip),
            work=embedded(self.work),
            pressure=embedded(self.pressure),
            gap=embedded(self.gap, np.inf),
            touched=embedded(self.touched, False),
        )


class FrictionalContact:
    """Solves the tractions of the steps of a run and keeps their memory."""

    def __init__(self, run: RunSetup, friction: Friction, load: TangentialLoad) -> None:
        self._run, self._load = run, load
        self._coefficient = friction.coefficient
        self._terms = shear_terms(run.problem.bodies, run.problem.clocks)
        self._domain = _domain_of(run)
        plans = run.shear_plans
        laws = tuple(plan.clocked_compliance for plan in plans) if len(plans) > 1 else ()
        shape = (2, *run.grid.shape)
        self._memory: list[HereditaryIntegral] = [plan.integral(shape, laws) for plan in plans]
        self._references = [np.zeros(shape) for _ in plans]
        self._state = SlipState.at_first(run.open_gap)
        #: Change of the traction [Pa] in the last step, and its duration [s].
        self._trend = np.zeros(shape), 0.0
        #: Warnings of the last step, by kind.
        self.warnings: dict[str, str] = {}

    def advance(self, step: TimeStep, solution: StepSolution) -> dict[str, Any]:
        """Solve the tractions at the end of a step; return scalars and fields of its state."""
        responses = [response_to(step, memory) for memory in self._memory]
        point = self._load.at(step.time, side=step.side)
        constraints = self._constraints(point)
        before, pressure = self._state, solution.pressure
        found: SlipSolution | None = None
        region: Region | None = None
        if pressure.any():
            region = self._domain.region_of(before.touched | (pressure > 0))
            found = self._solved(step, solution, responses, constraints, region)
            after = self._after(solution, found, constraints, region)
        else:
            self._refuse_force_apart(step, constraints)
            after = self._apart(solution, constraints)
        self._accept(responses, after.traction)
        self._trend = after.traction - before.traction, step.duration
        self._state = after
        scalars = self._scalars(step, before, found, region)
        self.warnings = self._warnings_of(step, before, constraints, scalars)
        return scalars | self._fields(found, region)

    def _warnings_of(
        self,
        step: TimeStep,
        before: SlipState,
        constraints: ShiftConstraints,
        scalars: dict[str, float],
    ) -> dict[str, str]:
        """Warnings of the step, by kind."""
        after, area = self._state, self._run.grid.cell_area
        cells, held = (int(np.count_nonzero(each.pressure > 0)) for each in (after, before))
        return grip_warnings(
            Grip(
                step.time,
                float(np.hypot(*constraints.resultants[:2])),
                self._coefficient * float(after.pressure.sum()) * area,
                cells,
                round(cells * scalars["slip_fraction"]),
                held,
            )
        )

    def _constraints(self, point: TangentialPoint) -> ShiftConstraints:
        """Constraints of the step's change of the motion."""
        periodic, symmetry = self._run.grid.periodic, _symmetry_of(self._run)
        motions = list(point.motions)
        if any(periodic):  # a body without end does not turn
            motions[2] = 0.0
        free = np.array([motion is None for motion in motions])
        if symmetry is not None:  # what does not act is zero
            free &= symmetry.modes
        forces = np.array([0.0 if force is None else force for force in point.forces])
        there = np.array([0.0 if motion is None else motion for motion in motions])
        change = np.where(free, 0.0, there - self._state.motion)
        arm = max(self._run.grid.size) / 4
        return ShiftConstraints(free, np.where(free, forces, 0.0), change, arm)

    def _solved(
        self,
        step: TimeStep,
        solution: StepSolution,
        responses: list[HereditaryResponse],
        constraints: ShiftConstraints,
        region: Region,
    ) -> SlipSolution:
        """Frictional equilibrium on a region."""
        cut, parts = region.cut, self._domain.parts(region)
        past = np.zeros((2, *region.shape))
        for term, response, reference in self._each(responses):
            change = response.history[:, *cut] - reference[:, *cut]
            if change.any():
                past += parts.sum_of(term.direct, term.poisson).apply(change)
        compliance, kappa = self._new(responses)
        state, pressure = self._state, solution.pressure
        entry = entry_compliance(
            *(pressure, state.pressure, state.gap, self._run.grid.cell_size, kappa),
            plane=not self._run.grid.has_datum,
        )
        largest = float(np.abs(solution.displacement).max())
        problem = SlipProblem(
            self._coefficient * pressure[cut],
            past,
            compliance,
            entry[:, *cut],
            constraints,
            LEAST_SHIFT * self._coefficient * largest,
        )
        block, start = self._domain.block(region, kappa), self._guess(step)[:, *cut]
        tolerance = self._run.problem.tolerance
        found = solve_slip(problem, block, start, tolerance=tolerance)
        if not found.converged:
            raise ConvergenceError(_not_converged(step, found, constraints, problem, block))
        return found

    def _guess(self, step: TimeStep) -> Floats:
        """Traction before the step, with its trend where the load goes on smoothly [Pa]."""
        trend, duration = self._trend
        if not step.smooth or duration == 0:
            return self._state.traction
        return self._state.traction + trend * (step.duration / duration)

    def _each(
        self, responses: list[HereditaryResponse]
    ) -> zip[tuple[ShearTerm, HereditaryResponse, Floats]]:
        """Each term with its response and its reference traction before the step."""
        return zip(self._terms, responses, self._references, strict=True)

    def _new(self, responses: list[HereditaryResponse]) -> tuple[float, float]:
        """Contact compliance of the new traction [1/Pa], and κ of the surface there."""
        pairs = list(zip(self._terms, responses, strict=True))
        direct = sum(term.direct * response.compliance for term, response in pairs)
        poisson = sum(term.poisson * response.compliance for term, response in pairs)
        return direct, poisson / direct

    def _after(
        self,
        solution: StepSolution,
        found: SlipSolution,
        constraints: ShiftConstraints,
        region: Region,
    ) -> SlipState:
        """State after a step in contact."""
        before, pressure = self._state, solution.pressure
        traction, moved = (
            self._domain.spread(region, each) for each in (found.traction, found.slip)
        )
        # The friction of the mean pressure over the way of the slip: exact where both grow
        # linearly, while the mean traction over it loses a quarter in one step.
        mean = self._coefficient * (before.pressure + pressure) / 2
        lost = mean * np.hypot(*moved)
        shift = self._domain.shift(region)
        forces = shift.resultants(found.traction)
        carried = self._coefficient * float(solution.resultants[0])
        arms = np.array([1.0, 1.0, constraints.arm])
        # What rounding leaves of symmetric loads is none.
        forces[np.abs(forces) < ROUNDING * carried * arms] = 0.0
        motion = found.motion * arms
        noise = ROUNDING * max(float(np.abs(motion).max()), found.displacement)
        motion[constraints.free & (np.abs(motion) < noise)] = 0.0
        return SlipState(
            traction,
            np.where(pressure > 0, before.slip + moved, 0.0),
            before.work + lost,
            pressure,
            solution.gap,
            before.touched | (pressure > 0),
            before.motion + motion / arms,
            forces,
            before.heat + float(lost.sum()) * self._run.grid.cell_area,
        )

    def _apart(self, solution: StepSolution, constraints: ShiftConstraints) -> SlipState:
        """State after a step without contact: only a prescribed motion goes on."""
        before = self._state
        # Bodies that are apart come to touch first: their lowest points are as far above the
        # nearest cells as at first.
        gap = solution.gap - (solution.gap.min() - self._run.open_gap.min())
        nothing, nowhere = np.zeros(before.traction.shape), np.zeros(before.work.shape)
        return SlipState(
            *(nothing, nothing, before.work, nowhere, gap, before.touched),
            before.motion + constraints.motions,
            np.zeros(3),
            before.heat,
        )

    def _accept(self, responses: list[HereditaryResponse], traction: Floats) -> None:
        """Close the step with its traction."""
        traction.flags.writeable = False  # the memory keeps it without a copy
        self._references = [response.of(traction) for response in responses]
        for memory in self._memory:
            memory.accept(traction)

    def _refuse_force_apart(self, step: TimeStep, constraints: ShiftConstraints) -> None:
        """Refuse a force on bodies that do not touch."""
        if np.abs(constraints.resultants).any():
            raise ConvergenceError(
                f"tangential: the bodies are apart at t = {format_quantity(step.time, 's', 6)} and "
                "nothing carries the prescribed force; let it end before contact is lost, or "
                "prescribe a displacement"
            )

    def _scalars(
        self,
        step: TimeStep,
        before: SlipState,
        found: SlipSolution | None,
        region: Region | None,
    ) -> dict[str, float]:
        """Scalars at the end of a step, as in the result."""
        after, area = self._state, self._run.grid.cell_area
        has_datum = self._run.grid.has_datum
        motion = after.motion if has_datum else np.full(3, math.nan)
        sticks, touches = 0, 0
        if found is not None and region is not None:
            count = self._domain.shift(region).cell_area / area  # with mirror images
            sticks = round(count * np.count_nonzero(found.state == 1))
            touches = round(count * np.count_nonzero(found.state))
        lost, stiffness = after.heat - before.heat, self._stiffness(before)
        return {
            "tangential_force_x": float(after.forces[0]),
            "tangential_force_y": float(after.forces[1]),
            "torque": math.nan if any(self._run.grid.periodic) else float(after.forces[2]),
            "tangential_displacement_x": float(motion[0]),
            "tangential_displacement_y": float(motion[1]),
            "rotation": float(motion[2]),
            "stick_area": sticks * area,
            "slip_fraction": 1 - sticks / touches if touches else 0.0,
            "friction_heat": after.heat,
            "friction_power": lost / step.duration if step.duration > 0 else math.nan,
            "tangential_stiffness_x": stiffness[0] if has_datum else math.nan,
            "tangential_stiffness_y": stiffness[1] if has_datum else math.nan,
            "duality_gap": 0.0 if found is None else found.duality_gap,
        }

    def _stiffness(self, before: SlipState) -> tuple[float, float]:
        """Changes of the forces over those of the shifts in the step; NaN at rest [N/m]."""
        moved, added = self._state.motion - before.motion, self._state.forces - before.forces
        along_x, along_y = (
            float(added[axis] / moved[axis]) if moved[axis] else math.nan for axis in (0, 1)
        )
        return along_x, along_y

    def _fields(self, found: SlipSolution | None, region: Region | None) -> dict[str, Any]:
        """Fields at the end of a step, as in the result."""
        after = self._state
        state = np.zeros(after.work.shape, np.int8)
        if found is not None and region is not None:
            state = self._domain.spread(region, found.state.astype(np.int8))
        fields = {
            "traction_x": after.traction[0],
            "traction_y": after.traction[1],
            "slip_x": after.slip[0],
            "slip_y": after.slip[1],
            "slip_state": state,
            "friction_work": after.work,
        }
        for field in fields.values():
            field.flags.writeable = False
        return fields

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue the same run on a larger grid."""
        self._run, self._domain = run, _domain_of(run)
        self._state = self._state.on(enlargement)
        small, large = enlargement.small.grid, enlargement.large.grid

        def grown(fields: Floats) -> Floats:
            found = np.zeros((*fields.shape[:-2], *large.shape))
            for index in np.ndindex(fields.shape[:-2]):
                found[index] = small.embed(fields[index], large)
            return found

        self._references = [grown(reference) for reference in self._references]
        self._trend = grown(self._trend[0]), self._trend[1]
        for memory in self._memory:
            memory.map_fields(grown)

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        return {
            "memory": [memory.restart_data() for memory in self._memory],
            "references": self._references,
            "state": vars(self._state),
            "trend": list(self._trend),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue the same run from restart data."""
        for memory, data in zip(self._memory, restart_data["memory"], strict=True):
            memory.restore(data)
        self._references = list(restart_data["references"])
        self._state = SlipState(**restart_data["state"])
        trend, duration = restart_data["trend"]
        self._trend = trend, duration


def frictional_contact(run: RunSetup) -> Frictionless | FrictionalContact:
    """Friction of a run; without it nothing is carried along the surface."""
    problem = run.problem
    if problem.friction is None or problem.tangential is None:
        return Frictionless()
    return FrictionalContact(run, problem.friction, problem.tangential)


def _domain_of(run: RunSetup) -> ShearDomain:
    return ShearDomain(run.grid, transforms_by(run.transforms, run.threads), _symmetry_of(run))


def _symmetry_of(run: RunSetup) -> ShearSymmetry | None:
    """Symmetry of the tractions, if the normal contact has both mirror planes and one load acts."""
    load = run.problem.tangential
    acting = [mode for mode in range(3) if load is not None and load.acts[mode]]
    if not all(run.mirrored) or len(acting) > 1:
        return None
    return ShearSymmetry(acting[0] if acting else 0)


def _not_converged(
    step: TimeStep,
    found: SlipSolution,
    constraints: ShiftConstraints,
    problem: SlipProblem,
    block: ShearBlock,
) -> str:
    """Message about a step whose tractions were not found."""
    time = format_quantity(step.time, "s", 6)
    missing = constraints.lacking(block.shift.resultants(found.traction))
    carried = float(problem.bound.sum()) * block.shift.cell_area
    if constraints.imbalance(block.shift.resultants(found.traction), carried) > IMBALANCE:
        return (
            f"tangential: the body slides away at t = {time}: friction carries up to "
            f"{format_quantity(carried, 'N', 4)}, and of the prescribed load "
            f"{format_quantity(float(np.hypot(*missing[:2])), 'N', 4)} and "
            f"{format_quantity(float(abs(missing[2])), 'N m', 4)} are left; prescribe less, or a "
            "displacement in place of the force"
        )
    return (
        f"the solver of friction stopped at t = {time} with residual {found.residual:.2g} after "
        f"{found.iterations} iterations, short of the tolerance; likely causes: a force close to "
        "what friction carries, or a tolerance near rounding"
    )
