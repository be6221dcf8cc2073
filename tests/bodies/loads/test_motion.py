"""Motions of a body: velocities on arrival, and the times at whole cells."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.rolling_shift import RollingShift


def test_velocity_at_a_bend_of_the_path_is_that_of_arrival() -> None:
    path = vc.Travel([0.0, 1.0, 3.0], x=[0.0, 2.0, 2.0], y=[0.0, 0.0, -6.0])
    found = [path.velocity_at(time) for time in (0.0, 0.5, 1.0, 2.0, 3.0, 3.5)]
    assert found == [(0.0, 0.0), (2.0, 0.0), (2.0, 0.0), (0.0, -3.0), (0.0, -3.0), (0.0, 0.0)]
    assert path.top_speed == 3.0


def test_velocity_of_a_reciprocation_is_the_derivative_of_its_sine() -> None:
    path, largest = vc.reciprocating(3e-4, 2.0, cycles=2), math.pi * 3e-4
    # It sets out from rest, arrives at the end at full speed, and is at rest from then on.
    found = [path.velocity_at(time)[1] for time in (0.0, 0.5, 1.0, 4.0, 4.1)]
    assert found == close_to([0.0, 0.0, -largest, largest, 0.0], abs=1e-15)
    assert path.top_speed == close_to(largest)


def test_a_reciprocating_body_is_at_whole_cells_at_the_times_that_say_so() -> None:
    path, cell = vc.reciprocating(2.5e-4, 2.0, cycles=2), 1e-4
    times = path.times_at_cells((1.0, cell))
    cells = path.position_at(times)[:, 1] / cell
    assert cells == close_to(np.round(cells), abs=1e-9)
    # From 0 to 2 and back, to -2 and back, twice.
    assert np.round(cells).tolist() == [0, 1, 2, 2, 1, 0, -1, -2, -2, -1, 0] + 1 * [
        *(1, 2, 2, 1, 0, -1, -2, -2, -1, 0)
    ]


def test_a_lateral_creepage_shifts_the_surface_to_the_right_of_the_way() -> None:
    """The way turned by a quarter clockwise, and back on the way back; -creepage along it."""
    bent = vc.Travel(
        [0.0, 1.0, 3.0], x=[0, 2, 2], y=[0, 0, -6], creepage=0.01, lateral_creepage=0.1
    )
    for time, shift in ((0.5, (-0.01, -0.1)), (1.0, (-0.02, -0.2)), (3.0, (-0.62, -0.14))):
        assert RollingShift(bent).at(time).motions == close_to([*shift, 0.0])
    swung = vc.reciprocating(3e-4, 2.0, cycles=2, creepage=0.0, lateral_creepage=-0.1)
    for time, aside in ((0.5, -3e-5), (1.0, 0.0), (1.5, 3e-5)):
        assert RollingShift(swung).at(time).motions == close_to([aside, 0.0, 0.0], abs=1e-18)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"lateral_creepage": 0.1}, "goes with a creepage, which may be 0"),
        ({"creepage": 0.0, "lateral_creepage": 1.5}, "must lie between -1 and 1, got 1.5"),
        ({"creepage": 0.0, "lateral_creepage": math.nan}, "lateral_creepage"),
    ],
)
def test_a_lateral_creepage_that_means_nothing_is_refused(given: dict[str, float], said: str):
    with pytest.raises(ValueError, match=said):
        vc.Travel([0.0, 1.0], y=[0.0, 1e-3], **given)
    with pytest.raises(ValueError, match=said):
        vc.reciprocating(1e-3, 1.0, 1, **given)
