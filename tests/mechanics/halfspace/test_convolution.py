"""The operator against the sum over all pairs of cells that it abbreviates."""

import numpy as np
import pytest
import scipy

from closeness import close_to
from returned import some
from viscontact.backend import team
from viscontact.backend.transforms import as_reals, fast_length, transforms_by
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.influence import influence_coefficient, influence_table
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.spectral import PeriodicConvolution

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


@pytest.mark.parametrize("mirrored", [(True, False), (False, True), (True, True)])
@pytest.mark.parametrize("shape", [(8, 6), (12, 2), (2, 10), (6, 22)])
def test_on_a_part_it_is_the_direct_sum_of_an_even_field(shape, mirrored):
    nx, ny = (cells // 2 if even else 0 for cells, even in zip(shape, mirrored, strict=True))
    (whole,) = fields(shape)
    for axis in (0, 1):
        whole = whole + np.flip(whole, axis) if mirrored[axis] else whole
    expected = direct_sum(whole, CELL)[nx:, ny:]
    found = Convolution(influence_table(shape, CELL), mirrored=mirrored).apply(whole[nx:, ny:])
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


@pytest.mark.parametrize("shape", SHAPES)
def test_it_is_linear_symmetric_and_positive(shape):
    operator = Convolution(influence_table(shape, CELL))
    for p, q in some(fields(shape, 20).reshape(10, 2, *shape)):
        left, right = operator.apply(p), operator.apply(q)
        size = np.abs(left).max() + np.abs(right).max()
        assert np.abs(operator.apply(2 * p - q) - (2 * left - right)).max() < 1e-13 * size
        # Maxwell's and Betti's reciprocity; and pressing costs work.
        assert np.vdot(q, left) == close_to(np.vdot(p, right), abs=1e-13 * size * p.size)
        assert np.vdot(p, left) > 0


def test_applying_does_not_touch_its_argument_nor_what_it_returned_before():
    operator = Convolution(influence_table((6, 5), CELL))
    p, q = fields((6, 5), 2)
    kept, first = p.copy(), operator.apply(p)
    before = first.copy()
    operator.apply(q)
    assert (p == kept).all()
    assert (first == before).all()


@pytest.mark.parametrize("mirrored", [(False, False), (True, False), (False, True), (True, True)])
@pytest.mark.parametrize("library", ["scipy", "ducc0"])
@pytest.mark.parametrize("single", [False, True])
def test_blocks_of_lines_are_the_whole_on_any_number_of_threads(
    mirrored, library, single, monkeypatch
):
    if library == "ducc0":
        pytest.importorskip("ducc0")
    table = influence_table((26, 38), CELL)
    options = {"mirrored": mirrored, "single": single}
    whole = Convolution(table, transforms=transforms_by(library), **options)
    (pressure,) = fields(whole.shape)
    expected = whole.apply(pressure)
    monkeypatch.setattr(team, "BLOCK_BYTES", 2000)
    one, *others = (
        Convolution(table, transforms=transforms_by(library, threads), **options).apply(pressure)
        for threads in (1, 2, 3)
    )
    rounding = 1e-6 if single else ROUNDING
    assert np.abs(one - expected).max() < rounding * np.abs(expected).max()
    assert all((each == one).all() for each in others)


@pytest.mark.parametrize("library", ["scipy", "ducc0"])
@pytest.mark.parametrize("threads", [2, 3, 4])
def test_threads_change_transforms_by_rounding_only(threads, library):
    """A library transforms lines in bunches, and the remaining ones one by one: other rounding."""
    if library == "ducc0":
        pytest.importorskip("ducc0")
    random = np.random.default_rng(3)
    for shape in ((129, 128), (128, 129), (67, 200), (200, 67), (400, 35), (24, 480)):
        for number, pair in ((np.float32, np.complex64), (np.float64, np.complex128)):
            field = random.standard_normal(shape).astype(number)
            for axis in (0, 1):
                half = tuple(n // 2 + 1 if k == axis else n for k, n in enumerate(shape))
                both = []
                for by in (transforms_by(library), transforms_by(library, threads)):
                    there = by.real_forward(field.copy(), np.empty(half, pair), axis).copy()
                    back = by.real_inverse(there.copy(), np.empty(shape, number), axis)
                    forward = by.complex_forward(there.copy(), 1 - axis)
                    onwards = by.complex_inverse(forward, 1 - axis)
                    pairs = as_reals(there.copy())
                    even = by.cosine_inverse(by.cosine_forward(pairs, 1 - axis), 1 - axis)
                    both.append([there, back, onwards.copy(), even])
                for one, several in zip(*both, strict=True):
                    rounding = 20 * np.finfo(number).eps * np.abs(one).max()
                    assert np.abs(several - one).max() <= rounding


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("mirrored", [(False, False), (True, False), (False, True), (True, True)])
def test_ducc0_finds_what_scipy_finds(mirrored, single):
    pytest.importorskip("ducc0")
    (field,), table = fields((24, 18)), influence_table((48, 36), CELL)
    table = table[: 24 * (1 + mirrored[0]), : 18 * (1 + mirrored[1])]
    for operator in (
        lambda by: Convolution(table, mirrored=mirrored, single=single, transforms=by),
        lambda by: PeriodicConvolution((24, 18), CELL, single=single, transforms=by),
        lambda by: Preconditioner((24, 18), CELL, mirrored=mirrored, transforms=by),
    ):
        one, other = (operator(by).apply(field) for by in map(transforms_by, ("scipy", "ducc0")))
        rounding = 1e-6  # of single precision
        assert np.abs(one - other).max() < rounding * np.abs(one).max()


@pytest.mark.parametrize("mirrored", [(True, False), (False, True), (True, True)])
def test_the_preconditioner_of_a_part_is_that_of_the_whole(mirrored):
    (whole,) = fields((16, 12))
    for axis in (0, 1):
        whole = np.concatenate([np.flip(whole, axis), whole], axis) if mirrored[axis] else whole
    part = tuple(slice(whole.shape[k] - (16, 12)[k], None) for k in (0, 1))
    found = Preconditioner((16, 12), CELL, mirrored=mirrored).apply(whole[part])
    expected = Preconditioner(whole.shape, CELL).apply(whole)[part]
    assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max()


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
    assert operator.apply(scale * field) == close_to(scale * operator.apply(field), rel=1e-5)


def test_fast_lengths_are_those_of_scipy():
    for least in [*range(1, 2000), 4097, 12_289, 100_001]:
        assert fast_length(least) == scipy.fft.next_fast_len(least, real=True)


@pytest.mark.parametrize("library", ["scipy", "ducc0"])
def test_transform_of_an_even_field_is_its_cosine_sum(library):
    if library == "ducc0":
        pytest.importorskip("ducc0")
    (half,) = fields((3, 9))
    whole = np.concatenate([half, half[:, -2:0:-1]], axis=1)  # 0, 1, ... 8, 7, ... 1
    angles = 2 * np.pi * np.outer(np.arange(9), np.arange(16)) / 16
    expected = whole @ np.cos(angles).T
    found = transforms_by(library).even_forward(half.copy(), 1)
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()
