"""Prony series from Laplace transforms."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.mechanics.problem.creeping_stack import transformed
from viscontact.mechanics.problem.rational_creep import series_of_transform

S = np.geomspace(1e-3, 1e4, 42)


@pytest.mark.parametrize("fluidity", [0.0, 0.3])
def test_the_series_of_a_transform_is_found_again(fluidity):
    given = SeriesCompliance(0.7, [2.0, 0.5, 3.0], [0.004, 0.3, 12.0], fluidity)
    found = series_of_transform(
        S, S, transformed(given, S), transformed(given, 1j * S), (0.05, 400.0), flows=fluidity > 0
    )
    assert found.times == close_to(given.times, rel=1e-4)
    assert found.amplitudes == close_to(given.amplitudes, rel=1e-4)
    assert (found.instant, found.fluidity) == close_to((0.7, fluidity), rel=1e-4)


def test_a_wide_spectrum_needs_fewer_times_than_it_has():
    # 60 lines of 1/τ between 1e-3 s and 1e2 s; J = Σ (1 - exp(-t/τ)) by itself.
    given = SeriesCompliance(1.0, np.full(60, 0.2), np.geomspace(1e-3, 1e2, 60))
    found = series_of_transform(
        S, S, transformed(given, S), transformed(given, 1j * S), (1e-2, 1e3), flows=False
    )
    assert found.term_count < 20
    times = np.geomspace(1e-3, 1e3, 50)
    assert found(times) == close_to(given(times), rel=1e-4)
    assert (found.amplitudes > 0).all()
