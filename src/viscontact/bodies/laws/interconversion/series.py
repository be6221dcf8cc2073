"""Exact interconversion of creep and relaxation series, by poles and residues.

A creep function and a relaxation function of the same material,

    J(t) = J_0 + sum_i J_i (1 - exp(-t/τ_i)) + φ t,
    M(t) = M_inf + sum_j M_j exp(-t/ρ_j),

are inverse under the Boltzmann integral: s² L[J](s) L[M](s) = 1. With s = -1/x both become
rational functions of a *time* x,

    s L[J] = x [ J_0/x + sum_i J_i/(x - τ_i) - φ ],
    s L[M] = - [ sum_j M_j ρ_j/(x - ρ_j) - M_inf ],

whose brackets have one and the same form, sum_i w_i/(x - p_i) - c with w_i > 0 and c >= 0: the
secular equation of a symmetric rank-one update. The roots of one bracket are the poles of the
other function. They interlace, one between each two neighbouring poles and one beyond the last
if c > 0, so each is found by bisection inside a bracket that cannot fail; nothing is fitted.

No factor 2 and no material convention here: J and M are plain inverses of each other.

References
----------
.. [1] N. W. Tschoegl, The Phenomenological Theory of Linear Viscoelastic Behavior,
   Springer, 1989, sections 3.5 and 8.1.
.. [2] S. W. Park, R. A. Schapery, Int. J. Solids Struct. 36 (1999) 1653-1675.
.. [3] R.-C. Li, Solving secular equations stably and efficiently, LAPACK Working Note 89,
   1993: why roots are kept as offsets from their nearest pole.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats, Integers

# Each bisection of a ratio halves its logarithm; 64 of them take any ratio that double
# precision can hold (ln 1e600 = 1400) below one unit in the last place.
_BISECTIONS = 64


class SeriesTerms(NamedTuple):
    """The terms of J(t) = instant + sum amplitudes (1 - exp(-t/times)) + fluidity t."""

    instant: float
    amplitudes: Floats
    times: Floats
    fluidity: float


class RelaxationTerms(NamedTuple):
    """The terms of M(t) = equilibrium + sum moduli exp(-t/times)."""

    equilibrium: float
    moduli: Floats
    times: Floats


def creep_from_relaxation(equilibrium: float, moduli: ArrayLike, times: ArrayLike) -> SeriesTerms:
    """Return the creep series that is the exact inverse of a relaxation series.

    Strengths M_j >= 0, `equilibrium` M_inf >= 0 [Pa], relaxation times ρ_j > 0 [s] in any order;
    ValueError if all moduli are 0. J_0 = 1/M(0); the residues are J_i = 1 / (τ_i sum_j M_j ρ_j /
    (τ_i - ρ_j)²), and for a fluid (M_inf = 0) φ = 1 / sum_j M_j ρ_j [1/(Pa s)].
    """
    moduli, times = merged(moduli, times)
    total = float(equilibrium + moduli.sum())
    if not total > 0:
        raise ValueError("relaxation series: all moduli are 0; at least one must be positive")
    viscosities = moduli * times
    retardation_times, slopes = _secular_roots(times, viscosities, equilibrium)
    fluidity = float(1.0 / viscosities.sum()) if equilibrium == 0 else 0.0
    amplitudes = 1.0 / (retardation_times * slopes)
    return SeriesTerms(1.0 / total, *merged(amplitudes, retardation_times), fluidity)


def relaxation_from_creep(
    instant: float, amplitudes: ArrayLike, times: ArrayLike, fluidity: float
) -> RelaxationTerms:
    """Return the relaxation series that is the exact inverse of a creep series.

    `instant` J_0 > 0, amplitudes J_i >= 0 [1/Pa], retardation times τ_i > 0 [s] in any order,
    fluidity φ >= 0 [1/(Pa s)]; ValueError if J_0 is 0, whose inverse holds a Dirac impulse. M_inf =
    1/J(inf); the residues are M_j = 1 / sum_i J_i (ρ_j / (ρ_j - τ_i))², with J_0 as a term of time
    0.
    """
    if not instant > 0:
        raise ValueError(
            f"instant: a relaxation modulus needs an instant compliance > 0, got {instant!r}; "
            "without one a step in strain takes an infinite stress (a Dirac impulse): "
            "give a small instant compliance, or use the creep function alone"
        )
    amplitudes, times = merged(amplitudes, times)
    compliances = np.concatenate([[instant], amplitudes])
    poles = np.concatenate([[0.0], times])
    relaxation_times, slopes = _secular_roots(poles, compliances, fluidity)
    moduli = 1.0 / (relaxation_times**2 * slopes)
    equilibrium = 0.0 if fluidity > 0 else float(1.0 / compliances.sum())
    return RelaxationTerms(equilibrium, *merged(moduli, relaxation_times))


def creep_function(terms: SeriesTerms, t: Floats) -> Floats:
    """Return J(t) of a creep series; `t` of any shape, >= 0 [s]."""
    # expm1 keeps all digits of 1 - exp(-t/τ) at times far below τ.
    delayed = -np.expm1(-t[..., None] / terms.times) @ terms.amplitudes
    # Without flow the product is left out, so that J(inf) is a number and not 0 * inf.
    flow = terms.fluidity * t if terms.fluidity > 0 else 0.0
    return np.asarray(terms.instant + delayed + flow, dtype=np.float64)


def creep_mean(terms: SeriesTerms, start: Floats, end: Floats) -> Floats:
    """Return the mean of J over the times `start` to `end` [s], of equal shapes; J where equal."""
    begins, ratios = start[..., None] / terms.times, (end - start)[..., None] / terms.times
    # 1 - exp(-t/τ) at the start, and what it grows by on average: two parts of one sign.
    shares = -np.expm1(-begins) + np.exp(-begins) * mean_growth(ratios)
    flow = terms.fluidity * (start + (end - start) / 2) if terms.fluidity > 0 else 0.0
    return np.asarray(terms.instant + shares @ terms.amplitudes + flow, dtype=np.float64)


def mean_growth(ratio: Floats) -> Floats:
    """Return 1 - (1 - exp(-r))/r, the mean of 1 - exp(-x) for x from 0 to r >= 0."""
    small = ratio < 0.25  # beyond it the closed form loses less than a digit
    near = np.where(small, ratio, 0.0)
    # r/2 - r²/6 + r³/24 - ...: the twelfth term is below 1e-17 of the first.
    series = np.zeros_like(near)
    for k in range(12, 1, -1):
        series = near / k * (1 - series)
    far = np.where(small, 1.0, ratio)
    return np.where(small, series, 1 + np.expm1(-far) / far)


def relaxation_function(terms: RelaxationTerms, t: Floats) -> Floats:
    """Return M(t) of a relaxation series; `t` of any shape, >= 0 [s]."""
    relaxing = np.exp(-t[..., None] / terms.times) @ terms.moduli
    return np.asarray(terms.equilibrium + relaxing, dtype=np.float64)


def merged(strengths: ArrayLike, times: ArrayLike) -> tuple[Floats, Floats]:
    """Return the series with times ascending, equal times added up, zero strengths left out."""
    strengths, times = np.asarray(strengths, np.float64), np.asarray(times, np.float64)
    present = strengths > 0
    distinct, where = np.unique(times[present], return_inverse=True)
    sums = np.bincount(where, weights=strengths[present], minlength=distinct.size)
    return sums.astype(np.float64), distinct


def _secular_roots(poles: Floats, weights: Floats, constant: float) -> tuple[Floats, Floats]:
    """Return the roots of F(x) = sum_i w_i/(x - p_i) - c, p_i ascending, and their -F' > 0."""
    origins, side, reach = _nearest_poles(poles, weights, constant)
    from_origin = poles[origins][:, None] - poles
    # Seen from its nearest pole, at distance d, every root is where side * F falls through 0.
    # There the pole's own share w/d balances all others, which weigh no more than their
    # magnitudes at full reach: d has a lower bound that is free of cancellation.
    shares = np.abs(weights / (from_origin + (side * reach)[:, None])).sum(axis=1) + constant
    lower, upper = np.maximum(weights[origins] / shares, np.finfo(np.float64).tiny), reach
    for _ in range(_BISECTIONS):
        middle = np.sqrt(lower) * np.sqrt(upper)  # halves the ratio, not the difference
        to_poles = from_origin + (side * middle)[:, None]
        beyond = side * ((weights / to_poles).sum(axis=1) - constant) > 0
        lower, upper = np.where(beyond, middle, lower), np.where(beyond, upper, middle)
    offsets = side * upper
    slopes = _slopes(
        np.abs(from_origin + offsets[:, None]),
        np.abs(from_origin[:, origins] + (offsets[:, None] - offsets)),
        constant if constant > 0 else float(weights.sum()),
    )
    return poles[origins] + offsets, slopes


