"""Planes, balances and the foundation, against plain linear algebra and statics."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.loads import step
from viscontact.mechanics.contact.rigid_balance import Constraints, RigidPlane, restore_balance
from viscontact.mechanics.contact.winkler import winkler_contact

GRID = Grid((12, 9), (2.4, 0.9))
PLANE = RigidPlane(GRID.x, GRID.y, GRID.cell_size)
X, Y = np.broadcast_arrays(GRID.x[:, None], GRID.y[None, :])
COLUMNS = np.stack([np.ones(X.size), X.ravel(), Y.ravel()], axis=1)
FREE = np.ones(3, dtype=bool)


def test_a_plane_is_what_it_says() -> None:
    np.testing.assert_allclose(PLANE.field(np.array([1.0, 2.0, -3.0])), 1 + 2 * X - 3 * Y)


def test_sums_are_those_of_a_matrix_product() -> None:
    values = np.random.default_rng(1).random(GRID.shape)
    np.testing.assert_allclose(PLANE.sums(values), COLUMNS.T @ values.ravel(), rtol=1e-13)


@given(seed=st.integers(0, 10_000), cells=st.integers(4, 100))
def test_inverse_gram_is_numpys_least_squares(seed: int, cells: int) -> None:
    """numpy.linalg.lstsq, on any cells that are no line."""
    rng = np.random.default_rng(seed)
    weight = np.zeros(X.size)
    weight[rng.choice(X.size, cells, replace=False)] = 1.0
    where = weight > 0
    values = rng.standard_normal(X.size)
    expected, _, rank, _ = np.linalg.lstsq(COLUMNS[where], values[where], rcond=None)
    assume(rank == 3)
    inverse = PLANE.inverse_gram(weight.reshape(GRID.shape), FREE)
    found = inverse @ PLANE.sums((weight * values).reshape(GRID.shape))
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("columns", [9, 4096, 4097])
def test_counted_cells_have_the_moments_of_whole_numbers(columns: int) -> None:
    """Their sums are those of Python's integers, with the axis at a third of a cell."""
    filled = np.random.default_rng(columns).random((3, columns)) < 0.7
    plane = RigidPlane(np.arange(3) - 1.0, np.arange(columns) - columns / 2 + 1 / 3, (1.0, 1.0))
    rows, places = (list(map(int, index)) for index in np.nonzero(filled))
    sum_x = sum(row - 1 for row in rows)
    six_y = [6 * place - 3 * columns + 2 for place in places]
    expected = (
        len(rows),
        sum_x,
        sum(six_y) / 6,
        sum((row - 1) ** 2 for row in rows),
        sum((row - 1) * y for row, y in zip(rows, six_y, strict=True)) / 6,
        sum(y * y for y in six_y) / 36,
    )
    scale = len(rows) * columns
    found = plane.moments_of_rows(filled, np.ones(3, bool))
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14 * scale)


def test_a_line_of_cells_knows_no_tilt_across_itself() -> None:
    weight = np.zeros(GRID.shape)
    weight[3:8, 4] = 1.0
    tilts = PLANE.inverse_gram(weight, FREE) @ PLANE.sums(weight * (2 * X + 7 * Y))
    assert tilts[1] == close_to(2.0)
    assert tilts[2] == 0.0


def test_a_single_cell_knows_only_its_height() -> None:
    weight = np.zeros(GRID.shape)
    weight[2, 3] = 1.0
    assert (PLANE.inverse_gram(weight, FREE) @ PLANE.sums(5.0 * weight)).tolist() == [5.0, 0, 0]


@given(
    force=st.floats(0.1, 10),
    x=st.floats(-0.3, 0.3),
    y=st.floats(-0.1, 0.1),
    seed=st.integers(0, 99),
)
def test_a_restored_pressure_has_the_resultants_and_no_tension(
    force: float, x: float, y: float, seed: int
) -> None:
    pressure = 0.5 + np.random.default_rng(seed).random(GRID.shape)
    support = Constraints((force, force * x, force * y))
    restored = restore_balance(pressure, support, PLANE, GRID.cell_area, arm=1.0)
    assert restored is not None
    assert restored.min() >= 0
    resultants = COLUMNS.T @ restored.ravel() * GRID.cell_area
    np.testing.assert_allclose(resultants, [force, force * x, force * y], atol=1e-12 * force)


def test_cells_that_cannot_carry_the_moment_are_refused() -> None:
    pressure = np.zeros(GRID.shape)
    pressure[:4] = 1.0  # all at x < 0
    support = Constraints((1.0, 0.5, 0.0))
    assert restore_balance(pressure, support, PLANE, GRID.cell_area, arm=1.0) is None


def test_half_a_body_carries_half_and_does_not_tilt_across() -> None:
    whole = Constraints.of(step(6.0, eccentricity_x=0.5).at(0.0))
    assert whole.halved(1) == Constraints((3.0, 1.5, None))
    across = Constraints.of(step(6.0, eccentricity_y=0.5).at(0.0))
    assert across.halved(0) == Constraints((3.0, None, 1.5))
    assert whole.halved(1).halved(0) == Constraints((1.5, None, None))


@pytest.mark.parametrize("force", [1e-9, 1e-3, 1.0])
def test_a_foundation_balances_a_bowl_under_any_force(force: float) -> None:
    """Down to a force that one cell would carry: statics, and overlap only where it bears."""
    gap = (X**2 + Y**2) / 2
    support = Constraints((force, 0.2 * force, 0.05 * force))
    pressure, motion = winkler_contact(gap, 1.0, support, PLANE, GRID.cell_area)
    resultants = COLUMNS.T @ pressure.ravel() * GRID.cell_area
    np.testing.assert_allclose(resultants, support.targets, atol=1e-5 * force)
    overlapping = PLANE.field(motion) > gap
    np.testing.assert_array_equal(overlapping, pressure > 0)
