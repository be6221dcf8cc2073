"""Least squares of few unknowns within bounds, by the method of Levenberg and Marquardt.

SciPy has methods for more; to import them takes as long as a fit.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass

_FIRST_DAMPING = 1e-3
_LARGEST_DAMPING = 1e20
_LEAST_SCALE = 1e-14  # of the largest one: an unknown without effect stays where it is
_GOOD = 0.25  # of the decrease that the linear model predicts


@dataclass(frozen=True)
class Tolerances:
    """When a search ends: by the relative change of the unknowns, and of the sum of squares."""

    unknowns: float
    squares: float
    evaluations: int = 400


def least_squares(
    residuals: Callable[[Floats], Floats],
    jacobian: Callable[[Floats], Floats],
    start: Floats,
    bounds: tuple[Floats, Floats],
    tolerances: Tolerances,
    longest: Floats | None = None,
) -> Floats:
    """Unknowns that minimise the sum of squares of residuals, as far as steps from a start lead.

    Steps of Gauss and Newton with damping on the scale of each unknown [1]_, which falls with the
    success of a step [2]_. A step that would change an unknown by more than the `longest` for it is
    shortened, along its direction: the linear model does not reach so far, and beyond a solution
    may lie a region where the residuals no longer change.

    References
    ----------
    .. [1] J. J. Moré, The Levenberg-Marquardt algorithm: implementation and theory, Lecture Notes
       in Mathematics 630 (1978) 105-116.
    .. [2] H. B. Nielsen, Damping parameter in Marquardt's method, IMM-REP-1999-05, 1999.
    """
    low, high = bounds
    here = np.clip(start, low, high)
    missed = _finite("residuals", residuals(here))
    squares, damping, left = float(missed @ missed), _FIRST_DAMPING, tolerances.evaluations - 1
    scale = np.zeros(here.size)
    while left > 0 and squares > 0:
        slopes = _finite("slopes", jacobian(here))
        gradient, normal = slopes.T @ missed, slopes.T @ slopes
        scale = _grown(scale, np.diag(normal))
        free = ~((here <= low) & (gradient > 0) | (here >= high) & (gradient < 0))
        growth = 2.0
        while left > 0:
            step = _shortened(_step(normal, gradient, damping * scale, free), longest)
            tried = np.clip(here + step, low, high)
            step = tried - here
            least = tolerances.unknowns * (tolerances.unknowns + float(np.linalg.norm(here)))
            if np.linalg.norm(step) < least or damping > _LARGEST_DAMPING:
                return here
            missed_there = residuals(tried)
            left -= 1
            there = float(missed_there @ missed_there)
            gain = _gain(squares - there, gradient, normal, step)
            if there < squares:
                break
            damping, growth = damping * growth, 2 * growth
        else:
            return here
        is_last = squares - there < tolerances.squares * squares and gain > _GOOD
        here, missed, squares = tried, missed_there, there
        damping *= max(1 / 3, 1 - (2 * gain - 1) ** 3)
        if is_last:
            return here
    return here


def _grown(scale: Floats, squares: Floats) -> Floats:
    """Largest scale of each unknown so far, above 0."""
    scale = np.maximum(scale, squares)
    return np.maximum(scale, max(_LEAST_SCALE * float(scale.max()), 1e-300))


def _step(normal: Floats, gradient: Floats, damping: Floats, free: Bools) -> Floats:
    """Step of the unknowns that are not held by a bound."""
    step = np.zeros(gradient.size)
    if free.any():
        damped = normal[np.ix_(free, free)] + np.diag(damping[free])
        step[free] = np.linalg.solve(damped, -gradient[free])
    return step


def _shortened(step: Floats, longest: Floats | None) -> Floats:
    """Step, shortened so that it changes no unknown by more than the longest for it."""
    if longest is None:
        return step
    return np.asarray(step / max(1.0, float((np.abs(step) / longest).max())))


def _gain(decrease: float, gradient: Floats, normal: Floats, step: Floats) -> float:
    """Decrease of the sum of squares over that of the linear model; 0 if this is none."""
    predicted = -float(2 * gradient @ step + step @ normal @ step)
    return decrease / predicted if predicted > 0 else 0.0


def _finite(what: str, rows: Floats) -> Floats:
    """Rows, if all of their numbers lead to a step."""
    bad = np.argwhere(~np.isfinite(rows))
    if bad.size:
        got, row = rows[tuple(bad[0])], int(bad[0, 0])
        raise ValueError(
            f"least_squares: {what} must be finite where a step begins, got {got} in row {row}; "
            "begin from other unknowns, or leave out the rows without a number"
        )
    return rows


def central_differences(function: Callable[[Floats], Floats], free: Floats) -> Floats:
    """Jacobian by central differences."""
    steps = np.cbrt(np.finfo(np.float64).eps) * np.maximum(np.abs(free), 1.0)
    columns = [
        (function(free + way) - function(free - way)) / (2 * step)
        for step, way in zip(steps, np.diag(steps), strict=True)
    ]
    return np.stack(columns, axis=1)
