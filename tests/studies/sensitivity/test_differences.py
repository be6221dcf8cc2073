"""Differences: their order, and their stated error."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.studies.sensitivity.differences import ABOVE, BELOW, CENTRAL, Stencil


def slope_of_exp(stencil: Stencil, step: float) -> tuple[float, float]:
    """Slope of exp(1.3 x) at zero, which is 1.3, and its stated error."""
    values = {n: np.array(np.exp(1.3 * step * n)) for n in (0, *stencil.points)}
    found = stencil.slopes(values, step)
    return float(found.extrapolated), float(found.error)


@pytest.mark.parametrize(("stencil", "order"), [(CENTRAL, 4), (ABOVE, 3), (BELOW, 3)])
def test_the_error_falls_with_the_order_of_the_extrapolation(stencil: Stencil, order: int) -> None:
    errors = [abs(slope_of_exp(stencil, 0.2 / 2**n)[0] - 1.3) for n in range(4)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == close_to(order, abs=0.35)


@pytest.mark.parametrize("stencil", [CENTRAL, ABOVE, BELOW])
@pytest.mark.parametrize("step", [0.2, 0.1, 0.05])
def test_the_stated_error_contains_that_of_the_step(stencil: Stencil, step: float) -> None:
    slope, error = slope_of_exp(stencil, step)
    assert abs(slope - 1.3) < error


def test_the_stated_error_is_the_distance_of_differences_with_one_and_two_steps() -> None:
    """By Taylor central differences miss the slope by h²/6 and (2h)²/6 of the third derivative."""
    assert slope_of_exp(CENTRAL, 0.02)[1] == close_to(0.02**2 * 1.3**3 / 2, rel=1e-3)


@pytest.mark.parametrize("stencil", [CENTRAL, ABOVE, BELOW])
def test_a_straight_line_has_no_error(stencil: Stencil) -> None:
    found = stencil.slopes({n: np.array(2.0 + 3.0 * n) for n in range(-4, 5)}, 1.0)
    assert float(found.extrapolated) == close_to(3.0, abs=1e-12)
    assert float(found.error) == close_to(0.0, abs=1e-12)
