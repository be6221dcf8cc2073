"""The operator against the sum over all pairs of cells that it abbreviates."""

import numpy as np
import pytest

from viscontact.convolution import Convolution, MirroredConvolution, Preconditioner
from viscontact.influence import influence_coefficient, influence_table

SHAPES = [(1, 1), (2, 3), (7, 11), (8, 8), (13, 16), (31, 6), (5, 37)]
CELL = (0.7, 1.9)


def direct_sum(pressure, cell):
    """Displacement as a double loop over loaded cells, per unit compliance."""
    x, y = (np.arange(n) * edge for n, edge in zip(pressure.shape, cell, strict=True))
    total = np.zeros(pressure.shape)
    for i, j in np.ndindex(pressure.shape):
        total += pressure[i, j] * influence_coefficient(x[:, None] - x[i], y[None, :] - y[j], cell)
    return total


def fields(shape, count=1, seed=3):
    return np.random.default_rng(seed).standard_normal((count, *shape))


# Rounding of transforms of a few hundred values: measured below 1e-15 of the largest.
ROUNDING = 1e-14


@pytest.mark.parametrize("shape", SHAPES)
def test_it_is_the_direct_sum(shape):
    (pressure,) = fields(shape)
    expected = direct_sum(pressure, CELL)
    found = Convolution(influence_table(shape, CELL)).apply(pressure)
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


@pytest.mark.parametrize("shape", [(7, 6), (8, 8), (13, 2), (5, 22)])
def test_on_one_half_it_is_the_direct_sum_of_an_even_field(shape):
    (half,) = fields((shape[0], shape[1] // 2))
    whole = np.concatenate([half[:, ::-1], half], axis=1)
    expected = direct_sum(whole, CELL)[:, shape[1] // 2 :]
    found = MirroredConvolution(influence_table(shape, CELL)).apply(half)
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


@pytest.mark.parametrize("shape", SHAPES)
def test_it_is_linear_symmetric_and_positive(shape):
    operator = Convolution(influence_table(shape, CELL))
    for p, q in fields(shape, 20).reshape(10, 2, *shape):
        left, right = operator.apply(p), operator.apply(q)
        size = np.abs(left).max() + np.abs(right).max()
        assert np.abs(operator.apply(2 * p - q) - (2 * left - right)).max() < 1e-13 * size
        # Maxwell's and Betti's reciprocity; and pressing costs work.
        assert np.vdot(q, left) == pytest.approx(np.vdot(p, right), abs=1e-13 * size * p.size)
        assert np.vdot(p, left) > 0


def test_applying_does_not_touch_its_argument_nor_what_it_returned_before():
    operator = Convolution(influence_table((6, 5), CELL))
    p, q = fields((6, 5), 2)
    kept, first = p.copy(), operator.apply(p)
    before = first.copy()
    operator.apply(q)
    assert (p == kept).all()
    assert (first == before).all()


def test_threads_change_nothing():
    (pressure,), table = fields((40, 33)), influence_table((40, 33), CELL)
    one, two = (Convolution(table, threads=n).apply(pressure) for n in (1, 2))
    assert (one == two).all()


def test_the_preconditioner_turns_a_wave_back_into_the_pressure_that_made_it():
    # Johnson (1985), eq. 13.7 with E* = 1/J: u = 2 J p/q. Single precision.
    shape, cell = (32, 24), (0.5, 0.25)
    x, y = np.arange(32)[:, None] * 0.5, np.arange(24)[None, :] * 0.25
    qx, qy = 2 * np.pi * 3 / 16, 2 * np.pi * 2 / 6
    wave = np.cos(qx * x + qy * y)
    found = Preconditioner(shape, cell).apply(wave)
    assert np.abs(found - np.hypot(qx, qy) / 2 * wave).max() < 1e-6 * np.hypot(qx, qy)


@pytest.mark.parametrize("scale", [1e-30, 1e30])
def test_the_preconditioner_survives_any_unit(scale):
    (field,) = fields((16, 16))
    operator = Preconditioner((16, 16), (1.0, 1.0))
    assert operator.apply(scale * field) == pytest.approx(scale * operator.apply(field), rel=1e-5)
