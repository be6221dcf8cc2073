"""Errors from three spacings: sequences whose limit is known."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from closeness import close_to
from viscontact.simulation.accuracy.richardson import richardson

CELL_RATIOS = np.array([1.0, 1.4, 2.0])


@pytest.mark.parametrize("order", [0.5, 0.8, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("spacings", [CELL_RATIOS, np.array([0.3, 0.7, 0.9])])
def test_a_power_of_the_spacing_is_found_with_its_error(order: float, spacings: np.ndarray) -> None:
    slopes = np.array([-3.0, 1e-3, 20.0])
    values = 7.0 + slopes * spacings[:, None] ** order
    found = richardson(values, spacings)
    # The finest value's distance from the limit 7; rounding of 7 counts beside the slope 1e-3.
    np.testing.assert_allclose(found.error, np.abs(values[0] - 7.0), rtol=1e-7)
    np.testing.assert_allclose(found.order, order, rtol=1e-7)
    assert found.converges.all()


@pytest.mark.parametrize("spacings", [CELL_RATIOS, np.array([0.3, 0.7, 0.9])])
def test_values_without_a_limit_are_found(spacings: np.ndarray) -> None:
    tip, edge = -np.log(spacings) + 3.0, spacings**-0.5
    found = richardson(np.stack([tip, edge], axis=1), spacings)
    assert not found.converges.any()
    assert np.isinf(found.error).all()
    np.testing.assert_allclose(found.order, [0.0, -0.5], atol=1e-6)


def test_a_better_order_than_second_is_not_believed() -> None:
    found = richardson(1.0 + 1e-4 * CELL_RATIOS**4, CELL_RATIOS)
    assert found.order == close_to(4.0, rel=1e-6)
    assert found.error > 2e-4  # twice the distance from the limit, 1


def test_values_to_and_fro_count_as_first_order() -> None:
    found = richardson([1.0, 1.1, 0.7], [1.0, 2.0, 4.0])
    assert np.isnan(found.order)
    # 0.1 over a spacing of 1, and 0.4 over one of 2: at 1 that is 0.2.
    assert found.error == close_to(0.2)


def test_equal_values_have_no_error() -> None:
    found = richardson(np.full((3, 2), 4.0), CELL_RATIOS)
    np.testing.assert_array_equal(found.error, 0.0)
    assert found.converges.all()


def test_what_hardly_changes_converges() -> None:
    """Scatter of a part in 1e4 is not taken for the growth of a singular pressure."""
    assert richardson([1.0002, 1.0001, 1.0], CELL_RATIOS).converges


@pytest.mark.parametrize(
    ("values", "spacings", "message"),
    [
        ([1.0, 2.0], CELL_RATIOS, "three sets"),
        (1.0, CELL_RATIOS, "three sets"),
        ([1.0, 2.0, 3.0], [1.0, 1.0, 2.0], "increasing"),
        ([1.0, 2.0, 3.0], [0.0, 1.0, 2.0], "increasing"),
        ([1.0, 2.0, 3.0], [1.0, 2.0], "increasing"),
    ],
)
def test_nonsense_is_refused(values: Any, spacings: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        richardson(values, spacings)
