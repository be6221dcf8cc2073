"""Functions of the thickness of a slab under waves of normal load on both faces.

With r² = ζ² + k², x = r W and ξ = r (W - X) at the distance X from a face (S. P. Timoshenko & J. N.
Goodier, Theory of Elasticity, 1970, art. 24), for even loads

    S = [(sinh x + x cosh x) cosh ξ - ξ sinh ξ sinh x] / D,   H = sinh x cosh ξ / D,
    T = dS/dξ = [x cosh x sinh ξ - ξ cosh ξ sinh x] / D,      D = sinh x cosh x + x;

for odd ones sinh and cosh change places, and D = sinh x cosh x - x. Far from the other face they
are (1 + rX) exp(-rX), exp(-rX) and, up to its sign, rX exp(-rX).
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

#: Arguments below which sinh x cosh x - x is a series.
SMALL = 0.03


@dataclass(frozen=True, eq=False)
class SlabFunctions:
    """Functions of the distance from a face, shape (waves, places)."""

    normal: Floats  # S, the stress across the slab over the load
    half_sum: Floats  # H
    shear: Floats  # stress along the faces over the load, and its sign towards the inside


def slab_functions(
    rates: Floats, distances: Floats, half: float | None, sign: float
) -> SlabFunctions:
    """Functions of waves of r at distances X from a face, of a slab of half thickness W or of none.

    `sign` is -1 for odd loads.
    """
    decay = np.multiply.outer(rates, distances)
    own = np.exp(-decay)
    if half is None:
        return SlabFunctions((1 + decay) * own, own, decay * own)
    x = rates * half
    sinh, cosh, denominator, _ = (each[:, None] for each in slab(x, sign))
    x, xi = x[:, None], x[:, None] - decay
    # cosh ξ and sinh ξ times 2 exp(-x), exchanged if odd.
    other = sign * np.exp(decay - 2 * x)
    cosh_xi, sinh_xi = own + other, own - other
    normal = ((sinh + x * cosh) * cosh_xi - xi * sinh_xi * sinh) / denominator
    shear = (x * cosh * sinh_xi - xi * cosh_xi * sinh) / denominator
    return SlabFunctions(normal, sinh * cosh_xi / denominator, shear)


def slab(x: Floats, sign: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Sinh x, cosh x and D times 2 or 4 powers of exp(-x), and exp(-2x); exchanged if odd."""
    decay = np.exp(-2 * x)
    denominator = 1 - decay**2 + sign * 4 * x * decay
    if sign < 0:  # without cancellation
        series = 4 * decay * x**3 * (2 / 3 + x**2 * (2 / 15 + x**2 * 4 / 315))
        denominator = np.where(x < SMALL, series, denominator)
    return 1 - sign * decay, 1 + sign * decay, denominator, decay
