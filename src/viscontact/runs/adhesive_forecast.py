"""Forecast of the run time of bodies that adhere: number of steps, and time of each."""

from __future__ import annotations

import numpy as np

from viscontact.bodies.cohesive_laws import CohesiveLaw
from viscontact.simulation import checks
from viscontact.simulation.transient.setup import RunSetup

#: Steps of a way into contact and off it: of a round body, what its Tabor number adds, up to one
#: that few grids resolve, and of another body; and what given instants, creep and a first jump into
#: contact add. Measured on spheres and a rough surface.
STEPS, STEPS_BY_TABOR, LARGEST_TABOR, STEPS_OF_OTHERS = 66.0, 25.0, 4.0, 50.0
STEPS_BY_INSTANT, STEPS_BY_CREEP, STEPS_BY_JUMP_IN = 0.5, 15.0, 40.0

#: Part of those steps that a given force takes, which leaves out the way from the pull-off on.
UNDER_FORCE = 0.5

#: Time of a step in those of a plain convolution of the cells computed, and its overhead [s].
STEP, OVERHEAD = 27.0, 2e-3

#: Steps, and time of each, over those of the exponential law, of one that ends abruptly: its front
#: crosses cell after cell. What a law that rises first adds, by the square of the Tabor number.
ABRUPT_STEPS, ABRUPT_TIME, RISING_TIME = 3.0, 1.5, 2.0

#: Power of the cells that lack across the cohesive zone with which the steps grow.
UNRESOLVED = 2.6


def adhesive_steps(run: RunSetup, law: CohesiveLaw) -> float:
    """Number of steps of bodies that adhere."""
    problem, number = run.problem, _tabor_number(run, law)
    steps = STEPS_OF_OTHERS if number is None else STEPS + STEPS_BY_TABOR * number
    if not problem.surface.creep.is_elastic:
        steps += STEPS_BY_CREEP
    if problem.load.control == "force":
        steps *= UNDER_FORCE
    elif problem.load.level_at(0.0) < 0 < problem.load.largest_level:
        steps += STEPS_BY_JUMP_IN
    given = problem.step_count if problem.adaptive else float(np.size(problem.instants))
    if law.is_abrupt:
        return steps * ABRUPT_STEPS + STEPS_BY_INSTANT * given
    across = checks.adhesion.cells_across_zone(law, problem, run.grid)
    lacking = max(1.0, checks.adhesion.ENOUGH_CELLS / across)
    return float((steps + STEPS_BY_INSTANT * given) * lacking**UNRESOLVED)


def adhesive_seconds(run: RunSetup, law: CohesiveLaw, steps: float, convolution: float) -> float:
    """Duration of steps, by that of a convolution of the cells that are computed [s]."""
    each = STEP * convolution + OVERHEAD
    if law.is_abrupt:
        each *= ABRUPT_TIME
    elif law.decreasing is not law:
        each *= 1 + RISING_TIME * (_tabor_number(run, law) or 1.0) ** 2
    return steps * each


def _tabor_number(run: RunSetup, law: CohesiveLaw) -> float | None:
    """Tabor number at the end, up to one that few grids resolve; None of a body not round."""
    numbers = checks.adhesive_limits.tabor_numbers(law, run.problem)
    return None if numbers is None else min(numbers[1], LARGEST_TABOR)


def computed_shape(run: RunSetup) -> tuple[int, int]:
    """Cells that are computed along both axes: of an even contact a half."""
    along, across = (
        count - count // 2 if even else count
        for count, even in zip(run.grid.shape, run.mirrored, strict=True)
    )
    return along, across
