"""Steady traction over creepage against Carter, Kalker, CONTACT, and the march to it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from verification.rolling_bodies import (
    BY_SPIN,
    FULL,
    HALF,
    LATERAL,
    LINE_LOAD,
    LONGITUDINAL,
    MU,
    RADIUS,
    RUBBER,
    half_width,
)
from viscontact.simulation.steady_motion import traction

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def rolled(cells: int, creepage: Any, **given: Any) -> xr.Dataset:
    """A roller on some cells across the half width of the rubber, unless a half width is given."""
    half = given.pop("half", HALF)
    count = 2 * cells + 20
    size = 1.0, count * 2 * half / (2 * cells)
    options = {"material": RUBBER, "speed": 0.1, "errors": False} | given
    grid = options.pop("grid", vc.Grid((1, count), size, periodic=(True, False)))
    return vc.steady(
        vc.Paraboloid(math.inf, RADIUS),
        options.pop("material"),
        vc.step(LINE_LOAD, tilt_y=0.0),
        options.pop("speed"),
        grid=grid,
        friction=MU,
        creepage=creepage,
        **options,
    )


SHARES = np.array([0.1, 0.3, 0.6, 0.9])


def carter_errors(cells: int) -> Any:
    """Relative errors of the tractions: Q/(μ W) = 1 - (1 - creepage R/(μ a))²."""
    ds = rolled(cells, SHARES * FULL)
    exact = MU * LINE_LOAD * (1 - (1 - SHARES) ** 2)
    return np.abs(-ds.tangential_force_y.values[0] / exact - 1)


def test_traction_over_creepage_is_that_of_carter_of_second_order_in_the_cells():
    """F. W. Carter, Proc. R. Soc. Lond. A 112 (1926) 151; K. L. Johnson (1985), section 8.3."""
    for cells in (10, 20, 40, 80):  # of the half width
        assert (carter_errors(cells) < 0.4 / cells**2).all(), cells


def test_stick_zone_and_tractions_are_those_of_carter():
    ds = rolled(40, 0.4 * FULL)
    y, found = ds.y.values / HALF, ds.isel(speed=0, creepage=0, x=0)
    touching, sticks = found.slip_state.values > 0, found.slip_state.values == 1
    # The part b/a = 1 - creepage R/(μ a), from the leading edge on.
    assert (y[sticks] > 1 - 2 * 0.6 - 0.03).all()
    assert (y[touching & ~sticks] < 1 - 2 * 0.6 + 0.03).all()
    # q = μ p0 [(1 - y²)^(1/2) - b/a (1 - ((y - d)/b)²)^(1/2)] with d = a - b.
    peak = 2 * LINE_LOAD / (math.pi * HALF)
    outer, inner = 1 - y**2, 1 - ((y - 0.4) / 0.6) ** 2
    exact = MU * peak * (np.sqrt(np.maximum(outer, 0)) - 0.6 * np.sqrt(np.maximum(inner, 0)))
    np.testing.assert_allclose(-found.traction_y.values, exact, atol=0.03 * MU * peak)


def test_lateral_creepage_has_the_force_of_carter_in_antiplane_strain():
    """A line moves by 1/(1 - ν) times as much across: twice the creepage at ν = 1/2 (8.3)."""
    lateral, carried = 2 * 0.4 * FULL, 0.64 * MU * LINE_LOAD
    for cells in (10, 20, 40):
        ds = rolled(cells, [0.0], lateral_creepage=lateral).isel(speed=0, creepage=0)
        assert ds.tangential_force_x == close_to(carried, rel=0.1 / cells**2)
        assert ds.tangential_force_y == 0
        put_in = float(ds.tangential_force_x) * lateral * 0.1
        assert ds.friction_power == close_to(put_in, rel=0.3 / cells**2)


def test_work_of_the_drive_is_heat_of_friction():
    """An elastic body in steady rolling stores nothing: Q creepage V is the heat."""
    creepages, speed = SHARES[1:] * FULL, 0.1
    for cells in (20, 40):
        ds = rolled(cells, creepages)
        put_in = -ds.tangential_force_y.values[0] * creepages * speed
        np.testing.assert_allclose(ds.friction_power.values[0], put_in, rtol=2.0 / cells**2)
        assert np.abs(ds.traction_dissipation.values[0] / put_in).max() < 1e-6
    radius = ds.drive_torque.values / -ds.tangential_force_y.values
    np.testing.assert_allclose(radius, RADIUS, rtol=1e-12)


def test_body_that_brakes_pushes_as_much_forth_and_one_without_creepage_not_at_all():
    ds = rolled(10, [0.5 * FULL, -0.5 * FULL, 0.0])
    drives, brakes, rests = ds.tangential_force_y.values[0]
    assert drives < 0
    assert brakes == close_to(-drives, rel=1e-5)
    assert rests == 0
    assert ds.slip_fraction.values[0, 2] == 0


def test_body_that_slides_all_over_carries_friction_times_force():
    ds = rolled(10, 3 * FULL)
    assert ds.slip_fraction.values == 1
    assert -float(ds.tangential_force_y[0, 0]) == close_to(MU * LINE_LOAD, rel=1e-6)


INSTANT, LATE = 0.25e-6, 0.5e-6  # J(0) and what is added [1/Pa], in 1 s
CREEPING = vc.Material(vc.CreepSeries(2 * INSTANT, [2 * LATE], [1.0]), 0.5)


@pytest.mark.parametrize(("speed", "relaxed"), [(1e-6, True), (1e3, False)])
def test_creeping_body_rolls_as_an_elastic_one_in_the_limits_of_speed(speed, relaxed):
    half = half_width(INSTANT + LATE if relaxed else INSTANT)
    creepages = SHARES * MU * half / RADIUS
    ds = rolled(40, creepages, material=CREEPING, half=half, speed=speed)
    exact = MU * LINE_LOAD * (1 - (1 - SHARES) ** 2)
    np.testing.assert_allclose(-ds.tangential_force_y.values[0], exact, rtol=1e-3)
    part = ds.traction_dissipation.values / (ds.traction_dissipation + ds.friction_power).values
    assert part.max() < 1e-2


def test_a_creeping_roller_on_a_stiff_plane_is_a_stiff_one_on_a_creeping_plane():
    """With a relaxation far shorter than a turn of the roller."""
    stiff = vc.Material(vc.Elastic(1e12), 0.5)
    given = {"speed": 3e-4, "half": half_width(INSTANT + LATE)}
    plane = rolled(20, 0.4 * FULL, material=CREEPING, **given)
    roller = rolled(
        20, 0.4 * FULL, material=stiff, indenter_material=CREEPING, rolling=True, **given
    )
    for name in ("tangential_force_y", "friction_power", "traction_dissipation"):
        np.testing.assert_allclose(roller[name].values, plane[name].values, rtol=1e-4)


@pytest.mark.parametrize("speed", [3e-4, 3e-3])
def test_power_of_a_drive_on_a_creeping_body_is_heat_and_loss_under_the_tractions(speed):
    """The loss is that of the dashpots by strips of constant traction, without the grid's."""
    creepage = 0.4 * FULL
    for cells in (20, 40):
        ds = rolled(cells, creepage, material=CREEPING, speed=speed).isel(speed=0, creepage=0)
        put_in = -float(ds.tangential_force_y) * creepage * speed
        lost = float(ds.traction_dissipation)
        assert lost > 0.05 * put_in
        assert float(ds.friction_power) + lost == close_to(put_in, rel=0.5 / cells**2)
        assert lost == close_to(loss_of_strips(ds, speed), rel=0.5 / cells)


