"""Stress influence coefficients of a uniformly loaded rectangle (Love 1929).

They depend on geometry and Poisson's ratio only: in a half-space loaded at its surface by pressure
alone, the stresses do not depend on the modulus.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats

#: Least square of a distance that is divided by [m²].
_TINY = float(np.finfo(np.float64).tiny)

#: The components of a stress tensor, in the order in which they are stacked.
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")

#: Places of the components after an exchange of x and y.
EXCHANGED = [1, 0, 2, 4, 3, 5]


def stress_coefficients(
    x_edges: Floats,
    y_edges: Floats,
    depth: float,
    poisson_ratio: float,
) -> Floats:
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

    and likewise with y for x.

    References
    ----------
    A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377.
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
    # Without what depends on x or on y alone, such as y/(y² + z²) in σyz, which the differences
    # remove: each term is even or odd in either. Of χ_xx, χ_yy and V_z, whose sum is 0 there, two
    # take an arctangent; the two of χ_xx are one.
    rest = 1 - 2 * poisson_ratio
    xx, yy, xy = x * x, y * y, x * y
    far = xx + yy
    r = np.sqrt(far + z * z)
    over_x, over_y = (z / np.maximum(each + z * z, _TINY) for each in (xx, yy))
    v_z = -np.arctan2(xy, z * r)
    xy_r = xy / r
    bent_x, bent_y = -over_x * xy_r, -over_y * xy_r  # z V_xx, z V_yy
    sigma_xx, sigma_yy, sigma_xy = v_z - bent_x, v_z - bent_y, -z / r
    if rest:
        chi_xx = np.arctan2(xy * far / (r + z), xx * r + z * yy)
        sigma_xx -= rest * (v_z + chi_xx)
        sigma_yy += rest * chi_xx
        sigma_xy -= rest * np.log(z + r)
    shear_yz, shear_xz = z * over_y * (x / r), z * over_x * (y / r)
    return sigma_xx, sigma_yy, v_z + bent_x + bent_y, shear_yz, shear_xz, sigma_xy
