"""Bodies that do not press each other: where they stand, as far as the load tells."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import ContactSolution
from viscontact.mechanics.contact.problem import ContactProblem
from viscontact.simulation.transient.setup import RunSetup

#: Samples each way within a cell in the search for the body's lowest point; even, so that they
#: include the cell's edges and corners.
TOUCH_SAMPLES = 16


def is_separated(problem: ContactProblem, domain: ContactDomain, motion: Floats) -> bool:
    """Whether bodies that move so do not touch."""
    plane = domain.whole.plane.field(motion)
    return bool((problem.open_gap >= plane).all())


def without_pressure(
    problem: ContactProblem, domain: ContactDomain, motion: Floats
) -> ContactSolution:
    """Solution of bodies that move so, and do not press each other."""
    nothing = np.zeros((2, *domain.shape))
    gap = problem.open_gap - domain.whole.plane.field(motion)
    nowhere = np.zeros(domain.shape, bool)
    return ContactSolution(nothing, motion, gap, nowhere, 0.0, 0, 0, converged=True)


def first_touch(problem: ContactProblem, domain: ContactDomain, motion: Floats) -> ContactSolution:
    """Place a body without force where it just touches the surface; free tilts are kept."""
    tilts = problem.constraints.with_prescribed(motion) * np.array([0.0, 1.0, 1.0])
    distance = problem.open_gap - domain.whole.plane.field(tilts)
    touching = tilts + np.array([float(distance.min()), 0.0, 0.0])
    return without_pressure(problem, domain, touching)


def at_lowest_point(run: RunSetup, time: float, apart: ContactSolution) -> ContactSolution:
    """Let the body's lowest point touch a flat surface, in place of the nearest cell centre."""
    tilts = apart.motion[1:]
    at_x, at_y = run.position_at(time)
    slopes = np.add.outer(tilts[0] * (run.grid.x - at_x), tilts[1] * (run.grid.y - at_y))
    cells = run.gap_at(time) - slopes
    i, j = np.unravel_index(int(cells.argmin()), cells.shape)
    part = np.linspace(-1.0, 1.0, 2 * TOUCH_SAMPLES + 1)
    x = run.grid.x[i] + part[:, None] * run.grid.cell_size[0]
    y = run.grid.y[j] + part[None, :] * run.grid.cell_size[1]
    gap = run.indenter_at(time).gap(x, y)
    lowest = float((gap - tilts[0] * (x - at_x) - tilts[1] * (y - at_y)).min())
    below = apart.motion[0] - lowest
    motion = apart.motion - np.array([below, 0.0, 0.0])
    return replace(apart, motion=motion, gap=apart.gap + below)
