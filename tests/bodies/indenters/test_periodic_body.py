"""Bodies that repeat themselves with a grid: height maps across the borders of the period."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.indenters import HeightMap, Indenter
from viscontact.bodies.indenters.periodic_body import PeriodicBody

COUNT, PERIOD = 16, 1e-3
STEP = PERIOD / COUNT
RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e4), poisson_ratio=0.5)


def heights(x: Any, y: Any) -> Any:
    """Waves without any symmetry within the period."""
    u, v = 2 * np.pi * np.asarray(x)[:, None] / PERIOD, 2 * np.pi * np.asarray(y) / PERIOD
    return 1e-6 * (np.cos(u) + np.sin(2 * v + 0.3) + 0.5 * np.sin(u + v))


def one_period(closed: bool, uneven: bool = False) -> HeightMap:
    """Map of one period; closed if its last points repeat the first ones."""
    lines = np.arange(COUNT + closed) * STEP - PERIOD / 2 + (0 if closed else STEP / 2)
    along = lines.copy()
    if uneven:
        along[2:-2] += 0.2 * STEP * (-1.0) ** np.arange(along.size - 4)
    return HeightMap(along, lines, heights(along, lines))


@pytest.mark.parametrize("uneven", [False, True])
@pytest.mark.parametrize("closed", [False, True])
def test_map_goes_on_where_its_next_period_begins(closed: bool, uneven: bool) -> None:
    body = one_period(closed, uneven)
    grid = vc.Grid((COUNT, COUNT), (PERIOD, PERIOD), periodic=True)
    repeated = PeriodicBody(body, grid)
    x, y = (np.random.default_rng(1).uniform(-2, 2, 500) * PERIOD for _ in range(2))
    # The bilinear interpolation of a map of three periods, about the middle one.
    wide = np.concatenate([body.x[: COUNT or None] + k * PERIOD for k in (-1, 0, 1)])
    tall = np.concatenate([body.y[: COUNT or None] + k * PERIOD for k in (-1, 0, 1)])
    whole = HeightMap(wide, tall, np.tile(body.height[:COUNT, :COUNT], (3, 3)))
    within = (np.mod(each + PERIOD / 2, PERIOD) - PERIOD / 2 for each in (x, y))
    np.testing.assert_allclose(repeated.gap(x, y), whole.gap(*within), atol=1e-18)


def test_positions_within_the_map_keep_their_bits() -> None:
    body, grid = one_period(False), vc.Grid((COUNT, COUNT), (PERIOD, PERIOD), periodic=True)
    places = grid.x[:, None], grid.y[None, :]
    np.testing.assert_array_equal(PeriodicBody(body, grid).gap(*places), body.gap(*places))


@pytest.mark.parametrize("quarters", [0, 1, 2, 3])
def test_map_that_is_turned_and_added_to_others_goes_on(quarters: int) -> None:
    grid = vc.Grid((COUNT, COUNT), (PERIOD, PERIOD), periodic=True)
    turned = one_period(False).rotated(quarters * math.pi / 2)
    body: Indenter = turned + vc.Waviness(1e-6, wavelength_x=PERIOD)
    by = 3 * STEP
    here = body.gap(grid.x[:, None], grid.y[None, :])
    moved = PeriodicBody(body, grid).gap(grid.x[:, None] - by, grid.y[None, :])
    np.testing.assert_allclose(moved, np.roll(here, 3, 0), atol=1e-17)


def test_a_map_between_the_lines_of_a_coarser_grid_goes_on() -> None:
    # The first line is as far as it may be from the border: at the first centre.
    lines = np.arange(COUNT) * STEP - PERIOD / 2 + PERIOD / 8
    body = HeightMap(lines, lines, heights(lines, lines))
    found = PeriodicBody(body, vc.Grid((4, 4), (PERIOD, PERIOD), periodic=True))
    edges = found.gap([-PERIOD / 2, -PERIOD / 2 + STEP / 3, PERIOD / 2], 0.0)
    assert np.isfinite(edges).all()
    assert edges[0] == close_to(edges[2], rel=1e-9)


def test_axis_without_period_ends_with_the_map() -> None:
    grid = vc.Grid((COUNT, COUNT), (PERIOD, PERIOD), periodic=(True, False))
    found = PeriodicBody(one_period(False), grid).gap([0.0, 0.6 * PERIOD], [[0.0], [0.6 * PERIOD]])
    assert np.isfinite(found).tolist() == [[True, True], [False, False]]


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_moving_map_has_the_contact_of_the_map_elsewhere() -> None:
    grid = vc.Grid((COUNT, COUNT), (PERIOD, PERIOD), periodic=True)
    body, steel = one_period(False), vc.Material(vc.Elastic(1e6), 0.5)
    load, by = vc.step(2e3 * grid.area, tilt_x=0.0, tilt_y=0.0), 5 * STEP
    run = vc.simulate(
        *(body, steel, load, grid, [0.0, 1.0]),
        motion=vc.Travel([0.0, 1.0], y=[0.0, by]),
        errors=False,
    )
    for name in ("gap", "pressure"):
        before, after = run[name].values
        scale = np.abs(before).max()
        np.testing.assert_allclose(after, np.roll(before, 5, 1), atol=1e-5 * scale)


def test_steady_map_has_no_end_across_its_motion() -> None:
    grid = vc.Grid((32, 32), (PERIOD, PERIOD), periodic=True)
    load = vc.step(2e3 * grid.area, tilt_x=0.0, tilt_y=0.0)
    u, v = (2 * np.pi * each / PERIOD for each in (grid.x[:, None], grid.y))
    waves = vc.HeightMap(grid.x, grid.y, 1e-6 * np.cos(u) * np.cos(v))
    exact = vc.Waviness(1e-6, wavelength_x=PERIOD, wavelength_y=PERIOD)
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always", vc.AccuracyWarning)
        found, smooth = (
            vc.steady(each, RUBBER, load, 0.02, grid=grid, errors=False) for each in (waves, exact)
        )
    assert not any("end of the body" in str(note.message) for note in notes)
    assert abs(float(found.resistance_x[0])) < 1e-6 * float(found.resistance_y[0])
    assert float(found.resistance_y[0]) == close_to(float(smooth.resistance_y[0]), rel=0.03)
