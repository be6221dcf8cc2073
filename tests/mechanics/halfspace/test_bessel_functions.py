"""Bessel functions of arrays against those of SciPy."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from closeness import close_to
from viscontact.mechanics.halfspace.bessel_functions import modified_bessel, spherical_bessel


def test_modified_bessel_functions_are_those_of_scipy_from_the_corner_to_far_away() -> None:
    places = np.geomspace(1e-13, 100.0, 4001)
    order_0, order_1 = modified_bessel(places)
    assert order_0 == close_to(scipy.special.k0(places), rel=1e-11)
    assert order_1 == close_to(scipy.special.k1(places), rel=1e-11)


def test_modified_bessel_functions_are_not_known_where_they_are_not_defined() -> None:
    assert np.isnan(modified_bessel(np.array([0.0, -1.0, np.nan]))).all()


@pytest.mark.parametrize("count", [1, 2, 3, 7, 8, 10])
def test_spherical_bessel_functions_are_those_of_scipy_at_all_places(count: int) -> None:
    places = np.append(0.0, np.geomspace(1e-9, 1e5, 4001))
    expected = scipy.special.spherical_jn(np.arange(count), places[:, None])
    # By recurrence down and up, which meet at the number of orders.
    assert spherical_bessel(count, places) == close_to(expected, abs=1e-14)
