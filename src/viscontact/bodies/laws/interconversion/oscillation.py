"""Complex compliance and modulus of series under steady oscillation.

With x = ω τ a relaxing term gives i x/(1 + i x) and a delayed one 1/(1 + i x). Their real and
imaginary parts are summed separately, where all terms have one sign, so that a loss far below
the storage (or vice versa) keeps its digits.
"""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Complexes, Floats
from viscontact.bodies.laws.interconversion.series import RelaxationTerms, SeriesTerms


def modulus_of_creep(terms: SeriesTerms, omega: Floats) -> Complexes:
    """Return G* = 1/(2 J*) [Pa] of a series in Phi = J(t), at angular frequencies > 0 [rad/s]."""
    in_phase, lagging = _debye(omega, terms.times)
    storage = terms.instant + in_phase @ terms.amplitudes
    loss = lagging @ terms.amplitudes + terms.fluidity / omega
    return half_inverse(storage, loss)


def modulus_of_relaxation(terms: RelaxationTerms, omega: Floats) -> Complexes:
    """Return G* [Pa] of a relaxation series, at angular frequencies > 0 [rad/s]."""
    # x²/(1 + x²) is 1/(1 + 1/x²).
    in_phase, lagging = _debye(1.0 / omega, 1.0 / terms.times)
    return np.asarray(terms.equilibrium + in_phase @ terms.moduli + 1j * (lagging @ terms.moduli))


def half_inverse(storage: Floats, loss: Floats) -> Complexes:
    """Return G* = 1/(2 Phi*) [Pa] of Phi* = storage - i loss [1/Pa], part by part."""
    size = np.hypot(storage, loss)
    return np.asarray(((storage + 1j * loss) / size) * (0.5 / size))


def _debye(omega: Floats, times: Floats) -> tuple[Floats, Floats]:
    """Return 1/(1 + x²) and x/(1 + x²) of x = ω τ, with a last axis for the times."""
    x = omega[..., None] * times
    size = np.hypot(1.0, x)
    return 1.0 / size**2, (x / size) / size
