"""Ball on a stage that is free to tilt, with its lowest point beside the pivot.

(x - e)²/2R = x²/2R - x e/R + e²/2R: tilted by -e/R, the ball is one with its lowest point at the
pivot, e²/2R further away.
"""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from returned import some

RADIUS, ASIDE = 0.01, (3e-4, -2e-4)
AWAY = (ASIDE[0] ** 2 + ASIDE[1] ** 2) / (2 * RADIUS)

BALL, GRID = vc.Paraboloid(RADIUS, RADIUS), vc.Grid((48, 48), (2.4e-3, 2.4e-3))
RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)
TIMES = np.linspace(0.0, 2.0, 9)

FREE = {"tilt_x": None, "tilt_y": None}

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def states(ball, approach, **tilts):
    load = vc.ApproachHistory([0.0, 1.0, 2.0], approach, **tilts)
    return list(vc.march(ball, RUBBER, load, GRID, TIMES, tolerance=1e-8))


def test_ball_beside_the_pivot_is_pressed_like_a_centred_one_that_is_further_away():
    # The first touch is at a requested time, so that both take the same steps.
    found = states(BALL.shifted(*ASIDE), [0.0, 4 * AWAY, 3.5 * AWAY], **FREE)
    centred = states(BALL, [-AWAY, 3 * AWAY, 2.5 * AWAY])
    assert [each.force > 0 for each in found] == [False, False] + 7 * [True]
    for one, other in zip(found, centred, strict=True):
        assert one.force == close_to(other.force, rel=1e-6)
        assert np.abs(one.pressure - other.pressure).max() <= 1e-5 * other.peak_pressure
        if one.force > 0:
            assert one.tilt_x == close_to(-ASIDE[0] / RADIUS, rel=1e-4)
            assert one.tilt_y == close_to(-ASIDE[1] / RADIUS, rel=1e-4)


def test_ball_rolls_off_until_it_is_balanced_on_the_pivot():
    """Tangent to the ball from the pivot: slope (sqrt(e² - 2Rd) - e)/R at the approach d."""
    aside = 4e-4
    first = aside**2 / (2 * RADIUS)
    # The nearest cell's centre lies within half a cell both ways, this much above the surface.
    missed = (GRID.cell_size[0] ** 2 + GRID.cell_size[1] ** 2) / 4 / (2 * RADIUS)

    def slope(approach):
        return (math.sqrt(aside**2 - 2 * RADIUS * approach) - aside) / RADIUS

    found = states(BALL.shifted(x=aside), [0.0, 0.99 * first, 0.99 * first], **FREE)
    for each in some(found):
        assert each.outcome is vc.Outcome.NO_CONTACT
        assert each.gap.min() >= -1e-12 * first
        assert slope(each.approach) <= each.tilt_x <= slope(max(each.approach - missed, 0.0))
        assert each.tilt_y == 0


def test_tilts_are_kept_while_the_body_is_clear():
    found = states(BALL.shifted(*ASIDE), [0.0, 0.9 * AWAY, -0.9 * AWAY], **FREE)
    deepest, after = found[4], found[5:]
    assert deepest.tilt_x < 0 < deepest.tilt_y
    assert all((each.tilt_x, each.tilt_y) == (deepest.tilt_x, deepest.tilt_y) for each in after)
