"""Steady traction over creepage on covers: against springs, half-spaces, and the march to it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

MU, RADIUS, GSHEAR = 0.3, 0.01, 400e6
UNCOUPLED = vc.Friction(MU, coupling=False)


def cover(thickness: float, nu: float = 0.3, law: Any = None) -> vc.Layered:
    material = vc.Material(law or vc.Elastic(GSHEAR), nu)
    return vc.Layered([vc.Layer(thickness, material)], base="rigid")


def rolled(body: Any, load: float, half: float, creepage: Any, cells: int, **given: Any) -> Any:
    """A roller on a line contact with some cells on an expected half width [m]."""
    count = 2 * cells + 20
    size = 1.0, count * half / cells
    options = {"speed": 0.1, "friction": UNCOUPLED, "errors": False} | given
    return vc.steady(
        *(vc.Paraboloid(math.inf, RADIUS), body, vc.step(load, tilt_y=0.0), options.pop("speed")),
        grid=vc.Grid((1, count), size, periodic=(True, False)),
        creepage=creepage,
        **options,
    )


def on_springs(half: float, thickness: float, creepages: np.ndarray) -> tuple[float, np.ndarray]:
    """Load and pulls [N/m] of a roll on springs M/h, G/h: a thin compressible cover.

    q = G ξ (a - y)/h from the leading edge y = a on, and μ p0 (1 - y²/a²) where that is less
    (K. L. Johnson 1985, sections 5.8 and 8.7).
    """
    modulus = 2 * GSHEAR * 0.7 / 0.4
    peak = modulus * half**2 / (2 * RADIUS * thickness)
    y = np.linspace(-half, half, 20001)
    sticking = GSHEAR * creepages[:, None] * (half - y) / thickness
    held = np.minimum(sticking, MU * peak * (1 - (y / half) ** 2))
    return 4 / 3 * peak * half, np.trapezoid(held, y, axis=1)


def test_a_roll_on_a_thin_cover_pulls_as_one_on_springs():
    half, creepages, off = 4.0e-4, np.array([0.002, 0.005, 0.01]), []
    for ratio in (8, 16, 32):
        load, pulls = on_springs(half, half / ratio, creepages)
        assert 0.1 < pulls[0] / (MU * load) < pulls[-1] / (MU * load) < 0.95
        ds = rolled(cover(half / ratio), load, half, creepages, 60)
        off.append(np.abs(-ds.tangential_force_y.values[0] / pulls - 1).max())
    # First order in the thickness over the half width, by the rounded edges of the pressure.
    orders = np.log2(np.array(off[:-1]) / np.array(off[1:]))
    assert (orders > 0.8).all()
    assert off[-1] < 0.03


def test_a_thick_cover_pulls_as_a_half_space():
    load, nu = 1e4, 0.3
    half = math.sqrt(4 * load * RADIUS * (1 - nu) / (2 * GSHEAR) / math.pi)
    full, off = MU * half / RADIUS, []
    creepages = np.array([0.1, 0.4, 0.8]) * full
    exact = MU * load * (1 - (1 - creepages / full) ** 2)  # Carter 1926
    for ratio in (5, 10, 20):
        ds = rolled(cover(ratio * half), load, half, creepages, 40)
        off.append(np.abs(-ds.tangential_force_y.values[0] / exact - 1).max())
    orders = np.log2(np.array(off[:-1]) / np.array(off[1:]))
    assert (orders > 1.5).all()  # strains of the base fall with the square of the depth
    assert off[-1] < 2e-3


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_layers_of_one_material_roll_as_its_half_space(nu: float):
    law = vc.Zener(GSHEAR, GSHEAR, 100 * GSHEAR)
    own = vc.Material(law, nu)
    layers = vc.Layered([vc.Layer(1e-4, own), vc.Layer(3e-4, own)], base=own)
    load, half = 1e4, 5e-4
    one, other = (rolled(body, load, half, [0.004, 0.02], 20, speed=1e-5) for body in (own, layers))
    for name in ("tangential_force_y", "friction_power", "slip_fraction", "resistance_y"):
        np.testing.assert_allclose(other[name].values, one[name].values, rtol=2e-4)


def test_a_ball_on_layers_of_one_material_rolls_as_on_its_half_space():
    own = vc.Material(vc.Elastic(GSHEAR), 0.3)
    layers = vc.Layered([vc.Layer(2e-4, own)], base=own)

    def pulls(body: Any) -> xr.Dataset:
        return vc.steady(
            *(vc.Paraboloid(RADIUS, RADIUS), body, vc.step(10.0), 0.1),
            grid=vc.Grid((32, 32), (1.1e-3, 1.1e-3)),
            friction=UNCOUPLED,
            creepage=[0.001, 0.005],
            errors=False,
        )

    one, other = pulls(own), pulls(layers)
    for name in ("tangential_force_y", "friction_power", "slip_fraction"):
        np.testing.assert_allclose(other[name].values, one[name].values, rtol=1e-4)


def test_a_ball_on_a_thin_cover_pulls_as_one_on_springs():
    half, creepage, off = 4.0e-4, 0.004, []
    modulus = 2 * GSHEAR * 0.7 / 0.4
    for ratio, cells in ((8, 48), (16, 64), (32, 96)):
        thickness = half / ratio
        peak = modulus * half**2 / (2 * RADIUS * thickness)
        load = math.pi / 2 * half**2 * peak
        x, y = np.meshgrid(*(2 * [np.linspace(-half, half, 801)]), indexing="ij")
        bound = MU * peak * np.maximum(1 - (x**2 + y**2) / half**2, 0)
        ahead = np.sqrt(np.maximum(half**2 - x**2, 0)) - y
        held = np.minimum(GSHEAR * creepage * np.maximum(ahead, 0) / thickness, bound)
        pull = held.sum() * (half / 400) ** 2
        assert 0.2 < pull / (MU * load) < 0.9
        ds = vc.steady(
            *(vc.Paraboloid(RADIUS, RADIUS), cover(thickness), vc.step(load), 0.1),
            grid=vc.Grid((cells, cells), (2.5 * half, 2.5 * half)),
            friction=UNCOUPLED,
            creepage=creepage,
            errors=False,
        )
        off.append(float(-ds.tangential_force_y[0, 0] / pull - 1))
    # First order in the thickness over the radius.
    assert np.log2(off[0] / off[1]) > 0.8
    assert np.log2(off[1] / off[2]) > 0.8
    assert 0 < off[2] < 0.04


@pytest.mark.parametrize(("speed", "relaxed"), [(1e-8, True), (1e2, False)])
def test_a_creeping_cover_pulls_as_an_elastic_one_in_the_limits_of_speed(
    speed: float, relaxed: bool
):
    law = vc.CreepSeries(1 / (2 * GSHEAR), [1 / (2 * GSHEAR)], [1.0])
    elastic = vc.Elastic(GSHEAR / (2 if relaxed else 1))
    load, half, creepages = 1e4, 4e-4, [0.003, 0.01]
    one, other = (
        rolled(cover(2e-4, 0.45, each), load, half, creepages, 30, speed=speed)
        for each in (law, elastic)
    )
    pulls = [ds.tangential_force_y.values[0] for ds in (one, other)]
    np.testing.assert_allclose(*pulls, rtol=1e-3)


@pytest.mark.slow
def test_a_roll_in_time_on_a_creeping_cover_comes_to_the_steady_traction():
    law = vc.CreepSeries(1 / (2 * GSHEAR), [1 / (2 * GSHEAR)], [1.0])
    body, load, half, cells, creepage = cover(2e-4, 0.45, law), 1e4, 4e-4, 40, 0.006
    cell, steps, speed = half / cells, 6 * cells, 4e-4
    steady = rolled(body, load, half, [creepage], cells, speed=speed)
    grid = vc.Grid(
        (1, steps + 4 * cells),
        (1.0, (steps + 4 * cells) * cell),
        centre=(0.0, steps * cell / 2),
        periodic=(True, False),
    )
    times = np.arange(steps + 1.0) * cell / speed
    path = vc.Travel([0.0, times[-1]], y=[0.0, steps * cell], rolling=True, creepage=creepage)
    state = list(
        vc.march(
            *(vc.Paraboloid(math.inf, RADIUS), body, vc.step(load, tilt_x=0.0, tilt_y=0.0)),
            *(grid, times),
            friction=UNCOUPLED,
            motion=path,
        )
    )[-1]
    pull = float(steady.tangential_force_y[0, 0])
    assert 0.2 < -pull / (MU * load) < 0.9
    assert state.tangential_force_y == close_to(pull, rel=1e-2)


def test_work_of_the_drive_is_heat_of_friction_and_of_the_cover():
    law = vc.CreepSeries(1 / (2 * GSHEAR), [1 / (2 * GSHEAR)], [1.0])
    creepages, speed, off = np.array([0.003, 0.006]), 4e-4, []
    for cells in (20, 40):
        ds = rolled(cover(2e-4, 0.45, law), 1e4, 4e-4, creepages, cells, speed=speed)
        put_in = -ds.tangential_force_y.values[0] * creepages * speed
        lost = (ds.friction_power + ds.traction_dissipation).values[0]
        off.append(np.abs(lost / put_in - 1).max())
        assert (ds.traction_dissipation.values > 0).all()
    assert off[1] < off[0] / 2.5
    assert off[1] < 2e-3


def test_layers_that_slide_and_rows_of_bodies_are_refused():
    sliding = vc.Layered([vc.Layer(2e-4, vc.Material(vc.Elastic(GSHEAR), 0.3))], "rigid", False)
    with pytest.raises(ValueError, match=r"material\.bonded: a layer that slides"):
        rolled(sliding, 1e4, 4e-4, [0.01], 20)
    with pytest.raises(ValueError, match=r"friction\.coupling: .*coupled"):
        rolled(cover(2e-4), 1e4, 4e-4, [0.01], 20, friction=MU)
    with pytest.raises(ValueError, match=r"grid\.periodic: layers under friction"):
        vc.steady(
            *(vc.Paraboloid(RADIUS, RADIUS), cover(2e-4), vc.step(10.0), 0.1),
            grid=vc.Grid((32, 32), (1.1e-3, 1.1e-3), periodic=(True, False)),
            friction=UNCOUPLED,
            creepage=0.01,
        )
