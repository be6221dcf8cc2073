"""What a run carries from step to step, and how it takes the next one."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.domain import ContactDomain
from viscontact.contact.equilibrium import ContactSolution, solve_contact
from viscontact.contact.problem import ContactProblem, Guess
from viscontact.contact.rigid_balance import Constraints
from viscontact.loads import LoadPoint
from viscontact.simulation.grid_enlargement import GridEnlargement
from viscontact.simulation.setup import RunSetup
from viscontact.simulation.step_solution import StepSolution
from viscontact.state import Outcome
from viscontact.time_integration.extrapolation import (
    EXTRAPOLATION_POINTS,
    ElasticReference,
    predict,
)
from viscontact.time_integration.fixed_steps import Step
from viscontact.time_integration.hereditary_integral import HereditaryIntegral, HereditaryResponse
from viscontact.time_integration.internal_variables import InternalVariables
from viscontact.time_integration.restart_data import RestartData
from viscontact.time_integration.step_error import StepError, TimeErrors

#: Errors are measured against the displacement that the pressure causes, but never against less
#: than this part of the largest displacement of the past: below it rounding would have a say.
PAST_DISPLACEMENT_WEIGHT = 1e-3

#: Samples each way within a cell when the body's lowest point is looked for; even, so that a
#: point on a cell's edge or corner is among them.
TOUCH_SAMPLES = 16


@dataclass(frozen=True, eq=False)
class StepProblem:
    """What a step meets, before it is solved.

    Attributes
    ----------
    point : LoadPoint
        The load at its end.
    response : HereditaryResponse
        Of the memory to the step.
    drive : float
        What the elastic elastic_reference moves with, as in `ElasticReference`.
    problem : ContactProblem
        What is to be solved.
    """

    point: LoadPoint
    response: HereditaryResponse
    drive: float
    problem: ContactProblem


@dataclass(frozen=True, eq=False)
class TrialStep:
    """A step that has been solved, and not been taken yet.

    Attributes
    ----------
    point : LoadPoint
        The load at its end.
    solution : ContactSolution
        Equilibrium there.
    response : HereditaryResponse
        Of the memory to the step.
    elastic_reference : ElasticReference
        Elastic elastic_reference of the end.
    outcome : Outcome
        How it ended.
    error : StepError
        What the step adds to the error of the pressure.
    """

    point: LoadPoint
    solution: ContactSolution
    response: HereditaryResponse
    elastic_reference: ElasticReference
    outcome: Outcome
    error: StepError


class Stepper:
    """What has happened so far: memories, the last twins, the last motion.

    Parameters
    ----------
    run : RunSetup
        The run.
    half_space : ContactDomain
        Where it takes place.
    """

    def __init__(self, run: RunSetup, half_space: ContactDomain) -> None:
        self._run, self._half_space = run, half_space
        self._shape = half_space.reduce_by_symmetry(run.open_gap)
        self._memory = run.memory.memory(
            (2, *half_space.shape)
        )  # of pressure and of unit_displacement
        self._force_memory = InternalVariables(run.memory.prony_approximation, (1,))
        self._errors = TimeErrors(run.memory, run.problem.load)
        self._scale = 1e-12 * max(run.grid.cell_size)
        self._references: list[ElasticReference] = []
        self._motion = np.zeros(3)

    def trial(self, step: Step) -> TrialStep:
        """Solve a step, without taking it."""
        step_problem = self._step_problem(step)
        solution, outcome = self._solved(step, step_problem)
        values = solution.values
        values.flags.writeable = False  # it will be remembered, without a copy
        response = step_problem.response
        elastic_reference = ElasticReference(
            step.time, step_problem.drive, response.of(values), solution.motion
        )
        error = self._errors.of_step(step, step_problem.point, values, response)
        return TrialStep(step_problem.point, solution, response, elastic_reference, outcome, error)

    def restart_data(self) -> RestartData:
        """What has to be kept to go on from here; asked for after an `accept`."""
        return {
            "memory": self._memory.restart_data(),
            "force_memory": self._force_memory.restart_data(),
            "errors": self._errors.restart_data(),
            "scale": self._scale,
            "twins": [vars(elastic_reference) for elastic_reference in self._references],
            "motion": self._motion,
        }

    def restore(self, restart_data: RestartData) -> None:
        """Go on from what was `restart_data`, in the same run."""
        self._memory.restore(restart_data["memory"])
        self._force_memory.restore(restart_data["force_memory"])
        self._errors.restore(restart_data["errors"])
        self._scale = restart_data["scale"]
        self._references = [
            ElasticReference(**elastic_reference) for elastic_reference in restart_data["twins"]
        ]
        self._motion = restart_data["motion"]

    def map_fields(self, run: RunSetup, half_space: ContactDomain) -> None:
        """Go on in the same run on a larger grid."""
        grown = GridEnlargement(self._half_space, half_space).pairs
        self._run, self._half_space = run, half_space
        self._shape = half_space.reduce_by_symmetry(run.open_gap)
        self._memory.map_fields(grown)
        self._errors.map_fields(grown)
        self._references = [
            replace(elastic_reference, fields=grown(elastic_reference.fields))
            for elastic_reference in self._references
        ]

    def _step_problem(self, step: Step) -> StepProblem:
        """Ask the memories what the step will meet."""
        point = self._run.problem.load.at(step.time, side=step.side)
        response, force_response = (
            _response(each, step) for each in (self._memory, self._force_memory)
        )
        reference_force = float(force_response.of(_force(point))[0])
        drive = reference_force if point.approach is None else point.approach
        problem = ContactProblem(
            self._shape + response.history[1],
            response.compliance,
            self._half_space.reduced_constraints(Constraints.of(point)),
            self._scale,
        )
        return StepProblem(point, response, drive, problem)

    def accept(self, step: Step, trial: TrialStep) -> StepSolution:
        """Take a step that has been solved."""
        known = (
            self._reference_history(step)[1 - EXTRAPOLATION_POINTS :] if not step.is_jump else []
        )
        self._references = (
            [] if trial.outcome is Outcome.NO_CONTACT else [*known, trial.elastic_reference]
        )
        self._motion = trial.solution.motion
        self._memory.accept(trial.solution.values)
        self._force_memory.accept(_force(trial.point))
        time_error = self._errors.after(step, trial.solution.values, trial.error)
        instant = _on_full_grid(self._half_space, trial, time_error)
        self._scale = max(
            self._scale, PAST_DISPLACEMENT_WEIGHT * float(trial.elastic_reference.fields[1].max())
        )
        return instant

    def _reference_history(self, step: Step) -> list[ElasticReference]:
        """The twins that tell where the next one will be."""
        return self._references[-EXTRAPOLATION_POINTS:] if step.smooth else self._references[-1:]

    def _solved(self, step: Step, step_problem: StepProblem) -> tuple[ContactSolution, Outcome]:
        point, problem, response = step_problem.point, step_problem.problem, step_problem.response
        if point.force == 0:
            untouched = not response.history[1].any()
            return self._first_touch(problem, untouched=untouched), Outcome.NO_CONTACT
        given = problem.constraints.with_prescribed(self._motion)
        if point.force is None and self._is_separated(problem, given):
            return _without_pressure(problem, self._half_space, given), Outcome.NO_CONTACT
        guess = _guess(
            predict(self._reference_history(step), step.time, step_problem.drive), response
        )
        tolerance = self._run.problem.tolerance
        solution = solve_contact(problem, self._half_space, guess, tolerance=tolerance)
        if not solution.converged:
            return solution, Outcome.NOT_CONVERGED
        touches = bool(solution.values[0].any())
        return solution, Outcome.CONVERGED if touches else Outcome.NO_CONTACT

    def _is_separated(self, problem: ContactProblem, motion: NDArray[np.float64]) -> bool:
        plane = self._half_space.whole.plane.field(motion)
        return bool((problem.open_gap >= plane).all())

    def _first_touch(self, problem: ContactProblem, *, untouched: bool) -> ContactSolution:
        """No force: the body is where it just touches the (dented) surface, tilts as they were."""
        tilts = problem.constraints.with_prescribed(self._motion) * np.array([0.0, 1.0, 1.0])
        distance = problem.open_gap - self._half_space.whole.plane.field(tilts)
        motion = tilts + np.array([float(distance.min()), 0.0, 0.0])
        apart = _without_pressure(problem, self._half_space, motion)
        return _at_lowest_point(self._run, apart) if untouched else apart


def _force(point: LoadPoint) -> NDArray[np.float64]:
    """The prescribed force [N], 0 where an approach is prescribed: a field of one number."""
    return np.array([point.force or 0.0])


def _response(memory: HereditaryIntegral, step: Step) -> HereditaryResponse:
    return memory.jump() if step.is_jump else memory.ramp(step.duration)


def _guess(
    elastic_reference: ElasticReference | None, response: HereditaryResponse
) -> Guess | None:
    """Pressure and unit displacement that a predicted elastic reference belongs to."""
    if elastic_reference is None:
        return None
    values = np.subtract(
        elastic_reference.fields, response.history, out=elastic_reference.fields
    )  # it was made for this
    values /= response.compliance
    return Guess(values[0], values[1], elastic_reference.motion)


def _without_pressure(
    problem: ContactProblem, half_space: ContactDomain, motion: NDArray[np.float64]
) -> ContactSolution:
    nothing = np.zeros((2, *half_space.shape))
    gap = problem.open_gap - half_space.whole.plane.field(motion)
    return ContactSolution(nothing, motion, gap, 0.0, 0, 0, converged=True)


def _at_lowest_point(run: RunSetup, apart: ContactSolution) -> ContactSolution:
    """A flat surface is touched by the body's lowest point, not by the nearest cell centre."""
    tilts = apart.motion[1:]
    cells = run.open_gap - np.add.outer(tilts[0] * run.grid.x, tilts[1] * run.grid.y)
    i, j = np.unravel_index(int(cells.argmin()), cells.shape)
    part = np.linspace(-1.0, 1.0, 2 * TOUCH_SAMPLES + 1)
    x = run.grid.x[i] + part[:, None] * run.grid.cell_size[0]
    y = run.grid.y[j] + part[None, :] * run.grid.cell_size[1]
    lowest = float((run.problem.indenter.gap(x, y) - tilts[0] * x - tilts[1] * y).min())
    below = apart.motion[0] - lowest
    motion = apart.motion - np.array([below, 0.0, 0.0])
    return replace(apart, motion=motion, gap=apart.gap + below)


def _on_full_grid(half_space: ContactDomain, trial: TrialStep, time_error: float) -> StepSolution:
    """The instant on the whole grid."""
    solution = trial.solution
    found = solution.found
    fields = {
        "pressure": half_space.expand_by_symmetry(found.pressure),
        "gap": half_space.expand_by_symmetry(solution.gap),
        "displacement": half_space.expand_by_symmetry(trial.elastic_reference.fields[1]),
        "twin": trial.elastic_reference.fields,
    }
    for field in fields.values():
        field.flags.writeable = False  # the run goes on from them
    cell_area = half_space.symmetry_count * half_space.grid.cell_area  # with its mirror images
    energy = float(np.einsum("ij,ij->", found.pressure, found.unit_displacement)) / 2
    return StepSolution(
        **fields,
        motion=found.motion,
        resultants=half_space.whole.plane.sums(found.pressure) * cell_area,
        energy=energy * cell_area,
        residual=solution.residual,
        iterations=solution.iterations,
        outcome=trial.outcome,
        resolved=trial.response.resolved,
        time_error=time_error,
    )
