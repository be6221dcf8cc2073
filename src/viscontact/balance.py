"""Force and moment balance: planes c0 + c1 x + c2 y over cells, and what holds the body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viscontact.load import LoadPoint

#: Variance of position [cells²] below which cells count as one, or as a line: no tilt is known.
NO_EXTENT = 1e-9


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

    def halved(self) -> Support:
        """Support of one half of a body that is even across y = 0: it does not tilt along y."""
        force, moment_x, _ = self.resultants
        return Support(
            (
                None if force is None else force / 2,
                None if moment_x is None else moment_x / 2,
                None,
            ),
            (self.motions[0], self.motions[1], 0.0),
        )

    @property
    def free(self) -> NDArray[np.bool_]:
        """Which of the three motions the balances determine."""
        return np.array([resultant is not None for resultant in self.resultants])

    @property
    def targets(self) -> NDArray[np.float64]:
        """Resultants, zero where the motion is prescribed."""
        return np.array([resultant or 0.0 for resultant in self.resultants])

    def with_prescribed(self, motion: NDArray[np.float64]) -> NDArray[np.float64]:
        """A motion with the prescribed components put in place."""
        return np.where(self.free, motion, np.array(self.motions))

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
    """Planes c0 + c1 x + c2 y on a block of cells, and sums of fields against 1, x, y.

    Parameters
    ----------
    x, y : ndarray
        Cell centres [m].
    cell_size : tuple of float
        Edge lengths (dx, dy) of a cell [m].
    """

    def __init__(
        self, x: NDArray[np.float64], y: NDArray[np.float64], cell_size: tuple[float, float]
    ) -> None:
        self._x, self._y = x, y
        # In units of cells, so that "no extent along x" means the same on every grid.
        self._unit = np.array([1.0, 1 / cell_size[0], 1 / cell_size[1]])
        self._powers_x = (x * self._unit[1]) ** np.arange(3)[:, None]
        self._powers_y = (y * self._unit[2]) ** np.arange(3)[:, None]

    def field(self, coefficients: NDArray[np.float64]) -> NDArray[np.float64]:
        """The plane c0 + c1 x + c2 y on every cell."""
        along_x = coefficients[0] + coefficients[1] * self._x
        return np.asarray(np.add.outer(along_x, coefficients[2] * self._y))

    def sums(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sums of a field against 1, x and y."""
        rows, columns = values @ self._powers_y[:2].T, self._powers_x[:2]
        sums = np.array([rows[:, 0].sum(), columns[1] @ rows[:, 0], rows[:, 1].sum()])
        return np.asarray(sums / self._unit)

    def inverse_gram(
        self, weight: NDArray[np.float64], free: NDArray[np.bool_]
    ) -> NDArray[np.float64]:
        """Turn weighted sums against 1, x, y into the plane that has them.

        Parameters
        ----------
        weight : ndarray, shape (nx, ny)
            Non-negative weight of each cell.
        free : ndarray of bool, shape (3,)
            Which coefficients may differ from zero.

        Returns
        -------
        ndarray, shape (3, 3)
            Pseudo-inverse of the sums of weight (1, x, y) (1, x, y)ᵀ; where the cells determine
            only some coefficients (one cell, or a line of cells) the others are of least norm
            about the cells' centre.
        """
        (n, y, yy), (x, xy, _), (xx, _, _) = self._powers_x @ weight @ self._powers_y.T
        gram = np.array([[n, x, y], [x, xx, xy], [y, xy, yy]])
        return _inverse(gram, free) * np.outer(self._unit, self._unit)


def _inverse(gram: NDArray[np.float64], free: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Rank-revealing inverse: the mean is eliminated first, if it is free, then the slopes."""
    result = np.zeros((3, 3))
    mass = gram[0, 0]
    if mass <= 0:
        return result
    centre = gram[0, 1:] / mass if free[0] else np.zeros(2)
    spread = gram[1:, 1:] - mass * np.outer(centre, centre)
    inner = _pseudo_inverse(spread * np.outer(free[1:], free[1:]), NO_EXTENT * mass)
    result[1:, 1:] = inner
    if free[0]:
        result[0, 1:] = result[1:, 0] = -inner @ centre
        result[0, 0] = 1 / mass + centre @ inner @ centre
    return result


def _pseudo_inverse(matrix: NDArray[np.float64], threshold: float) -> NDArray[np.float64]:
    """Inverse of a symmetric 2 x 2 matrix over its directions of more than a threshold."""
    values, vectors = np.linalg.eigh(matrix)
    inverse = np.divide(1.0, values, out=np.zeros(2), where=values > threshold)
    return np.asarray((vectors * inverse) @ vectors.T)


def restore_balance(
    pressure: NDArray[np.float64],
    support: Support,
    plane: RigidPlane,
    cell_area: float,
    arm: float,
) -> NDArray[np.float64] | None:
    """A pressure times a plane, so that force and moments are as wanted again.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        Non-negative pressure [Pa].
    support : Support
        The wanted resultants.
    plane : RigidPlane
        The planes of these cells.
    cell_area : float
        Area of a cell [m²].
    arm : float
        Length that turns a moment's error into a force's [m].

    Returns
    -------
    ndarray or None
        Non-negative balanced pressure; None if these cells cannot carry the resultants.
    """
    target = support.targets / cell_area
    for _ in range(20):
        factor = plane.inverse_gram(pressure, support.free) @ target
        scaled = pressure * plane.field(factor)
        if float(scaled.min()) >= 0:
            off = support.imbalance(plane.sums(scaled) * cell_area, arm)
            return scaled if off < 1e-9 else None
        pressure = np.maximum(scaled, 0.0)
    return None
