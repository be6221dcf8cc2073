"""Half-space under a load in steady motion, against quadrature, limits and exact waves."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.influence import influence_coefficient, influence_table
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, moving_influence_table
from viscontact.mechanics.halfspace.preconditioner import MovingPreconditioner
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE

ZENER = MovingCompliance(1.0, np.array([9.0]), np.array([0.8]))
SHAPE, CELL = (7, 5), (0.7, 1.9)


def one_mode(length, period=None):
    periods = np.empty(0) if period is None else np.array([period])
    return MovingCompliance(0.0, np.array([1.0]), np.array([length]), periods)


def delayed(x, y, cell, length):
    """Coefficient of one mode by adaptive quadrature, split at the edges of the cell."""

    def integrand(s):
        return np.exp(-s) * influence_coefficient(x + length * s, y, cell)

    edges = [(edge - x) / length for edge in (-cell[0] / 2, cell[0] / 2)]
    ends = sorted({0.0, 1e-4, 0.01, 0.1, 1.0, 10.0, 45.0, *(e for e in edges if 0 < e < 45)})
    parts = [
        quad(integrand, *pair, epsabs=1e-12, epsrel=1e-11, limit=200)[0]
        for pair in itertools.pairwise(ends)
    ]
    return sum(parts)


@pytest.mark.parametrize(
    "length", [0.001, 0.3, *(pytest.param(each, marks=pytest.mark.slow) for each in (0.01, 30.0))]
)
@pytest.mark.parametrize(
    "cell",
    [
        (1.0, 8.0),
        *(pytest.param(each, marks=pytest.mark.slow) for each in ((1.0, 1.0), (1.0, 0.1))),
    ],
)
def test_coefficients_are_the_delayed_integral(cell, length):
    table = moving_influence_table((5, 2), cell, one_mode(length), axis=0)
    largest = influence_coefficient(0.0, 0.0, cell)
    for i, j in [(-4, 0), (-1, 1), (0, 0), (1, 0)]:
        expected = delayed(i * cell[0], j * cell[1], cell, length)
        # Measured: 2e-9 at lengths of a thousandth of a cell, 1e-12 from a tenth on.
        error = 1e-8 if length < 0.01 else 1e-9
        assert table[i + 4, j] == close_to(expected, abs=error * largest)


def test_slow_motion_has_the_relaxed_compliance_and_fast_motion_the_instant_one():
    elastic = influence_table(SHAPE, CELL)
    signed = np.concatenate([elastic[:0:-1], elastic])
    for length, compliance in ((1e-7, 10.0), (1e9, 1.0)):
        moving = MovingCompliance(1.0, np.array([9.0]), np.array([length]))
        table = moving_influence_table(SHAPE, CELL, moving, axis=0)
        assert np.abs(table / (compliance * signed) - 1).max() < 1e-4


def test_the_surface_recovers_behind_the_load():
    """Memory lies ahead: what was under the load is behind it, and still displaced."""
    table = moving_influence_table(SHAPE, CELL, ZENER, axis=0)
    ahead, behind = table[-1, 0], table[0, 0]
    assert behind > 1.2 * ahead


def test_motion_along_y_is_motion_along_x_with_exchanged_axes():
    along_x = moving_influence_table(SHAPE, CELL, ZENER, axis=0)
    along_y = moving_influence_table(SHAPE[::-1], CELL[::-1], ZENER, axis=1)
    assert (along_y == along_x.T).all()


@pytest.mark.parametrize("length", [0.5, 40.0, 3e3])
def test_a_material_that_returns_keeps_what_is_left_of_earlier_passes(length):
    """One turn later the load is a period ahead, in material that has had exp(-period/l) to it."""
    period, count = 30.0, 4
    once = moving_influence_table((16, 2), (1.0, 1.0), one_mode(length), axis=0)
    table = moving_influence_table((count, 2), (1.0, 1.0), one_mode(length, period), axis=0)

    def passing(x, cells):
        return np.exp((cells - x) / length) * influence_coefficient(x, 0.0, (1.0, 1.0)) / length

    for cells in (-3, 0, 3):
        # Passes between half a period behind and ahead of the load, by quadrature.
        ends = itertools.pairwise([-15.0, -0.5, 0.5, 15.0])
        passed = sum(quad(passing, *pair, args=(cells,), epsrel=1e-10)[0] for pair in ends)
        earlier = passed / np.expm1(period / length) if period < 500 * length else 0.0
        beyond = np.exp(-(15.0 - cells) / length) * once[-1, 0]
        expected = once[cells + 15, 0] - beyond + earlier
        assert table[cells + count - 1, 0] == close_to(expected, rel=1e-8)


def test_a_period_shorter_than_the_table_is_refused():
    with pytest.raises(ValueError, match="longer than the period"):
        moving_influence_table((8, 2), (1.0, 1.0), one_mode(1.0, 14.0), axis=0)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("single", [False, True])
def test_the_convolution_is_the_direct_sum(axis, single):
    table = moving_influence_table(SHAPE, CELL, ZENER, axis)
    pressure = np.random.default_rng(3).standard_normal(SHAPE)
    expected = np.zeros(SHAPE)
    for i, j in np.ndindex(SHAPE):
        rows, columns = np.arange(SHAPE[0]) - i, np.arange(SHAPE[1]) - j
        if axis == 0:
            part = table[np.ix_(rows + SHAPE[0] - 1, np.abs(columns))]
        else:
            part = table[np.ix_(np.abs(rows), columns + SHAPE[1] - 1)]
        expected += pressure[i, j] * part
    found = Convolution(table, signed=axis, single=single).apply(pressure)
    error = np.abs(found - expected).max() / np.abs(expected).max()
    assert error < (1e-6 if single else 1e-14)


@pytest.mark.parametrize("axis", [0, 1])
def test_on_one_half_it_is_the_convolution_of_an_even_field(axis):
    shape = (6, 10)
    table = moving_influence_table(shape, CELL, ZENER, axis)
    half = np.random.default_rng(4).standard_normal((6, 5) if axis == 0 else (3, 10))
    whole = np.concatenate([np.flip(half, 1 - axis), half], 1 - axis)
    mirrored = (axis == 1, axis == 0)
    expected = Convolution(table, signed=axis).apply(whole)
    found = Convolution(table, signed=axis, mirrored=mirrored).apply(half)
    kept = expected[:, 5:] if axis == 0 else expected[3:]
    assert np.abs(found - kept).max() < 1e-14 * np.abs(kept).max()


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("cells", [24, 25])
def test_the_preconditioner_inverts_a_wave(axis, cells):
    """exp(i k x) under the complex compliance, which shifts the displacement behind the load."""
    k = 2 * np.pi * 3 / cells
    position = np.arange(cells)[:, None]
    along = np.tile(np.exp(1j * k * position), (1, 6))
    complex_compliance = complex(ZENER.at_wave_number(np.array(k)))
    displacement, pressure = (complex_compliance * 2 / k * along).real, along.real
    if axis == 1:
        displacement, pressure = displacement.T, pressure.T
    operator = MovingPreconditioner(displacement.shape, (1.0, 1.0), [(HALF_SPACE, ZENER)], axis)
    assert operator.apply(displacement) == close_to(pressure, abs=1e-5)
