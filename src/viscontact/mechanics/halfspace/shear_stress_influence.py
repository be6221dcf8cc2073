"""Stress influence coefficients of a rectangle under uniform shear traction (Cerruti).

They depend on geometry and Poisson's ratio only, as those of a pressure do: in a half-space that is
loaded at its surface the stresses do not depend on the modulus.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats

#: Least square of a distance that is divided by [m²].
_TINY = float(np.finfo(np.float64).tiny)


def shear_stress_coefficients(
    x_edges: Floats,
    y_edges: Floats,
    depth: float,
    poisson_ratio: float,
) -> Floats:
    """Stress at a point per unit traction along x on each cell of a block [-], tension positive.

    Components xx, yy, zz, yz, xz, xy, shape (6, nx, ny). `x_edges` and `y_edges` are the point's
    coordinates minus those of the cells' edges, descending [m]; `depth` > 0 [m]: at the surface
    the stresses have no limit at a cell's edge.

    Notes
    -----
    With Cerruti's potentials of a rectangle, F_1 = ∫ (z ln(z + r) - r) dA, F = ∂F_1/∂z and
    V = ∂F/∂z = ∫ dA/r, in whose derivatives each corner has a term, Hooke's law gives

        2π σxx = 2 (1 + ν) V_x + 2ν F_1,xxx - z F_xxx,    2π σzz = -z V_xz,
        2π σyy = 2ν V_x + 2ν F_1,xyy - z F_xyy,           2π σyz = -z V_xy,
        2π σxy = V_y + 2ν F_1,xxy - z F_xxy,              2π σxz = V_z - z V_xx.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge (1985), section 3.2, eqs. 3.2 to 3.5.
    """
    found = np.empty((6, len(x_edges) - 1, len(y_edges) - 1))
    terms = _corner_terms(x_edges[:, None], y_edges[None, :], depth, poisson_ratio)
    for corners, into in zip(terms, found, strict=True):
        across = corners[:, 1:] - corners[:, :-1]
        np.subtract(across[1:], across[:-1], out=into)
    found *= 1 / (2 * np.pi)
    return found


def _corner_terms(x: Floats, y: Floats, z: float, poisson_ratio: float) -> tuple[Floats, ...]:
    """Corner terms of all components; a cell's stress is their double difference."""
    # Without what depends on x or on y alone, such as ln(x² + z²)/2 in ln(y + r), which the
    # differences remove: each term is even or odd in either.
    xx_zz, yy_zz = (np.maximum(each * each + z * z, _TINY) for each in (x, y))
    r = np.sqrt(x * x + yy_zz)
    v_x, v_y = np.arcsinh(y / np.sqrt(xx_zz)), np.arcsinh(x / np.sqrt(yy_zz))
    v_z = -np.arctan2(x * y, z * r)
    over_x = z * z / (xx_zz * r)
    by_height, near = 1 / (r + z), z / (r * (r + z))
    bent = 2 * poisson_ratio * by_height + near
    return (
        2 * v_x + y * (bent - over_x),
        2 * poisson_ratio * v_x - y * bent,
        y * over_x,
        -z / r,
        v_z + z * x * y / (xx_zz * r),
        v_y - x * bent,
    )
