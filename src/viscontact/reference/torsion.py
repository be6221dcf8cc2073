"""Round punch that sticks to an elastic layer on a rigid base and is twisted.

With the Hankel transform of the tractions, T(q) = μ q ∫_0^a ψ(t) sin(q t) dt, which leaves the
surface free outside the punch, and the displacement tanh(q h)/(μ q) of a wave across its wave
vector, the rotation φ r under the punch requires

    ψ(t) = (4 φ/π) t + (2/π) ∫_0^a ψ(s) ∫_0^∞ [1 - tanh(q h)] sin(q t) sin(q s) dq ds,

and the torque is 4π μ ∫_0^a ψ t dt.

References
----------
E. Reissner, H. F. Sagoci, J. Appl. Phys. 15 (1944) 652: the half-space; I. N. Sneddon, Mixed
Boundary Value Problems in Potential Theory (1966).
"""

from __future__ import annotations

import numpy as np

from viscontact.reference.values import require_positive

#: Wave number times thickness beyond which 1 - tanh is below rounding.
SHORTEST_WAVE = 20.0

#: Gauss nodes: least number, and per thickness on the radius.
LEAST_NODES, NODES_PER_THICKNESS = 40, 12


def layer_torsion(radius: float, thickness: float, *, shear_modulus: float) -> float:
    """Torque per rotation of a round punch that sticks to an elastic layer on a rigid base.

    Parameters
    ----------
    radius : float
        Radius a of the punch [m].
    thickness : float
        Thickness h of the layer, which is bonded to its base [m].
    shear_modulus : float
        Shear modulus of the layer [Pa]. Poisson's ratio does not matter.

    Returns
    -------
    float
        Torque on the punch over its rotation about its axis [N m/rad].

    Raises
    ------
    ValueError
        If a length or the modulus is not positive.

    Examples
    --------
    A layer as thick as the punch's radius, over the 16/3 μ a³ of a half-space (Reissner & Sagoci
    1944):

    >>> print(f"{layer_torsion(1.0, 1.0, shear_modulus=3 / 16):.5f}")
    1.06155
    """
    require_positive("m", radius=radius, thickness=thickness)
    require_positive("Pa", shear_modulus=shear_modulus)
    depth = thickness / radius
    count = max(LEAST_NODES, int(NODES_PER_THICKNESS / depth))
    nodes, weights = np.polynomial.legendre.leggauss(count)
    t, of_t = (nodes + 1) / 2, weights / 2
    q, of_q = SHORTEST_WAVE / depth * t, SHORTEST_WAVE / depth * of_t
    sines = np.sin(np.multiply.outer(t, q))
    missing = 2 / (1 + np.exp(2 * q * depth))  # 1 - tanh
    kernel = 2 / np.pi * (sines * (of_q * missing)) @ sines.T
    density = np.linalg.solve(np.eye(count) - kernel * of_t, 4 / np.pi * t)
    return float(4 * np.pi * shear_modulus * radius**3 * (density * t) @ of_t)
