"""A quarter of a contact under shear is a quarter of the whole one."""

import numpy as np
import pytest

from viscontact.backend.transforms import transforms_by
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.mirrored_shear import (
    mirrored_shear_convolution,
    mirrored_shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_filter import shear_convolution
from viscontact.mechanics.halfspace.shear_influence import shear_tables

GRID = Grid((10, 14), (1.0, 1.7))
EVEN = [(True, True), (False, False), (True, False), (False, True)]


def whole(quarter, even):
    """Both components on the whole block."""
    found = []
    for field, signs in ((quarter[0], even), (quarter[1], [not each for each in even])):
        for axis in (0, 1):
            field = np.concatenate([np.flip(field, axis) * (1 if signs[axis] else -1), field], axis)
        found.append(field)
    return np.stack(found)


@pytest.mark.parametrize("library", ["scipy", "ducc0"])
@pytest.mark.parametrize("even", EVEN)
def test_a_quarter_is_displaced_as_the_whole_block(even, library):
    try:
        transforms = transforms_by(library)
    except ValueError:
        pytest.skip("not installed")
    quarter = np.random.default_rng(8).normal(size=(2, 5, 7))
    tables = shear_tables(GRID)
    full = shear_convolution(tables, (False, False)).sum_of(1.0, 0.7)
    mirrored = mirrored_shear_convolution(tables, even, transforms=transforms).sum_of(1.0, 0.7)
    expected = full.apply(whole(quarter, even))[:, 5:, 7:]
    np.testing.assert_allclose(mirrored.apply(quarter), expected, atol=1e-13)


@pytest.mark.parametrize("even", EVEN)
def test_the_approximate_inverse_undoes_products_of_waves(even):
    """2/k along the wave vector and 2 (1 + κ)/k across it, as in plane and antiplane strain."""
    kappa, shape, cell = 0.6, (20, 24), (0.1, 0.08)
    x, y = ((np.arange(n) + 0.5) * d for n, d in zip(shape, cell, strict=True))
    k = np.pi * 3 / 2.0, np.pi * 2 / 1.92
    waves = [np.cos, np.sin] if even[0] else [np.sin, np.cos]
    across = [np.cos, np.sin] if even[1] else [np.sin, np.cos]
    patterns = [np.outer(waves[c](k[0] * x), across[c](k[1] * y)) for c in (0, 1)]
    length = np.hypot(*k)
    sign = -1 if even[0] == even[1] else 1
    # The response to amplitudes (1, 0) of the components x and y.
    across_part = kappa * k[1] ** 2 / length**2, -sign * kappa * k[0] * k[1] / length**2
    displacement = (
        2 / length * np.stack([(1 + across_part[0]) * patterns[0], across_part[1] * patterns[1]])
    )
    inverse = mirrored_shear_preconditioner(shape, cell, kappa, even)
    found = inverse.apply(displacement)
    np.testing.assert_allclose(found[0], patterns[0], atol=1e-5)
    np.testing.assert_allclose(found[1], 0, atol=1e-5)
