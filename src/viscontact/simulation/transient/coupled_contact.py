"""Coupled friction: pressure and tractions of a step that solve both of their problems at once.

Where the bodies differ, tractions displace the surface into itself and pressure along itself. Each
step alternates between the normal contact under the displacement by the last tractions and the
tractions under the last pressure:

1. Normal contact in the gap that the tractions leave, from the last pressure.
2. Tractions at this pressure, from the last ones.
3. The displacement by these tractions, and the residual of the normal contact in it. Where it meets
   the tolerance both problems are solved at the same pressure and tractions. The displacement
   follows the tractions in single precision (`step_lift`); where a tolerance is so tight that the
   rounding of it counts, it is found once in double precision and the residual again.

Each alternation leaves a tenth to a thirtieth of the residual. Both solves go as far as the
coupling is known: up to a part of the last residual, as a length.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.friction import Friction
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.mechanics.contact.contact_residual import ContactResidual, contact_residual
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution, solve_contact
from viscontact.mechanics.contact.friction.equilibrium import NEGLIGIBLE
from viscontact.mechanics.contact.friction.mixing import AndersonMixing
from viscontact.mechanics.contact.friction.normal_contact import NormalContact
from viscontact.mechanics.contact.friction.predicted import predicted
from viscontact.mechanics.contact.friction.region import Region
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.halfspace.coupling_filter import CouplingSum
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.checks.friction import Grip, Growth
from viscontact.simulation.transient.coupling_history import CouplingHistory, CouplingStep
from viscontact.simulation.transient.frictional_contact import FrictionalContact
from viscontact.simulation.transient.frictionless import JointSlip, SlipTrial
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.shear_history import ShearStep
from viscontact.simulation.transient.slip_state import StepSlip, step_slip
from viscontact.simulation.transient.slip_step import (
    SlipGuess,
    rescaled,
    shift_constraints,
    solved_on,
)
from viscontact.simulation.transient.step_lift import LiftOperator, StepLift
from viscontact.simulation.transient.step_solution import StepSolution

#: Alternations of one step.
MOST_ALTERNATIONS = 40

#: Tolerance of the first solves, and part of the last residual that the next ones leave.
FIRST_TOLERANCE, FORCING = 1e-3, 0.03

#: Displacement under the pressure over that along the surface in a step, where it is not known yet,
#: and the largest tolerance of tractions.
USUAL_RATIO, MOST_LEFT = 10.0, 0.1

#: Part of the tolerance that the last solves leave.
LAST = 0.5


class CoupledContact(FrictionalContact):
    """Frictional contact whose normal contact feels the tractions."""

    def __init__(self, run: RunSetup, friction: Friction, load: TangentialLoad) -> None:
        super().__init__(run, friction, load)
        self._memory = CouplingHistory(run)
        self._lift = LiftOperator(run)
        self._growth = Growth()
        #: Operators of regions, which are kept.
        self._block: tuple[Region, CouplingSum] | None = None

    def earlier_lift(self, step: TimeStep) -> Floats:
        """Displacement into the surface at the end of a step by earlier tractions [m]."""
        return self._lift.of(self._respond(step).past)

    def equilibrium(
        self,
        step: TimeStep,
        problem: ContactProblem,
        domain: ContactDomain,
        guess: Guess | None,
        tolerance: float,
    ) -> tuple[ContactSolution, JointSlip | None]:
        """Solve both problems of a step; the open gap holds the lift by earlier tractions."""
        response, mixing = self._respond(step), AndersonMixing()
        reached = StepLift(self._lift, response, self._foreseen(step))
        lift, wanted = reached.field, max(tolerance, FIRST_TOLERANCE)
        slip: StepSlip | None = None
        contact: NormalContact | None = None
        for _ in range(MOST_ALTERNATIONS):
            found = solve_contact(_lifted(problem, lift), domain, guess, tolerance=wanted)
            if not found.converged or not found.in_contact.any():
                return found, None
            guess = found.found
            last, contact = contact, _contact_of(found, problem, domain)
            start = self._start(step, contact, last, slip)
            along = _tolerance_along(wanted, tolerance, contact, slip)
            slip = self._slip(step, response, contact, start, along)
            reached.follow(slip.traction)
            checked = _checked(problem, domain, guess, reached, contact.displacement, tolerance)
            error = max(checked.error, slip.residual)
            if error <= tolerance:
                opened = domain.expand_by_symmetry(checked.gap)
                gap = _bipotential_gap(slip, contact, opened, self._coefficient)
                joint = JointSlip(replace(slip, duality_gap=gap), reached.field)
                return _solved(found, checked, error), joint
            wanted = max(LAST * tolerance, min(wanted, FORCING * checked.error))
            lift = mixing.next(lift, reached.field)
        return replace(found, residual=error, converged=False), None

    def _start(
        self,
        step: TimeStep,
        contact: NormalContact,
        last: NormalContact | None,
        slip: StepSlip | None,
    ) -> SlipGuess:
        """Guess of the tractions: those of the last alternation, at its pressure, if there are."""
        if last is None or slip is None:
            return SlipGuess(self._guess(step, contact))
        fresh = contact.entered_since(self._state.contact)
        return rescaled(slip, last, contact, self._coefficient, fresh)

    def trial(
        self, step: TimeStep, solution: StepSolution, joint: JointSlip | None = None
    ) -> SlipTrial:
        """Tractions of a step that have been found with its normal contact."""
        found = super().trial(step, solution, joint)
        return replace(found, coupling=self._respond(step))

    @property
    def warnings_at_end(self) -> dict[str, str]:
        """Warnings of the whole run, by kind."""
        return super().warnings_at_end | self._growth.warnings

    def accept(self, trial: SlipTrial) -> None:
        """Close a step with its pressure and tractions."""
        super().accept(trial)
        assert trial.coupling is not None  # it is a trial of this contact
        self._memory.accept(trial.coupling, self._state.contact.pressure)
        assert trial.grip is not None
        self._growth = self._growth.after(trial.grip)

    def _foreseen(self, step: TimeStep) -> Floats:
        """Tractions under the force of a step, predicted for the pressure before it [Pa]."""
        guess, contact = self._guess(step), self._state.contact
        if self._moves or not contact.in_contact.any():
            return guess
        region, point = self._region_of(contact), self._load.at(step.time, side=step.side)
        bound = self._coefficient * (contact.pressure * contact.gripping)[region.cut]
        constraints = shift_constraints(self._run, point, self._state.motion)
        shift = self._domain.shift(region)
        found = predicted(guess[:, *region.cut], bound, shift, constraints)
        return self._domain.spread(region, found)

    def _respond(self, step: TimeStep) -> CouplingStep:
        return self._memory.respond(step, self._history.respond(step))

    def _earlier(self, region: Region, response: ShearStep) -> None:
        """None: alternations share the displacement by earlier loads, and add that by pressure."""

    def _slip(
        self,
        step: TimeStep,
        response: CouplingStep,
        contact: NormalContact,
        start: SlipGuess,
        tolerance: float,
    ) -> StepSlip:
        """Tractions at a pressure, which moves the surface along itself."""
        region = self._region_of(contact)
        known = self._known(step, contact, region, response.shear)
        later, track = response.of_pressure(contact.pressure), self._track_of(region)
        moved = self._on(track).along(
            [(now - then)[track.cut] for now, then in zip(later, response.before, strict=True)]
        )
        past = moved[:, *region.within(track)]
        known = replace(known, past=past if known.past is None else past + known.past)
        found = solved_on(self._run, self._domain, region, known, start, tolerance)
        slip = step_slip(found, known.constraints, self._domain, region, known.carried)
        return replace(slip, way=self._domain.spread(region, found.way))

    def _on(self, region: Region) -> CouplingSum:
        """Operator on a region."""
        if self._block is None or self._block[0] != region:
            self._block = region, self._lift.within(region.shape)
        return self._block[1]

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue the same run on a larger grid."""
        super().map_fields(run, enlargement)
        self._lift = LiftOperator(run)
        self._block = None
        self._memory.map_fields(_growing(enlargement))

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        grown = None if self._growth.grown is None else vars(self._growth.grown)
        more = {"memory": self._memory.restart_data(), "grown": grown, "most": self._growth.most}
        return super().restart_data() | more

    def restore(self, restart_data: RestartData) -> None:
        """Continue the same run from restart data."""
        super().restore(restart_data)
        self._memory.restore(restart_data["memory"])
        grown = restart_data["grown"]
        self._growth = Growth(None if grown is None else Grip(**grown), restart_data["most"])


