"""Tractions of a contact that nearly slides as a whole, |q| = μ p in all cells.

Close to full sliding no cell sticks to tell the rigid motion. Where the surface would have moved
by w without the motion δ, a contact that slips everywhere has q = μ p (δ - w)/|δ - w|, and the
resultants F of q are prescribed: δ is the minimum of the convex function Σ μ p |δ - w| - F δ. With
the tractions w changes, but less than the slip, if that is large.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.mechanics.contact.friction.discs import lengths
from viscontact.mechanics.contact.friction.problem import SlipProblem
from viscontact.mechanics.contact.friction.residual import SlipResidual
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, pseudo_inverse

#: Newton's steps for the motion, and times that one is halved. Far from the minimum each multiplies
#: the motion by about 1.5.
MOST_STEPS, MOST_HALVINGS = 80, 10

#: Part of what friction carries that resultants may lack.
BALANCED = 1e-13

TINY = float(np.finfo(np.float64).tiny)


def sliding_traction(
    problem: SlipProblem, shift: RigidShift, traction: Floats, found: SlipResidual
) -> tuple[Floats, Floats]:
    """Traction on the circles of all cells against their slip, and the motion."""
    constraints = problem.constraints
    before = problem.slip_before_shift(traction, found.unit_displacement)
    arms = np.array([1.0, 1.0, constraints.arm])
    carried = float(problem.bound.sum()) * shift.cell_area
    motion = found.motion
    cost, pull, way = _dual(problem, shift, before, motion)
    for _ in range(MOST_STEPS):
        lacking = constraints.lacking(shift.resultants(pull))
        if float(np.abs(lacking / arms).max()) <= BALANCED * carried:
            break
        x, y = way / np.maximum(lengths(way), TINY)
        stiff = problem.bound / np.maximum(lengths(way), TINY) * shift.cell_area
        gram = shift.gram(stiff * (1 - x * x), -stiff * x * y, stiff * (1 - y * y))
        step = pseudo_inverse(gram, constraints.free, constraints.arm) @ lacking
        for _ in range(MOST_HALVINGS):
            trial = _dual(problem, shift, before, motion + step)
            if trial[0] <= cost:
                break
            step = step / 2
        else:
            break
        motion = motion + step
        cost, pull, way = trial
    return pull, motion


def _dual(
    problem: SlipProblem, shift: RigidShift, before: Floats, motion: Floats
) -> tuple[float, Floats, Floats]:
    """Σ μ p |δ - w| - F δ, its tractions, and δ - w."""
    way = shift.field(motion) - before
    length = lengths(way)
    pull = way * (problem.bound / np.maximum(length, TINY))
    given = float(problem.constraints.resultants @ motion)
    return float((problem.bound * length).sum()) * shift.cell_area - given, pull, way
