"""Winkler foundation as an initial guess: a balanced pressure on independent springs.

The rigid motion minimises the convex energy 1/2 Σ max(overlap, 0)² - resultants·motion by a damped
Newton method (three unknowns), with continuation in the stiffness of the foundation: a few cells
under a stiff foundation do not determine the tilt, the many cells of a soft one do.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.mechanics.contact.clearance import ROUNDING, just_clear, touching_motion
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane

#: Factor from one stiffness of the continuation to the next.
STIFFENING_FACTOR = 4.0

#: Stiffness that cells of the last foundation add to the Hessian, as a part of their own.
REGULARISATION = 0.01

#: Newton steps on one foundation.
MAX_NEWTON = 40


def winkler_contact(
    open_gap: Floats,
    compliance: float,
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
) -> tuple[Floats, Floats]:
    """Balanced pressure [Pa] and rigid motion [m, rad] of a body on a Winkler foundation."""
    # The stiffness of the springs is matched to the half-space by the size of the contact, 1/(J
    # sqrt(area)).
    given = constraints.with_prescribed(np.zeros(3))
    gap = open_gap - plane.field(given)
    if not constraints.free[0]:
        # The approach is prescribed: only the tilts are unknown, whatever the stiffness.
        motion, overlap = _tilts_and_overlap(gap, given, plane, constraints.free)
        cells = max(int((overlap > 0).sum()), 1)
        return overlap / (compliance * np.sqrt(cell_area * cells)), given + motion
    # Stiffness from a guessed number of cells in contact, then from the number found.
    cells = 100
    for _ in range(2):
        stiffness = 1 / (compliance * np.sqrt(cell_area * cells))
        target = constraints.targets / (stiffness * cell_area)
        motion, overlap = _balanced(gap, target, plane, constraints.free)
        cells = max(int((overlap > 0).sum()), 1)
    return stiffness * overlap, given + motion


def _tilts_and_overlap(
    gap: Floats,
    given: Floats,
    plane: RigidPlane,
    free: Bools,
) -> tuple[Floats, Floats]:
    """Tilts and overlap [m] under a prescribed motion; the body tilts no more than necessary."""
    touching = touching_motion(gap, plane, free)
    turned = touching * np.array([0.0, 1.0, 1.0])
    rounding = ROUNDING * plane.height(given + turned)
    if touching[0] >= -rounding:
        return just_clear(gap, plane, np.zeros(3), turned), np.zeros(gap.shape)
    level = np.array([touching[0] - rounding, 0.0, 0.0])
    turned = just_clear(gap, plane, level, level + turned) - level
    bearing = (plane.field(turned) > gap).astype(float)
    return _newton_solve(gap, turned, np.zeros(3), plane, free, bearing)


def project_onto_balance(
    pressure: Floats,
    cells: Bools,
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
) -> Floats:
    """Nearest pressure >= 0 [Pa] on `cells` with the prescribed resultants, to a few digits."""
    # A plane is added and tension cut off, as on springs that are already compressed.
    tension = np.where(cells, -pressure, np.inf)
    target = constraints.targets / cell_area
    _, balanced = _newton_solve(
        tension, np.zeros(3), target, plane, constraints.free, cells.astype(float)
    )
    return balanced


def _balanced(
    gap: Floats,
    target: Floats,
    plane: RigidPlane,
    free: Bools,
) -> tuple[Floats, Floats]:
    """Motion and overlap on a foundation that is stiffened step by step to the final one."""
    solid = np.isfinite(gap)
    bearing = solid.astype(float)
    # The first foundation is so soft that about half of the body is in contact.
    depth = float(np.median(gap[solid]))
    softening = max(float(np.maximum(depth - gap, 0.0).sum() / target[0]), 1.0)
    motion = np.array([depth, 0.0, 0.0])
    while True:
        motion, overlap = _newton_solve(gap, motion, target * softening, plane, free, bearing)
        if softening == 1:
            return motion, overlap
        bearing = (overlap > 0).astype(float)
        softening = max(softening / STIFFENING_FACTOR, 1.0)


def _newton_solve(
    gap: Floats,
    motion: Floats,
    target: Floats,
    plane: RigidPlane,
    free: Bools,
    bearing: Floats,
) -> tuple[Floats, Floats]:
    """Motion of least energy and its overlap, by a damped Newton method."""
    # The cells in contact on the last, softer foundation (`bearing`) add a little stiffness, so
    # that the Hessian is never singular.
    energy, overlap = _energy(gap, motion, target, plane)
    for _ in range(MAX_NEWTON):
        inverse = plane.inverse_gram((overlap > 0) + REGULARISATION * bearing, free)
        # Newton step, halved until the energy does not rise.
        newton, before = inverse @ (target - plane.sums(overlap)), energy
        for halving in range(20):
            moved = motion + newton / 2**halving
            energy, overlap = _energy(gap, moved, target, plane)
            if energy <= before:
                break
        motion = moved
        if before - energy <= 1e-16 * abs(before):
            break
    return motion, overlap


def _energy(
    gap: Floats,
    motion: Floats,
    target: Floats,
    plane: RigidPlane,
) -> tuple[float, Floats]:
    """Energy of a motion, over the stiffness, and the overlap [m]."""
    overlap = np.maximum(plane.field(motion) - gap, 0.0)
    return float(np.square(overlap).sum() / 2 - target @ motion), overlap
