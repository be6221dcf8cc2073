"""Time stepper: solve one step of a run, and keep the history that the next one needs.

Each step is one elastic contact (Spinu & Cerlinca 2018, section 2):

1. The load at the step's end gives force or approach, eccentricity and tilts.
2. The hereditary integral splits the displacement into a history, which is known, and the step's
   own compliance times the unit displacement K p of the pressure increment sought.
3. The equilibrium of that contact is solved, from an extrapolated guess.
4. The error that the step adds is estimated; the step control accepts it or asks for a shorter one.
5. An accepted solution joins the hereditary integral.

It departs from the paper in step 2: within a step the pressure is linear in time, not constant.
"""

from __future__ import annotations

import math
from copy import copy
from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.loads import LoadHistory, LoadPoint
from viscontact.mechanics.contact.clearance import just_clear
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.problem import ContactProblem, Guess
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.state import Outcome
from viscontact.mechanics.time_integration.extrapolation import (
    ADHESIVE_POINTS,
    EXTRAPOLATION_POINTS,
    ElasticReference,
    predict,
)
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.hereditary_integral import response_to
from viscontact.mechanics.time_integration.internal_variables import InternalVariables
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.mechanics.time_integration.step_error import TimeErrors
from viscontact.mechanics.time_integration.step_shape import MAX_TREND_GROWTH
from viscontact.simulation import transient
from viscontact.simulation.transient.frictionless import JointSlip, Uncoupled
from viscontact.simulation.transient.grid_enlargement import GridEnlargement
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution
from viscontact.simulation.transient.surface_history import SurfaceHistory, SurfaceStep
from viscontact.simulation.transient.trial_step import (
    StepProblem,
    StepTooLongError,
    TrialStep,
    on_full_grid,
)
from viscontact.simulation.transient.without_force import (
    at_lowest_point,
    first_touch,
    is_separated,
    without_pressure,
)

#: Errors are relative to the displacement that the pressure causes, but to no less than this part
#: of the largest displacement so far, where rounding would dominate [-].
PAST_DISPLACEMENT_WEIGHT = 1e-3

#: Part of a step over which it may hold its value after its rise where the last one rose to its
#: end; part of the longest hold that a shorter step aims at, as its rise is somewhat shorter, too.
LARGEST_FIRST_HOLD, HOLD_SAFETY = 0.01, 0.8


