"""Cubic splines of several functions: those of SciPy."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from closeness import close_to
from viscontact.mechanics.halfspace.cubic_curves import CubicCurves


def test_curves_are_those_of_scipy() -> None:
    rng = np.random.default_rng(3)
    knots = np.cumsum(rng.uniform(0.2, 1.0, 14))
    values = rng.normal(size=(14, 3))
    places = np.linspace(knots[0] - 0.3, knots[-1] + 0.3, 90).reshape(9, 10)
    found = CubicCurves.through(knots, values)
    assert found(places) == close_to(CubicSpline(knots, values)(places), rel=1e-10, abs=1e-12)
    assert found.count == 3


def test_curves_through_a_cubic_are_that_cubic() -> None:
    knots = np.array([0.0, 0.4, 0.5, 1.7, 2.0])
    places = np.linspace(-1.0, 3.0, 21)
    found = CubicCurves.through(knots, np.stack([knots**3, 1 - knots**2], axis=1))(places)
    assert found == close_to(np.stack([places**3, 1 - places**2], axis=1), rel=0.0, abs=1e-12)
