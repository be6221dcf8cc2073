"""March: the loop over the time steps of a run, which can stop and continue after any of them."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import replace

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import ConvergenceError, DomainError
from viscontact.backend.team import Team
from viscontact.backend.transforms import transforms_by
from viscontact.bodies.grid import Grid
from viscontact.mechanics import time_integration
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.state import ContactState, Outcome
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.simulation.transient.frictionless import frictional_contact
from viscontact.simulation.transient.grid_enlargement import (
    FREE,
    GridEnlargement,
    next_grid,
    overrun,
)
from viscontact.simulation.transient.observer import Observer
from viscontact.simulation.transient.setup import RunSetup
from viscontact.simulation.transient.step_solution import StepSolution
from viscontact.simulation.transient.stepper import Stepper
from viscontact.simulation.transient.trial_step import StepTooLongError, TrialStep
from viscontact.units.formatting import format_quantity

_LOG = logging.getLogger("viscontact")


class March:
    """Loop over the steps of a run, which can continue to the same bits after any step."""

    def __init__(
        self, run: RunSetup, restart_data: RestartData | None = None, *, warns: bool = True
    ) -> None:
        if restart_data is not None:
            run = run.on(run.grid.widened(tuple(restart_data["cells"])))
        self._run = run
        self._domain = domain_of(run)
        self._friction = frictional_contact(run)
        self._stepper = Stepper(run, self._domain, self._friction)
        self._steps = run.problem.steps(run.grid.cell_size)
        self._observer = Observer(run, warns=warns)
        self.done, self.outcome = 0, Outcome.CONVERGED
        self._failure: str | None = None
        if restart_data is not None:
            self._restore(restart_data)

    def __iter__(self) -> Iterator[ContactState | None]:
        """Solve the remaining steps; yield each requested state, None for inner steps."""
        while self._steps.next_step() is not None and not self._is_over:
            yield self._solved_step()
            if self._failure is not None:
                raise ConvergenceError(self._failure)
        self._observer.refuse_coarse_mesh()

    @property
    def _is_over(self) -> bool:
        """True where nothing is left to be solved: a given force has pulled the bodies apart."""
        return self.outcome is Outcome.PULLED_OFF

    @property
    def left(self) -> int:
        """Requested states still to come; an estimate where the run chooses its steps."""
        return self._steps.left

    @property
    def last_reference(self) -> Floats | None:
        """Elastic reference ∫ J dp of the last pressure, on the whole grid; None without contact.

        As a pressure times a compliance it is of one sign, and zero where that is.
        """
        found = self._stepper.last_reference
        return None if found is None else self._domain.expand_by_symmetry(found)

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""
        return {
            "stepper": self._stepper.restart_data(),
            "steps": self._steps.restart_data(),
            "observer": self._observer.restart_data(),
            "friction": self._friction.restart_data(),
            "patch": list(self._domain.kept_patch),
            "cells": list(self._run.grid.shape),
            "done": self.done,
            "outcome": int(self.outcome),
        }

    def _restore(self, restart_data: RestartData) -> None:
        self._stepper.restore(restart_data["stepper"])
        self._steps.restore(restart_data["steps"])
        self._observer.restore(restart_data["observer"])
        self._friction.restore(restart_data["friction"])
        first_row, last_row, first_column, last_column = restart_data["patch"]
        self._domain.keep_patch((first_row, last_row, first_column, last_column))
        self.done = restart_data["done"]
        self.outcome = Outcome(restart_data.get("outcome", Outcome.CONVERGED))

    def _advance(self) -> tuple[TimeStep, TrialStep]:
        """Solve the next step; repeat it on a larger grid, or shorter, where necessary."""
        # Predict, solve, check, and repeat until the grid holds the contact and the step control
        # accepts the error (Hairer, Norsett & Wanner, Solving ODEs I, II.4).
        while True:
            step = self._steps.next_step()
            assert step is not None  # the caller has seen one, and a refused one is replaced
            try:
                trial = self._stepper.trial(step)
            except StepTooLongError as found:
                assert isinstance(self._steps, time_integration.AdaptiveSteps)  # of adhesion
                self._steps.repeat_shorter(found.change, found.longest)
                continue
            if self._outgrows(step, trial):
                continue  # the same step again, on the larger grid
            failed = trial.outcome is Outcome.NOT_CONVERGED
            if failed and self._repeats_sooner():
                continue
            if failed or self._steps.accept_step(trial.error.relative, trial.change):
                return step, trial
            _LOG.debug("step to t = %.6g s: error %.2g, repeated", step.time, trial.error.relative)

    def _repeats_sooner(self) -> bool:
        """Try a jump that was not solved in a shorter step; return whether there is one."""
        steps = self._steps
        return isinstance(steps, time_integration.AdaptiveSteps) and steps.repeat_sooner()

    def _outgrows(self, step: TimeStep, trial: TrialStep) -> bool:
        """Enlarge a grid that may grow if the contact is near its rim; return whether it was."""
        if not self._run.grows:
            return False
        in_contact = self._domain.expand_by_symmetry(trial.solution.in_contact)
        reached = overrun(in_contact, FREE, self._domain.team)
        along_x, along_y = self._run.grid.periodic  # a period has no rim
        over = reached[0] and not along_x, reached[1] and not along_y
        if not any(over):
            return False
        larger = next_grid(self._run.grid, *over)
        if larger is None:
            raise DomainError(_too_large(self._run, step))
        _LOG.info("t = %.6g s: grid enlarged to %d x %d cells", step.time, *larger.shape)
        self._enlarge(larger)
        return True

    def _enlarge(self, grid: Grid) -> None:
        """Continue from the same state on a larger grid."""
        run = self._run.on(grid)
        enlargement = GridEnlargement(self._domain, domain_of(run), run)
        self._stepper.map_fields(run, enlargement)
        self._observer.map_fields(run, enlargement)
        self._friction.map_fields(run, enlargement)
        self._run, self._domain = run, enlargement.large

    def _solved_step(self) -> ContactState | None:
        """Solve the next step; the fields of the trial are not kept until the one after it."""
        step, trial = self._advance()
        self.outcome = trial.outcome
        if trial.outcome is Outcome.NOT_CONVERGED:
            self._failure = not_converged(self._run, step, trial.solution)
        return self._complete_step(step, trial)

    def _complete_step(self, step: TimeStep, trial: TrialStep) -> ContactState | None:
        solution = self._stepper.accept(step, trial)
        refuse_rim(self._run, step, solution, self._domain.team)
        state = self._observer.evaluate(step, trial.point, solution)
        slip = self._friction.trial(step, solution, trial.joint)
        self._friction.accept(slip)
        if slip.values:
            state = replace(state, **slip.values)
        if state.heat is not None and state.dissipation is not None:
            heat, power = slip.loss
            state = replace(state, heat=state.heat + heat, dissipation=state.dissipation + power)
        self._observer.warn(slip.warnings)
        _LOG.debug(
            "step to t = %.6g s: %d iterations, residual %.2g",
            *(step.time, solution.iterations, solution.residual),
        )
        if step.requested is None and not self._is_over:
            return None
        self.done += 1
        is_end = step.requested is not None and step.requested >= self._run.problem.end
        last = self._is_over or is_end
        if last:
            self._observer.warn(self._friction.warnings_at_end)
        return self._observer.add_warnings(state, last=last)


def domain_of(run: RunSetup) -> ContactDomain:
    """Return the contact domain of a run, of the first term of its surface."""
    terms = run.problem.surface.terms
    return ContactDomain(
        run.grid,
        response=terms[0].response,
        mirrored=run.mirrored,
        even_rows=run.even[0],
        transforms=transforms_by(run.transforms, run.threads),
        inner_loops=run.inner_loops,
    )


def refuse_rim(
    run: RunSetup, step: TimeStep, solution: StepSolution, team: Team | None = None
) -> None:
    """Raise DomainError if the outermost cells are in contact."""
    reached = zip(overrun(solution.in_contact, team=team), run.grid.periodic, strict=True)
    if not any(over and not repeats for over, repeats in reached):
        return
    raise DomainError(
        "grid: the contact reaches the edge of the grid at "
        f"t = {format_quantity(step.time, 's', 6)}; enlarge grid.size, now "
        f"{format_quantity(run.grid.size[0], 'm')} x {format_quantity(run.grid.size[1], 'm')}"
    )


def _too_large(run: RunSetup, step: TimeStep) -> str:
    return (
        f"grid: the contact outgrows {format_quantity(run.grid.size[0], 'm')} x "
        f"{format_quantity(run.grid.size[1], 'm')} at t = {format_quantity(step.time, 's', 6)}, "
        "and with cells as fine as these an automatic grid cannot be larger; give a grid of your "
        "own, or check whether the load moves the body away"
    )


def not_converged(run: RunSetup, step: TimeStep, solution: ContactSolution) -> str:
    """Return the message about a step whose contact was not solved."""
    return (
        f"the contact solver stopped at t = {format_quantity(step.time, 's', 6)} with residual "
        f"{solution.residual:.2g} after {solution.iterations} iterations, short of "
        f"the tolerance {run.problem.tolerance:g}; likely causes: a resultant that hardly fits "
        "under the body, a grid too coarse for the contact, or a tolerance near rounding"
    )
