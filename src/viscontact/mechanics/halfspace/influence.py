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
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.team import Team, blocks_of

#: Beyond this many cell edges the difference of four corner terms cancels, by a factor of about
#: (distance/edge)², while Taylor's series to the sixth order is exact to 5e-14.
FAR = 20.0

#: Temporary fields of the series, which stay in the cache together.
WORK_FIELDS = 4

#: Terms of the series for ∫∫ dA/r, by powers of u = x²/r²: of the second order for a² and b², the
#: fourth for a⁴, a²b² and b⁴, the sixth for a⁶, a⁴b², a²b⁴ and b⁶. Each is a moment of the cell,
#: such as the mean a⁴/5 of x'⁴, times a derivative of 1/r.
SECOND = np.array([[-1, 3], [2, -3]]) / 6
FOURTH = np.array([[3, -30, 35], [-12, 105, -105], [8, -40, 35]]) / [[40], [36], [40]]
SIXTH = np.array(
    [
        [-5, 105, -315, 231],
        [270, -5355, 15120, -10395],
        [-360, 6300, -16065, 10395],
        [16, -168, 378, -231],
    ]
) / [[112], [720], [720], [112]]


def influence_coefficient(x: ArrayLike, y: ArrayLike, cell_size: tuple[float, float]) -> Floats:
    """Displacement into the body [m] at x, y [m] from a cell's centre, per unit p and J."""
    # Closed form near the cell, Taylor's series of the same integral far from it.
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    squared = np.square(x) + np.square(y)
    limit = (FAR * max(cell_size)) ** 2
    near = squared <= limit
    # Near the cell the series is not used; there the distance is replaced, as it may be zero.
    result = _series(np.square(x), np.maximum(squared, limit), cell_size)
    x, y = np.broadcast_arrays(x, y)
    result[near] = _closed_form(x[near], y[near], cell_size)
    return result / np.pi


def influence_table(
    shape: tuple[int, int], cell_size: tuple[float, float], team: Team | None = None
) -> Floats:
    """Influence coefficients [m] at i, j >= 0 cells from a loaded cell, shape (nx, ny)."""
    x, y = (np.arange(cells) * cell for cells, cell in zip(shape, cell_size, strict=True))
    table = np.empty(shape)

    def compute(rows: slice) -> None:
        table[rows] = influence_coefficient(x[rows, None], y[None, :], cell_size)

    (team or Team()).each(compute, blocks_of(shape[0], WORK_FIELDS * y.nbytes))
    return table


def _closed_form(x: Floats, y: Floats, cell_size: tuple[float, float]) -> Floats:
    a, b = cell_size[0] / 2, cell_size[1] / 2
    # The double integral is the double difference of its primitive over the corners.
    return (
        _corner(x + a, y + b)
        - _corner(x + a, y - b)
        - _corner(x - a, y + b)
        + _corner(x - a, y - b)
    )


def _corner(x: Floats, y: Floats) -> Floats:
    """F(x, y) = x asinh(y/|x|) + y asinh(x/|y|): primitive of 1/r in x and y, odd in both."""
    # On an axis (x = 0 or y = 0) the singular asinh is multiplied by 0: its limit is 0.
    along_y = np.arcsinh(np.divide(y, np.abs(x), out=np.zeros_like(y), where=x != 0))
    along_x = np.arcsinh(np.divide(x, np.abs(y), out=np.zeros_like(x), where=y != 0))
    return np.asarray(x * along_y + y * along_x)


def _series(x_squared: Floats, squared: Floats, cell_size: tuple[float, float]) -> Floats:
    """∫∫ dA/r by Taylor's series of 1/r about the centre of the cell, of x² and r²."""
    a2, b2 = cell_size[0] ** 2 / 4, cell_size[1] ** 2 / 4
    second = np.array([a2, b2]) @ SECOND
    fourth = np.array([a2 * a2, a2 * b2, b2 * b2]) @ FOURTH
    sixth = np.array([a2**3, a2 * a2 * b2, a2 * b2 * b2, b2**3]) @ SIXTH
    inverse = np.asarray(1 / squared)
    u = np.asarray(x_squared * inverse)
    total, term = np.zeros(u.shape), np.empty(u.shape)
    # Horner's scheme in 1/r², and for each term in u.
    for coefficients in (sixth, fourth, second, np.ones(1)):
        term[...] = coefficients[-1]
        for coefficient in coefficients[-2::-1]:
            term *= u
            term += coefficient
        total *= inverse
        total += term
    total *= np.sqrt(inverse, out=inverse)
    total *= cell_size[0] * cell_size[1]
    return total
