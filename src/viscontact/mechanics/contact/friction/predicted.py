"""Tractions under a changed force, predicted without a convolution.

As the force on a sphere grows, q = μ p - μ p_c with the pressure p_c of a smaller contact, whose
edge is where |p| = s:

    p_c = (p² - s²)^(1/2)                                                  (R. D. Mindlin, 1949)

Where tractions have been before, cells that slip take up what is left to their circles, the others

    κ μ ((p² - b²)^(1/2) - (p² - s²)^(1/2))

with b of the edge of the stick zone before, and s of that after, which meets the force; κ makes the
tractions of both meet there, 1 at first and 2 after a reversal. It is exact for elliptic contacts
that keep their pressure, of ν = 0 and elastic bodies. Otherwise it is a guess, whose cells slip
about where those of the solution do.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.contact.friction.discs import CutOff
from viscontact.mechanics.contact.friction.rigid_shift import RigidShift, ShiftConstraints

#: Change of the force over what friction carries from which on it is predicted.
LEAST_CHANGE = 1e-6

#: Way to the circle over its radius below which a cell slips.
SLIPPING = 0.02

#: Trials of the edge of the stick zone, and error of the force over its change that ends them.
MOST_TRIALS, MET = 20, 1e-3


def predicted(
    traction: Floats, bound: Floats, shift: RigidShift, constraints: ShiftConstraints
) -> Floats:
    """Tractions on the discs of which the prescribed forces have made a given traction, about.

    Under a force that friction does not carry, or just so, all cells slide along it.
    """
    given = CutOff(traction, bound, np.zeros(bound.shape, bool)).traction
    lacking = constraints.lacking(shift.resultants(given))[:2] / shift.cell_area
    size, most = float(np.hypot(*lacking)), float(bound.sum())
    if most == 0 or not size > LEAST_CHANGE * most:
        return given
    force = constraints.resultants[:2] / shift.cell_area
    pull = float(np.hypot(*force))
    if pull >= most:
        return np.asarray((force / pull)[:, None, None] * bound)
    direction = lacking / size
    return given + direction[:, None, None] * _change(given, bound, direction, size)


def _change(traction: Floats, bound: Floats, direction: Floats, size: float) -> Floats:
    """Change of the tractions of cells along a direction, whose sum is given, if they carry it."""
    (x, y), (to_x, to_y) = traction, direction
    along, across = to_x * x + to_y * y, to_x * y - to_y * x
    square = bound**2
    left = np.sqrt(np.maximum(square - across**2, 0.0)) - along
    slipped: Bools = left <= SLIPPING * bound
    edge = float((bound * slipped).max()) ** 2
    depth = np.sqrt(np.maximum(square - edge, 0.0))

    def changed(new: float) -> Floats:
        """Change where the edge of the stick zone is at a square of the bound."""
        slips = square < new
        fresh = (slips > slipped).astype(np.float64)
        depths = float((depth * fresh).sum())
        factor = float((left * fresh).sum()) / depths if depths > 0 else 1.0
        sticks = factor * (depth - np.sqrt(np.maximum(square - new, 0.0)))
        return np.asarray(np.where(slips, left, np.minimum(sticks, left)))

    # The secant that keeps the root between its ends, and halves the weight of an end that stays
    # twice; over the cubed radius of what sticks, of which the force on a sphere is linear.
    deepest, found = float(square.max()), changed(edge)
    low, high, stays = 0.0, 1.0, ""
    short, over = float(found.sum()) - size, float(left.sum()) - size
    for _ in range(MOST_TRIALS):
        if not short < -MET * size or not over > 0:
            break
        middle = (low * over - high * short) / (over - short)
        found = changed(deepest - (deepest - edge) * (1 - middle) ** (2 / 3))
        off = float(found.sum()) - size
        if abs(off) <= MET * size:
            break
        if off < 0:
            low, short, over = middle, off, over / 2 if stays == "high" else over
            stays = "high"
        else:
            high, over, short = middle, off, short / 2 if stays == "low" else short
            stays = "low"
    return found
