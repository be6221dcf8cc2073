"""Force and moment balances: constraints of the body, and planes c0 + c1 x + c2 y over cells."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import DTypeLike

from viscontact.backend.arrays import Bools, Floats, Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.backend.team import Team, blocks_of
from viscontact.bodies.loads import LoadPoint

_Found = TypeVar("_Found")

#: Sums of weight times 1, x, y, x², xy, y² over cells.
Moments = tuple[float, ...]

#: Size of a number of a field [bytes].
ITEM_BYTES = 8

#: Cells of a row whose places about its middle add up exactly in single precision.
MOST_EXACT_CELLS = 4096

#: Least force that imbalances are divided by [N].
LEAST_FORCE = float(np.finfo(float).tiny)

#: Variance of position [cells²] below which cells count as one, or as a line, without a known tilt.
NO_EXTENT = 1e-9


@dataclass(frozen=True)
class Constraints:
    """Constraints of the body: for each rigid motion its resultant, or the motion itself."""

    #: Force [N] and moments [N m] about the origin (integrals of p x and p y); None where the
    #: motion is prescribed.
    resultants: tuple[float | None, float | None, float | None]
    #: Approach [m], tilts along x and y [rad]; used where the resultant is None.
    motions: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @classmethod
    def of(cls, point: LoadPoint) -> Constraints:
        """Constraints of a load: force and moments, or the prescribed approach and tilts."""
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
        """Constraints of one half of a body that is even along an axis, so is level along it."""
        halves = [None if each is None else each / 2 for each in self.resultants]
        motions = list(self.motions)
        halves[1 + axis], motions[1 + axis] = None, 0.0
        return Constraints((halves[0], halves[1], halves[2]), (motions[0], motions[1], motions[2]))

    def level(self, axis: int) -> Constraints:
        """Constraints of one period of a body along an axis, along which it cannot tilt."""
        (force, *moments), (approach, *tilts) = self.resultants, self.motions
        moments[axis], tilts[axis] = None, 0.0
        return Constraints((force, moments[0], moments[1]), (approach, tilts[0], tilts[1]))

    @cached_property
    def free(self) -> Bools:
        """The motions that the balances determine."""
        return np.array(self.free_motions)

    @cached_property
    def free_motions(self) -> tuple[bool, bool, bool]:
        """The same as plain numbers."""
        approach, tilt_x, tilt_y = (resultant is not None for resultant in self.resultants)
        return approach, tilt_x, tilt_y

    @cached_property
    def targets(self) -> Floats:
        """Resultants, zero where the motion is prescribed."""
        return np.array(self.plain_targets)

    @cached_property
    def plain_targets(self) -> tuple[float, float, float]:
        """The same as plain numbers."""
        force, moment_x, moment_y = (float(each or 0.0) for each in self.resultants)
        return force, moment_x, moment_y

    def with_prescribed(self, motion: Floats) -> Floats:
        """A motion with its prescribed components set."""
        choices = zip(self.free_motions, motion.tolist(), self.motions, strict=True)
        return np.array([own if is_free else given for is_free, own, given in choices])

    def imbalance(self, sums: Floats, arm: float) -> float:
        """Largest error of `sums` [N, N m, N m] over the force or target; `arm` in [m]."""
        found, targets = sums.tolist(), self.plain_targets
        force = max(abs(targets[0]), abs(found[0]), LEAST_FORCE)
        errors = [
            abs(found[k] - targets[k]) / (force * (arm if k else 1.0))
            for k, is_free in enumerate(self.free_motions)
            if is_free
        ]
        # Not Python's `max`, which may pass over NaN.
        unknown = any(map(math.isnan, (found[0], *errors)))
        return math.nan if unknown else max(errors, default=0.0)


class RigidPlane:
    """Planes c0 + c1 x + c2 y on a block of cells, and sums of fields against 1, x, y.

    `x` and `y` are cell centres [m]. Mirrored cells count for their mirror images as well: sums
    that are odd along that axis vanish. Passes over fields go through blocks of rows, `each` a
    plane, by a `team`.
    """

    def __init__(
        self,
        x: Floats,
        y: Floats,
        cell_size: tuple[float, float],
        mirrored: tuple[bool, bool] = (False, False),
        team: Team | None = None,
        rows: slice | None = None,
    ) -> None:
        self._x, self._y = x, y
        self._mirrored, self._cell_size = mirrored, cell_size
        self.team = team or Team()
        #: Rows of a field that these cells are.
        self.rows = rows or slice(0, len(x))
        # In units of cells, so that NO_EXTENT means the same on every grid.
        unit = np.array([1.0, 1 / cell_size[0], 1 / cell_size[1]])
        self._column, self._row = x * unit[1], y * unit[2]
        self._units = np.outer(unit, unit)

    @property
    def cells(self) -> tuple[Floats, Floats, tuple[float, float], tuple[bool, bool], int]:
        """Cell centres [m] and sizes (dx, dy) [m], mirrored axes, and number of threads."""
        return self._x, self._y, self._cell_size, self._mirrored, self.team.threads

    @cached_property
    def of_core(self) -> Any:
        """The same cells in the team's compiled core; None without one."""
        return self.team.core and self.team.core.Plane(*self.cells)

    @cached_property
    def extents(self) -> Floats:
        """Largest values of 1, x and y over the cells [-, m, m]."""
        return np.array([1.0, np.abs(self._x).max(), np.abs(self._y).max()])

    def height(self, coefficients: Floats) -> float:
        """Upper limit of the plane's absolute values."""
        return float(np.abs(coefficients) @ self.extents)

    def column(self, row: int, column: int) -> Floats:
        """Values of 1, x and y of one cell [-, m, m]."""
        return np.array([1.0, self._x[row], self._y[column]])

    def field(self, coefficients: Floats, kind: DTypeLike = np.float64) -> Numbers:
        """The plane on the cells: one column for all of them if it is level along y."""
        along_x = (coefficients[0] + coefficients[1] * self._x).astype(kind, copy=False)
        if coefficients[2] == 0:
            return np.asarray(along_x[:, None])
        along_y = (coefficients[2] * self._y).astype(kind, copy=False)
        return np.asarray(np.add.outer(along_x, along_y))

    def each(self, work: Callable[[RigidPlane], _Found]) -> list[_Found]:
        """Work on each block of rows, and return what that gives, in their order."""
        return self.team.each(work, self._blocks)

    @cached_property
    def _blocks(self) -> list[RigidPlane]:
        lines = blocks_of(len(self._x), len(self._y) * ITEM_BYTES)
        if len(lines) == 1:
            return [self]
        return [
            RigidPlane(self._x[rows], self._y, self._cell_size, self._mirrored, rows=rows)
            for rows in lines
        ]

    def sums(self, values: Numbers) -> Floats:
        """Sums of a field against 1, x and y."""
        return added(self.each(lambda block: block.sums_of_rows(values[block.rows])))

    def sums_of_rows(self, values: Numbers) -> Floats:
        """Sums of the rows of one block against 1, x and y, at once."""
        # Not as matrix products: BLAS would start threads, which cost more than they save. Of a
        # matrix `einsum` takes half the time of `sum`.
        values = values.astype(np.float64, copy=False)
        along_x = np.einsum("ij->i", values)
        moment_x = 0.0 if self._mirrored[0] else along_x @ self._x
        moment_y = 0.0 if self._mirrored[1] else np.einsum("ij->j", values) @ self._y
        return np.array([along_x.sum(), moment_x, moment_y])

    def inverse_gram(self, weight: Numbers, free: Bools) -> Floats:
        """Pseudo-inverse of weighted sums of (1, x, y) (1, x, y)ᵀ over free coefficients."""
        # Where the cells determine only some coefficients (one cell, or a line of cells) the others
        # are of least norm about the cells' centre.
        moments = self.each(lambda block: block.moments_of_rows(weight[block.rows], free))
        return self.inverse_of(moments, free)

    def inverse_of(self, moments: Sequence[Moments], free: Bools) -> Floats:
        """Inverse of the moments of all blocks."""
        total = moments[0] if len(moments) == 1 else tuple(map(sum, zip(*moments, strict=True)))
        return _inverse(total, free) * self._units

    def moments_of_rows(self, weight: Numbers, free: Bools) -> Moments:
        """Sums of the rows' weights times 1, x, y, x², xy, y² in cells; 0 where none is needed."""
        # Only those of free tilts are, and of axes that are not mirrored.
        _, of_x, of_y = np.logical_and(free, [True, *np.logical_not(self._mirrored)]).tolist()
        column, row = self._column, self._row
        # Sums of up to 2^24 are exact in single precision, which takes half the time.
        is_exact = weight.dtype == bool and len(row) <= MOST_EXACT_CELLS
        weight = weight.astype(np.float32 if is_exact else np.float64, copy=False)
        x = y = xx = xy = yy = 0.0
        along_x = np.einsum("ij->i", weight).astype(np.float64)
        n = along_x.sum()
        if of_x:
            x, xx = along_x @ column, along_x @ column**2
        if of_y:
            along_y = np.einsum("ij->j", weight).astype(np.float64)
            y, yy = along_y @ row, along_y @ row**2
        if of_x and of_y:
            middle = float(row[0] + row[-1]) / 2 if is_exact else 0.0
            about = (row - middle).round(1).astype(np.float32) if is_exact else row
            along_y = np.einsum("ij,j->i", weight, about)
            xy = column @ (along_y + middle * along_x)
        return tuple(map(float, (n, x, y, xx, xy, yy)))


