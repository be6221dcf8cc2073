"""Least squares of an indentation fit, and the covariance of its unknowns."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache, partial
from typing import Protocol

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.quantiles import student_quantile
from viscontact.bodies.series_fits.residual_noise import Noise, noise_of
from viscontact.identification.least_squares import Tolerances, least_squares

_STEP = 1e-4  # of ln p, for differences: well above rounding, well below the curvature
_REACH = np.log(1e8)  # largest change of ln p from its start
_LONGEST = 2.0  # change of ln p in a step: longer ones jump past solutions
_FINER = 2  # times as many nodes for the last step
_LEFT = 0.02  # of the standard errors: a smaller step changes nothing of the result
_TOUCH = 1e-9  # of the largest response: less is none


class Named(Protocol):
    """Unknowns with names."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names in the order of the unknowns."""


class Problem(Protocol):
    """Measured rows, and a response to unknowns of a law and others, plus linear terms."""

    @property
    def shape(self) -> Named:
        """Law or contact with unknown parameters, which are the first unknowns."""

    @property
    def starts(self) -> list[Floats]:
        """Starting values of the unknowns."""

    @property
    def reach(self) -> Floats:
        """Largest change of each unknown besides those of the law."""

    @property
    def measured(self) -> Floats:
        """Measured values, scaled to be at most about 1 [-]."""

    @property
    def baseline(self) -> Floats:
        """Columns of the linear terms, shape (rows, terms)."""

    @property
    def unseen(self) -> Floats:
        """Standard deviation of what the rows cannot tell from other terms [-], shape (rows,)."""

    def response(self, free: Floats, finer: int = 1) -> Floats:
        """Response to the unknowns on the same scale [-], with `finer` times as many nodes."""

    def refined(self, coarse: Floats, fine: Floats) -> Floats:
        """Error of a response with `_FINER` times as many nodes, from one without [-]."""


@dataclass(frozen=True, eq=False)
class Projected:
    """A problem without its linear terms, which take their best values (Golub, Pereyra 1973)."""

    problem: Problem

    @cached_property
    def _basis(self) -> Floats:
        columns = self.problem.baseline
        if not columns.shape[1]:
            return columns
        return np.linalg.qr(columns / np.abs(columns).max(axis=0))[0]

    @cached_property
    def fitting(self) -> Floats:
        """Pseudoinverse of the baseline, shape (terms, rows)."""
        columns = self.problem.baseline
        if not columns.shape[1]:
            return np.asarray(columns.T)
        size = np.abs(columns).max(axis=0)
        return np.asarray(np.linalg.pinv(columns / size) / size[:, None])

    def without_baseline(self, rows: Floats) -> Floats:
        """Part of rows, shape (rows,) or (rows, n), that is perpendicular to the linear terms."""
        return np.asarray(rows - self._basis @ (self._basis.T @ rows))

    def residuals(self, free: Floats, finer: int = 1) -> Floats:
        """Response less measurement with the best linear terms [-]."""
        return self.without_baseline(self.problem.response(free, finer) - self.problem.measured)

    def terms(self, rows: Floats) -> Floats:
        """Linear terms that fit rows best, shape (terms,) or (terms, n)."""
        return np.asarray(self.fitting @ rows)


@dataclass(frozen=True, eq=False)
class Estimate:
    """Least-squares solution with the covariance of unknowns and linear terms."""

    free: Floats  # unknowns: of the law on their unbounded scale, then the others
    terms: Floats  # linear terms
    residuals: Floats
    covariance: Floats  # of the unknowns, followed by the linear terms
    noise: Noise
    widening: float  # largest ratio of a standard error to that under white noise
    is_found: bool  # a further step would change the unknowns by little of their errors

    @property
    def errors(self) -> Floats:
        """Standard errors of the unknowns, followed by the linear terms."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    def quantile(self, confidence: float) -> float:
        """Student's t of two-sided intervals."""
        return student_quantile(self.noise.freedom, 0.5 + confidence / 2)