def loss_of_strips(ds: xr.Dataset, speed: float) -> float:
    """Power lost under the tractions [W]: V Σ Ji/li ∫ q (K q - Ei K q) dy, by quadrature."""
    # K is -(2/π) ln|y| of a unit length, of a creep function J; its constant cancels.
    y, q = ds.y.values, ds.traction_y.values[0]
    cell, length = y[1] - y[0], speed * 1.0
    edges = np.concatenate([[0.0], np.geomspace(1e-4, 60.0, 1500)]) * length
    ahead, widths = (edges[1:] + edges[:-1]) / 2, np.diff(edges)
    weights = np.exp(-edges[:-1] / length) - np.exp(-edges[1:] / length)

    def strip(distance: Any) -> Any:
        low, high = distance - cell / 2, distance + cell / 2
        return -2 / math.pi * (_log_primitive(high) - _log_primitive(low))

    offsets = y[:, None] - y[None, :]
    at_rest = strip(offsets)
    delayed = sum(w * strip(offsets + a) for w, a in zip(weights, ahead, strict=True))
    assert widths.min() > 0
    loss = LATE / length * (at_rest - delayed)
    return float(speed * q @ (loss @ q) * cell)


def _log_primitive(y: Any) -> Any:
    return y * np.log(np.maximum(np.abs(y), 1e-300)) - y


