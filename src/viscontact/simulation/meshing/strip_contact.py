"""Growing contact of a cylinder on strips of equal width: a plane elastic contact, solved exactly.

The pressure of Hertz's line contact is that of a paraboloid along its axes, so that strips show
what cells do to a growing contact, at the cost of one factorisation.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass


@dataclass(frozen=True, eq=False)
class StripContact:
    """Contacts of 0, 1, 2, .. strips on either side, each as the next strip is about to touch."""

    # Between them the pressure is linear in the force. Lengths are in strips, pressures such that
    # Hertz's is sqrt(a² - x²).

    forces: Floats  # increasing, shape (strips,)
    pressures: Floats  # of the strips on one side, shape (strips, strips)

    def pressure(self, half_width: float) -> Floats:
        """Pressure of the strips on one side, under the force of Hertz's contact."""
        force = np.pi * half_width**2 / 2
        after = int(np.searchsorted(self.forces, force, side="right"))
        after = min(max(after, 1), len(self.forces) - 1)
        low, high = self.forces[after - 1 : after + 1]
        before, last = self.pressures[after - 1 : after + 1]
        return np.asarray(before + (force - low) / (high - low) * (last - before))


@lru_cache(maxsize=4)
def strip_contact(strips: int) -> StripContact:
    """Contacts of up to `strips` strips on either side of the centre."""
    # Displacement under a uniform strip: Johnson 1985, Contact Mechanics, eq. 2.30, for a modulus
    # of 1, a cylinder of radius 1/2 and a depth of 10 grids. Under a contact of m strips, the
    # pressure is that of a flat punch times the approach, less that which makes the surface a
    # parabola.
    x = np.arange(strips) + 0.5
    kernel = _influence(np.subtract.outer(x, x), 20.0 * strips)
    kernel += _influence(np.add.outer(x, x), 20.0 * strips)
    # The factors of leading blocks are leading blocks of the factor.
    lower = scipy.linalg.cholesky(kernel, lower=True)
    sides = scipy.linalg.solve_triangular(
        lower, np.stack([np.ones(strips), x**2], axis=1), lower=True
    )
    pressures = np.zeros((strips, strips))
    for touching in range(1, strips):
        block = slice(touching + 1)
        punch, parabola = scipy.linalg.solve_triangular(lower[block, block].T, sides[block]).T
        approach = parabola[-1] / punch[-1]  # which leaves the last strip without pressure
        pressures[touching, :touching] = (approach * punch - parabola)[:-1]
    return StripContact(2 * pressures.sum(axis=1), pressures)


def _influence(distance: Floats, far: float) -> Floats:
    """Displacement at a distance from a strip under unit pressure, 0 at about the distance far."""

    def antiderivative(s: Floats) -> Floats:
        return s * np.log(np.abs(s) / far)

    ends = antiderivative(distance + 0.5) - antiderivative(distance - 0.5)
    return np.asarray(-2 / np.pi * (ends - 1))


def mean_pressure(half_width: float, edges: Floats) -> Floats:
    """Means of Hertz's sqrt(1 - x²/a²) between edges."""
    if half_width == 0:
        return np.zeros(len(edges) - 1)
    inside = np.clip(edges / half_width, -1.0, 1.0)
    integral = (inside * np.sqrt(1 - inside**2) + np.arcsin(inside)) * half_width / 2
    return np.asarray(np.diff(integral) / np.diff(edges))