def _slopes(to_poles: Floats, to_roots: Floats, leading: float) -> Floats:
    """Return -F'(x_j) from the distances of the roots to all poles and to each other."""
    # F is its leading coefficient, c or sum(w), times the product of all x - x_k over that of all x
    # - p_i. At x_j this leaves a product of ratios that interlacing bounds. The sum of w_i/(x_j -
    # p_i)² is equivalent for exact roots only: where rounding blurs the distance of a root from a
    # weak pole, the product still gives residues that fit the roots found.
    count = to_roots.shape[0]
    np.fill_diagonal(to_roots, 1.0)
    with np.errstate(over="ignore"):  # a root upon its pole: slope inf, strength 0, left out
        slopes = leading * np.prod(to_roots / to_poles[:, :count], axis=1)
        return np.asarray(slopes / np.prod(to_poles[:, count:], axis=1))


def _nearest_poles(
    poles: Floats, weights: Floats, constant: float
) -> tuple[Integers, Floats, Floats]:
    """Return each root's nearest pole by its index, side (+1: right) and largest distance."""
    half = np.diff(poles) / 2
    middle = (poles[:-1, None] - poles) + half[:, None]
    # F falls from +inf to -inf between two poles: the sign half-way shows the half of the root.
    right = (weights / middle).sum(axis=1) > constant
    nearest, side = np.arange(half.size) + right, np.where(right, -1.0, 1.0)
    if constant > 0 and poles.size > 0:
        # One more beyond the last pole, where F <= sum(w)/(x - p_n) - c.
        half = np.append(half, weights.sum() / constant)
        nearest, side = np.append(nearest, poles.size - 1), np.append(side, 1.0)
    return nearest, side, half
