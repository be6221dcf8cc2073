"""Force and moment balance: planes c0 + c1 x + c2 y over the grid, and what holds the body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.grid import Grid
from viscontact.load import LoadPoint


@dataclass(frozen=True)
class Support:
    """What holds the body: for each rigid motion either its resultant or the motion itself.

    Attributes
    ----------
    resultants : tuple of (float or None)
        Force [N] and moments [N m] of the pressure about the origin (integrals of p x and p y);
        None where the motion is prescribed instead.
    motions : tuple of float
        Approach [m], tilt along x, tilt along y [rad]; used where the resultant is None.
    """

    resultants: tuple[float | None, float | None, float | None]
    motions: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @classmethod
    def of(cls, point: LoadPoint) -> Support:
        """Support by a force at an eccentricity, with the tilts that are prescribed.

        Parameters
        ----------
        point : LoadPoint
            Force, eccentricities, and tilts (None where free).

        Returns
        -------
        Support
            A prescribed tilt takes the place of its moment.
        """
        return cls(
            (
                point.force,
                point.force * point.eccentricity_x if point.tilt_x is None else None,
                point.force * point.eccentricity_y if point.tilt_y is None else None,
            ),
            (0.0, point.tilt_x or 0.0, point.tilt_y or 0.0),
        )

    @property
    def free(self) -> NDArray[np.intp]:
        """Indices of the motions that the balances determine."""
        return np.flatnonzero([resultant is not None for resultant in self.resultants])

    @property
    def targets(self) -> NDArray[np.float64]:
        """Resultants, zero where the motion is prescribed."""
        return np.array([resultant or 0.0 for resultant in self.resultants])

    def prescribed_motion(self) -> NDArray[np.float64]:
        """Motions, zero where they are to be found."""
        return self.with_prescribed(np.zeros(3))

    def with_prescribed(self, motion: NDArray[np.float64]) -> NDArray[np.float64]:
        """A motion with the prescribed components put in place."""
        result = np.array(self.motions, dtype=float)
        result[self.free] = motion[self.free]
        return result

    def imbalance(self, sums: NDArray[np.float64], arm: float) -> float:
        """Largest relative error of the balances.

        Parameters
        ----------
        sums : ndarray, shape (3,)
            Resultants of a pressure [N, N m, N m].
        arm : float
            Length that turns a moment's error into a force's [m].

        Returns
        -------
        float
            Relative to the pressure's own resultant or the target, the larger.
        """
        force = max(abs(self.targets[0]), abs(float(sums[0])), np.finfo(float).tiny)
        error = (sums - self.targets) / (force * np.array([1.0, arm, arm]))
        return float(np.abs(error[self.free]).max(initial=0.0))


class RigidPlane:
    """Planes c0 + c1 x + c2 y on a grid, and sums of fields against 1, x, y.

    Parameters
    ----------
    grid : Grid
        Where the fields live.
    """

    def __init__(self, grid: Grid) -> None:
        self._x, self._y = grid.x, grid.y
        self._cell = np.array(grid.cell_size)
        self._powers_x = np.stack([np.ones_like(self._x), self._x, self._x**2])
        self._powers_y = np.stack([np.ones_like(self._y), self._y, self._y**2])

    def field(self, coefficients: NDArray[np.float64]) -> NDArray[np.float64]:
        """The plane c0 + c1 x + c2 y on every cell."""
        along_x = coefficients[0] + coefficients[1] * self._x
        return np.asarray(along_x[:, None] + coefficients[2] * self._y[None, :])

    def sums(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sums of a field against 1, x and y."""
        partial = self._powers_x[:2] @ values
        return np.array([partial[0].sum(), partial[1].sum(), partial[0] @ self._y])

    def extent(self, contact: NDArray[np.bool_]) -> float:
        """Larger edge of the box around the contact, at least one cell [m]."""
        spans = [
            np.ptp(np.flatnonzero(contact.any(axis))) + 1 if contact.any() else 1 for axis in (1, 0)
        ]
        return float(np.max(self._cell * spans))

    def fit(
        self, values: NDArray[np.float64], where: NDArray[np.bool_], free: NDArray[np.intp]
    ) -> NDArray[np.float64]:
        """Least-squares plane through a field over part of the grid.

        Parameters
        ----------
        values : ndarray
            Field; read only where ``where`` is true.
        where : ndarray of bool
            The part of the grid.
        free : ndarray of int
            Which of the three coefficients may differ from zero.

        Returns
        -------
        ndarray, shape (3,)
            Coefficients; of least norm about the part's centre where it is too small to
            determine all of them (one cell, or a line of cells).
        """
        return self.solve(where.astype(float), self.sums(np.where(where, values, 0.0)), free)

    def solve(
        self, weight: NDArray[np.float64], target: NDArray[np.float64], free: NDArray[np.intp]
    ) -> NDArray[np.float64]:
        """Plane whose product with a weight has the given sums against 1, x, y."""
        moments = self._powers_x @ weight @ self._powers_y.T
        gram = np.array(
            [
                [moments[0, 0], moments[1, 0], moments[0, 1]],
                [moments[1, 0], moments[2, 0], moments[1, 1]],
                [moments[0, 1], moments[1, 1], moments[0, 2]],
            ]
        )
        # In units of cells, so that "no extent along x" means the same on every grid.
        unit = np.array([1.0, *(1 / self._cell)])
        scaled = (gram * np.outer(unit, unit))[np.ix_(free, free)]
        result = np.zeros(3)
        result[free] = _solve_rank_revealing(scaled, (target * unit)[free], 0 in free)
        return np.asarray(result * unit)


