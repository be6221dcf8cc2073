"""Predicted tractions, against those of spheres without coupling (Cattaneo 1938, Mindlin 1949)."""

import numpy as np
import pytest

from closeness import close_to
from mechanics.contact.friction.fixtures import (
    CONTACT,
    FORCE,
    FRICTION,
    PEAK,
    hertz,
    shear_block,
    under,
)
from viscontact.mechanics.contact.friction.predicted import predicted

LIMIT = FRICTION * FORCE


def sphere():
    """Grid, bound and motions of a sphere, of pressures at the centres of cells."""
    grid, _ = hertz(80)
    squared = (grid.x[:, None] ** 2 + grid.y[None, :] ** 2) / CONTACT**2
    return shear_block(grid, 0.0).shift, FRICTION * pressure_of(squared), squared


def pressure_of(squared, radius=1.0):
    """p0 (c² - r²)^(1/2)/a of a stick radius over that of the contact."""
    return PEAK * np.sqrt(np.maximum(radius**2 - squared, 0))


def loaded(squared, force):
    """q of a first force: μ p less that of the stick zone (Johnson 1985, eqs. 7.40 and 7.41)."""
    radius = (1 - force / LIMIT) ** (1 / 3)
    return FRICTION * (pressure_of(squared) - pressure_of(squared, radius))


@pytest.mark.parametrize("direction", [(1.0, 0.0), (-0.6, 0.8)])
@pytest.mark.parametrize("force", [0.2, 1.0, 2.5])
def test_a_first_force_is_that_of_cattaneo_and_mindlin(force, direction):
    shift, bound, squared = sphere()
    along = np.array(direction)[:, None, None]
    given = under((*(force * np.array(direction)), 0.0))
    found = predicted(np.zeros((2, *bound.shape)), bound, shift, given)
    # The force is met to a thousandth, and by sums over cells in place of integrals.
    np.testing.assert_allclose(found, along * loaded(squared, force), atol=0.03 * bound.max())
    assert shift.resultants(found)[:2] == close_to(list(force * np.array(direction)), rel=2e-3)


@pytest.mark.parametrize(("first", "then"), [(0.5, 1.0), (1.0, 1.2), (1.0, 2.8)])
def test_a_force_that_grows_goes_on_along_the_same_curve(first, then):
    shift, bound, squared = sphere()
    before = np.stack([loaded(squared, first), np.zeros(bound.shape)])
    found = predicted(before, bound, shift, under((then, 0.0, 0.0)))
    # Cells close to their circle count as slipping: the edge of the stick zone is a cell off.
    np.testing.assert_allclose(found[0], loaded(squared, then), atol=0.05 * bound.max())


@pytest.mark.parametrize("back", [0.3, 0.9, 1.5])
def test_a_force_that_returns_takes_twice_the_curve(back):
    """Masing's rule: q of the first force less 2 q of half of the way back (Mindlin 1953)."""
    shift, bound, squared = sphere()
    before = np.stack([loaded(squared, 1.0), np.zeros(bound.shape)])
    found = predicted(before, bound, shift, under((1.0 - back, 0.0, 0.0)))
    expected = before[0] - 2 * loaded(squared, back / 2)
    np.testing.assert_allclose(found[0], expected, atol=0.03 * bound.max())


def test_without_a_change_of_the_force_tractions_are_cut_off_only():
    shift, bound, squared = sphere()
    before = np.stack([loaded(squared, 1.0), np.zeros(bound.shape)])
    held = under((float(shift.resultants(before)[0]), 0.0, 0.0))
    np.testing.assert_array_equal(predicted(before, bound, shift, held), before)
    # A prescribed motion says nothing of the force.
    moved = under(motions=(1e-3, 0.0, 0.0))
    found = predicted(2 * before, bound, shift, moved)
    assert np.hypot(*found).max() <= bound.max()
    np.testing.assert_allclose(np.hypot(*found), np.minimum(bound, 2 * before[0]), rtol=1e-12)


@pytest.mark.parametrize("times", [1.1, 2.0])
@pytest.mark.parametrize("before", [0.0, 1.0])
def test_a_force_beyond_the_limit_slides_along_it(before, times):
    """Whatever was before: |q| = μ p, by Coulomb's law."""
    shift, bound, squared = sphere()
    given = np.stack([loaded(squared, before), np.zeros(bound.shape)])
    direction = np.array([-0.6, 0.8])
    found = predicted(given, bound, shift, under((*(times * LIMIT * direction), 0.0)))
    expected = direction[:, None, None] * bound
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * bound.max())


def test_nothing_is_predicted_where_friction_carries_nothing():
    shift, bound, _ = sphere()
    traction = np.zeros((2, *bound.shape))
    found = predicted(traction, 0 * bound, shift, under((1.0, 0.0, 0.0)))
    np.testing.assert_array_equal(found, traction)