def _growing(enlargement: GridEnlargement) -> Callable[[Floats], Floats]:
    small, large = enlargement.small.grid, enlargement.large.grid

    def grown(fields: Floats) -> Floats:
        found = np.zeros((*fields.shape[:-2], *large.shape))
        for index in np.ndindex(fields.shape[:-2]):
            found[index] = small.embed(fields[index], large)
        return found

    return grown


def _checked(
    problem: ContactProblem,
    domain: ContactDomain,
    found: Guess,
    lift: StepLift,
    displacement: float,
    tolerance: float,
) -> ContactResidual:
    """Residual of a pressure in a lift, which is refined where it would be accepted by rounding."""
    checked = contact_residual(_lifted(problem, lift.field), domain.whole, found)
    scale = max(problem.displacement_scale, displacement)
    if checked.error <= tolerance and lift.refine(NEGLIGIBLE * tolerance * scale):
        checked = contact_residual(_lifted(problem, lift.field), domain.whole, found)
    return checked


def _lifted(problem: ContactProblem, lift: Floats) -> ContactProblem:
    return replace(problem, open_gap=problem.open_gap + lift)


def _solved(found: ContactSolution, checked: ContactResidual, error: float) -> ContactSolution:
    """Solution of the normal contact with the residual of both problems."""
    return replace(
        found,
        motion=checked.motion,
        gap=checked.gap,
        in_contact=checked.in_contact,
        residual=error,
    )


