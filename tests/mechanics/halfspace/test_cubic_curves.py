"""Cubics of several functions on panels: those of SciPy, and their order."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace.cubic_curves import CubicCurves
from viscontact.mechanics.halfspace.log_panels import LogPanels

PANELS = LogPanels.over(0.1, 20.0, 3.0)
LOGARITHMS = np.linspace(PANELS.edges[0], PANELS.edges[-1], 301).reshape(7, 43)


def _decaying(logarithms: Floats) -> Floats:
    places = np.exp(logarithms)
    return np.stack([np.exp(-places), places * np.exp(-places)], axis=-1)


def test_curves_are_those_of_scipy_through_values_and_slopes() -> None:
    panels = LogPanels.over(0.1, 20.0, 1.5)  # on which polynomials are exact, to rounding
    knots = np.linspace(panels.edges[0], panels.edges[-1], 8 * (len(panels.edges) - 1) + 1)
    places = np.exp(knots)[:, None]
    slopes = places * np.exp(-places) * np.column_stack([-np.ones(len(knots)), 1 - places])
    expected = CubicHermiteSpline(knots, _decaying(knots), slopes)
    found = CubicCurves.on_panels(panels, _decaying(panels.logarithms), 8)
    assert found(LOGARITHMS) == close_to(expected(LOGARITHMS), rel=0.0, abs=1e-10)


def test_curves_are_of_fourth_order() -> None:
    panels = LogPanels.over(0.1, 3.0, 2.0)  # on which polynomials miss less than cubics
    logarithms = np.linspace(panels.edges[0], panels.edges[-1], 400)
    values = _decaying(panels.logarithms)
    errors = [
        np.abs(CubicCurves.on_panels(panels, values, parts)(logarithms) - _decaying(logarithms))
        for parts in (2, 4, 8)
    ]
    most = np.array([each.max() for each in errors])
    assert np.log2(most[:-1] / most[1:]) == close_to(np.array([4.0, 4.0]), abs=0.3)


def test_curves_through_a_cubic_are_that_cubic_also_beyond_the_panels() -> None:
    def cubic(x: Floats) -> Floats:
        return np.stack([x**3, 1 - x**2], axis=-1)

    found = CubicCurves.on_panels(PANELS, cubic(PANELS.logarithms), 3)
    beyond = np.linspace(PANELS.edges[0] - 1.0, PANELS.edges[-1] + 1.0, 50)
    assert found(beyond) == close_to(cubic(beyond), rel=0.0, abs=1e-10)
