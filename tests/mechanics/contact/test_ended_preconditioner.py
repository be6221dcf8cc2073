"""Preconditioner of bodies that end: exact for the waves between their planes."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.surface_response import SummedResponse

GRID = Grid((16, 12), (16.0, 6.0))

#: Rows within the body, and its ends.
BODIES = {
    "two ends": (slice(2, 14), (-6.0, 6.0)),
    "one end": (slice(3, 16), (-5.0, None)),
    "end at +x": (slice(0, 11), (None, 3.0)),
}


@pytest.mark.parametrize("name", BODIES)
@pytest.mark.parametrize(("turns", "waves"), [(1, 0), (3, 2), (0, 5)])
def test_waves_that_are_even_about_the_ends_are_inverted(name: str, turns: int, waves: int) -> None:
    rows, planes = BODIES[name]
    response = EndedResponse(0.3, planes, (planes[0] is not None, planes[1] is not None))
    domain = ContactDomain(GRID, response=response)
    count = rows.stop - rows.start
    along = np.pi * turns / count
    across = 2 * np.pi * waves / 6.0
    wave = np.zeros(GRID.shape, np.float32)
    profile = np.cos(along * (np.arange(count) + 0.5))
    wave[rows] = profile[:, None] * np.cos(across * GRID.y)
    # A wave of pressure p displaces a half-space by 2 p/|q| per compliance (Johnson 1985, 13.2).
    found = domain._preconditioner(GRID.shape, 0).apply(wave)
    assert found == close_to(np.hypot(along, across) / 2 * wave, rel=0.0, abs=2e-6)


def test_bodies_that_end_at_different_places_have_the_preconditioner_of_a_half_space() -> None:
    one, other = (EndedResponse(0.3, (place, None), (True, False)) for place in (-6.0, -5.0))
    for parts, alike in (((one, one), True), ((one, other), False)):
        domain = ContactDomain(GRID, response=SummedResponse(parts, (1.0, 0.5)))
        field = np.zeros(GRID.shape, np.float32)
        field[8, 6] = 1.0
        beyond = domain._preconditioner(GRID.shape, 0).apply(field)[:2]
        assert (not beyond.any()) == alike
