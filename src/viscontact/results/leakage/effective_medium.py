"""Effective medium: transmissivity from the distribution of gaps alone."""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats

#: Part of contact at which an isotropic contact closes; Bruggeman's medium in the plane closes at
#: 0.5 (W. B. Dapp, A. Lücke, B. N. J. Persson, M. H. Müser, Phys. Rev. Lett. 108 (2012) 244301).
CLOSED = 0.42

#: Range of ln K below the largest conductance in which it is searched.
_RANGE = 90.0


def effective_transmissivity(gap: Floats) -> float:
    """K of <(k - K)/(k + (d - 1) K)> = 0, k = h³/12 and 0 in contact, d = 1/(1 - 0.42) [m³].

    >>> print(f"{12 * effective_transmissivity(np.full((2, 2), 1e-6)):.3g}")
    1e-18
    """
    widest = float(gap.max())
    if not widest > 0:
        return 0.0
    conductance = (gap / widest) ** 3
    others = 1 / (1 - CLOSED) - 1

    def balance(log: float) -> float:
        medium = np.exp(log)
        return float(((conductance - medium) / (conductance + others * medium)).mean())

    if balance(-_RANGE) <= 0:
        return 0.0
    if balance(0.0) >= 0:
        return widest**3 / 12
    # In the logarithm: K spans many decades, and has no scale for an absolute tolerance.
    found = scipy.optimize.brentq(balance, -_RANGE, 0.0, xtol=1e-10)
    return float(np.exp(found)) * widest**3 / 12
