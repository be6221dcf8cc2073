"""Least squares of a calibration on formulas in place of runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import ttest_1samp

from closeness import close_to
from viscontact.studies.calibration.fit_case import notes_on
from viscontact.studies.calibration.search import (
    Evaluate,
    NoResidualsError,
    Optimum,
    search,
)
from viscontact.studies.calibration.unknowns import Unknown
from viscontact.studies.evaluation import BudgetSpentError, Level
from viscontact.studies.space import Range

Array = NDArray[np.float64]

TIMES = np.linspace(0.0, 3.0, 20)
#: Parts of the ranges.
TRUE = np.array([0.62, 0.27])
NAMES = ("material.shear_modulus", "material.viscosity")
UNKNOWNS = tuple(Unknown(Range(name, 1.0, 3.0, "MPa"), 0.5) for name in NAMES)


def decay(point: Array) -> Array:
    """Exponential that has an amplitude and a rate as its parameters."""
    return np.asarray((1 + 2 * point[0]) * np.exp(-(0.2 + 2 * point[1]) * TIMES))


def evaluate_of(
    model: Callable[[Array], Array],
    measured: Array,
    *,
    budget: int = 1000,
    error: float = 0.0,
    fails: Callable[[Array], bool] = lambda point: False,
) -> Evaluate:
    """Residuals of a model, whose values on coarse cells are too large by a relative error."""
    left = [budget]

    def evaluate(points: Sequence[Array], level: Level) -> list[Array | str]:
        if level == "coarse":
            left[0] -= len(points)
            if left[0] < 0:
                raise BudgetSpentError
        scale = 1 + error if level == "coarse" else 1.0
        return [
            "no run at these values" if fails(each) else scale * model(each) - measured
            for each in points
        ]

    return evaluate


def searched(evaluate: Evaluate, size: int = 2) -> Optimum:
    return search(evaluate, np.full(size, 0.5))


def test_parameters_of_an_exponential_are_found_to_six_digits() -> None:
    found = searched(evaluate_of(decay, decay(TRUE)))
    np.testing.assert_allclose(found.point, TRUE, rtol=1e-6)
    assert found.complete


def test_the_optimum_is_that_of_the_cells_of_the_case_and_the_shift_is_stated() -> None:
    # Where the coarse values are too large by 2 %, the amplitude 1 + 2 x is too small by it.
    found = searched(evaluate_of(decay, decay(TRUE), error=0.02))
    np.testing.assert_allclose(found.point, TRUE, rtol=1e-4)
    coarse = ((1 + 2 * TRUE[0]) / 1.02 - 1) / 2
    assert found.point[0] - found.shift[0] == close_to(coarse, rel=1e-3)


def test_values_without_a_run_are_avoided() -> None:
    evaluate = evaluate_of(decay, decay(TRUE), fails=lambda point: bool(point[0] > 0.8))
    np.testing.assert_allclose(searched(evaluate).point, TRUE, rtol=1e-5)


def test_a_start_without_any_run_raises_the_reason() -> None:
    evaluate = evaluate_of(decay, decay(TRUE), fails=lambda point: True)
    with pytest.raises(NoResidualsError, match="no run at these values"):
        searched(evaluate)


def test_intervals_of_scattered_values_hold_the_true_ones() -> None:
    # 95 of 100 intervals of each parameter, within three standard deviations of that number.
    held = np.zeros(2)
    for seed in range(100):
        scatter = 0.01 * np.random.default_rng(seed).standard_normal(TIMES.size)
        found = searched(evaluate_of(decay, decay(TRUE) + scatter))
        held += abs(found.point - TRUE) < found.reach(0.95)
        assert abs(found.correlation[0, 1]) < 0.99
    assert (abs(held - 95) <= 7).all()


def test_interval_of_a_mean_is_students() -> None:
    values = np.array([1.0, 2.0, 4.0, 7.0])
    ones = np.ones((4, 1))
    found = Optimum(np.array([values.mean()]), np.zeros(1), values.mean() - values, ones, True)
    (low, high) = ttest_1samp(values, 0.0).confidence_interval(0.95)
    assert found.reach(0.95)[0] == close_to((high - low) / 2, rel=1e-12)


def test_spent_runs_leave_the_best_values_with_a_note() -> None:
    found = searched(evaluate_of(decay, decay(TRUE), budget=12))
    assert not found.complete
    (note,) = [each for each in notes_on(UNKNOWNS, found, 0.95, 12) if "runs" in each]
    assert "the search ended after 12 runs" in note
    with pytest.raises(BudgetSpentError):
        searched(evaluate_of(decay, decay(TRUE), budget=1))


def test_inseparable_parameters_are_named() -> None:
    def product(point: Array) -> Array:
        return np.asarray((1 + point[0]) * (1 + point[1]) * TIMES)

    # A little scatter, so that the covariance is not zero.
    scatter = 1e-4 * np.random.default_rng(0).standard_normal(TIMES.size)
    found = searched(evaluate_of(product, product(TRUE) + scatter))
    notes = list(notes_on(UNKNOWNS, found, 0.95, 100))
    assert "material.shear_modulus and material.viscosity cannot be distinguished" in notes[0]
    assert np.prod(1 + found.point) == close_to(np.prod(1 + TRUE), rel=1e-3)


def test_a_value_at_its_bound_is_named_with_the_bound() -> None:
    found = searched(evaluate_of(decay, decay(np.array([1.3, 0.27]))))
    notes = list(notes_on(UNKNOWNS, found, 0.95, 100))
    assert "material.shear_modulus lies at its bound 3 MPa; widen its range" in notes