def ball(
    ratio: float,
    cells: int,
    shares: Any,
    along: str = "y",
    aside: float | None = None,
    *,
    spin: float | None = None,
    errors: bool = False,
) -> tuple[xr.Dataset, Any]:
    """Two equal balls under creepages, as parts of that at which a roller slides; G a² creepage.

    Another such part is the creepage to the right; the spin is in rad/m.
    """
    radius, half, modulus = 0.01, 1e-3, 1e6
    compliance = (1 - ratio) / modulus  # of both
    force = 4 * half**3 / (3 * radius * compliance)
    creepages = np.array(shares) * MU * half / radius
    body = vc.Material(vc.Elastic(modulus), ratio)
    size = (cells + 8) * 2 * half / cells
    ds = vc.steady(
        vc.Paraboloid(radius, radius),
        body,
        vc.step(force, tilt_x=0.0, tilt_y=0.0),
        0.1,
        along=along,
        indenter_material=body,
        grid=vc.Grid((cells + 8, cells + 8), (size, size)),
        friction=MU,
        creepage=creepages,
        lateral_creepage=None if aside is None else aside * MU * half / radius,
        spin=spin,
        errors=errors,
    )
    return ds, modulus * half**2 * creepages


@pytest.mark.parametrize("ratio", LONGITUDINAL)
def test_small_creepage_of_balls_has_the_coefficient_of_kalker(ratio):
    """Of first order in the slip: Q = C11 G a² creepage (1 - ...); extrapolated to none."""
    ds, unit = ball(ratio, 32, [0.02, 0.04])
    low, high = -ds.tangential_force_y.values[0] / unit
    assert 2 * low - high == close_to(LONGITUDINAL[ratio], rel=0.007)


@pytest.mark.parametrize("ratio", LATERAL)
def test_small_lateral_creepage_of_balls_has_the_coefficient_of_kalker(ratio):
    """Q = C22 G a² creepage to the right, within its error bar of 32 cells, and none along."""
    found, bars = [], []
    for aside in (0.01, 0.02):
        ds, _ = ball(ratio, 32, [0.0], aside=aside, errors=True)
        unit = 1e6 * 1e-6 * aside * MU * 0.1
        found.append(float(ds.tangential_force_x[0, 0]) / unit)
        bars.append(float(ds.tangential_force_x_error[0, 0]) / unit)
        assert ds.tangential_force_y.values == close_to(0.0, abs=1e-6 * unit)
    assert 2 * found[0] - found[1] == close_to(LATERAL[ratio], abs=min(bars))
    assert bars[0] < 0.01 * found[0]


@pytest.mark.parametrize("ratio", BY_SPIN)
def test_small_spin_of_balls_has_the_coefficient_of_kalker(ratio):
    """Q = C23 G a³ spin to the left of the travel, to the digits of the table and its error bar."""
    ds, _ = ball(ratio, 32, [0.0], spin=0.3, errors=True)
    unit = 1e6 * 1e-9 * 0.3
    bar = float(ds.tangential_force_x_error[0, 0]) / unit
    assert -float(ds.tangential_force_x[0, 0]) / unit == close_to(BY_SPIN[ratio], abs=0.006)
    assert bar < 0.007
    assert ds.tangential_force_y.values == close_to(0.0, abs=1e-6 * unit)


def test_spin_turns_with_the_travel_and_back_with_its_sign():
    """A travel along +x is one along +y that is turned clockwise: the force stays to its left."""
    along_y, along_x = (ball(0.3, 12, [0.0], along=each, spin=20.0)[0] for each in "yx")
    back = ball(0.3, 12, [0.0], spin=-20.0)[0]
    aside = along_y.tangential_force_x.values
    assert aside < 0
    assert along_x.tangential_force_y.values == close_to(-aside, rel=1e-5)
    assert back.tangential_force_x.values == close_to(-aside, rel=1e-5)


