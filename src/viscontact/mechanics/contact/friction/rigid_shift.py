"""Rigid motions along the surface: shifts along x and y and a rotation, with their resultants."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class RigidShift:
    """Shifts δx, δy [m] and a rotation φ [rad] over cells: (δx - φ y, δy + φ x)."""

    x: Floats  # centres of the cells from the axis of rotation, shape (nx, 1) [m]
    y: Floats  # shape (1, ny) [m]
    cell_area: float  # with that of mirror images [m²]
    modes: tuple[bool, bool, bool] = (True, True, True)  # motions that cells and images have

    def field(self, motion: Numbers) -> Floats:
        """Displacement of the cells by a motion [m], (2, nx, ny); without rotation (2, 1, 1).

        It is a new array, which shares no memory with the motion.
        """
        if not motion[2]:
            return motion[:2, None, None].copy()
        found = np.empty((2, self.x.shape[0], self.y.shape[1]))
        found[0] = motion[0] - motion[2] * self.y
        found[1] = motion[1] + motion[2] * self.x
        return found

    def resultants(self, traction: Numbers) -> Floats:
        """Forces along x and y [N] and torque about the axis [N m] of a traction."""
        along_x, along_y = traction
        found = np.zeros(3)
        if self.modes[0]:
            found[0] = along_x.sum(dtype=np.float64)
        if self.modes[1]:
            found[1] = along_y.sum(dtype=np.float64)
        if self.modes[2]:
            found[2] = self.x[:, 0] @ along_y.sum(axis=1, dtype=np.float64)
            found[2] -= self.y[0] @ along_x.sum(axis=0, dtype=np.float64)
        return found * self.cell_area

    def gram(self, xx: Numbers, xy: Numbers, yy: Numbers) -> Floats:
        """Sums over cells of the three motions with weights, a symmetric matrix for each cell."""
        x, y = self.x, self.y
        if not self.modes[2]:
            a, b, d = float(xx.sum()), float(xy.sum()), float(yy.sum())
            return np.array([[a, b, 0.0], [b, d, 0.0], [0.0, 0.0, 0.0]])
        turned_x, turned_y = xy * x - xx * y, yy * x - xy * y  # of the rotation
        entries = [xx.sum(), xy.sum(), turned_x.sum(), yy.sum(), turned_y.sum()]
        last = float((x * turned_y - y * turned_x).sum())
        a, b, c, d, e = map(float, entries)
        return np.array([[a, b, c], [b, d, e], [c, e, last]])


@dataclass(frozen=True, eq=False)
class ShiftConstraints:
    """For each motion its prescribed resultant, or the motion itself."""

    free: Bools  # True where the resultant is prescribed
    resultants: Floats  # forces [N] and torque [N m]; 0 where the motion is prescribed
    motions: Floats  # shifts [m] and rotation [rad] in the step; 0 where they are free
    arm: float  # length that makes a force of a torque [m]

    def lacking(self, resultants: Floats) -> Floats:
        """What resultants lack, 0 where the motion is prescribed."""
        return np.where(self.free, self.resultants - resultants, 0.0)

    def imbalance(self, resultants: Floats, force: float) -> float:
        """Largest error of resultants over a force [N] [-]."""
        arms = np.array([1.0, 1.0, self.arm])
        return float(np.abs(self.lacking(resultants) / arms).max()) / force


def pseudo_inverse(matrix: Floats, free: Bools, arm: float) -> Floats:
    """Inverse of a matrix of the three motions on its free part, of a length for rotations [m]."""
    # In units in which a rotation counts like a shift; directions that cells do not determine (all
    # slip, or there is one cell only) are left out.
    if np.count_nonzero(free) == 1:
        (only,) = np.flatnonzero(free)
        found, value = np.zeros((3, 3)), float(matrix[only, only])
        found[only, only] = 1 / value if value > 0 else 0.0
        return found
    units = np.where(free, [1.0, 1.0, 1 / arm], 0.0)
    scaled = matrix * np.outer(units, units)
    return np.asarray(np.linalg.pinv(scaled, rcond=1e-10, hermitian=True) * np.outer(units, units))
