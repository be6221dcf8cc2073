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

#: Part of its circle below which a traction tells no direction in which it could be held there.
LEAST = 1e-100

TINY = float(np.finfo(np.float64).tiny)

#: Imbalance over the force that friction carries that is left [-].
BALANCED = 1e-13


def lengths(pairs: Floats) -> Floats:
    """Lengths of pairs of components."""
    x, y = pairs
    return np.asarray(np.sqrt(x * x + y * y))


def divided(fields: Floats, by: Floats, cells: Bools) -> Floats:
    """Quotients in some cells, 0 in the others."""
    # A division of these cells only takes four times as long.
    return np.asarray(fields / np.where(cells, by, 1.0) * cells)


def on_circle(traction: Floats, bound: Floats, in_contact: Bools) -> Bools:
    """Cells in contact whose traction has reached what friction carries."""
    return np.asarray(in_contact & (lengths(traction) >= bound * (1 - ON_CIRCLE)))


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
    nowhere = np.zeros(slips.shape, bool)
    if not constraints.free.any():
        return CutOff(traction, bound, nowhere).traction
    most = BALANCED * float(bound.sum()) * shift.cell_area
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
    motion, found = np.zeros(3), CutOff(traction, bound, held)
    off = _off(found.traction, shift, constraints)
    for _ in range(MOST_ROUNDS):
        if off <= most:
            break
        gram = shift.gram(*found.slopes(weight)) * shift.cell_area
        inverse = pseudo_inverse(gram, constraints.free, constraints.arm)
        step = inverse @ constraints.lacking(shift.resultants(found.traction))
        for _ in range(MOST_HALVINGS):
            trial = CutOff(traction + weight * shift.field(motion + step), bound, held)
            remaining = _off(trial.traction, shift, constraints)
            if remaining < off:
                break
            step = step / 2
        else:
            break
        motion, found, off = motion + step, trial, remaining
    return found.traction, off


def _off(traction: Floats, shift: RigidShift, constraints: ShiftConstraints) -> float:
    """Length of what the resultants lack [N]."""
    arms = np.array([1.0, 1.0, constraints.arm])
    return float(np.linalg.norm(constraints.lacking(shift.resultants(traction)) / arms))


class CutOff:
    """Nearest tractions on the discs; on their circles in cells that are held there."""

    def __init__(self, beyond: Floats, bound: Floats, held: Bools) -> None:
        self._beyond, self._size = beyond, lengths(beyond)
        self._least = np.where(held, LEAST, 1.0) * bound + TINY
        self._share = bound / np.maximum(self._size, self._least)  # 1 within the circle
        self.traction: Floats = beyond * self._share

    def slopes(self, weight: Floats) -> tuple[Floats, Floats, Floats]:
        """Change with a rigid motion by a weight: entries xx, xy and yy for each cell."""
        # Beyond the circle only the tangent is left, shortened.
        x, y = divided(self._beyond, self._size, self._size > self._least)
        left = weight * self._share
        return left * (1 - x * x), -left * x * y, left * (1 - y * y)