def test_power_of_a_large_spin_is_that_of_the_torque_of_full_sliding():
    """3π/16 μ W a at a vanishing shift (Lubkin 1951); the pole moves aside by 1/spin."""
    powers = []
    for spin in (1e3, 4e3):
        ds, _ = ball(0.3, 24, [0.0], spin=spin)
        torque = 3 * math.pi / 16 * MU * float(ds.force[0]) * 1e-3
        powers.append(float(ds.friction_power[0, 0]) / (torque * spin * 0.1))
        assert ds.slip_fraction.values == 1
    assert powers[1] == close_to(1.0, abs=2e-3)
    assert abs(powers[0] - 1) > abs(powers[1] - 1)


def test_without_lateral_contraction_tractions_are_along_the_creepage_in_any_direction():
    """Of ν = 0 both components of traction displace alike: the discs turn with the creepage."""
    straight, oblique = ball(0.0, 12, [0.5])[0], ball(0.0, 12, [0.3], aside=0.4)[0]
    along, size = straight.traction_y.values, float(np.abs(straight.traction_y).max())
    np.testing.assert_allclose(oblique.traction_y.values, 0.6 * along, atol=1e-5 * size)
    np.testing.assert_allclose(oblique.traction_x.values, -0.8 * along, atol=1e-5 * size)


@pytest.mark.parametrize(("along", "right"), [("y", 1.0), ("x", -1.0)])
def test_a_large_lateral_creepage_slides_to_the_right_of_the_travel(along, right):
    """All of the contact slips: friction times force, towards +x from y, towards -y from x."""
    ds = ball(0.3, 8, [0.0], along, aside=5.0)[0]
    across = {"y": ds.tangential_force_x, "x": ds.tangential_force_y}[along]
    assert across.values[0] == close_to(right * MU * ds.force.values, rel=1e-3)
    assert ds.slip_fraction.values == 1


def test_direction_of_rolling_does_not_matter():
    along_x, along_y = (ball(0.3, 12, [0.5], along=each)[0] for each in "xy")
    forces = along_x.tangential_force_x.values, along_y.tangential_force_y.values
    np.testing.assert_allclose(*forces, rtol=1e-5)
    assert along_x.tangential_force_y.values == 0
    tractions = along_x.traction_x.values[0, 0].T, along_y.traction_y.values[0, 0]
    np.testing.assert_allclose(*tractions, atol=1e-4 * np.abs(tractions[1]).max())
    across = along_x.traction_y.values[0, 0].T, along_y.traction_x.values[0, 0]
    np.testing.assert_allclose(*across, atol=1e-4 * np.abs(tractions[1]).max())


def held(contact: Any, before: Any, *given: Any, **options: Any) -> Any:
    """No compliance of cells that enter: they are held from the begin of their step on."""
    return np.zeros((3, *before.gap.shape))


#: FX/FSTAT/FN and cells in adhesion by CKSI, cases 1 to 16 of `tractcurv.ref_out`, without an
#: interface layer, of CONTACT (E. A. H. Vollebregt, repository eve70a/CONTACT, commit d431cdb,
#: 2025), after O. Polach, Wear 258 (2005) 992.
TRACTION_CURVE = {
    **{1e-5: (7.015e-3, 1382), 4e-4: (0.2588, 1182), 8e-4: (0.4742, 976), 1.2e-3: (0.6482, 782)},
    **{1.6e-3: (0.7831, 596), 2e-3: (0.8816, 422), 2.4e-3: (0.9467, 262), 2.8e-3: (0.9832, 132)},
    **{3.2e-3: (0.9976, 32), 3.6e-3: (0.9991, 0), 6e-3: (0.9997, 0)},
}
STEEL = vc.Material(vc.Elastic(82000.0), 0.28)  # mm, N, MPa


def wheel(shape: tuple[int, int], creepages: list[float]) -> xr.Dataset:
    """The wheel of `tractcurv.inp` on its cells, or on others of the same size."""
    return vc.steady(
        vc.Paraboloid(625.0, 1 / (2 * 0.2814e-3)),
        STEEL,
        vc.step(106700.0, tilt_x=0.0, tilt_y=0.0),
        1e4,
        along="x",
        indenter_material=STEEL,
        friction=0.33,
        creepage=creepages,
        grid=vc.Grid(shape, (2.2 * 6.304, 2.2 * 12.61)),
        errors=False,
    )


