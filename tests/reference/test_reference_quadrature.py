"""Quadrature of hereditary integrals against closed forms."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import dawsn

from closeness import close_to
from viscontact.reference.hereditary import accumulated, averaged, evaluate, superposed
from viscontact.reference.lag_means import instant_compliance, lag_mean
from viscontact.reference.profiles import arcsine
from viscontact.reference.rod_history import RodHistory


def test_functions_are_evaluated_at_times_of_any_shape():
    assert evaluate(lambda t: 2 * t, [[1.0, 2.0]]).tolist() == [[2.0, 4.0]]
    assert instant_compliance(lambda t: 1e-9 * (1 + t)) == 1e-9


def test_root_is_integrated_from_its_singular_beginning():
    assert accumulated(np.sqrt, 9.0) == close_to(18.0, rel=1e-12)


def test_mean_over_no_interval_is_the_value():
    found = averaged(np.square, np.array([3.0, 3.0]), np.array([6.0, 3.0]))
    assert found == close_to([21.0, 9.0], rel=1e-10)


def test_exponential_kernel_over_a_root_is_dawsons_integral():
    """∫ exp(t' - 1) d√t' from 0 to 1 is Dawson's integral of 1 (DLMF 7.2.5)."""
    zero, one = np.zeros(1), np.ones(1)
    found = superposed(lambda lag: np.exp(-lag), np.sqrt, zero, one, one)
    assert found[0] == close_to(dawsn(1.0), rel=1e-12)


def test_arcsine_of_a_half():
    assert arcsine(np.array(1.0), np.array(2.0)) == close_to(math.pi / 6, rel=1e-12)


def test_load_that_grows_evenly_displaces_by_the_mean_compliance():
    """J = 1 + t over lags of 2 to 4: 3 times 4."""
    history = RodHistory(lag_mean(lambda t: 1.0 + t), rods=1, steps=1)
    history.add_whole(0.0, 2.0, np.array([3.0]))
    assert history.displacement_at(4.0) == close_to([12.0], rel=1e-12)
