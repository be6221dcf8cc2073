"""Stress influence coefficients of a uniformly loaded rectangle (Love 1929).

They depend on geometry and Poisson's ratio only: in a half-space loaded at its surface by pressure
alone, the stresses do not depend on the modulus.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

#: The components of a stress tensor, in the order in which they are stacked.
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")


def stress_coefficients(
    x_edges: NDArray[np.float64],
    y_edges: NDArray[np.float64],
    depth: float,
    poisson_ratio: float,
) -> NDArray[np.float64]:
    """Stress at a point per unit pressure on each cell of a block [-], tension positive.

    Components xx, yy, zz, yz, xz, xy, shape (6, nx, ny). `x_edges` and `y_edges` are the point's
    coordinates minus those of the cells' edges, descending [m]; `depth` >= 0 [m], and at 0 not on
    a cell's edge, where the stress jumps.

    Notes
    -----
    Love's potentials of a rectangle, V = ∫ dA/r and χ = ∫ ln(z + r) dA, in whose derivatives each
    corner has a term: with λ and μ eliminated,

        σxx = (2ν V_z - (1 - 2ν) χ_xx - z V_xx)/2π,    σzz = (V_z - z V_zz)/2π,
        σxz = -z V_xz/2π,                              σxy = -((1 - 2ν) χ_xy + z V_xy)/2π,

    and likewise with y for x. The sums r + x and r + y are formed without cancellation.

    References
    ----------
    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377.

    Examples
    --------
    In the middle of a loaded square, at the surface, all normal stresses are -p for ν = 0.5:

    >>> import numpy as np
    >>> edges = np.array([1.0, -1.0])
    >>> stress_coefficients(edges, edges, 0.0, 0.5)[:3].ravel().round(9).tolist()
    [-1.0, -1.0, -1.0]
    """
    corners = _corner_terms(x_edges[:, None], y_edges[None, :], depth, poisson_ratio)
    return np.diff(np.diff(corners, axis=1), axis=2) / (2 * np.pi)


def _corner_terms(
    x: NDArray[np.float64], y: NDArray[np.float64], z: float, poisson_ratio: float
) -> NDArray[np.float64]:
    """Corner terms of all components; a cell's stress is their double difference."""
    incompressible, rest = 2 * poisson_ratio, 1 - 2 * poisson_ratio
    r = np.sqrt(x * x + y * y + z * z)
    to_x, to_y = _sum_with_root(x, y, z, r), _sum_with_root(y, x, z, r)
    v_z = -np.arctan2(x * y, z * r)
    v_xx, v_yy, v_xy = x / (r * to_y), y / (r * to_x), 1 / r
    chi_xx = _angle(y, x) - _angle(z * y, x * r)
    chi_yy = _angle(x, y) - _angle(z * x, y * r)
    return np.stack(
        [
            incompressible * v_z - rest * chi_xx - z * v_xx,
            incompressible * v_z - rest * chi_yy - z * v_yy,
            v_z + z * (v_xx + v_yy),
            -z * z / (r * to_x),
            -z * z / (r * to_y),
            -rest * np.log(z + r) - z * v_xy,
        ]
    )


def _sum_with_root(
    along: NDArray[np.float64], across: NDArray[np.float64], z: float, r: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Sum r + along; where along < 0, as (across² + z²) / (r - along), without cancellation."""
    return np.where(along >= 0, r + along, (across * across + z * z) / (r + np.abs(along)))


def _angle(opposite: NDArray[np.float64], adjacent: NDArray[np.float64]) -> NDArray[np.float64]:
    """arctan(opposite/adjacent), between -π/2 and π/2."""
    return np.arctan2(opposite * np.sign(adjacent), np.abs(adjacent))
