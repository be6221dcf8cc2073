"""Least squares of a calibration: the search on coarse cells, and the correction on the case's."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import least_squares
from scipy.special import stdtrit
from scipy.stats import qmc

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.evaluation import BudgetSpentError, Level

#: Step of the differences, in parts of the ranges: well above the tolerance of the solver.
_STEP = 5e-4
#: First trust region, in parts of the ranges: a long first step may end far from the optimum, where
#: the response depends on nothing. Searches from different starts, at most, where one ends at a
#: bound, and the part of a range that counts as its bound.
_FIRST_REGION, _DESCENTS, _AT_BOUND = 0.2, 3, 1e-3
#: Corrections on the cells of the case, at most, and the part of a standard error below which
#: another one is not worth while.
_CORRECTIONS, _SMALL = 3, 0.1


@dataclass(frozen=True)
class Optimum:
    """Least squares on the cells of the case: p parameters and n residuals."""

    point: Floats  # parts of the ranges (p,)
    shift: Floats  # from the least squares on the coarse cells (p,)
    residuals: Floats  # fitted less measured values over the largest of each record [-] (n,)
    jacobian: Floats  # of the residuals by the parts (n, p)
    complete: bool  # False if the runs were used up before the search had ended

    @property
    def freedom(self) -> int:
        """Degrees of freedom."""
        return int(self.residuals.size - self.point.size)

    @property
    def covariance(self) -> Floats:
        """Covariance of the parts, from the scatter of the residuals."""
        variance = float(self.residuals @ self.residuals) / self.freedom
        _, singular, directions = np.linalg.svd(self.jacobian, full_matrices=False)
        least = np.finfo(np.float64).eps * max(float(singular.max()), 1e-300)
        spread = directions / np.maximum(singular, least)[:, None]
        return np.asarray(variance * spread.T @ spread)

    @property
    def correlation(self) -> Floats:
        """Correlation of the parts."""
        errors = np.sqrt(np.diag(self.covariance))
        return np.asarray(self.covariance / np.outer(errors, errors))

    def reach(self, confidence: float) -> Floats:
        """Half widths of the confidence intervals, in parts."""
        student = float(stdtrit(self.freedom, 0.5 + confidence / 2))
        return np.asarray(student * np.sqrt(np.diag(self.covariance)))


#: Residuals at several points, parts of the ranges, or the reason where there are none.
Evaluate = Callable[[Sequence[Floats], Level], Sequence[Floats | str]]


class NoResidualsError(ValueError):
    """There are no residuals at a point; the message has the reason."""


def search(evaluate: Evaluate, *starts: Floats) -> Optimum:
    """Find the least squares from the best start; NoResidualsError if there are none at any.

    BudgetSpentError if the runs are used up before the first derivatives are known.
    """
    found = _Descent(evaluate, starts)
    complete = True
    try:
        found.begin()
        found.descend()
    except BudgetSpentError:
        complete = False
        if found.jacobian is None:
            raise
    assert found.jacobian is not None
    point, shift, residuals = _correct(evaluate, found.best, found.jacobian)
    return Optimum(point, shift, residuals, found.jacobian, complete)


def _all_residuals(evaluate: Evaluate, points: Sequence[Floats], level: Level) -> list[Floats]:
    """Residuals at all points; NoResidualsError if one has none."""
    found = []
    for each in evaluate(points, level):
        if isinstance(each, str):
            raise NoResidualsError(each)
        found.append(each)
    return found


class _Descent:
    """Search on the coarse cells, which keeps its best point."""

    # Trust-region reflective (Branch, Coleman and Li 1999).

    def __init__(self, evaluate: Evaluate, given: Sequence[Floats]) -> None:
        self._evaluate, self._given = evaluate, given
        self._least = np.inf
        self._penalty = np.zeros(0)
        self._starts: list[tuple[float, tuple[float, ...]]] = []
        self.best = np.zeros(0)
        self.jacobian: Floats | None = None

    def begin(self) -> None:
        """Rank the given starts and some others in the ranges."""
        count = self._given[0].size
        others = qmc.Sobol(count, scramble=False).random_base2(2 + (count > 2))[1:]
        for point in (*self._given, *others):
            residuals = self._try(point)
            if residuals is not None:
                self._starts.append((float(residuals @ residuals), tuple(point.tolist())))
        reached = self.best if self._starts else self._given[0]  # which raises the reason
        self._penalty = 10.0 + np.abs(_all_residuals(self._evaluate, [reached], "coarse")[0])

    def descend(self) -> None:
        """Search from the best start, and from others if the search ends at a bound."""
        for _, start in sorted(self._starts)[:_DESCENTS]:
            self._descend(np.clip(start, 0.02, 0.98))
            if np.all((self.best > _AT_BOUND) & (self.best < 1 - _AT_BOUND)):
                break
        self.jacobian = self._jacobian(self.best)

    def _descend(self, start: Floats) -> None:
        # The first trust region is as large as the norm of the start: the origin is put near it.
        origin = start - _FIRST_REGION / np.sqrt(start.size)
        least_squares(
            lambda offset: self._residuals(origin + offset),
            start - origin,
            jac=lambda offset: self._jacobian(origin + offset),
            bounds=(-origin, 1.0 - origin),
            xtol=1e-5,
            ftol=1e-7,
            gtol=1e-10,
            max_nfev=40,
        )

    def _try(self, point: Floats) -> Floats | None:
        (residuals,) = self._evaluate([point], "coarse")
        if isinstance(residuals, str):
            return None
        squares = float(residuals @ residuals)
        if squares < self._least:
            self._least, self.best = squares, np.array(point)
        return residuals

    def _residuals(self, point: Floats) -> Floats:
        residuals = self._try(point)
        return self._penalty if residuals is None else residuals

    def _jacobian(self, point: Floats) -> Floats:
        """Jacobian by differences that point away from the bounds."""
        steps = np.where(point + _STEP <= 1.0, _STEP, -_STEP)
        try:
            self.jacobian = self._differences(point, steps)
        except NoResidualsError:  # on that side of the point
            self.jacobian = self._differences(point, -steps)
        return self.jacobian

    def _differences(self, point: Floats, steps: Floats) -> Floats:
        moved = [point + step * unit for step, unit in zip(steps, np.eye(point.size), strict=True)]
        here, *there = _all_residuals(self._evaluate, [point, *moved], "coarse")
        columns = [(each - here) / step for each, step in zip(there, steps, strict=True)]
        return np.stack(columns, axis=1)


def _correct(evaluate: Evaluate, coarse: Floats, jacobian: Floats) -> tuple[Floats, Floats, Floats]:
    """Least squares on the case's cells with steps half as long: point, its shift, residuals."""
    # Gauss-Newton steps with the Jacobian of the coarse cells, which is near enough.
    (residuals,), best = _all_residuals(evaluate, [coarse], "case"), coarse
    inverse = np.linalg.pinv(jacobian)
    variance = float(residuals @ residuals) / (residuals.size - coarse.size)
    errors = np.sqrt(variance * np.diag(inverse @ inverse.T))
    shift = -inverse @ residuals
    for _ in range(_CORRECTIONS):
        trial = np.clip(best - inverse @ residuals, 0.0, 1.0)
        (changed,) = evaluate([trial], "case")
        if isinstance(changed, str) or changed @ changed > residuals @ residuals:
            break
        moved, best, residuals = trial - best, trial, changed
        shift = best - coarse
        if (np.abs(moved) <= _SMALL * errors).all():
            break
    return best, shift, residuals