def _solve_rank_revealing(
    gram: NDArray[np.float64], target: NDArray[np.float64], centred: bool
) -> NDArray[np.float64]:
    """Normal equations by elimination of the mean, then a pseudo-inverse of the rest."""
    threshold = (
        1e-9 * max(float(np.trace(gram)) / len(gram), np.finfo(float).tiny) if len(gram) else 0
    )
    if not centred:
        return _pseudo_inverse(gram, threshold) @ target
    mass = gram[0, 0]
    if mass <= 0:
        return np.zeros(len(gram))
    centre = gram[0, 1:] / mass
    tail = _pseudo_inverse(gram[1:, 1:] - mass * np.outer(centre, centre), 1e-9 * mass) @ (
        target[1:] - centre * target[0]
    )
    return np.concatenate([[target[0] / mass - centre @ tail], tail])


def _pseudo_inverse(matrix: NDArray[np.float64], threshold: float) -> NDArray[np.float64]:
    values, vectors = np.linalg.eigh(matrix)
    kept = values > threshold
    inverse = np.divide(1.0, values, out=np.zeros_like(values), where=kept)
    return np.asarray((vectors * inverse) @ vectors.T)


def restore_balance(
    pressure: NDArray[np.float64], support: Support, plane: RigidPlane, cell_area: float
) -> NDArray[np.float64] | None:
    """A pressure times a plane, so that force and moments are as wanted again.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        Non-negative pressure [Pa].
    support : Support
        The wanted resultants.
    plane : RigidPlane
        The grid's planes.
    cell_area : float
        Area of a cell [m²].

    Returns
    -------
    ndarray or None
        Non-negative balanced pressure; None if this support cannot carry the resultants.
    """
    target = support.targets / cell_area
    for _ in range(20):
        factor = plane.field(plane.solve(pressure, target, support.free))
        scaled = pressure * factor
        if float(scaled.min()) >= 0:
            sums = plane.sums(scaled) * cell_area
            return scaled if support.imbalance(sums, plane.extent(scaled > 0)) < 1e-9 else None
        pressure = np.maximum(scaled, 0.0)
    return None


def bedding_pressure(
    open_gap: NDArray[np.float64],
    compliance: float,
    support: Support,
    grid: Grid,
    plane: RigidPlane,
) -> NDArray[np.float64]:
    """Balanced pressure of the same body on an elastic bedding (Winkler), a start for iterations.

    The bedding's stiffness is matched to the half-space by its own contact size.

    Parameters
    ----------
    open_gap : ndarray, shape (nx, ny)
        Gap without pressure and motion [m], +inf where there is no body.
    compliance : float
        Contact compliance [1/Pa].
    support : Support
        Wanted resultants or prescribed motions.
    grid : Grid
        The cells.
    plane : RigidPlane
        The grid's planes.

    Returns
    -------
    ndarray, shape (nx, ny)
        Non-negative pressure [Pa].
    """
    gap = open_gap - plane.field(support.prescribed_motion())
    size = np.sqrt(grid.cell_area * 100)
    pressure = np.zeros(grid.shape)
    for _ in range(4):
        stiffness = 1 / (compliance * size)
        pressure = stiffness * _penetration(gap, stiffness, support, grid.cell_area, plane)
        size = np.sqrt(grid.cell_area * max(int((pressure > 0).sum()), 1))
    return pressure


def _penetration(
    gap: NDArray[np.float64],
    stiffness: float,
    support: Support,
    cell_area: float,
    plane: RigidPlane,
) -> NDArray[np.float64]:
    """Overlap of a balanced body with a bedding: damped Newton on a convex energy."""
    target = support.targets / (stiffness * cell_area)
    free = support.free
    # Deep enough that one cell alone would carry the force: Newton comes down from there.
    motion = np.array([float(gap.min()) + target[0], 0.0, 0.0])
    energy, overlap = _energy(gap, motion, target, plane)
    for _ in range(60):
        unbalanced = target - plane.sums(overlap)
        step = plane.solve((overlap > 0).astype(float), unbalanced, free)
        length = 1.0
        while length > 1e-6:
            trial_energy, trial = _energy(gap, motion + length * step, target, plane)
            if trial_energy <= energy:
                break
            length /= 2
        motion, overlap = motion + length * step, trial
        if energy - trial_energy <= 1e-14 * abs(energy):
            break
        energy = trial_energy
    return overlap


def _energy(
    gap: NDArray[np.float64],
    motion: NDArray[np.float64],
    target: NDArray[np.float64],
    plane: RigidPlane,
) -> tuple[float, NDArray[np.float64]]:
    overlap = np.maximum(plane.field(motion) - gap, 0.0)
    return float(np.vdot(overlap, overlap) / 2 - target @ motion), overlap
