"""Influence coefficients: what a uniformly loaded cell does to the surface around it.

Geometry only. The displacement of a half-space of contact compliance J under a pressure p is
u = (J/π) ∫ p/r, so a coefficient is (1/π) ∫ dA/r over the loaded cell, and u = J Σ K p.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Beyond this many cell edges the closed form has lost digits to cancellation (about
#: (distance/edge)² of them) while a 4-point Gauss rule is exact to rounding.
FAR = 20.0

GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(4)


def influence_coefficient(
    x: ArrayLike, y: ArrayLike, cell_size: tuple[float, float]
) -> NDArray[np.float64]:
    """Displacement at a distance from a uniformly loaded rectangular cell.

    Parameters
    ----------
    x, y : array_like
        Offsets from the cell's centre [m]; they broadcast against each other.
    cell_size : tuple of float
        Edge lengths (dx, dy) of the loaded cell [m].

    Returns
    -------
    ndarray
        Displacement into the half-space per unit pressure and unit contact compliance [m],
        positive, shape of ``x + y``.

    Notes
    -----
    Near the cell: Love (1929), as in Johnson (1985), eq. 3.25, with inverse hyperbolic sines
    in place of logarithms of sums. Far away: the same integral by a 4 x 4 Gauss rule.

    References
    ----------
    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377.
    K. L. Johnson, Contact Mechanics, Cambridge (1985), section 3.3.

    Examples
    --------
    The centre of a loaded unit square sinks by 4 asinh(1)/π:

    >>> round(float(influence_coefficient(0.0, 0.0, (1.0, 1.0))), 6)
    1.1222
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    far = np.hypot(x, y) > FAR * max(cell_size)
    result = np.empty(x.shape)
    result[far] = _by_quadrature(x[far], y[far], cell_size)
    result[~far] = _in_closed_form(x[~far], y[~far], cell_size)
    return result / np.pi


def influence_table(shape: tuple[int, int], cell_size: tuple[float, float]) -> NDArray[np.float64]:
    """Influence coefficients of a cell at one corner of a block of cells.

    Parameters
    ----------
    shape : tuple of int
        Cells of the block along x and y.
    cell_size : tuple of float
        Edge lengths (dx, dy) of a cell [m].

    Returns
    -------
    ndarray, shape (nx, ny)
        Entry [i, j] for an offset of i and j cells [m]. All offsets of a grid follow by symmetry,
        and those of a smaller block are its leading part.

    Examples
    --------
    >>> influence_table((2, 2), (1.0, 1.0)).round(3).tolist()
    [[1.122, 0.33], [0.33, 0.231]]
    """
    x, y = (np.arange(cells) * cell for cells, cell in zip(shape, cell_size, strict=True))
    return influence_coefficient(x[:, None], y[None, :], cell_size)


def _in_closed_form(
    x: NDArray[np.float64], y: NDArray[np.float64], cell_size: tuple[float, float]
) -> NDArray[np.float64]:
    a, b = cell_size[0] / 2, cell_size[1] / 2
    return (
        _corner(x + a, y + b)
        - _corner(x + a, y - b)
        - _corner(x - a, y + b)
        + _corner(x - a, y - b)
    )


def _corner(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """The primitive x asinh(y/|x|) + y asinh(x/|y|) of 1/r in both directions; odd in both."""
    # On an axis the term that would divide by zero vanishes with its factor.
    along_y = np.arcsinh(np.divide(y, np.abs(x), out=np.zeros_like(y), where=x != 0))
    along_x = np.arcsinh(np.divide(x, np.abs(y), out=np.zeros_like(x), where=y != 0))
    return np.asarray(x * along_y + y * along_x)


def _by_quadrature(
    x: NDArray[np.float64], y: NDArray[np.float64], cell_size: tuple[float, float]
) -> NDArray[np.float64]:
    dx, dy = cell_size
    total, distance = np.zeros_like(x), np.empty_like(x)
    for node_x, weight_x in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
        along_x = np.square(x - node_x * dx / 2)
        for node_y, weight_y in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
            np.square(np.subtract(y, node_y * dy / 2, out=distance), out=distance)
            np.sqrt(np.add(along_x, distance, out=distance), out=distance)
            total += np.divide(weight_x * weight_y, distance, out=distance)
    return np.asarray(total * (dx * dy / 4))