class Stepper:
    """Solves a run's steps and keeps hereditary integrals, elastic references and rigid motion."""

    def __init__(
        self, run: RunSetup, domain: ContactDomain, friction: Uncoupled | None = None
    ) -> None:
        self._run, self._domain, self._friction = run, domain, friction or Uncoupled()
        # Of pressure [Pa] and unit displacement K p [Pa m], and of the force [N].
        self._history = SurfaceHistory(run, domain)
        first = run.hereditary
        self._force_memory = InternalVariables(
            first.prony_approximation, (1,), team=domain.team, clock=first.clock
        )
        self._creeping = run.problem.surface.most_creeping  # term whose time error is estimated
        self._errors = TimeErrors(run.plans[self._creeping], run.problem.contact_load, domain.team)
        self._scale = 1e-12 * max(run.grid.cell_size)
        self._references: list[ElasticReference] = []
        self._motion = np.zeros(3)
        self._adhesive = _adhesive_contact(run, domain)
        self._points = EXTRAPOLATION_POINTS if self._adhesive is None else ADHESIVE_POINTS
        #: Part of the last step after its rise [s].
        self._slow = 0.0

    def trial(self, step: TimeStep) -> TrialStep:
        """Solve a step without accepting it; StepTooLongError if it has to be shorter."""
        posed = self._step_problem(step)
        if self._adhesive is not None:
            self._refuse_levelling(step, posed.response)
        adhesive, joint = self._solve_adhesive(step, posed), None
        if adhesive is None:
            solution, outcome, joint = self._solve_step(step, posed)
        else:
            solution, outcome = adhesive.solution, adhesive.outcome
        response = posed.response
        pairs = self._history.pairs(response, solution.values)
        reference = ElasticReference(step.time, posed.drive, response.of(pairs), solution.motion)
        creeping = pairs[self._creeping], response.terms[self._creeping]
        error = self._errors.of_step(step, posed.point, *creeping)  # step 4
        return TrialStep(
            *(posed.point, solution, response, pairs, reference, outcome, error),
            *(adhesive, joint, posed.earlier_lift),
        )

    def without_friction(self) -> Stepper:
        """The same stepper, whose normal contact does not feel tractions, for trials."""
        same = copy(self)
        same._friction = Uncoupled()
        return same

    def whole_solution(self, trial: TrialStep) -> StepSolution:
        """Return the solution of a step on the whole grid, without accepting it."""
        return on_full_grid(self._domain, trial, 0.0)

    def continue_under(self, load: LoadHistory) -> None:
        """Go on under another load, which is the same up to the last step."""
        self._run = replace(self._run, problem=replace(self._run.problem, load=load))

    @property
    def last_reference(self) -> Floats | None:
        """Elastic reference of the last pressure on the domain's cells; None without contact."""
        return self._references[-1].fields[0] if self._references else None

    def restart_data(self) -> RestartData:
        """Return the state after an accepted step as plain data."""
        return {
            "history": self._history.restart_data(),
            "force_memory": self._force_memory.restart_data(),
            "errors": self._errors.restart_data(),
            "scale": self._scale,
            "references": [vars(reference) for reference in self._references],
            "motion": self._motion,
            "slow": self._slow,
            "adhesive": self._adhesive and self._adhesive.restart_data(),
        }

    def restore(self, restart_data: RestartData) -> None:
        """Continue the same run from restart data."""
        self._history.restore(restart_data["history"])
        self._force_memory.restore(restart_data["force_memory"])
        self._errors.restore(restart_data["errors"])
        self._scale = restart_data["scale"]
        self._references = [ElasticReference(**each) for each in restart_data["references"]]
        self._motion, self._slow = restart_data["motion"], restart_data["slow"]
        if self._adhesive is not None:
            self._adhesive.restore(restart_data["adhesive"])

    def map_fields(self, run: RunSetup, enlargement: GridEnlargement) -> None:
        """Continue the same run on a larger grid."""
        mapped = enlargement.pairs
        self._run, self._domain = run, enlargement.large
        self._history.map_fields(enlargement)
        self._errors.map_fields(mapped, enlargement.pressure)
        self._references = [
            replace(reference, fields=mapped(reference.fields)) for reference in self._references
        ]
        if self._adhesive is not None:
            self._adhesive.map_fields(enlargement)

    def _step_problem(self, step: TimeStep) -> StepProblem:
        """Pose a step: load at its end, response of the history, elastic contact to be solved."""
        point = self._run.problem.contact_load.at(step.time, side=step.side)  # step 1
        response, force_response = (
            self._history.respond(step),
            response_to(step, self._force_memory),
        )
        reference_force = float(force_response.of(_force(point))[0])
        drive = reference_force if point.approach is None else point.approach
        position = self._run.position_at(step.time)
        self._domain.move_axis(position)
        open_gap = self._domain.reduce_by_symmetry(self._run.gap_at(step.time))
        widened = response.widened(open_gap)  # step 2: the history widens the gap
        lift = self._friction.earlier_lift(step)
        problem = ContactProblem(
            widened if lift is None else widened + lift,
            response.compliance,
            self._domain.reduced_constraints(Constraints.of(point)),
            self._scale,
        )
        known = self._reference_history(step)
        if self._run.problem.motion.stands:
            guess = self._reference_guess(self._predicted(known, step, drive), response)
        else:
            moved = self._predicted(self._move_known(known, step), step, point.level)
            guess = None if moved is None else self._moved_guess(moved, problem)
        return StepProblem(point, response, drive, problem, guess, lift)

    def accept(self, step: TimeStep, trial: TrialStep) -> StepSolution:
        """Add a solved step to the history (step 5), and return its solution on the whole grid."""
        if trial.outcome is Outcome.NO_CONTACT and trial.adhesive is None:
            self._references = []
        else:
            # A jump breaks the extrapolation: what came before it does not count.
            jumps = step.is_jump or math.isinf(trial.change)
            known = [] if jumps else self._reference_history(step)
            self._references = [*known[1 - self._points :], self._known_from(trial)]
        self._motion = trial.solution.motion
        self._slow = trial.response.slow * step.duration
        loss = self._loss(trial.pairs)
        self._history.accept(trial.pairs)
        self._force_memory.accept(_force(trial.point))
        time_error = self._errors.after(step, trial.pairs[self._creeping], trial.error)
        largest = float(trial.reference.fields[1].max())
        if trial.adhesive is not None:
            largest = max(largest, -float(trial.reference.fields[1].min()))
            self._adhesive_accept(trial.adhesive)
        self._scale = max(self._scale, PAST_DISPLACEMENT_WEIGHT * largest)
        return on_full_grid(self._domain, trial, time_error, loss, self._stability(step, trial))

    def _known_from(self, trial: TrialStep) -> ElasticReference:
        """Reference that the next guess is extrapolated from."""
        if self._run.problem.motion.stands:
            return trial.reference
        # The elastic reference of a moving body has a trace of where it was, which pressures have
        # not.
        return replace(trial.reference, drive=trial.point.level, fields=trial.solution.values)

    def _loss(self, pairs: tuple[Floats, ...]) -> tuple[float, float]:
        """Heat [J] of a step and power [W] lost at its end; NaN if unknown."""
        run = self._run
        # Without a datum, part of it is lost by the approach.
        if run.problem.motion.stands or not run.has_datum:
            return math.nan, math.nan
        lost = self._history.loss(pairs)
        if lost is None:
            return math.nan, math.nan
        area = self._domain.symmetry_count * self._domain.grid.cell_area
        return lost[0] * area, lost[1] * area

    def _reference_history(self, step: TimeStep) -> list[ElasticReference]:
        """The references that the next one is extrapolated from; after a kink, the last one."""
        return self._references[-self._points :] if step.smooth else self._references[-1:]

    def _predicted(
        self, known: list[ElasticReference], step: TimeStep, drive: float
    ) -> ElasticReference | None:
        """Reference that known ones foresee at the end of a step."""
        return predict(known, step.time, drive, self._domain.team, self._points)

    def _moved_guess(self, moved: ElasticReference, problem: ContactProblem) -> Guess:
        """Guess from earlier pressures that have been moved with the body."""
        pressure, unit_displacement = moved.fields  # made by `predict` for this use
        # Moved by whole cells it may lie beyond the body's end.
        beyond = np.isinf(problem.open_gap)
        if pressure[beyond].any():
            pressure[beyond] = 0.0
            self._domain.convolution.apply(pressure, into=unit_displacement)
        return Guess(moved.fields, moved.motion)

    def _reference_guess(
        self,
        reference: ElasticReference | None,
        response: SurfaceStep,
    ) -> Guess | None:
        """Pressure and unit displacement of a reference."""
        if reference is None or response.first.compliance == 0:
            return None
        values = reference.fields  # made by `predict` for this use, so it may be overwritten
        if len(response.terms) > 1:  # the displacement is that of all terms
            first = response.first
            values[0] -= first.history[0]
            values[0] /= first.compliance
            self._domain.convolution.apply(values[0], into=values[1])
            return Guess(values, reference.motion)

        return Guess(response.first.value_of(values), reference.motion)

    def _move_known(self, known: list[ElasticReference], step: TimeStep) -> list[ElasticReference]:
        """Known solutions, moved by whole cells to where the body is at the end of a step."""
        moved = self._run.moved
        return [replace(each, fields=moved(each.fields, each.time, step.time)) for each in known]

    def _solve_step(
        self, step: TimeStep, posed: StepProblem
    ) -> tuple[ContactSolution, Outcome, JointSlip | None]:
        """Solve the equilibrium of a step (step 3); without force there is nothing to solve."""
        point, problem, response = posed.point, posed.problem, posed.response
        if point.force == 0:
            touched = first_touch(problem, self._domain, self._motion)
            if response.is_untouched:
                touched = at_lowest_point(self._run, step.time, touched)
            return touched, Outcome.NO_CONTACT, None
        if point.force is None:
            given = problem.constraints.with_prescribed(self._motion)
            if is_separated(problem, self._domain, given):
                return without_pressure(problem, self._domain, given), Outcome.NO_CONTACT, None
        tolerance = self._run.problem.tolerance
        solution, joint = self._friction.equilibrium(
            step, problem, self._domain, posed.guess, tolerance
        )
        if not solution.converged:
            return solution, Outcome.NOT_CONVERGED, None
        if solution.in_contact.any():
            return solution, Outcome.CONVERGED, joint
        # A body that can tilt has turned away: from its last tilts no farther than it must.
        plane, given = self._domain.whole.plane, problem.constraints.with_prescribed(self._motion)
        motion = just_clear(problem.open_gap, plane, given, solution.motion)
        return without_pressure(problem, self._domain, motion), Outcome.NO_CONTACT, None

    def _refuse_levelling(self, step: TimeStep, response: SurfaceStep) -> None:
        """StepTooLongError for a step that holds its value long where others continue a trend."""
        # Its error is of first order. A somewhat shorter one goes over to steps that are long
        # against the law, or continues their trend, and needs no solution to be found.
        held = response.first.held * step.duration
        longest = max(MAX_TREND_GROWTH * self._slow, LARGEST_FIRST_HOLD * step.duration)
        if not step.smooth or held <= longest or step.is_shortest:
            return
        rise = step.duration - held
        raise StepTooLongError(math.inf, longest=rise + HOLD_SAFETY * longest)

    def _solve_adhesive(self, step: TimeStep, posed: StepProblem) -> transient.AdhesiveStep | None:
        """Solve the equilibrium of bodies that adhere (step 3); None without adhesion."""
        if self._adhesive is None:
            return None
        load, under_force = self._run.problem.load, posed.point.force is not None
        spring = None if under_force else load.stage_stiffness
        found = self._adhesive.solve(step, posed.problem, posed.guess, spring)
        if found.is_too_long:
            raise StepTooLongError(found.change)
        return found

    def _adhesive_accept(self, step: transient.AdhesiveStep) -> None:
        if self._adhesive is not None:
            self._adhesive.accept(step)

    def _stability(self, step: TimeStep, trial: TrialStep) -> float:
        """Stability of a state that is reported; NaN of others, and without adhesion [-]."""
        if self._adhesive is None or trial.adhesive is None or step.requested is None:
            return math.nan
        return self._adhesive.stability(trial.adhesive)


def _adhesive_contact(run: RunSetup, domain: ContactDomain) -> transient.AdhesiveContact | None:
    """Adhesive contacts of a run; None without adhesion."""
    if run.law is None:
        return None
    open_gap = domain.reduce_by_symmetry(run.open_gap)
    return transient.AdhesiveContact(run.law, domain, open_gap, run.problem.tolerance)


def _force(point: LoadPoint) -> Floats:
    """The prescribed force as a field of one number [N]; 0 under a prescribed approach."""
    return np.array([point.force or 0.0])
