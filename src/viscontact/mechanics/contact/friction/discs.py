"""Discs of admissible tractions, |q| <= μ p in each cell, and tractions on them."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.contact.friction.rigid_shift import (
    RigidShift,
    ShiftConstraints,
    pseudo_inverse,
)

#: Relative distance from its circle at which a traction counts as on it.
ON_CIRCLE = 1e-12

#: Times that a step is halved.
MOST_HALVINGS = 20

#: Rounds in which resultants are restored.
MOST_ROUNDS = 60

#: Imbalance over the force that friction carries that is left [-].
BALANCED = 1e-13


def clipped(traction: Floats, bound: Floats, held: Bools | bool = False) -> Floats:
    """Nearest tractions on the discs; on their circles in cells that are held there."""
    size = np.hypot(*traction)
    outside = (size > bound) | (held & (size > 0))
    factor = np.divide(bound, size, out=np.ones(size.shape), where=outside)
    return np.asarray(traction * factor)


def on_circle(traction: Floats, bound: Floats) -> Bools:
    """Cells under pressure whose traction has reached what friction carries."""
    return np.asarray((bound > 0) & (np.hypot(*traction) >= bound * (1 - ON_CIRCLE)))


def balanced(
    traction: Floats,
    bound: Floats,
    shift: RigidShift,
    constraints: ShiftConstraints,
    slips: Bools,
) -> Floats:
    """Nearest tractions on the discs with the prescribed resultants; at best nearly so.

    Cells that slip do not change, or else stay on their circles, if that restores the resultants.
    """
    found = clipped(traction, bound)
    if not constraints.free.any():
        return found
    most = BALANCED * float(bound.sum()) * shift.cell_area
    nowhere = np.zeros(slips.shape, bool)
    for weight, held in (
        (np.where(slips, 0.0, bound), slips),
        (bound, slips),
        (bound, nowhere),
    ):
        found, off = _nearest(traction, bound, weight, held, shift, constraints, most)
        if off <= most:
            break
    return found


def _nearest(
    traction: Floats,
    bound: Floats,
    weight: Floats,
    held: Bools,
    shift: RigidShift,
    constraints: ShiftConstraints,
    most: float,
) -> tuple[Floats, float]:
    """Nearest tractions by distances over the weights, and what the resultants lack [N]."""
    # They are those of q + weight (rigid motion), cut off at the circles. The motion solves a
    # concave problem of three numbers by Newton's method, with shorter steps where that is no gain.
    motion, found = np.zeros(3), clipped(traction, bound, held)
    off = _off(found, shift, constraints)
    for _ in range(MOST_ROUNDS):
        if off <= most:
            break
        beyond = traction + weight * shift.field(motion)
        gram = shift.gram(*_slopes(beyond, bound, weight, held)) * shift.cell_area
        inverse = pseudo_inverse(gram, constraints.free, constraints.arm)
        step = inverse @ constraints.lacking(shift.resultants(found))
        for _ in range(MOST_HALVINGS):
            trial = clipped(traction + weight * shift.field(motion + step), bound, held)
            remaining = _off(trial, shift, constraints)
            if remaining < off:
                break
            step = step / 2
        else:
            break
        motion, found, off = motion + step, trial, remaining
    return found, off


def _off(traction: Floats, shift: RigidShift, constraints: ShiftConstraints) -> float:
    """Length of what the resultants lack [N]."""
    arms = np.array([1.0, 1.0, constraints.arm])
    return float(np.linalg.norm(constraints.lacking(shift.resultants(traction)) / arms))


def _slopes(
    beyond: Floats, bound: Floats, weight: Floats, held: Bools
) -> tuple[Floats, Floats, Floats]:
    """Change of cut off tractions with a rigid motion: entries xx, xy and yy for each cell."""
    size = np.hypot(*beyond)
    outside = (size > bound) | (held & (size > 0))
    # Beyond the circle only the tangent is left, shortened.
    share = np.divide(bound, size, out=np.ones(size.shape), where=outside)
    x, y = np.divide(beyond, size, out=np.zeros(beyond.shape), where=outside)
    left = weight * share
    return left * (1 - x * x), -left * x * y, left * (1 - y * y)
