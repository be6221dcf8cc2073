"""Balls that roll with traction against Kalker, and cylinders that creep."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.rolling_bodies import HELD, LATERAL, LONGITUDINAL, MU

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def ball_rolled(
    ratio: float,
    *,
    cells: int,
    share: float,
    aside: float | None = None,
    along: str = "y",
    way: float = 8.0,
    speed: float = 0.1,
) -> tuple[vc.ContactState, float]:
    """Two equal balls over a way of some radii, and G a² μ a/R.

    Shares of μ a/R are the creepage, and that to the right.
    """
    radius, half, modulus = 0.01, 1e-3, 1e6
    compliance = (1 - ratio) / modulus  # of both
    force, whole = 4 * half**3 / (3 * radius * compliance), MU * half / radius
    creepage = share * whole
    lateral = None if aside is None else aside * whole
    cell = 2 * half / cells
    steps = round(way * half / cell)
    shape, centre = (cells + 8, cells + 8 + steps), (0.0, steps * cell / 2)
    if along == "x":
        shape, centre = shape[::-1], centre[::-1]
    times = np.arange(steps + 1) * cell / speed
    body = vc.Material(vc.Elastic(modulus), ratio)
    *_, last = vc.march(
        vc.Paraboloid(radius, radius),
        body,
        vc.step(force, **HELD),
        vc.Grid((shape[0], shape[1]), (shape[0] * cell, shape[1] * cell), centre=centre),
        times,
        indenter_material=body,
        friction=MU,
        motion=vc.Travel(
            [0.0, times[-1]],
            **{along: [0.0, steps * cell]},
            creepage=creepage,
            lateral_creepage=lateral,
        ),
    )
    return last, modulus * half**2 * whole


@pytest.mark.slow
@pytest.mark.parametrize("ratio", LONGITUDINAL)
def test_small_creepage_of_balls_has_the_coefficient_of_kalker(ratio):
    """Of first order in the slip: Q = C11 G a² creepage (1 - ...); extrapolated to none."""
    found = []
    for share in (0.02, 0.04):
        last, unit = ball_rolled(ratio, cells=24, share=share)
        found.append(-last.tangential_force_y / (share * unit))
    assert 2 * found[0] - found[1] == close_to(LONGITUDINAL[ratio], rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", LATERAL)
def test_small_lateral_creepage_of_balls_has_the_coefficient_of_kalker(ratio):
    """Q = C22 G a² creepage to the right of the travel, and nothing along it."""
    found = []
    for aside in (0.02, 0.04):
        last, unit = ball_rolled(ratio, cells=24, share=0.0, aside=aside)
        found.append(last.tangential_force_x / (aside * unit))
        assert last.tangential_force_y == close_to(0.0, abs=1e-6 * unit)
    assert 2 * found[0] - found[1] == close_to(LATERAL[ratio], rel=0.01)


def test_without_lateral_contraction_tractions_are_along_the_creepage_in_any_direction():
    """Of ν = 0 both components of traction displace alike: the discs turn with the creepage."""
    straight, _ = ball_rolled(0.0, cells=8, share=0.5, way=3.0)
    oblique, _ = ball_rolled(0.0, cells=8, share=0.3, aside=0.4, way=3.0)
    size = float(np.abs(straight.traction_y).max())
    np.testing.assert_allclose(oblique.traction_y, 0.6 * straight.traction_y, atol=1e-5 * size)
    np.testing.assert_allclose(oblique.traction_x, -0.8 * straight.traction_y, atol=1e-5 * size)


@pytest.mark.parametrize(("along", "right"), [("y", 1.0), ("x", -1.0)])
def test_a_large_lateral_creepage_slides_to_the_right_of_the_travel(along, right):
    """All of the contact slips: friction times force, towards +x from y, towards -y from x."""
    last, _ = ball_rolled(0.3, cells=8, share=0.0, aside=5.0, way=3.0, along=along)
    across = {"y": last.tangential_force_x, "x": last.tangential_force_y}[along]
    assert across == close_to(right * MU * last.force, rel=1e-3)
    assert last.slip_fraction == 1.0


def test_direction_of_rolling_does_not_matter():
    along_x, along_y = (ball_rolled(0.3, cells=8, share=0.5, way=2.0, along=a)[0] for a in "xy")
    assert along_x.tangential_force_x == close_to(along_y.tangential_force_y, rel=1e-6)
    # Sums along rows and columns are rounded differently: to a part of the tolerance, 1e-6.
    largest = float(np.abs(along_y.traction_y).max())
    np.testing.assert_allclose(
        along_x.traction_x.T, along_y.traction_y, rtol=0, atol=3e-7 * largest
    )
    np.testing.assert_array_equal(along_x.slip_state.T, along_y.slip_state)


@pytest.mark.slow
def test_work_of_drive_and_motion_is_heat_of_friction_and_loss_in_a_creeping_body():
    """Steady rolling of a ball: Q creepage V and the resistance times V; to 1 % on 16 cells."""
    compliance, radius, force, speed = 1 / 200, 10.0, 10.0, 0.05
    material = vc.Material(vc.CreepSeries(1e-3, [9e-3], [1.0]), 0.5)
    half = (0.75 * force * radius * compliance) ** (1 / 3)
    cell, creepage = half / 8, 0.5 * MU * half / radius
    steps = 80
    shape = 24, 28 + steps
    grid = vc.Grid(shape, (shape[0] * cell, shape[1] * cell), centre=(0.0, steps * cell / 2))
    times = np.arange(steps + 1) * cell / speed
    states = list(
        vc.march(
            vc.Paraboloid(radius, radius),
            material,
            vc.step(force, **HELD),
            grid,
            times,
            friction=MU,
            motion=vc.Travel([0.0, times[-1]], y=[0.0, steps * cell], creepage=creepage),
        )
    )
    before, last = states[-9], states[-1]
    way = 8 * cell
    put_in = way * (last.resistance_y - last.tangential_force_y * creepage)
    rubbed = last.friction_heat - before.friction_heat
    lost = last.heat - before.heat
    assert rubbed + lost == close_to(put_in, rel=1e-2)
    # The tractions lose a part of it in the body: more than the pressure alone.
    assert lost > 1.02 * way * last.resistance_y


@pytest.mark.slow
@pytest.mark.parametrize(
    ("time", "way", "peak", "creepage"),
    [(0.009, 60.0, 78.74, 1.365e-2), (2.0, 30.0, 85.31, 9.932e-3)],
)
def test_two_cylinders_that_creep_roll_as_in_contact(time, way, peak, creepage):
    """`visc_cylindr.ref_out` of CONTACT after G. Wang and K. Knothe, J. Appl. Mech. 60 (1993) 310.

    Its creepages are of first order in cell and step: 1 % on these cells of an elastic body.
    """
    late, force, cell, speed = 1 / 1143, 600.0, 0.32, 1000.0  # mm, N, MPa, s
    body = vc.Material(vc.CreepSeries(late / 2, [late / 2], [time]), 0.4)
    steps = round(way / cell)
    count = 76 + steps
    count += count % 2
    *_, last = vc.march(
        vc.Paraboloid(math.inf, 50.0),
        body,
        vc.step(force, **HELD),
        vc.Grid((1, count), (1.0, count * cell), centre=(0.0, way / 2), periodic=(True, False)),
        np.arange(steps + 1) * cell / speed,
        indenter_material=body,
        friction=0.3,
        tangential=vc.tangential_step(force_y=-0.6 * 0.3 * force),
        motion=vc.Travel([0.0, steps * cell / speed], y=[0.0, steps * cell], rolling=True),
    )
    assert last.peak_pressure == close_to(peak, rel=1e-3)
    assert last.creepage == close_to(creepage, rel=2e-2)