def added(parts: Sequence[Floats]) -> Floats:
    """Sum of the sums of all blocks."""
    return parts[0] if len(parts) == 1 else np.asarray(np.sum(parts, axis=0))


def _inverse(moments: tuple[float, ...], free: Bools) -> Floats:
    """Rank-revealing inverse: eliminates the mean first, if it is free, then the slopes."""
    # In plain numbers, as it is called in every iteration, and arrays of three are slow.
    n, x, y, xx, xy, yy = moments
    if n <= 0:
        return np.zeros((3, 3))
    mean, along_x, along_y = free.tolist()
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
    pressure: Floats,
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
    arm: float,
) -> Floats | None:
    """Cut off tension and multiply by a plane that restores the resultants; None if none can."""
    restored = pressure.copy()
    return restored if balance(restored, constraints, plane, cell_area, arm) else None


def balance(
    pressure: Floats,
    constraints: Constraints,
    plane: RigidPlane,
    cell_area: float,
    arm: float,
) -> bool:
    """Balance a pressure as `restore_balance` does, in its own memory; False if it cannot be."""
    target = constraints.targets / cell_area

    def cut(block: RigidPlane) -> tuple[Floats, Moments]:
        here = pressure[block.rows]
        np.maximum(here, 0.0, out=here)
        return block.sums_of_rows(here), block.moments_of_rows(here, constraints.free)

    def scaled(block: RigidPlane) -> tuple[Floats, float]:
        here = pressure[block.rows]
        here *= block.field(factor)
        return block.sums_of_rows(here), float(here.min())

    for _ in range(20):
        sums, moments = zip(*plane.each(cut), strict=True)
        if not constraints.free.any():
            return True
        # A correction to 1, so that the factor is 1 where all balances are met.
        lacking = target - added(sums)
        inverse = plane.inverse_of(moments, constraints.free)
        factor = inverse @ lacking + np.array([1.0, 0.0, 0.0])
        sums, least = zip(*plane.each(scaled), strict=True)
        if min(least) >= 0:
            return constraints.imbalance(added(sums) * cell_area, arm) < 1e-9
    return False