def estimated(problem: Problem, start: Floats | None = None) -> Estimate:
    """Least-squares solution, from the best start if none is given."""
    projected = Projected(problem)
    first = _best_start(projected) if start is None else start
    penalty = 10.0 + np.abs(projected.residuals(first))  # exceeded where there is no solution

    @lru_cache(maxsize=1)
    def at(values: tuple[float, ...]) -> Floats:
        try:
            return projected.residuals(np.array(values))
        except ValueError:
            return penalty

    def guarded(free: Floats) -> Floats:
        return at(tuple(free.tolist()))

    names = len(problem.shape.names)
    reach = np.concatenate([np.full(names, _REACH), problem.reach])
    bounds = (first - reach, first + reach)
    longest = np.concatenate([np.full(names, _LONGEST), np.full(problem.reach.size, np.inf)])
    slopes = partial(differences, guarded)
    ended = least_squares(guarded, slopes, first, bounds, Tolerances(1e-7, 1e-9, 60), longest)
    return _with_covariance(projected, ended, bounds)


def differences(
    function: Callable[[Floats], Floats], free: Floats, here: Floats | None = None
) -> Floats:
    """Jacobian by forward differences, from what the function is there, if that is known."""
    here = function(free) if here is None else here
    steps = _STEP * np.eye(free.size)
    return np.stack([(function(free + step) - here) / _STEP for step in steps], axis=1)


def _best_start(projected: Projected) -> Floats:
    starts = projected.problem.starts
    tried = [_sum_of_squares(projected, start) for start in starts]
    best = int(np.argmin(tried))
    if not np.isfinite(tried[best]):
        projected.residuals(starts[best])  # raises the error
    return starts[best]


def _sum_of_squares(projected: Projected, free: Floats) -> float:
    try:
        return float(np.sum(projected.residuals(free) ** 2))
    except ValueError:
        return float("inf")


def _with_covariance(projected: Projected, free: Floats, bounds: tuple[Floats, Floats]) -> Estimate:
    """Solution after a last step with finer nodes, and the covariance there."""
    problem = projected.problem
    here = problem.response(free)
    slopes = differences(problem.response, free, here)
    influence = _inverse(projected.without_baseline(slopes))
    fine = problem.response(free, _FINER)
    coarse = projected.without_baseline(fine - problem.measured)
    moved = np.clip(free - influence @ coarse, *bounds)
    rest = problem.measured - problem.response(moved, _FINER)
    finer = -projected.without_baseline(rest)
    if finer @ finer > coarse @ coarse:
        moved, finer, rest = free, coarse, problem.measured - fine
    # What a row changes in the response, the linear terms do not take up.
    linear = projected.fitting - projected.terms(slopes) @ influence
    influence = np.concatenate([influence, linear])
    noise = noise_of(finer, len(influence), _in_contact(problem.response(moved)))
    numerical = influence @ problem.refined(here, fine)
    unseen = influence @ problem.unseen
    covariance = noise.covariance(influence)
    covariance += np.outer(numerical, numerical) + np.outer(unseen, unseen)
    steps = np.abs(influence[: free.size] @ finer)
    return Estimate(
        free=moved,
        terms=projected.terms(rest),
        residuals=finer,
        covariance=covariance,
        noise=noise,
        widening=noise.widening(influence),
        is_found=bool((steps <= _LEFT * np.sqrt(np.diag(covariance))[: free.size]).all()),
    )


def _in_contact(response: Floats) -> slice | None:
    """Rows from the first to the last with a response; None if that is all, or nothing."""
    rows = np.flatnonzero(np.abs(response) > _TOUCH)
    if not rows.size or rows.size == response.size:
        return None
    return slice(int(rows[0]), int(rows[-1]) + 1)


def _inverse(jacobian: Floats) -> Floats:
    """Pseudoinverse, without a limit of the rank: undetermined unknowns have large errors."""
    left, singular, right = np.linalg.svd(jacobian, full_matrices=False)
    floor = np.finfo(np.float64).tiny ** 0.25
    return np.asarray((right.T / np.maximum(singular, floor)) @ left.T)
