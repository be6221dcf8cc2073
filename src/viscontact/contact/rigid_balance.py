"""Force and moment balance: planes c0 + c1 x + c2 y over cells, and what holds the body."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viscontact.loads import LoadPoint

#: Variance of position [cells²] below which cells count as one, or as a line: no tilt is known.
NO_EXTENT = 1e-9


@dataclass(frozen=True)
class Constraints:
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
    def of(cls, point: LoadPoint) -> Constraints:
        """Constraints by a force at an eccentricity or a stage, with the tilts that are prescribed.

        Parameters
        ----------
        point : LoadPoint
            Force and eccentricities or approach, and tilts (None where free).

        Returns
        -------
        Constraints
            A prescribed motion takes the place of its balance.
        """
        force = point.force or 0.0  # none is prescribed under an approach, nor then a moment
        return cls(
            (
                point.force,
                force * point.eccentricity_x if point.tilt_x is None else None,
                force * point.eccentricity_y if point.tilt_y is None else None,
            ),
            (point.approach or 0.0, point.tilt_x or 0.0, point.tilt_y or 0.0),
        )

    def halved(self, axis: int) -> Constraints:
        """Constraints of one half of a body that is even along an axis, so does not tilt along it.

        Parameters
        ----------
        axis : {0, 1}
            Across x = 0, or across y = 0.
        """
        halves = [None if each is None else each / 2 for each in self.resultants]
        motions = list(self.motions)
        halves[1 + axis], motions[1 + axis] = None, 0.0
        return Constraints((halves[0], halves[1], halves[2]), (motions[0], motions[1], motions[2]))

    def level(self) -> Constraints:
        """Constraints of one period of a body, which cannot tilt: its neighbours would not fit."""
        return Constraints((self.resultants[0], None, None), (self.motions[0], 0.0, 0.0))

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Which of the three motions the balances determine."""
        return np.array([resultant is not None for resultant in self.resultants])

    @cached_property
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
    mirrored : tuple of bool
        Whether the cells stand for their mirror images across x = 0, and across y = 0, as well:
        what is odd along that axis then sums up to 0.

    Examples
    --------
    >>> row = np.array([0.5, 1.5])
    >>> RigidPlane(row, row, (1.0, 1.0), (False, True)).sums(np.ones((2, 2))).tolist()
    [4.0, 4.0, 0.0]
    """

    def __init__(
        self,
        x: NDArray[np.float64],
        y: NDArray[np.float64],
        cell_size: tuple[float, float],
        mirrored: tuple[bool, bool] = (False, False),
    ) -> None:
        self._x, self._y = x, y
        self._mirrored = mirrored
        # In units of cells, so that "no extent along x" means the same on every grid.
        unit = np.array([1.0, 1 / cell_size[0], 1 / cell_size[1]])
        self._column, self._row = x * unit[1], y * unit[2]
        self._units = np.outer(unit, unit)

    def field(self, coefficients: NDArray[np.float64]) -> NDArray[np.float64]:
        """The plane c0 + c1 x + c2 y on the cells: a column for all of them if level along y."""
        along_x = coefficients[0] + coefficients[1] * self._x
        if coefficients[2] == 0:
            return np.asarray(along_x[:, None])
        return np.asarray(np.add.outer(along_x, coefficients[2] * self._y))

    def sums(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sums of a field against 1, x and y."""
        # Not as matrix products: BLAS would put threads to work, which cost more than they bring.
        along_x = values.sum(axis=1)
        moment_x = 0.0 if self._mirrored[0] else along_x @ self._x
        moment_y = 0.0 if self._mirrored[1] else values.sum(axis=0) @ self._y
        return np.array([along_x.sum(), moment_x, moment_y])

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
        return _inverse(self._moments(weight), free) * self._units

    def _moments(self, weight: NDArray[np.float64]) -> tuple[float, ...]:
        """Sums of weight times 1, x, y, x², xy, y², in units of cells; no squares if mirrored."""
        column, row = self._column, self._row
        x = y = xx = xy = yy = 0.0
        along_x = weight.sum(axis=1)
        n = along_x.sum()
        if not self._mirrored[0]:
            x, xx = along_x @ column, along_x @ column**2
        if not self._mirrored[1]:
            along_y = weight.sum(axis=0)
            y, yy = along_y @ row, along_y @ row**2
        if not any(self._mirrored):
            xy = column @ np.einsum("ij,j->i", weight, row)
        return tuple(map(float, (n, x, y, xx, xy, yy)))


def _inverse(moments: tuple[float, ...], free: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Rank-revealing inverse: the mean is eliminated first, if it is free, then the slopes.

    In plain numbers: it is called for every iteration, and arrays of three are slow.
    """
    n, x, y, xx, xy, yy = moments
    if n <= 0:
        return np.zeros((3, 3))
    mean, along_x, along_y = (float(is_free) for is_free in free)
    mx, my = mean * x / n, mean * y / n
    a, b, c = _pseudo_inverse(
        along_x * (xx - n * mx * mx),
        along_x * along_y * (xy - n * mx * my),
        along_y * (yy - n * my * my),
        NO_EXTENT * n,
    )
    to_x, to_y = -(a * mx + b * my), -(b * mx + c * my)
    head = mean / n - (mx * to_x + my * to_y)
    return np.array([[head, to_x, to_y], [to_x, a, b], [to_y, b, c]])


def _pseudo_inverse(
    xx: float, xy: float, yy: float, threshold: float
) -> tuple[float, float, float]:
    """Entries of the inverse of a symmetric 2 x 2 matrix, on its directions above a threshold."""
    middle, radius = (xx + yy) / 2, math.hypot((xx - yy) / 2, xy)
    if middle - radius > threshold:
        determinant = xx * yy - xy * xy
        return yy / determinant, -xy / determinant, xx / determinant
    if middle + radius > threshold:
        # Of rank one: the matrix is its only eigenvalue times a projector.
        square = (middle + radius) ** 2
        return xx / square, xy / square, yy / square
    return 0.0, 0.0, 0.0


def restore_balance(
    pressure: NDArray[np.float64],
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
    arm: float,
) -> NDArray[np.float64] | None:
    """A pressure times a plane, so that force and moments are as wanted again.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        Non-negative pressure [Pa].
    constraints : Constraints
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
    if not constraints.free.any():
        return pressure
    target = constraints.targets / cell_area
    for _ in range(20):
        # A correction to 1, so that what no balance asks for stays as it is.
        lacking = target - plane.sums(pressure)
        factor = plane.inverse_gram(pressure, constraints.free) @ lacking + np.array(
            [1.0, 0.0, 0.0]
        )
        scaled = pressure * plane.field(factor)
        if float(scaled.min()) >= 0:
            off = constraints.imbalance(plane.sums(scaled) * cell_area, arm)
            return scaled if off < 1e-9 else None
        pressure = np.maximum(scaled, 0.0)
    return None
