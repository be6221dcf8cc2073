"""Loads on the faces of a body between two of them under waves that are long against its length.

They have a table of their own, as operators on the surface need none (`strip`): there the body is a
plate. Stresses at depths of some lengths of the body are made of these waves.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.log_chebyshev import LogChebyshev
from viscontact.mechanics.halfspace.strip import LONGEST_WAVES, LOWEST_WAVE, freeing_loads

#: Chebyshev's places of ln k W from the longest wave to the lowest one of `strip`.
WAVES = 14


@dataclass(frozen=True, eq=False)
class LongLoads:
    """Chebyshev's coefficients of loads on the faces, and of the stress by them above."""

    faces: Floats  # shape (waves, nodes of a face, nodes of the surface)
    tops: Floats  # shape (waves, nodes of the surface, nodes of the surface)
    longest: float  # k W of the longest wave

    def loads(self, wave: float) -> tuple[Floats, Floats]:
        """Matrices of the load on the faces and of the stress by it above, at w = k W."""
        powers = _series(self.longest).powers(np.array([wave]))[0]
        return np.tensordot(powers, self.faces, axes=1), np.tensordot(powers, self.tops, axes=1)


def longest_wave(*, odd: bool) -> float:
    """Product k W of the longest wave under even or odd pressures."""
    return LONGEST_WAVES[odd]


@lru_cache(maxsize=4)
def long_loads(poisson_ratio: float, *, odd: bool) -> LongLoads:
    """Loads under even or odd pressures, for a constant Poisson's ratio."""
    longest, sign = longest_wave(odd=odd), -1.0 if odd else 1.0
    series = _series(longest)
    parts = [freeing_loads(wave, poisson_ratio, sign) for wave in series.waves]
    faces, tops = (series.coefficients(np.array([part[k] for part in parts])) for k in (1, 2))
    return LongLoads(faces, tops, longest)


def _series(longest: float) -> LogChebyshev:
    return LogChebyshev(longest, LOWEST_WAVE, WAVES)
