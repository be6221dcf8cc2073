"""Monotone curve through points against SciPy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from closeness import close_to
from viscontact.identification.monotone_curve import monotone_curve


@pytest.mark.parametrize("points", [2, 3, 4, 7, 60])
@pytest.mark.parametrize("rising", [True, False])
def test_curve_is_that_of_scipy(points: int, rising: bool) -> None:
    rng = np.random.default_rng(points)
    places = np.cumsum(rng.uniform(0.01, 1.0, points))
    steps = rng.standard_normal(points)
    values = np.cumsum(np.abs(steps) if rising else steps)
    at = np.append(rng.uniform(places[0], places[-1], 200), places)
    expected = PchipInterpolator(places, values)(at)
    assert monotone_curve(places, values, at) == close_to(expected, abs=1e-12 * np.ptp(values))


def test_curve_of_level_points_is_level() -> None:
    found = monotone_curve(np.array([0.0, 1.0, 3.0]), np.ones(3), np.array([0.3, 2.0, 3.0]))
    assert (found == 1.0).all()
