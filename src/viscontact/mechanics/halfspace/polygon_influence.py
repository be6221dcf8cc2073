"""Displacement of a half-space by a linear pressure on a polygon, in closed form.

With r the distance from a point on the surface, the pressure p + g·(x' - x) of a polygon displaces
it by J/π ∫ (p + g·(x' - x))/r dA', with p the value that the linear pressure has, or would have, at
the point. By Gauss' theorem both parts are sums over the edges, as 1/r is the divergence of
(x' - x)/r, and (x' - x)/r the gradient of r:

    ∫ dA'/r = Σ d [asinh(t₂/|d|) - asinh(t₁/|d|)],        ∫ (x' - x)/r dA' = Σ n ∫ r dt,
    ∫ r dt = {t₂ r₂ - t₁ r₁ + d² [asinh(t₂/|d|) - asinh(t₁/|d|)]}/2,

where the edge, which has the outer normal n, lies at the distance d = n·(x' - x) of either sign,
and goes from t₁ to t₂ along itself, with its ends at r₁ and r₂.

References
----------
K. L. Johnson, Contact Mechanics, Cambridge (1985), eq. 3.25, for a rectangle.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats


def edge_integrals(x: float, y: float, edges: Floats) -> Floats:
    """Displacement at x, y per 1/E* by the edges of polygons, whose sum is that by the polygons.

    Parameters
    ----------
    x, y : float
        Place on the surface [m].
    edges : ndarray, shape (edges, 4)
        From x, y to x, y, counter-clockwise around each polygon [m].

    Returns
    -------
    ndarray, shape (3, edges)
        Under a uniform pressure of 1 Pa [Pa m], and under pressures that rise by 1 Pa/m along x and
        along y and vanish at the origin [Pa m]; positive into the body.

    Examples
    --------
    A square of 2 m under 1 Pa, at its centre: 1.122 of 2 p a/E* (Johnson 1985, eq. 3.26).

    >>> square = [[-1, -1, 1, -1], [1, -1, 1, 1], [1, 1, -1, 1], [-1, 1, -1, -1]]
    >>> each = edge_integrals(0.0, 0.0, np.array(square, float))
    >>> print(f"{each[0].sum() / 2:.4f} {abs(each[1:].sum(axis=1)).max():.4f}")
    1.1222 0.0000
    """
    by_level, by_slope, normal_x, normal_y = _integrals(x, y, edges)
    along, across = x * by_level + normal_x * by_slope, y * by_level + normal_y * by_slope
    return np.array([by_level, along, across]) / np.pi


def _integrals(x: float, y: float, edges: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Parts of the edges in ∫ dA'/r and ∫ r dt, and their outer normals."""
    start_x, start_y, end_x, end_y = edges.T - np.array([x, y, x, y])[:, None]
    along_x, along_y = end_x - start_x, end_y - start_y
    length = np.hypot(along_x, along_y)
    along_x, along_y = along_x / length, along_y / length
    distance = start_x * along_y - start_y * along_x
    first, last = start_x * along_x + start_y * along_y, end_x * along_x + end_y * along_y
    far = np.abs(distance)
    # A point in line with the edge gets nothing from it in either integral but for r dt.
    far = np.where(far > 0, far, 1.0)
    angles = np.where(distance != 0, np.arcsinh(last / far) - np.arcsinh(first / far), 0.0)
    radii = last * np.hypot(end_x, end_y) - first * np.hypot(start_x, start_y)
    by_slope = (radii + distance**2 * angles) / 2
    return distance * angles, by_slope, along_y, -along_x
