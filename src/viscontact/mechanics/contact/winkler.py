"""Winkler foundation as an initial guess: a balanced pressure on independent springs.

The rigid motion minimises the convex energy 1/2 Σ max(overlap, 0)² - resultants·motion by a damped
Newton method (three unknowns), with continuation in the stiffness of the foundation: a few cells
under a stiff foundation do not determine the tilt, the many cells of a soft one do.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
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
    foundation = np.ascontiguousarray(gap), plane, free, np.ascontiguousarray(bearing)
    pressed = _pressed(motion, *foundation)
    for _ in range(MAX_NEWTON):
        # Newton step, halved until the energy does not rise.
        newton, before = pressed.inverse @ (target - pressed.sums), pressed.energy(target)
        for halving in range(20):
            pressed = _pressed(motion + newton / 2**halving, *foundation)
            if pressed.energy(target) <= before:
                break
        motion = pressed.motion
        if before - pressed.energy(target) <= 1e-16 * abs(before):
            break
    return motion, _overlap(motion, gap, plane)


@dataclass(frozen=True, eq=False)
class _Pressed:
    """Springs that a motion presses, of unit stiffness."""

    motion: Floats
    squares: float  # sum of the squares of the overlaps [m²]
    sums: Floats  # of the overlaps against 1, x, y
    inverse: Floats  # of the Gram matrix over the pressed springs and a part of the bearing ones

    def energy(self, target: Floats) -> float:
        """Energy of the motion, over the stiffness."""
        return float(self.squares / 2 - target @ self.motion)


def _pressed(
    motion: Floats, gap: Floats, plane: RigidPlane, free: Bools, bearing: Floats
) -> _Pressed:
    """Springs that a motion presses, in one pass of the compiled core if there is one."""
    if (core := plane.team.core) is not None:
        at, free_motions = tuple(motion.tolist()), tuple(free.tolist())
        others = bearing, REGULARISATION, free_motions
        squares, sums, inverse = core.press(plane.of_core, gap, at, *others)
        return _Pressed(motion, squares, np.array(sums), np.array(inverse))
    overlap = _overlap(motion, gap, plane)
    inverse = plane.inverse_gram((overlap > 0) + REGULARISATION * bearing, free)
    return _Pressed(motion, np.square(overlap).sum(), plane.sums(overlap), inverse)


def _overlap(motion: Floats, gap: Floats, plane: RigidPlane) -> Floats:
    """Overlap of a moved body with the springs [m]."""
    return np.maximum(plane.field(motion) - gap, 0.0)
