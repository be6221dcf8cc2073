"""Force over approach of an elastic sphere that adheres, as one branch of states."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats

#: Maugis's parameter over the Tabor number, λ = 2 (9/(16 π))^(1/3) μ.
MAUGIS = 2 * float(np.cbrt(9 / (16 * np.pi)))

_POINTS = 3000
_LEAST_EXCESS, _LARGEST_EXCESS = 1e-7, 1e5  # of the zone's outer radius over the inner one


def adhesive_branch(tabor: float, largest: float, finer: int = 1) -> tuple[Floats, Floats]:
    """Forces [pi w R] and approaches [(pi² w² R/K²)^(1/3)] up to a contact radius, falling.

    By Johnson, Kendall and Roberts (1971) for an infinite Tabor number, else by Maugis (1992), and
    behind the contact that has shrunk to a point by the uniform attraction of a circle whose gap is
    below the range (Johnson 1985, section 3.4).
    """
    points = finer * _POINTS
    if np.isinf(tabor):
        a = largest * np.linspace(1.0, 0.0, points)
        root = np.sqrt(6 * a)
        return a**3 - a * root, a**2 - 2 / 3 * root
    lam = MAUGIS * tabor
    ratio = 1 + np.geomspace(_LEAST_EXCESS, _LARGEST_EXCESS, points)
    # Eq. 6.14 is quadratic in the contact radius, with sqrt(m² - 1) and acos(1/m).
    root = np.sqrt((ratio - 1) * (ratio + 1))
    angle = np.arctan(root)
    square, linear = lam / 2 * (root + (ratio**2 - 2) * angle), 4 / 3 * lam**2 * _shape(ratio, root)
    a = 2 / (linear + np.sqrt(linear**2 + 4 * square))
    a, ratio, root, angle = (each[a <= largest] for each in (a, ratio, root, angle))
    forces = a**3 - lam * a**2 * (root + ratio**2 * angle)
    approaches = a**2 - 4 / 3 * a * lam * root
    apart = _apart(lam, points // 10)
    return np.concatenate([forces, apart[0]]), np.concatenate([approaches, apart[1]])


def _shape(ratio: Floats, root: Floats) -> Floats:
    """1 - m + sqrt(m² - 1) acos(1/m), without cancellation near m = 1."""
    excess = ratio - 1
    near = excess - excess**2 * (1 / 3 - 4 / 15 * excess)
    return np.where(excess < 1e-4, near, root * np.arctan(root) - excess)


def _apart(lam: float, points: int) -> tuple[Floats, Floats]:
    """Forces and approaches of a circle that is attracted without contact, from contact on."""
    shift = (4 - 8 / np.pi) / 3 * lam
    touching = 4 / (np.pi * lam) / (shift + np.sqrt(shift**2 + 4 / (np.pi * lam)))
    c = touching * np.linspace(1.0, 0.0, points)
    return -np.pi * lam / 2 * c**2, c**2 / 2 - 8 * lam / (3 * np.pi) * c - 2 / (np.pi * lam)
