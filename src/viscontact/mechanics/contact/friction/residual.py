"""Residual of the friction law, and the duality gap, which bounds the error of the traction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.friction.directions import Directions, directions_of
from viscontact.mechanics.contact.friction.problem import SlipProblem
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, pseudo_inverse


@dataclass(frozen=True, eq=False)
class SlipResidual:
    """Slip under a traction with the rigid motion that fits best, and its errors."""

    motion: Floats
    slip: Floats  # w [m], (2, nx, ny)
    directions: Directions
    error: float  # largest deviation from the friction law over the largest displacement [-]
    duality_gap: float  # over the energy of the step [-]
    objective: float  # what the solution minimises [Pa m]
    displacement: float  # largest displacement, which errors are relative to [m]


def slip_residual(
    problem: SlipProblem,
    shift: RigidShift,
    traction: Floats,
    unit_displacement: Floats,
    guess: Floats | None = None,
) -> SlipResidual:
    """Fit the motion by least squares over the free directions, and judge the slip that is left.

    A guess of the motion tells which cells slip; without one all do that have reached their circle.
    """
    before = problem.slip_before_shift(traction, unit_displacement)
    motion = problem.constraints.motions if guess is None else guess
    against = -traction if guess is None else before - shift.field(motion)
    directions = directions_of(problem, traction, against)
    motion = _fitted(problem, shift, before, directions, motion)
    slip = before - shift.field(motion)
    directions = directions_of(problem, traction, slip)
    touching = problem.bound > 0
    wrong = np.hypot(*directions.projected(slip))
    largest = float(np.hypot(*before).max(initial=0.0, where=touching))
    moved = float(np.hypot(*shift.field(motion)).max(initial=0.0, where=touching))
    scale = max(problem.displacement_scale, largest, moved)
    gap = _gap(problem, traction, slip, scale)
    given = shift.field(problem.constraints.motions)
    objective = float((traction * ((before + problem.past) / 2 - given)).sum())
    error = float(wrong.max()) / scale
    return SlipResidual(motion, slip, directions, error, gap, objective, scale)


def _fitted(
    problem: SlipProblem,
    shift: RigidShift,
    before: Floats,
    directions: Directions,
    motion: Floats,
) -> Floats:
    """Motion with the least slip along free directions."""
    constraints = problem.constraints
    if not constraints.free.any():
        return motion
    gram = shift.gram(*directions.matrix) * shift.cell_area
    lacking = shift.resultants(directions.projected(before - shift.field(motion)))
    # As a correction, so that a motion that no cell determines is unchanged.
    return motion + pseudo_inverse(gram, constraints.free, constraints.arm) @ lacking


def _gap(problem: SlipProblem, traction: Floats, slip: Floats, scale: float) -> float:
    """Σ (μ p |w| + q·w) over the work of all friction on the largest displacement [-]."""
    # Primal less dual objective of the convex problem: it is not negative, is zero at the solution
    # only, and bounds 1/2 (q - q*)·(J T + D) (q - q*).
    here = problem.bound > 0
    found = problem.bound * np.hypot(*slip) + (traction * slip).sum(axis=0)
    most = float(problem.bound.sum()) * scale
    return max(float(found[here].sum()), 0.0) / most if most > 0 else 0.0
