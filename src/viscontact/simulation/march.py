"""A run step after step, to be stopped after any of them and gone on with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from viscontact.contact.domain import ContactDomain
from viscontact.contact.equilibrium import ContactSolution
from viscontact.errors import ConvergenceError, DomainError
from viscontact.fourier import transforms_by
from viscontact.grid import Grid
from viscontact.simulation.grid_enlargement import FREE, GridEnlargement, next_grid, overrun
from viscontact.simulation.observer import Observer
from viscontact.simulation.setup import RunSetup
from viscontact.simulation.step_solution import StepSolution
from viscontact.simulation.stepper import Stepper, TrialStep
from viscontact.state import ContactState, Outcome
from viscontact.time_integration.fixed_steps import Step
from viscontact.time_integration.restart_data import RestartData
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True, eq=False)
class CompletedStep:
    """A step that a run has taken.

    Attributes
    ----------
    outcome : Outcome
        How it ended.
    state : ContactState or None
        The state at its end; None for an inner step that nobody asked for.
    done, left : int
        Instants asked for that are done, and that are still to come (probably, where the run
        chooses its steps).
    """

    outcome: Outcome
    state: ContactState | None
    done: int
    left: int


class March:
    """A run under way: iterate for its steps, stop after any, and go on another day.

    Parameters
    ----------
    run : RunSetup
        From `prepare_run`.
    restart_data : dict, optional
        What the same run had `restart_data` after some step: it goes on from there, to the same
        bits; from the start when left out.

    Examples
    --------
    >>> import viscontact as vc
    >>> from viscontact.problem.problem import Problem
    >>> from viscontact.simulation.setup import prepare_run
    >>> rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((32, 32), (2.4e-3, 2.4e-3))
    >>> run = prepare_run(Problem(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 0.5, 1.0]))
    >>> begun = March(run)
    >>> steps = iter(begun)
    >>> first = next(steps)
    >>> resumed = March(run, begun.restart_data())
    >>> [step.state.approach for step in resumed] == [step.state.approach for step in steps]
    True
    """

    def __init__(self, run: RunSetup, restart_data: RestartData | None = None) -> None:
        if restart_data is not None:
            run = run.on(run.grid.widened(tuple(restart_data["cells"])))
        self._run = run
        self._half_space = _half_space(run)
        self._stepper = Stepper(run, self._half_space)
        self._steps = run.problem.steps()
        self._observer = Observer(run)
        self._done = 0
        if restart_data is not None:
            self._restore(restart_data)

    def __iter__(self) -> Iterator[CompletedStep]:
        """Take the steps that are left.

        Raises
        ------
        ConvergenceError, DomainError
            As in `march`.
        """
        while self._steps.next_step() is not None:
            step, trial = self._advance()
            yield self._complete(step, trial)
            if trial.outcome is Outcome.NOT_CONVERGED:
                raise ConvergenceError(_not_converged(self._run, step, trial.solution))
        self._observer.refuse_coarse_mesh()

    def restart_data(self) -> RestartData:
        """What has to be kept to go on from here, as plain data."""
        return {
            "past": self._stepper.restart_data(),
            "steps": self._steps.restart_data(),
            "observer": self._observer.restart_data(),
            "patch": list(self._half_space.kept_patch),
            "cells": list(self._run.grid.shape),
            "done": self._done,
        }

    def _restore(self, restart_data: RestartData) -> None:
        self._stepper.restore(restart_data["past"])
        self._steps.restore(restart_data["steps"])
        self._observer.restore(restart_data["observer"])
        first_row, last_row, first_column, last_column = restart_data["patch"]
        self._half_space.keep_patch((first_row, last_row, first_column, last_column))
        self._done = restart_data["done"]

    def _advance(self) -> tuple[Step, TrialStep]:
        """Solve the next step; one may be tried again, on a larger grid or shorter."""
        while True:
            step = self._steps.next_step()
            assert step is not None  # its caller has seen one, and a refused one is replaced
            trial = self._stepper.trial(step)
            if self._outgrows(step, trial):
                continue
            failed = trial.outcome is Outcome.NOT_CONVERGED
            if failed or self._steps.accept_step(trial.error.relative):
                return step, trial

    def _outgrows(self, step: Step, trial: TrialStep) -> bool:
        """Whether a contact has come near the rim of a grid that may grow, and now has grown."""
        if not self._run.grows:
            return False
        over = overrun(self._half_space.expand_by_symmetry(trial.solution.found.pressure), FREE)
        if not any(over):
            return False
        larger = next_grid(self._run.grid, *over)
        if larger is None:
            raise DomainError(_too_large(self._run, step))
        self._enlarge(larger)
        return True

    def _enlarge(self, grid: Grid) -> None:
        """Go on from the same state on a larger grid."""
        run = self._run.on(grid)
        half_space = _half_space(run)
        self._stepper.map_fields(run, half_space)
        self._observer.map_fields(run, GridEnlargement(self._half_space, half_space))
        self._run, self._half_space = run, half_space

    def _complete(self, step: Step, trial: TrialStep) -> CompletedStep:
        instant = self._stepper.accept(step, trial)
        _refuse_rim(self._run, step, instant)
        state = self._observer.evaluate(step, trial.point, instant)
        if step.asked is None:
            return CompletedStep(trial.outcome, None, self._done, self._steps.left)
        self._done += 1
        last = step.asked >= self._run.problem.end
        state = self._observer.add_warnings(state, last=last)
        return CompletedStep(trial.outcome, state, self._done, self._steps.left)


def _half_space(run: RunSetup) -> ContactDomain:
    transforms = transforms_by(run.transforms, run.threads)
    return ContactDomain(run.grid, mirrored=run.mirrored, transforms=transforms)


def _refuse_rim(run: RunSetup, step: Step, instant: StepSolution) -> None:
    if run.grid.periodic or not any(overrun(instant.pressure)):
        return
    raise DomainError(
        f"grid: the contact reaches the grid's rim at t = {format_quantity(step.time, 's', 6)}; "
        f"enlarge grid.size, now {format_quantity(run.grid.size[0], 'm')} x "
        f"{format_quantity(run.grid.size[1], 'm')}"
    )


def _too_large(run: RunSetup, step: Step) -> str:
    return (
        f"grid: the contact outgrows {format_quantity(run.grid.size[0], 'm')} x "
        f"{format_quantity(run.grid.size[1], 'm')} at t = {format_quantity(step.time, 's', 6)}, "
        "and with cells as fine as these an automatic grid cannot be larger; give a grid of your "
        "own, or look whether the load carries the body off"
    )


def _not_converged(run: RunSetup, step: Step, solution: ContactSolution) -> str:
    return (
        f"the contact solver stopped at t = {format_quantity(step.time, 's', 6)} with residual "
        f"{solution.residual:.2g} after {solution.iterations} iterations, short of "
        f"the tolerance {run.problem.tolerance:g}; likely causes: a resultant that hardly fits "
        "under the body, a grid too coarse for the contact, or a tolerance near rounding"
    )
