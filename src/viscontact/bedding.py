"""A body on an elastic bedding (Winkler): balanced, cheap, and a fair start for iterations."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viscontact.balance import RigidPlane, Support


def bedding_pressure(
    open_gap: NDArray[np.float64],
    compliance: float,
    support: Support,
    plane: RigidPlane,
    cell_area: float,
) -> NDArray[np.float64]:
    """Balanced pressure of a body pressed on independent springs.

    The springs' stiffness is matched to the half-space by the contact's own size.

    Parameters
    ----------
    open_gap : ndarray, shape (nx, ny)
        Gap without pressure and motion [m], +inf where there is no body.
    compliance : float
        Contact compliance [1/Pa].
    support : Support
        Wanted resultants or prescribed motions.
    plane : RigidPlane
        The planes of these cells.
    cell_area : float
        Area of a cell [m²].

    Returns
    -------
    ndarray, shape (nx, ny)
        Non-negative pressure [Pa], balanced wherever the resultants can be.
    """
    gap = open_gap - plane.field(support.with_prescribed(np.zeros(3)))
    cells = 100
    pressure = np.zeros_like(open_gap)
    for _ in range(4):
        stiffness = 1 / (compliance * np.sqrt(cell_area * cells))
        pressure = stiffness * _overlap(gap, stiffness * cell_area, support, plane)
        cells = max(int((pressure > 0).sum()), 1)
    return pressure


def _overlap(
    gap: NDArray[np.float64], spring: float, support: Support, plane: RigidPlane
) -> NDArray[np.float64]:
    """Overlap of a balanced body with a bedding: damped Newton on a convex energy."""
    target = support.targets / spring
    # Deep enough that one cell alone would carry the force: Newton comes down from there.
    motion = np.array([float(gap.min()) + target[0], 0.0, 0.0])
    energy, overlap = _energy(gap, motion, target, plane)
    for _ in range(60):
        inverse = plane.inverse_gram((overlap > 0).astype(float), support.free)
        newton = inverse @ (target - plane.sums(overlap))
        before = energy
        for halving in range(20):
            energy, overlap = _energy(gap, motion + newton / 2**halving, target, plane)
            if energy <= before:
                break
        motion = motion + newton / 2**halving
        if before - energy <= 1e-14 * abs(before):
            break
    return overlap


def _energy(
    gap: NDArray[np.float64],
    motion: NDArray[np.float64],
    target: NDArray[np.float64],
    plane: RigidPlane,
) -> tuple[float, NDArray[np.float64]]:
    overlap = np.maximum(plane.field(motion) - gap, 0.0)
    return float(np.square(overlap).sum() / 2 - target @ motion), overlap