def test_traction_curve_of_a_wheel_is_that_of_contact(monkeypatch):
    """All digits, with new cells held from the begin of their step, as they are there.

    CONTACT has 1384 cells in contact; four of them at the rim are open here, which leaves 1.2e-3 at
    the smallest creepage.
    """
    monkeypatch.setattr(traction, "entry_compliance", held)
    ds = wheel((48, 44), list(TRACTION_CURVE))
    assert float(ds.peak_pressure[0]) == close_to(640.7, rel=1e-4)
    assert float(ds.approach[0]) == close_to(7.651e-2, rel=1e-4)
    part = -ds.tangential_force_x.values[0] / (0.33 * 106700.0)
    stuck = (ds.slip_state.values[0] == 1).sum(axis=(1, 2))
    for index, (force, cells) in enumerate(TRACTION_CURVE.values()):
        assert part[index] == close_to(force, rel=1.5e-3 if index == 0 else 2e-4), index
        assert abs(int(stuck[index]) - cells) <= 2, index


def test_cells_that_enter_within_the_way_of_a_cell_leave_second_order_errors():
    """Held from its begin, as in CONTACT, they leave 1.4 % at a small creepage on these cells."""
    creepages = [4e-4, 1.2e-3, 2e-3]
    coarse, fine = (wheel((n, n - 4), creepages).tangential_force_x.values for n in (48, 96))
    np.testing.assert_allclose(coarse, fine, rtol=5e-4)


def test_carter_in_two_dimensions_has_the_numbers_of_contact(monkeypatch):
    """`carter2d.ref_out`: FX/FSTAT/FN 0.6480, 30 cells that stick and 20 that slip."""

    def roller() -> xr.Dataset:
        grid = vc.Grid((1, 55), (200.0, 2.2), centre=(0.0, 0.03), periodic=(True, False))
        load = vc.step(35780.0, tilt_y=0.0)
        given = {"indenter_material": STEEL, "friction": 0.3, "creepage": 2.4e-4, "grid": grid}
        body = vc.Paraboloid(math.inf, 500.0)
        return vc.steady(body, STEEL, load, 3e4, errors=False, **given).isel(speed=0, creepage=0)

    ours = roller()
    monkeypatch.setattr(traction, "entry_compliance", held)
    theirs = roller()
    assert float(theirs.peak_pressure) == close_to(113.9, rel=2e-4)
    assert -float(theirs.tangential_force_y) / (0.3 * 35780.0) == close_to(0.6480, rel=1e-4)
    for each in (ours, theirs):
        counts = [int((each.slip_state == state).sum()) for state in (1, 2)]
        assert counts == [30, 20]
    # Carter's own is 0.64 for 0.6 of the width in adhesion.
    assert -float(ours.tangential_force_y) / (0.3 * 35780.0) == close_to(0.64, rel=2e-4)


@pytest.mark.slow
def test_a_march_under_a_creepage_comes_to_the_steady_traction():
    """A creeping ball from rest over twelve half widths, a cell a step, on the same cells."""
    compliance, radius, force, speed = 1 / 200, 10.0, 10.0, 0.05
    material = vc.Material(vc.CreepSeries(1e-3, [9e-3], [1.0]), 0.5)
    half = (0.75 * force * radius * compliance) ** (1 / 3)
    cell, creepage, steps = half / 8, 0.5 * MU * half / radius, 96
    load, body = vc.step(force, tilt_x=0.0, tilt_y=0.0), vc.Paraboloid(radius, radius)
    size = 24 * cell, (28 + steps) * cell
    grid = vc.Grid((24, 28 + steps), size, centre=(0.0, steps * cell / 2))
    times = np.arange(steps + 1) * cell / speed
    path = vc.Travel([0.0, times[-1]], y=[0.0, steps * cell], creepage=creepage)
    *_, last = vc.march(body, material, load, grid, times, friction=MU, motion=path)
    around = vc.Grid((24, 28), (24 * cell, 28 * cell))
    ds = vc.steady(
        *(body, material, load, speed),
        grid=around,
        friction=MU,
        creepage=creepage,
        errors=False,
    ).isel(speed=0, creepage=0)
    assert last.tangential_force_y == close_to(float(ds.tangential_force_y), rel=3e-3)
    assert last.drive_torque == close_to(float(ds.drive_torque), rel=3e-3)
    assert last.friction_power == close_to(float(ds.friction_power), rel=2e-2)
    assert last.slip_fraction == close_to(float(ds.slip_fraction), rel=3e-2)
