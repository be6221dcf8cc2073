"""Least squares within bounds, on problems of known solutions and against SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import optimize

from closeness import close_to
from viscontact.identification.least_squares import Tolerances, central_differences, least_squares

SHARP = Tolerances(1e-12, 1e-14)
ANYWHERE = (np.full(2, -np.inf), np.full(2, np.inf))


def rosenbrock(x: np.ndarray) -> np.ndarray:
    return np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]])


def solved(function, start, bounds=ANYWHERE, tolerances=SHARP) -> np.ndarray:
    start = np.array(start, float)
    slopes = lambda x: central_differences(function, x)  # noqa: E731
    return least_squares(function, slopes, start, bounds, tolerances)


@pytest.mark.parametrize("start", [(-1.2, 1.0), (5.0, -3.0), (1.0, 1.0)])
def test_rosenbrock_valley_ends_at_one(start: tuple[float, float]) -> None:
    # Moré, Garbow, Hillstrom, ACM Trans. Math. Softw. 7 (1981) 17-41, problem 1
    assert solved(rosenbrock, start) == close_to(np.ones(2), rel=1e-9)


def test_freudenstein_and_roth_end_in_their_local_minimum() -> None:
    def function(x: np.ndarray) -> np.ndarray:
        # problem 2 there: from (0.5, -2) the local minimum of 48.9842 at (11.4128, -0.896805)
        return np.array(
            [
                -13 + x[0] + ((5 - x[1]) * x[1] - 2) * x[1],
                -29 + x[0] + ((x[1] + 1) * x[1] - 14) * x[1],
            ]
        )

    found = solved(function, (0.5, -2.0))
    assert float(function(found) @ function(found)) == close_to(48.9842, rel=1e-5)


def test_bounds_hold_and_the_rest_is_as_good_as_scipy_finds_it() -> None:
    bounds = (np.array([-2.0, -2.0]), np.array([0.5, 2.0]))
    found = solved(rosenbrock, (-1.2, 1.0), bounds)
    expected = optimize.least_squares(rosenbrock, (-1.2, 1.0), bounds=bounds, xtol=1e-15).x
    assert found == close_to(expected, rel=1e-6)
    assert found[0] == 0.5


def test_exponentials_with_noise_end_where_scipy_does() -> None:
    t = np.linspace(0, 4, 60)
    data = 2 * np.exp(-t / 0.7) + 0.05 * np.random.default_rng(0).standard_normal(t.size)

    def misses(x: np.ndarray) -> np.ndarray:
        return np.exp(x[0]) * np.exp(-t / np.exp(x[1])) - data

    expected = optimize.least_squares(misses, (0.0, 2.0), xtol=1e-14, ftol=1e-14).x
    assert solved(misses, (0.0, 2.0)) == close_to(expected, rel=1e-7)


def test_unknown_without_effect_stays() -> None:
    found = solved(lambda x: np.array([x[0] - 3.0, 2 * (x[0] - 3.0)]), (1.0, 7.0))
    assert found == close_to(np.array([3.0, 7.0]))


def test_search_ends_after_its_evaluations() -> None:
    calls = []

    def counted(x: np.ndarray) -> np.ndarray:
        calls.append(x)
        return rosenbrock(x)

    few = Tolerances(1e-12, 1e-14, evaluations=3)
    least_squares(
        counted,
        lambda x: central_differences(rosenbrock, x),
        np.array([-1.2, 1.0]),
        ANYWHERE,
        few,
    )
    assert len(calls) == 3


def decay(x: np.ndarray) -> np.ndarray:
    """Misses of exp(-t/tau), over ln(1/tau); those of a fast decay no longer change."""
    t = np.linspace(0.1, 5, 50)
    return np.exp(-t * np.exp(x[0])) - np.exp(-t)


def test_a_limited_step_does_not_jump_past_the_solution() -> None:
    # The linear model of a slow decay leads to ln(1/tau) > 100, with a lower sum of squares.
    slopes = lambda x: central_differences(decay, x)  # noqa: E731
    anywhere, start = (np.array([-np.inf]), np.array([np.inf])), np.array([-6.0])
    assert float(np.sum(decay(np.array([100.0])) ** 2)) < float(np.sum(decay(start) ** 2))
    found = least_squares(decay, slopes, start, anywhere, SHARP, np.array([2.0]))
    assert found == close_to(np.zeros(1), abs=1e-7)


def test_no_step_is_longer_than_the_longest() -> None:
    ends = [np.array([-1.2, 1.0])]

    def noted(x: np.ndarray) -> np.ndarray:
        ends.append(x)  # where a step ends, the slopes are asked for
        return central_differences(rosenbrock, x)

    found = least_squares(rosenbrock, noted, ends[0], ANYWHERE, SHARP, np.array([0.1, np.inf]))
    assert found == close_to(np.ones(2), rel=1e-9)
    assert 0.09 < np.abs(np.diff(np.array(ends)[:, 0])).max() <= 0.1 + 1e-12


def test_a_start_without_a_number_is_refused() -> None:
    # as by SciPy's least_squares: "Residuals are not finite in the initial point"
    with pytest.raises(ValueError, match=r"residuals must be finite .* got nan in row 1"):
        solved(lambda x: np.array([x[0], np.nan * x[1]]), (1.0, 2.0))


def test_slopes_without_a_number_are_refused() -> None:
    slopes = lambda x: np.array([[np.inf, 0.0], [0.0, 1.0]])  # noqa: E731
    with pytest.raises(ValueError, match=r"slopes must be finite .* got inf in row 0"):
        least_squares(rosenbrock, slopes, np.array([-1.2, 1.0]), ANYWHERE, SHARP)


def test_a_step_to_where_there_is_no_number_is_shortened() -> None:
    def root(x: np.ndarray) -> np.ndarray:
        with np.errstate(invalid="ignore"):
            return np.append(np.sqrt(x[0] + 0.1) - 0.4, x[1])

    # From 1.5 the tangent leads to -0.4, where the root is no number.
    assert solved(root, (1.5, 1.0)) == close_to(np.array([0.06, 0.0]), abs=1e-9)


@pytest.mark.parametrize("step", [1.0, 0.1])
def test_central_differences_are_exact_for_parabolas(step: float) -> None:
    found = central_differences(lambda x: np.array([x[0] ** 2 * step, x[1]]), np.array([2.0, 1.0]))
    assert found == close_to(np.array([[4.0 * step, 0.0], [0.0, 1.0]]), rel=1e-9, abs=1e-9)