def _contact_of(
    found: ContactSolution, problem: ContactProblem, domain: ContactDomain
) -> NormalContact:
    """Normal contact of a solution on all cells; a copy, as the next solve works in its memory."""
    largest = problem.compliance * float(np.abs(found.found.unit_displacement).max())
    force = float(found.found.pressure.sum()) * domain.grid.cell_area * domain.symmetry_count
    whole = domain.expand_by_symmetry
    pressure, gap, in_contact = (
        whole(found.found.pressure),
        whole(found.gap),
        whole(found.in_contact),
    )
    if not any(domain.mirrored):
        pressure = pressure.copy()
    return NormalContact(pressure, gap, in_contact, force, largest)


def _bipotential_gap(
    slip: StepSlip, contact: NormalContact, gap: Floats, coefficient: float
) -> float:
    """Σ (p |g| + μ p |w| + q·w) over the work of both forces on their displacements [-]."""
    # De Saxcé and Feng (1998): not negative, and zero at the solution of both problems only.
    touching = contact.in_contact
    lost = float((contact.pressure[touching] * np.abs(gap[touching])).sum())
    carried = float(contact.pressure.sum())
    along = coefficient * carried * slip.displacement
    most = carried * contact.displacement + along
    return (lost + slip.duality_gap * along) / most if most > 0 else 0.0


def _tolerance_along(
    wanted: float, tolerance: float, contact: NormalContact, last: StepSlip | None
) -> float:
    """Tolerance of tractions at which they err by the same way as the normal contact."""
    if wanted <= 2 * LAST * tolerance:  # this alternation may be the last one
        return tolerance
    ratio = USUAL_RATIO
    if last is not None and last.displacement > 0:
        ratio = max(contact.displacement / last.displacement, 1.0)
    return max(tolerance, min(wanted * ratio, MOST_LEFT))
