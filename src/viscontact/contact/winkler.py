"""A body on an elastic foundation (Winkler): balanced, cheap, and a fair start for iterations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.contact.rigid_balance import Constraints, RigidPlane

#: From one foundation to the next it stiffens by this factor.
STIFFENING_FACTOR = 4.0

#: Part of their stiffness that the last foundation's cells lend to the next.
REGULARISATION = 0.01

#: Under this part of the deepest overlap before it has settled, a body is clear of the surface.
SEPARATION_TOLERANCE = 1e-12

MAX_NEWTON = 40


def winkler_contact(
    open_gap: NDArray[np.float64],
    compliance: float,
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Balanced pressure and rigid motion of a body pressed on independent springs.

    The springs' stiffness is matched to the half-space by the contact's own size.

    Parameters
    ----------
    open_gap : ndarray, shape (nx, ny)
        Gap without pressure and motion [m], +inf where there is no body.
    compliance : float
        Contact compliance [1/Pa].
    constraints : Constraints
        Wanted resultants or prescribed motions.
    plane : RigidPlane
        The planes of these cells.
    cell_area : float
        Area of a cell [m²].

    Returns
    -------
    pressure : ndarray, shape (nx, ny)
        Non-negative pressure [Pa], balanced wherever the resultants can be.
    motion : ndarray, shape (3,)
        Approach [m] and tilts [rad] with which nothing overlaps but what is pressed.
    """
    given = constraints.with_prescribed(np.zeros(3))
    gap = open_gap - plane.field(given)
    if not constraints.free[0]:
        # No force, no matter how stiff the foundation: it is only the tilts that settle.
        bearing = (gap < 0).astype(float)
        motion, overlap = _newton_solve(
            gap, np.zeros(3), np.zeros(3), plane, constraints.free, bearing
        )
        # A body that tilts clear of the surface ends with rounding between them, and no contact.
        overlap[overlap <= SEPARATION_TOLERANCE * -float(gap.min())] = 0.0
        cells = max(int((overlap > 0).sum()), 1)
        return overlap / (compliance * np.sqrt(cell_area * cells)), given + motion
    cells = 100
    for _ in range(2):
        stiffness = 1 / (compliance * np.sqrt(cell_area * cells))
        target = constraints.targets / (stiffness * cell_area)
        motion, overlap = _balanced(gap, target, plane, constraints.free)
        cells = max(int((overlap > 0).sum()), 1)
    return stiffness * overlap, given + motion


def project_onto_balance(
    pressure: NDArray[np.float64],
    cells: NDArray[np.bool_],
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
) -> NDArray[np.float64]:
    """The non-negative pressure with the wanted resultants that is nearest to a given one.

    A plane is added and tension cut off: the body settles on springs that are stressed already.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure, tension among it [Pa].
    cells : ndarray of bool, shape (nx, ny)
        Cells that may carry pressure; together they must be able to carry the load.
    constraints : Constraints
        Wanted resultants; a plane has no part in motions that are prescribed.
    plane : RigidPlane
        The planes of these cells.
    cell_area : float
        Area of a cell [m²].

    Returns
    -------
    ndarray, shape (nx, ny)
        Pressure, zero on all other cells [Pa], balanced to a few digits at least.

    Examples
    --------
    Two newtons at the middle one of three cells of 1 m², one of which pulls; the first and the
    last have to carry alike:

    >>> row = RigidPlane(np.array([-1.0, 0.0, 1.0]), np.zeros(1), (1.0, 1.0))
    >>> pressure, cells = np.array([[3.0], [-2.0], [-1.0]]), np.ones((3, 1), dtype=bool)
    >>> centred = Constraints((2.0, 0.0, None))
    >>> project_onto_balance(pressure, cells, centred, row, 1.0).round(9).tolist()
    [[1.0], [0.0], [1.0]]
    """
    tension = np.where(cells, -pressure, np.inf)
    target = constraints.targets / cell_area
    _, balanced = _newton_solve(
        tension, np.zeros(3), target, plane, constraints.free, cells.astype(float)
    )
    return balanced


def _balanced(
    gap: NDArray[np.float64],
    target: NDArray[np.float64],
    plane: RigidPlane,
    free: NDArray[np.bool_],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Motion and overlap on a foundation, from a soft one to the wanted one by steps.

    A few cells under a stiff foundation cannot say which way the body has to tilt; the many cells
    of a softer one can.
    """
    solid = np.isfinite(gap)
    bearing = solid.astype(float)
    # The first foundation is so soft that about half of the body would bear.
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
    gap: NDArray[np.float64],
    motion: NDArray[np.float64],
    target: NDArray[np.float64],
    plane: RigidPlane,
    free: NDArray[np.bool_],
    bearing: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Motion of least energy and its overlap: damped Newton on a convex function.

    The cells that bore the body on a softer foundation lend a little stiffness, so that no
    motion is ever without any.
    """
    energy, overlap = _energy(gap, motion, target, plane)
    for _ in range(MAX_NEWTON):
        inverse = plane.inverse_gram((overlap > 0) + REGULARISATION * bearing, free)
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
    gap: NDArray[np.float64],
    motion: NDArray[np.float64],
    target: NDArray[np.float64],
    plane: RigidPlane,
) -> tuple[float, NDArray[np.float64]]:
    overlap = np.maximum(plane.field(motion) - gap, 0.0)
    return float(np.square(overlap).sum() / 2 - target @ motion), overlap
