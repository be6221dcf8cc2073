"""Means of a formula over cells, which are divided where it is not smooth."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid

#: Values of a formula at points, of arrays that have one shape after broadcasting.
PointValues = Callable[[Floats, Floats], Floats]

#: Points over the half edge of a cell, and their weights.
Rule = tuple[Floats, Floats]

#: Gauss' rule; and Simpson's, whose outer points see an edge beside the border of a cell. They are
#: a little inside, as a formula may have no value on a border, such as that of a cone at its tip.
GAUSS: Rule = np.polynomial.legendre.leggauss(3)
SIMPSON: Rule = (np.array([-1 + 1e-6, 0.0, 1 - 1e-6]), np.array([1.0, 4.0, 1.0]) / 3)

#: Most times that a cell is halved along both axes.
HALVINGS = 13

#: Most parts at once, as a formula of noise would be divided everywhere.
MOST_PARTS = 2_000_000

#: Tolerance that the first halving is taken to reach, and each further one a quarter of it: so many
#: are done in any case, as rules may agree by chance on a cell that an edge crosses.
UNTRIED = 1e-3

#: Power of its share of a cell by which the error of a part counts, as errors along an edge are
#: of either sign.
OF_PARTS = 0.75

_SIDES = ((-1, -1), (-1, 1), (1, -1), (1, 1))


def cell_means(values: PointValues, grid: Grid, tolerance: float) -> Floats:
    """Mean over each cell, to a tolerance relative to the largest mean; (nx, ny).

    Gauss' and Simpson's rules on the cell, with three points along each axis, are compared with
    Gauss' on its quarters. Where they differ the quarters are divided further. With an infinite
    tolerance it is Gauss' rule on the cell.

    >>> square = Grid((4, 4), (2.0, 2.0))
    >>> circle = cell_means(lambda x, y: 1.0 * (x**2 + y**2 < 1), square, 1e-6)
    >>> print(f"{circle.sum() * square.cell_area:.4f}")
    3.1416
    """
    half = (grid.cell_size[0] / 2, grid.cell_size[1] / 2)
    x, y = grid.x[:, None], grid.y[None, :]
    whole = _mean(values, x, y, half, GAUSS)
    if np.isinf(tolerance):
        return whole
    found = _of_quarters(values, x, y, half).mean(axis=0)
    bound = tolerance * float(np.abs(found).max(initial=0.0))
    # Two rules, as one may agree by chance with that on the quarters.
    by_simpson = _mean(values, x, y, half, SIMPSON)
    rough = np.maximum(np.abs(found - whole), np.abs(found - by_simpson)) > bound
    if rough.any():
        x, y = (np.broadcast_to(each, grid.shape)[rough] for each in (x, y))
        found[rough] = _divided(values, x, y, half, bound, tolerance)
    return np.asarray(found)


def _mean(
    values: PointValues, x: Floats, y: Floats, half: tuple[float, float], rule: Rule
) -> Floats:
    """Means over cells of half edges around x, y by a rule."""
    total = np.zeros(np.broadcast_shapes(x.shape, y.shape))
    for node_x, share_x in zip(*rule, strict=True):
        for node_y, share_y in zip(*rule, strict=True):
            total += share_x * share_y / 4 * values(x + node_x * half[0], y + node_y * half[1])
    return total


def _of_quarters(values: PointValues, x: Floats, y: Floats, half: tuple[float, float]) -> Floats:
    """Means over the four quarters of cells by Gauss' rule, in a first dimension."""
    a, b = half[0] / 2, half[1] / 2
    return np.stack([_mean(values, x + i * a, y + j * b, (a, b), GAUSS) for i, j in _SIDES])


def _divided(
    values: PointValues,
    x: Floats,
    y: Floats,
    half: tuple[float, float],
    bound: float,
    tolerance: float,
) -> Floats:
    """Means over the cells around x, y (1-D) by quarters that are divided where it is needed."""
    total, owner, share = np.zeros(x.size), np.arange(x.size), 1.0
    whole, least = np.zeros(x.size), round(np.log(UNTRIED / tolerance) / np.log(4))
    for halvings in range(HALVINGS):
        quarters = _of_quarters(values, x, y, half)
        mean = quarters.mean(axis=0)
        fine = (halvings >= least) & (np.abs(mean - whole) * share**OF_PARTS <= bound)
        if 4 * np.count_nonzero(~fine) > MOST_PARTS:
            fine[:] = True
        np.add.at(total, owner[fine], share * mean[fine])
        rough = ~fine
        if not rough.any():
            break
        half, share = (half[0] / 2, half[1] / 2), share / 4
        x, y = (
            np.concatenate([each[rough] + side[axis] * half[axis] for side in _SIDES])
            for axis, each in ((0, x), (1, y))
        )
        owner, whole = np.tile(owner[rough], 4), quarters[:, rough].ravel()
    else:
        np.add.at(total, owner, share * whole)
    return total
