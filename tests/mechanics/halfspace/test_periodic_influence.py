"""Influence coefficients of a rectangle that repeats along one axis."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.influence import influence_coefficient
from viscontact.mechanics.halfspace.layered_influence import periodic_layered_table
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE

DATUM = 40.0


def strip(y, width, datum=DATUM):
    """Displacement by a strip without end on a half-plane, -(2/pi) ∫ ln|y| dy (Johnson 2.3)."""

    def primitive(s):
        return s * np.log(np.abs(s) / datum) - s

    return -2 / np.pi * (primitive(y + width / 2) - primitive(y - width / 2))


@pytest.mark.parametrize("edge", [0.05, 0.3, 3.0, 20.0])
@pytest.mark.parametrize("cells", [1, 2, 6, 7])
def test_cells_along_a_period_make_the_strip_of_a_half_plane(cells, edge):
    """Johnson 1985, section 2.3, whatever the shape of the cells and their number."""
    table = periodic_layered_table((cells, 8), (0.25, edge), HALF_SPACE, DATUM)
    exact = strip(edge * np.arange(8), edge)
    assert np.abs(table.sum(axis=0) - exact).max() < 1e-10 * exact[0]


@pytest.mark.parametrize("place", [(0, 1), (3, 0), (1, 7), (3, 7)])
def test_direct_sum_of_many_images(place):
    """The difference of two places has a limit; the images left out fall as 1/count²."""
    cell, period = (0.25, 0.3), 1.5
    table = periodic_layered_table((6, 8), cell, HALF_SPACE, DATUM)

    def direct(count):
        x = np.arange(-count, count + 1) * period
        there = influence_coefficient(place[0] * cell[0] + x, place[1] * cell[1], cell)
        return float((there - influence_coefficient(x, 0.0, cell)).sum())

    few, many = direct(1000), direct(2000)
    assert table[place] - table[0, 0] == close_to(many + (many - few) / 3, abs=2e-11)


def test_far_images_of_a_long_period_are_far():
    """In a period much longer than the distance, differences are those of a single rectangle."""
    table = periodic_layered_table((4000, 4), (1.0, 1.0), HALF_SPACE, DATUM)[:4]
    single = influence_coefficient(np.arange(4.0)[:, None], np.arange(4.0), (1.0, 1.0))
    assert np.abs((table - table[0, 0]) - (single - single[0, 0])).max() < 1e-5


@pytest.mark.parametrize("mirrored", [False, True])
def test_convolution_is_the_sum_over_all_pairs(mirrored):
    """Circular along the period, linear across."""
    table = periodic_layered_table((5, 6), (0.3, 0.2), HALF_SPACE, DATUM)
    random = np.random.default_rng(1)
    pressure = random.random((5, 6))
    if mirrored:
        pressure += pressure[:, ::-1]
    operator = Convolution(table, mirrored=(False, mirrored), periodic=(True, False))
    found = operator.apply(pressure[:, 3:] if mirrored else pressure)
    i, j = np.indices((5, 6)).reshape(2, -1)
    pairs = table[(i[:, None] - i) % 5, np.abs(j[:, None] - j)]
    direct = (pairs @ pressure.ravel()).reshape(5, 6)
    assert np.abs(found - (direct[:, 3:] if mirrored else direct)).max() < 1e-13


def test_reciprocity_and_positive_energy():
    """Pressure without resultant displaces against itself: the operator is positive there."""
    table = periodic_layered_table((4, 6), (0.3, 0.2), HALF_SPACE, DATUM)
    random = np.random.default_rng(2)
    operator = Convolution(table, periodic=(True, False))
    one, two = (each - each.mean() for each in random.normal(size=(2, 4, 6)))
    assert np.vdot(one, operator.apply(two)) == close_to(np.vdot(two, operator.apply(one)))
    assert np.vdot(one, operator.apply(one)) > 0
