"""Influence coefficients of a uniformly loaded rectangle (Love 1929).

Under a pressure p (positive in compression) the surface of a half-space of contact compliance J
is displaced into the body by u(x, y) = (J/π) ∫∫ p(x', y') / r dx' dy', with r the distance on the
surface. For a unit pressure on a rectangle of edges 2a and 2b around the origin, and J = 1,

    K(x, y) = (1/π) ∫∫ dx' dy' / r
            = (1/π) [F(x+a, y+b) - F(x+a, y-b) - F(x-a, y+b) + F(x-a, y-b)] > 0   [m],
    F(x, y) = x asinh(y/|x|) + y asinh(x/|y|),

and u = J Σ K p over the cells. The integrand 1/r is singular inside the rectangle, K is not: F is
continuous, with F = 0 on the axes, so K is finite at the centre, on the edges and at the corners.

References
----------
A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377.
K. L. Johnson, Contact Mechanics, Cambridge (1985), section 3.3, eq. 3.25, with logarithms of
sums, which lose digits, in place of the inverse hyperbolic sines.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.halfspace.line_blocks import Team, blocks_of

#: Beyond this many cell edges the difference of four corner terms cancels, by a factor of about
#: (distance/edge)², while the 4 x 4 Gauss rule is exact to rounding.
FAR = 20.0

GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(4)


def influence_coefficient(
    x: ArrayLike, y: ArrayLike, cell_size: tuple[float, float]
) -> NDArray[np.float64]:
    """Displacement [m] at offsets x, y [m] from the centre of a cell, per unit p and unit J.

    Positive into the half-space; the shape is that of ``x + y``. Closed form near the cell, Gauss
    quadrature of the same integral far from it.

    The centre of a loaded unit square is displaced by 4 asinh(1)/π:

    >>> round(float(influence_coefficient(0.0, 0.0, (1.0, 1.0))), 6)
    1.1222
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    far = np.hypot(x, y) > FAR * max(cell_size)
    result = np.empty(x.shape)
    result[far] = _gauss_quadrature(x[far], y[far], cell_size)
    result[~far] = _closed_form(x[~far], y[~far], cell_size)
    return result / np.pi


def influence_table(
    shape: tuple[int, int], cell_size: tuple[float, float], team: Team | None = None
) -> NDArray[np.float64]:
    """Influence coefficients [m] at offsets of i and j cells from a loaded cell, shape (nx, ny).

    All other offsets follow by symmetry; the table of a smaller block is its leading part. The
    rows are shared out among the threads of a team.

    >>> influence_table((2, 2), (1.0, 1.0)).round(3).tolist()
    [[1.122, 0.33], [0.33, 0.231]]
    """
    x, y = (np.arange(cells) * cell for cells, cell in zip(shape, cell_size, strict=True))
    table = np.empty(shape)

    def compute(rows: slice) -> None:
        table[rows] = influence_coefficient(x[rows, None], y[None, :], cell_size)

    (team or Team()).each(compute, blocks_of(shape[0], y.nbytes))
    return table


def _closed_form(
    x: NDArray[np.float64], y: NDArray[np.float64], cell_size: tuple[float, float]
) -> NDArray[np.float64]:
    a, b = cell_size[0] / 2, cell_size[1] / 2
    # The double integral is the double difference of its primitive over the corners.
    return (
        _corner(x + a, y + b)
        - _corner(x + a, y - b)
        - _corner(x - a, y + b)
        + _corner(x - a, y - b)
    )


def _corner(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """F(x, y) = x asinh(y/|x|) + y asinh(x/|y|): primitive of 1/r in x and y, odd in both."""
    # On an axis (x = 0 or y = 0) the singular asinh is multiplied by 0: its limit is 0.
    along_y = np.arcsinh(np.divide(y, np.abs(x), out=np.zeros_like(y), where=x != 0))
    along_x = np.arcsinh(np.divide(x, np.abs(y), out=np.zeros_like(x), where=y != 0))
    return np.asarray(x * along_y + y * along_x)


def _gauss_quadrature(
    x: NDArray[np.float64], y: NDArray[np.float64], cell_size: tuple[float, float]
) -> NDArray[np.float64]:
    # 4 x 4 Gauss-Legendre rule for ∫ dA/r over the cell; the weights of [-1, 1] sum to 2.
    dx, dy = cell_size
    total, distance = np.zeros_like(x), np.empty_like(x)
    for node_x, weight_x in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
        along_x = np.square(x - node_x * dx / 2)
        for node_y, weight_y in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
            np.square(np.subtract(y, node_y * dy / 2, out=distance), out=distance)
            np.sqrt(np.add(along_x, distance, out=distance), out=distance)
            total += np.divide(weight_x * weight_y, distance, out=distance)
    return np.asarray(total * (dx * dy / 4))
