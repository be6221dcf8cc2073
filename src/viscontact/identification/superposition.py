"""Joint superposition of sets at several temperatures: shift factors and their covariance."""

from __future__ import annotations

import numpy as np
import scipy

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.joint_likelihood import Joined, JointLikelihood
from viscontact.identification.measured_sets import MeasuredSets
from viscontact.identification.pair_alignment import Alignment, aligned_pair
from viscontact.identification.penalized_splines import PenalizedSplines
from viscontact.identification.scatter import Scatter, own_scatters
from viscontact.identification.vertical_shift import VerticalShift

_ROUNDS = 12  # of noise, trust and shifts in turn
_SETTLED = 0.01  # relative change of noise and trust that ends them
# Noise that the fit begins with, so that it does not end beside a step between two of those tried,
# and its least value: splines are no more accurate.
_FIRST_NOISE, _LEAST_NOISE = 0.01, 1e-5
# Ten times less information than expected is the least that is believed.
_LEAST_INFORMATION = 0.1
# A warmer set is slower beyond a third of a decade, and this many standard deviations.
_SLOWER, _SURE = np.log(10.0) / 3, 3.0
# Moves of sets to rival alignments are tried if they are farther than this in ln(time).
_APART = np.log(10.0) / 10


@dataclass(frozen=True, eq=False)
class Superposition:
    """Shifts of all sets relative to one of them, with their joint covariance."""

    logs_a: Floats  # ln a_T, shape (sets,)
    logs_b: Floats  # ln b_T
    covariance: Floats  # of ln a_T and then ln b_T, shape (2 sets, 2 sets)
    noise: Floats  # scatter of each response about the common curve [-], shape (columns,)
    freedom: Floats  # its degrees of freedom
    own: Scatter  # scatter of the sets each alone
    cost: float  # -2 ln(likelihood)


def slower_steps(joined: Superposition) -> list[int]:
    """Sets of which the next warmer one is slower, beyond the uncertainty."""
    rises = np.diff(joined.logs_a)
    return [
        k
        for k, rise in enumerate(rises)
        if rise > _SLOWER and rise > _SURE * np.sqrt(step_variance(joined.covariance, k))
    ]


def step_variance(covariance: Floats, k: int) -> float:
    """Variance of the difference between a set and the next one."""
    pair = covariance[k : k + 2, k : k + 2]
    return max(float(pair[0, 0] + pair[1, 1] - 2 * pair[0, 1]), 0.0)


def superposed(sets: MeasuredSets, vertical: VerticalShift) -> Superposition:
    """Most likely shifts of all sets."""
    found = [_superposed(sets, vertical, own) for own in own_scatters(sets)]
    return min(found, key=lambda each: each.cost)


def _superposed(sets: MeasuredSets, vertical: VerticalShift, own: Scatter) -> Superposition:
    """Most likely shifts for the roughness that the sets have alone.

    The start is the chain of pairs, each at its most likely step; rivals of a step are then tried
    with all sets at once.
    """
    pairs = [_pair(sets, own, vertical, k) for k in range(sets.count - 1)]
    start = -np.concatenate([[0.0], np.cumsum([pair.step for pair in pairs])])
    anchor = sets.count // 2
    best, joined, shifts = _descended(sets, vertical, own, start - start[anchor])
    spreads = np.zeros(sets.count - 1)
    for k, pair in enumerate(pairs):
        for rival in pair.rivals:
            moved = shifts - (rival - pair.step) * (np.arange(sets.count) > k)
            if abs(-np.diff(moved)[k] + np.diff(shifts)[k]) < _APART:
                continue
            other, seen, place = _descended(sets, vertical, own, moved - moved[anchor])
            apart = float(np.diff(place)[k] - np.diff(shifts)[k])
            if abs(apart) < _APART:
                continue
            if seen.cost < joined.cost:
                best, joined, shifts, other, seen = other, seen, place, best, joined
            # Of two alignments, each with its likelihood, the variance is that of the mixture.
            odds = np.exp(-0.5 * (seen.cost - joined.cost))
            spreads[k] = max(spreads[k], abs(apart) * np.sqrt(odds / (1 + odds)))
    return _described(best, joined, shifts, own, spreads)


def _pair(sets: MeasuredSets, own: Scatter, vertical: VerticalShift, k: int) -> Alignment:
    given = None if vertical.given is None else vertical.given[k : k + 2]
    step = VerticalShift(sets.temperatures[k : k + 2], given)
    return aligned_pair(sets.chosen(k, k + 1), own, step)


