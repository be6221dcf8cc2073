"""Influence coefficients against the integral that defines them, and against themselves."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from closeness import close_to
from verification.independent import love
from viscontact.mechanics.halfspace.influence import influence_coefficient, influence_table

CELLS = [(1.0, 1.0), (30.0, 1.0), (1.0, 30.0), (1.0, 3.0)]


def integral_over_cell(x, y, dx, dy):
    """(1/pi) times the integral of 1/r over the cell: one direction by hand, one by quadrature."""

    def along_x(offset):
        high, low = x + dx / 2, x - dx / 2
        near = max(abs(offset), 1e-300)
        return np.arcsinh(high / near) - np.arcsinh(low / near)

    ends = [y - dy / 2, *([0.0] if abs(y) < dy / 2 else []), y + dy / 2]
    parts = [
        quad(along_x, *pair, epsabs=0, epsrel=1e-12, limit=200)[0]
        for pair in itertools.pairwise(ends)
    ]
    return sum(parts) / np.pi


@pytest.mark.parametrize("cell", CELLS)
def test_coefficients_are_the_integral_of_one_over_distance(cell):
    # At the centre, on the axes and diagonal, on edges and corners, near and beyond the switch of
    # formulas at 20 edges. Measured: 6e-13, the closed form's cancellation at 19 long edges.
    places = [0.0, 0.5, 1.0, 1.7, 6.3, 19.0, 21.0]
    for i, j in itertools.product(places, places):
        x, y = i * cell[0], j * cell[1]
        expected = integral_over_cell(x, y, *cell)
        assert influence_coefficient(x, y, cell) == close_to(expected, rel=1e-11)


@pytest.mark.parametrize("cell", CELLS)
def test_the_whole_table_agrees_with_loves_logarithms_in_extended_precision(cell):
    table = influence_table((64, 50), cell)
    x, y = np.arange(64)[:, None] * cell[0], np.arange(50)[None, :] * cell[1]
    # Measured: 3e-13 for squares, 6e-12 for edges of 30 to 1.
    assert table == close_to(love(x, y, *cell), rel=1e-11)


@pytest.mark.parametrize("cell", CELLS)
def test_nothing_jumps_where_the_far_formula_takes_over(cell):
    switch = 20 * max(cell)
    for angle in np.linspace(0, np.pi / 2, 7):
        ray = switch * (1 + np.array([-1e-9, 1e-9]))
        before, after = influence_coefficient(ray * np.cos(angle), ray * np.sin(angle), cell)
        # The coefficient itself changes by 2e-9 over this gap.
        assert after / before - 1 == close_to(-2e-9, abs=1e-10)


@pytest.mark.parametrize("cell", CELLS)
def test_beyond_twenty_edges_coefficients_are_gauss_sums_of_eight_by_eight_points(cell):
    nodes, weights = np.polynomial.legendre.leggauss(8)
    for edges, angle in itertools.product((20.01, 25.0, 60.0), np.linspace(0, np.pi / 2, 9)):
        x, y = edges * max(cell) * np.cos(angle), edges * max(cell) * np.sin(angle)
        distance = np.hypot(x - nodes[:, None] * cell[0] / 2, y - nodes * cell[1] / 2)
        expected = cell[0] * cell[1] / (4 * np.pi) * (weights @ (1 / distance) @ weights)
        # Measured: 4.5e-14 for squares on the diagonal, 2e-14 for edges of 30 to 1.
        assert influence_coefficient(x, y, cell) == close_to(expected, rel=1e-13, abs=0)


def test_far_away_a_cell_is_a_point_load_and_its_second_moments():
    # 1/r (1 + (3 x²/r² - 1) dx²/(24 r²) + (3 y²/r² - 1) dy²/(24 r²) + O(r^-4)), Taylor's series.
    dx, dy, x, y = 1.0, 2.0, 3e4, 4e4
    r = np.hypot(x, y)
    second = (3 * x**2 / r**2 - 1) * dx**2 + (3 * y**2 / r**2 - 1) * dy**2
    expected = dx * dy / (np.pi * r) * (1 + second / (24 * r**2))
    assert influence_coefficient(x, y, (dx, dy)) == close_to(expected, rel=1e-15)


offset = st.floats(-1e3, 1e3)
edge = st.floats(1e-3, 1e3)


@given(offset, offset, edge, edge)
def test_coefficients_are_positive_even_and_indifferent_to_the_axes_names(x, y, dx, dy):
    value = influence_coefficient(x, y, (dx, dy))
    assert value > 0
    # Rounding of the closed form grows with distance²/(dx dy), at most 400 times the aspect of the
    # cell. Measured: 6e-17 times that.
    rounding = 1e-13 + 4e-16 * 400 * max(dx / dy, dy / dx)
    assert influence_coefficient(-x, y, (dx, dy)) == close_to(value, rel=rounding)
    assert influence_coefficient(x, -y, (dx, dy)) == close_to(value, rel=rounding)
    assert influence_coefficient(y, x, (dy, dx)) == close_to(value, rel=rounding)


@given(st.floats(1e-9, 1e6))
def test_coefficients_are_lengths(scale):
    one = influence_table((5, 4), (1.0, 2.0))
    assert influence_table((5, 4), (scale, 2 * scale)) == close_to(scale * one, rel=1e-12)


def test_four_cells_make_one_of_twice_the_size():
    # Sum rule: the integral is additive over the loaded area.
    x, y, cell = np.linspace(-5, 5, 23)[:, None], np.linspace(-3, 4, 19)[None, :], (1.0, 0.4)
    parts = sum(
        influence_coefficient(x + i * 0.5, y + j * 0.2, cell)
        for i, j in itertools.product((-1, 1), (-1, 1))
    )
    assert parts == close_to(influence_coefficient(x, y, (2.0, 0.8)), rel=1e-12)
