"""One half of a contact with a mirror plane is one half of the whole one."""

import numpy as np
import pytest

from viscontact.backend.transforms import transforms_by
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.coupling_filter import coupling_filter
from viscontact.mechanics.halfspace.halved_shear import (
    halved_shear_convolution,
    halved_shear_preconditioner,
)
from viscontact.mechanics.halfspace.shear_filter import shear_convolution, shear_preconditioner
from viscontact.mechanics.halfspace.shear_influence import shear_tables

GRID = Grid((10, 14), (1.0, 1.7))
LINE = Grid((1, 14), (1.0, 1.7), periodic=(True, False))
#: Grid, mirrored axis, and True where the component x is even along it.
HALVES = [(GRID, 0, True), (GRID, 0, False), (GRID, 1, True), (GRID, 1, False), (LINE, 1, True)]
PLANES = [(GRID, (True, False)), (GRID, (False, True)), (GRID, (True, True)), (LINE, (False, True))]


def with_images(field, axis, sign):
    return np.concatenate([sign * np.flip(field, axis), field], axis)


def half_of(grid, axis):
    shape = list(grid.shape)
    shape[axis] //= 2
    return np.random.default_rng(8).normal(size=(2, *shape))


def whole(half, axis, *, even):
    signs = (1, -1) if even else (-1, 1)
    return np.stack([with_images(part, axis, sign) for part, sign in zip(half, signs, strict=True)])


def kept(fields, axis):
    """The cells with positive coordinates."""
    return np.split(fields, 2, axis=axis - 2)[1]


@pytest.mark.parametrize("library", ["scipy", "ducc0"])
@pytest.mark.parametrize(("grid", "axis", "even"), HALVES)
def test_a_half_is_displaced_as_the_whole_block(grid, axis, even, library):
    try:
        transforms = transforms_by(library)
    except ValueError:
        pytest.skip("not installed")
    half, tables = half_of(grid, axis), shear_tables(grid)
    full = shear_convolution(tables, grid.periodic).sum_of(1.0, 0.7)
    expected = kept(full.apply(whole(half, axis, even=even)), axis)
    halved = halved_shear_convolution(
        tables, grid.periodic, axis, even=even, transforms=transforms
    ).sum_of(1.0, 0.7)
    np.testing.assert_allclose(halved.apply(half), expected, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize("axis", [0, 1])
def test_the_approximate_inverse_is_that_of_the_whole_block(axis, even):
    """Up to its mean, which the whole block has no wave of the same length for."""
    half = half_of(GRID, axis)
    half -= half.mean(axis=(1, 2), keepdims=True)
    inverse = shear_preconditioner(GRID.shape, GRID.cell_size, 0.6)
    expected = kept(inverse.apply(whole(half, axis, even=even)), axis)
    halved = halved_shear_preconditioner(half.shape[1:], GRID.cell_size, 0.6, axis, even=even)
    np.testing.assert_allclose(halved.apply(half), expected, atol=1e-5)


@pytest.mark.parametrize(("grid", "mirrored"), PLANES)
def test_pressure_and_mirrored_tractions_act_on_each_other_as_on_the_whole_block(grid, mirrored):
    random, axes = np.random.default_rng(3), [a for a in (0, 1) if mirrored[a]]
    shape = [n // (1 + even) for n, even in zip(grid.shape, mirrored, strict=True)]
    pressure, traction = random.normal(size=shape), random.normal(size=(2, *shape))
    full, halved = coupling_filter(grid), coupling_filter(grid, mirrored=mirrored)
    pushed, pulled = pressure, list(traction)
    for axis in axes:
        pushed = with_images(pushed, axis, 1)
        pulled = [
            with_images(part, axis, -1 if own == axis else 1) for own, part in enumerate(pulled)
        ]
    along, normal = full.along(pushed), full.normal(np.stack(pulled))
    for axis in axes:
        along, normal = kept(along, axis), kept(normal, axis)
    np.testing.assert_allclose(halved.along(pressure), along, atol=1e-13)
    np.testing.assert_allclose(halved.normal(traction), normal, atol=1e-13)
    smaller = halved.within(tuple(shape))
    np.testing.assert_allclose(smaller.normal(traction), normal, atol=1e-13)


def test_a_multiple_of_tractions_moves_the_surface_by_that_multiple():
    """To double precision; in single precision, displacements would jump with the largest one."""
    halved = halved_shear_convolution(shear_tables(GRID), (False, False), 1, even=True)
    operator = halved.sum_of(1.0, 0.4)
    given = np.random.default_rng(1).standard_normal((2, *operator.shape))
    moved = operator.apply(given)
    for factor in (1 / 3, 1 + 1e-7, 0.7e5):
        found = operator.apply(factor * given)
        np.testing.assert_allclose(
            found, factor * moved, rtol=0, atol=1e-14 * factor * abs(moved).max()
        )
