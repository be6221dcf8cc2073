"""Passive sums of creep functions times frequency responses.

A sum Σ_m b_m(s) L_m(q), with b_m = s L[J_m], is passive if its loss -Im Σ b_m(i ω) L_m(q) is not
negative for any wave at any frequency: then no history of pressure from rest gains energy. As the
creep of each wave is

    C(q, t) = C(q, 0) + (2/π) ∫_0^∞ loss(q, ω) (1 - cos ω t)/ω dω,

it is never below its beginning either, and the operator of each step is positive.

Creep functions with amplitudes >= 0 are not enough, as the L_m have both signs. L_m >= 0, or
amplitudes >= 0 of every exponential at every q, would be; but such positive approximations converge
with the square of the number of terms only (Korovkin 1960), others exponentially.

References
----------
M. Fabrizio, A. Morro, Mathematical Problems in Linear Viscoelasticity (1992): positive loss and the
second law. P. P. Korovkin, Linear Operators and Approximation Theory (1960).
"""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Numbers

#: Rounding of the loss over the compliance, and a gain that a uniform share balances [-].
ROUNDING, SMALL = 1e-13, 1e-9

#: Frequencies of gain looked at for a wave number, and all of these points.
GAINS_PER_WAVE, MOST_GAINS = 4, 400

#: Frequencies and wave numbers at which the change is measured.
MEASURED = (20, 24)


def passive_share(harmonic: Numbers, weights: Numbers, at_points: Numbers) -> Numbers:
    """Shares to add to the weights (m, j) [Pa] of the C(q, s_j) so that the sum is passive."""
    # `harmonic` are b_m(i ω), shape (ω, m) [1/Pa]; `at_points` are C(q, s_j), shape (j, q) [1/Pa].
    # A term of negative sign gains energy.
    found = harmonic @ (weights @ at_points)
    gain = scipy.ndimage.maximum_filter(found.imag / np.abs(found), 5)  # also between the points
    wanted = np.where(gain > ROUNDING, gain, 0.0)
    share = np.zeros(weights.shape)
    if wanted.max() > SMALL:
        share = _least_share(harmonic, at_points, wanted, np.abs(found))
    # The sum of the b_m loses energy at all frequencies, that of the C(q, s_j) is positive.
    uniform = np.outer(1 / np.abs(harmonic).max(axis=0), 1 / at_points.max(axis=1))
    missing = wanted * np.abs(found) + (harmonic @ (share @ at_points)).imag
    added, short = -(harmonic @ (uniform @ at_points)).imag, missing > 0
    return np.asarray(share + float((missing[short] / added[short]).max(initial=0.0)) * uniform)


def _least_share(harmonic: Numbers, at_points: Numbers, wanted: Numbers, found: Numbers) -> Numbers:
    """Share of the least change relative to |found|, by a linear program over some points."""
    # C decreases in s: the b_m times the differences of neighbouring C(q, s_j), and times the last
    # one, are passive, and so is any sum of them with factors >= 0.
    order = np.argsort(-at_points[:, 0])
    steps = np.eye(order.size)[order]
    steps[:-1] -= steps[1:].copy()
    responses = np.maximum(steps @ at_points, 0.0)
    scales = np.abs(harmonic).max(axis=0)

    def of_products(functions: Numbers, places: tuple[Numbers, Numbers]) -> Numbers:
        frequency, q = places
        each = (functions / scales)[frequency][:, :, None] * responses[:, q].T[:, None]
        return np.asarray((each / found[places][:, None, None]).reshape(q.size, -1))

    gaining, measured = _points_of_gain(wanted), _spread(found.shape)
    largest = float(wanted.max())
    losses = of_products(-harmonic.imag, gaining) / largest
    changes = of_products(np.abs(harmonic), measured) / largest
    most = changes.max(axis=0)
    sizes = np.divide(1.0, most, out=np.zeros(most.size), where=most > 0)
    limits = np.append(-wanted[gaining] / largest, np.zeros(len(changes)))
    rows = np.zeros((limits.size, sizes.size + 1))
    rows[: len(losses), :-1] = -losses * sizes
    rows[len(losses) :, :-1], rows[len(losses) :, -1] = changes * sizes, -1.0
    target = np.append(np.zeros(sizes.size), 1.0)
    solved = scipy.optimize.linprog(target, A_ub=rows, b_ub=limits, method="highs")
    if solved.x is None:
        return np.zeros((scales.size, order.size))
    factors = (solved.x[:-1] * sizes).reshape(scales.size, order.size)
    return np.asarray(factors / scales[:, None] @ steps)


def _points_of_gain(wanted: Numbers) -> tuple[Numbers, Numbers]:
    """Frequencies and wave numbers of gain: the largest one of each wave, and some more."""
    points = set()
    for q in np.flatnonzero(wanted.max(axis=0)):
        places = np.flatnonzero(wanted[:, q])
        chosen = [*places[:: max(1, places.size // GAINS_PER_WAVE)], wanted[:, q].argmax()]
        points |= {(int(place), int(q)) for place in chosen}
    ordered = np.array(sorted(points))
    some = ordered[:: max(1, len(ordered) // MOST_GAINS)]
    return some[:, 0], some[:, 1]


def _spread(shape: tuple[int, ...]) -> tuple[Numbers, Numbers]:
    """Points all over the frequencies and wave numbers."""
    each = [np.arange(0, n, max(1, n // m)) for n, m in zip(shape, MEASURED, strict=True)]
    frequency, q = np.meshgrid(*each)
    return frequency.ravel(), q.ravel()
