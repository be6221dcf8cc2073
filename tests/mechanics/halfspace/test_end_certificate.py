"""The stress that is left on free ends: none by the operator's images, much by wrong ones."""

from __future__ import annotations

import numpy as np
import pytest

from mechanics.halfspace.ended_bodies import ENDS, GRID
from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace import free_end, strip
from viscontact.mechanics.halfspace.end_certificate import stress_left
from viscontact.mechanics.halfspace.ended_response import EndedResponse


def _pressure() -> Floats:
    """Smooth pressure that reaches both ends, unequal on both sides and along y."""
    x, y = GRID.x[:, None], GRID.y
    inside = np.abs(x) < 2.0
    profile = np.sqrt(np.maximum(1 - ((y - 0.1) / 0.5) ** 2, 0.0)) * (1 + 0.3 * y)
    return np.where(inside, (1 + 0.25 * x) * profile, 0.0)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("name", ENDS)
def test_hardly_any_stress_is_left_on_free_ends(name: str, ratio: float) -> None:
    planes, free = ENDS[name]
    left = stress_left(EndedResponse(ratio, planes, free), _pressure(), GRID)
    assert 0 < left < 2e-5


def test_walls_have_no_stress_to_be_left() -> None:
    walls = EndedResponse(0.3, (-2.0, 2.0), (False, False))
    assert stress_left(walls, _pressure(), GRID) == 0.0
    free = EndedResponse(0.3, (-2.0, 2.0), (True, True))
    assert stress_left(free, np.zeros(GRID.shape), GRID) == 0.0


def test_images_of_another_poisson_ratio_leave_a_stress(monkeypatch: pytest.MonkeyPatch) -> None:
    one, two = (EndedResponse(0.3, *ENDS[name]) for name in ("one end", "two free ends"))
    images, table = free_end.images, strip.strip_table
    monkeypatch.setattr(free_end, "images", lambda ratio: images(ratio + 0.01))
    monkeypatch.setattr(strip, "strip_table", lambda ratio, odd: table(ratio + 0.01, odd=odd))
    # The stress on the face goes by (1 - 2 ν) near the surface, that is by 2 % of the peak.
    for response in (one, two):
        assert 5e-3 < stress_left(response, _pressure(), GRID) < 5e-2
