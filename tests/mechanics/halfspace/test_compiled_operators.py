"""Operators in the compiled core: against sums over cells, and against the same by transforms."""

import numpy as np
import pytest

from closeness import close_to
from mechanics.halfspace.test_convolution import CELL, ROUNDING, SHAPES, direct_sum, fields
from viscontact.backend import compiled
from viscontact.backend.team import Team, Workspace
from viscontact.mechanics.halfspace.convolution import Convolution
from viscontact.mechanics.halfspace.influence import influence_table
from viscontact.mechanics.halfspace.preconditioner import Preconditioner
from viscontact.mechanics.halfspace.spectral import PeriodicConvolution

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

TEAM = Team(1, compiled.core)
MIRRORED = [(False, False), (True, False), (False, True), (True, True)]


@pytest.mark.parametrize("mirrored", MIRRORED)
@pytest.mark.parametrize("shape", [*SHAPES, (20, 2), (18, 20)])
def test_a_compiled_convolution_is_the_direct_sum_of_an_even_field(shape, mirrored):
    if any(cells % 2 and even for cells, even in zip(shape, mirrored, strict=True)):
        pytest.skip("an even field has an even number of cells")
    nx, ny = (cells // 2 if even else 0 for cells, even in zip(shape, mirrored, strict=True))
    (whole,) = fields(shape)
    for axis in (0, 1):
        whole = whole + np.flip(whole, axis) if mirrored[axis] else whole
    expected = direct_sum(whole, CELL)[nx:, ny:]
    operator = Convolution(influence_table(shape, CELL), mirrored=mirrored, team=TEAM)
    assert operator.compiled is not None
    found = operator.apply(whole[nx:, ny:])
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


@pytest.mark.parametrize("mirrored", MIRRORED)
@pytest.mark.parametrize("single", [False, True])
def test_a_compiled_convolution_is_that_by_transforms(mirrored, single):
    table = influence_table((90, 100), CELL)
    twin = Convolution(table, mirrored=mirrored, single=single)
    operator = Convolution(
        table, mirrored=mirrored, single=single, team=TEAM, workspace=Workspace()
    )
    assert operator.compiled is not None
    (pressure,) = fields(twin.shape)
    found, expected = operator.apply(pressure), twin.apply(pressure)
    rounding = 3e-6 if single else ROUNDING
    assert np.abs(found - expected).max() < rounding * np.abs(expected).max()


@pytest.mark.parametrize("single", [False, True])
def test_a_sum_of_compiled_convolutions_has_the_sum_of_their_symbols(single):
    tables = influence_table((12, 10), CELL), np.ones((12, 10))
    parts = [Convolution(table, team=TEAM) for table in tables]
    like = Convolution(tables[0], single=single, team=TEAM)
    (pressure,) = fields((12, 10))
    total = like.sum_of(parts, [2.0, -0.5])
    assert total.compiled is not None
    found = total.apply(pressure)
    expected = 2 * parts[0].apply(pressure) - 0.5 * parts[1].apply(pressure)
    rounding = 3e-6 if single else ROUNDING
    assert np.abs(found - expected).max() < rounding * np.abs(expected).max()
    assert like.apply(pressure) == close_to(parts[0].apply(pressure), rel=1e-4, abs=1e-4)


@pytest.mark.parametrize("mirrored", MIRRORED)
def test_a_compiled_preconditioner_is_that_by_transforms(mirrored):
    twin, found = (
        Preconditioner((40, 36), CELL, mirrored=mirrored, team=team) for team in (Team(), TEAM)
    )
    assert None not in found.compiled
    (gap,) = fields((40, 36))
    expected = twin.apply(gap)
    assert np.abs(found.apply(gap) - expected).max() < 3e-6 * np.abs(expected).max()
    expected = twin.stiffness_of(gap > 0)
    assert np.abs(found.stiffness_of(gap > 0) - expected).max() < 3e-6 * np.abs(expected).max()


@pytest.mark.parametrize("shape", [(30, 32), (45, 27), (15, 9)])
def test_a_compiled_periodic_convolution_displaces_waves_by_their_length(shape):
    """Johnson (1985), eq. 13.7: a wave of wave number q displaces by 2 p/|q| per compliance."""
    nx, ny = shape
    x, y = (np.arange(count) * edge for count, edge in zip(shape, CELL, strict=True))
    kx, ky = 2 * np.pi * 3 / (nx * CELL[0]), 2 * np.pi * 2 / (ny * CELL[1])
    wave = np.cos(kx * x[:, None] + ky * y[None, :] + 0.3)
    operator = PeriodicConvolution(shape, CELL, team=TEAM)
    assert operator.compiled is not None
    found, expected = operator.apply(wave), 2 * wave / np.hypot(kx, ky)
    assert np.abs(found - expected).max() < ROUNDING * np.abs(expected).max()


@pytest.mark.parametrize("shape", [(30, 32), (45, 27), (2, 1)])
def test_a_sum_of_compiled_periodic_convolutions_has_the_sum_of_their_symbols(shape):
    parts = [PeriodicConvolution(shape, CELL, team=TEAM) for _ in range(2)]
    twins = [PeriodicConvolution(shape, CELL) for _ in range(2)]
    (pressure,) = fields(shape)
    total = parts[0].sum_of(parts, [2.0, -0.5])
    assert total.compiled is not None
    expected = twins[0].sum_of(twins, [2.0, -0.5]).apply(pressure)
    assert np.abs(total.apply(pressure) - expected).max() < ROUNDING * np.abs(pressure).max()