def _descended(
    sets: MeasuredSets, vertical: VerticalShift, own: Scatter, start: Floats
) -> tuple[JointLikelihood, Joined, Floats]:
    """Local maximum of the likelihood: in turn shifts, noise and trust; shifts of all sets."""
    anchor = sets.count // 2
    shifts = np.delete(start, anchor)
    noise, trust = np.maximum(own.noise, _FIRST_NOISE), np.ones(sets.count - 1)
    for turn in range(_ROUNDS):
        places = sets.log_times - np.insert(shifts, anchor, 0.0)[sets.owner]
        splines = PenalizedSplines.over(places, sets.spacing)
        likelihood = JointLikelihood(sets, vertical, splines, noise, own.roughness, trust, anchor)
        shifts = _most_likely(likelihood, shifts)
        joined = likelihood.joined(shifts)
        squares = np.sum(sets.weights * joined.residuals**2, axis=1)
        shared = (sets.count - 1) / sets.columns
        least = max(_FIRST_NOISE * 0.1**turn, _LEAST_NOISE)
        scatter = np.sqrt(squares / np.maximum(joined.freedom - shared, 1.0))
        scatter = np.maximum(scatter, least)
        trusted = vertical.trust(joined.logs_b) if vertical.is_found else trust
        change = max(
            np.abs(np.log(scatter / noise)).max(), np.abs(np.log(trusted / trust)).max(initial=0.0)
        )
        if turn > 1 and change < _SETTLED:
            break
        noise, trust = scatter, trusted
    return likelihood, joined, np.insert(shifts, anchor, 0.0)


def _most_likely(likelihood: JointLikelihood, shifts: Floats) -> Floats:
    """Shifts of least cost near these, in coordinates of equal uncertainty."""
    scale = _scale(likelihood.joined(shifts).information)

    def cost(steps: Floats) -> tuple[float, Floats]:
        value, slope = likelihood.cost(shifts + scale @ steps)
        return value, scale.T @ slope

    start = np.zeros_like(shifts)
    found = scipy.optimize.minimize(
        cost, start, jac=True, method="BFGS", options={"gtol": 1e-2, "maxiter": 100}
    )
    return np.asarray(shifts + scale @ found.x)


def _scale(information: Floats) -> Floats:
    """Matrix S whose columns change the cost alike: S^T information S = 1."""
    values, vectors = np.linalg.eigh(information)
    return np.asarray(vectors / np.sqrt(np.maximum(values, 1e-3)))


def _described(
    likelihood: JointLikelihood, joined: Joined, shifts: Floats, own: Scatter, spreads: Floats
) -> Superposition:
    """Shifts with their covariance: the curvature of the likelihood, and rival alignments."""
    sets, anchor = likelihood.sets, likelihood.anchor
    others = np.delete(np.arange(sets.count), anchor)
    covariance = _covariance(likelihood, joined, shifts[others])
    between = np.arange(sets.count)[:, None] > np.arange(spreads.size)
    moved = (between.astype(float) - between[anchor]) * spreads
    covariance += (moved @ moved.T)[np.ix_(others, others)]
    covariance *= _repetition(sets, joined.residuals)
    rows = np.ix_(others, others)
    full = np.zeros((2, sets.count, 2, sets.count))
    full[0, :, 0, :][rows] = covariance
    if likelihood.vertical.is_found:
        crossed = joined.by_shift @ covariance
        full[1, :, 0, :][rows] = crossed
        full[0, :, 1, :][rows] = crossed.T
        full[1, :, 1, :][rows] = joined.covariance_b + crossed @ joined.by_shift.T
    return Superposition(
        shifts,
        joined.logs_b,
        full.reshape(2 * sets.count, 2 * sets.count),
        likelihood.noise,
        joined.freedom,
        own,
        joined.cost,
    )


def _covariance(likelihood: JointLikelihood, joined: Joined, shifts: Floats) -> Floats:
    """Inverse of the second derivative of half the cost."""
    scale = _scale(joined.information)
    step = 0.1
    slopes = [
        scale.T @ (likelihood.cost(shifts + step * s)[1] - likelihood.cost(shifts - step * s)[1])
        for s in scale.T
    ]
    second = np.array(slopes) / (4 * step)
    values, vectors = np.linalg.eigh((second + second.T) / 2)
    spread = scale @ vectors
    return np.asarray(spread / np.maximum(values, _LEAST_INFORMATION) @ spread.T)


def _repetition(sets: MeasuredSets, residuals: Floats) -> float:
    """Factor by which residuals that resemble their neighbours raise the variance."""
    # Of a first-order autoregressive process: (1 + r)/(1 - r). Within 2/sqrt(n) it is chance.
    within = np.diff(sets.owner) == 0
    products = np.sum(residuals[:, 1:] * residuals[:, :-1] * within, axis=1)
    alike = float(np.mean(products / np.sum(residuals**2, axis=1)))
    if alike < 2 / np.sqrt(residuals.size):
        return 1.0
    return (1 + min(alike, 0.9)) / (1 - min(alike, 0.9))
