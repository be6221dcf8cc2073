"""Rolling with traction against Carter, Kalker, and examples of another program."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.simulation.transient import slip_step

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

MU, RADIUS, LINE_LOAD = 0.3, 0.01, 100.0
RUBBER = vc.Material(vc.Elastic(1 / 3 * 1e6), 0.5)
HELD = {"tilt_x": 0.0, "tilt_y": 0.0}


def half_width(compliance: float, force: float = LINE_LOAD, radius: float = RADIUS) -> float:
    """Half width of a line contact of contact compliance J [1/Pa] (Hertz) [m]."""
    return math.sqrt(4 * force * radius * compliance / math.pi)


#: J = (1 - ν)/(2G) of the rubber.
HALF = half_width(0.75e-6)
FULL = MU * HALF / RADIUS  # creepage from which on all slips (Carter)


def rolled(
    cells: int,
    way: float,
    *,
    material: vc.Material = RUBBER,
    half: float = HALF,
    speed: float = 0.1,
    creepage: float | None = None,
    tangential: Any = None,
    **given: Any,
) -> list[vc.ContactState]:
    """A roller over a way of some half widths along y, a cell a step, from rest."""
    cell = 2 * half / cells
    steps = round(way * half / cell)
    count = steps + 4 * cells
    travel = steps * cell
    grid = vc.Grid(
        (1, count), (1.0, count * cell), centre=(0.0, travel / 2), periodic=(True, False)
    )
    times = np.arange(steps + 1) * cell / speed
    path = vc.Travel([0.0, times[-1]], y=[0.0, travel], rolling=True, creepage=creepage)
    return list(
        vc.march(
            vc.Paraboloid(math.inf, RADIUS),
            material,
            vc.step(LINE_LOAD, **HELD),
            grid,
            times,
            friction=MU,
            motion=path,
            tangential=tangential,
            **given,
        )
    )


def pulled(part: float) -> vc.TangentialHistory:
    """A force of a part of what friction carries, which drives towards +y."""
    return vc.tangential_step(force_y=-part * MU * LINE_LOAD)


@pytest.fixture(scope="module")
def driven() -> dict[int, vc.ContactState]:
    """Steady rolling under 0.64 of what friction carries, by cells across."""
    return {cells: rolled(cells, 5.0, tangential=pulled(0.64))[-1] for cells in (10, 20)}


def creepage_error(state: vc.ContactState) -> float:
    """Relative error of the creepage under 0.64 μ W."""
    exact = FULL * (1 - math.sqrt(1 - 0.64))
    assert state.creepage is not None
    return abs(state.creepage / exact - 1)


def power_error(state: vc.ContactState) -> float:
    """Relative error of the heat of friction, which is all that the drive does: Q creepage V."""
    power = -state.tangential_force_y * state.creepage * 0.1
    return abs(state.friction_power / power - 1)


def test_creepage_under_a_held_force_is_that_of_carter(driven):
    """F. W. Carter, Proc. R. Soc. Lond. A 112 (1926) 151; K. L. Johnson (1985), section 8.3."""
    assert creepage_error(driven[20]) < 1.5e-3
    assert creepage_error(driven[20]) < creepage_error(driven[10]) / 3


def test_work_of_the_drive_is_heat_of_friction(driven):
    """An elastic body in steady rolling stores nothing."""
    assert power_error(driven[20]) < 4e-3
    assert power_error(driven[20]) < power_error(driven[10]) / 2.5
    pushes = -driven[20].tangential_force_y
    assert driven[20].drive_torque == close_to(pushes * RADIUS, rel=1e-12)


@pytest.mark.slow
def test_errors_against_carter_are_of_second_order_in_the_cells(driven):
    last = rolled(40, 5.0, tangential=pulled(0.64))[-1]
    assert creepage_error(last) < 3e-4
    assert creepage_error(last) < creepage_error(driven[20]) / 3


def test_stick_zone_lies_at_the_leading_edge_and_tractions_are_those_of_carter(driven):
    last = driven[20]
    y = (last.grid.y - last.position_y) / HALF
    touching, sticks = last.slip_state[0] > 0, last.slip_state[0] == 1
    # 2b = 2a sqrt(1 - Q/(μ W)), from the leading edge on.
    np.testing.assert_array_equal(sticks[touching], y[touching] > 1 - 2 * 0.6)
    # q = μ p0 [(1 - y²)^(1/2) - b/a (1 - ((y - d)/b)²)^(1/2)] with d = a - b.
    peak = 2 * LINE_LOAD / (math.pi * HALF)
    outer, inner = 1 - y**2, 1 - ((y - 0.4) / 0.6) ** 2
    exact = MU * peak * (np.sqrt(np.maximum(outer, 0)) - 0.6 * np.sqrt(np.maximum(inner, 0)))
    np.testing.assert_allclose(-last.traction_y[0], exact, atol=0.03 * MU * peak)


@pytest.mark.parametrize("creepage", [0.5 * FULL, -0.5 * FULL])
def test_body_that_drives_pushes_the_half_space_back_and_one_that_brakes_forth(creepage):
    last = rolled(8, 6.0, creepage=creepage)[-1]
    assert np.sign(last.tangential_force_y) == -np.sign(creepage)
    assert last.creepage == close_to(creepage, rel=1e-9)
    assert last.drive_torque * creepage > 0


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.4, 0.6])
def test_traction_over_creepage_is_that_of_carter(share):
    """Q/(μ W) = 1 - (1 - creepage R/(μ a))²; of a line contact after a way of 15 contact widths."""
    exact = 1 - (1 - share) ** 2
    found = [-rolled(c, 32.0, creepage=share * FULL)[-1].tangential_force_y for c in (10, 20)]
    errors = [abs(each / (MU * LINE_LOAD * exact) - 1) for each in found]
    assert errors[1] < 8e-4
    assert errors[1] < errors[0] / 3


def test_body_that_slides_all_over_carries_friction_times_force():
    last = rolled(8, 16.0, creepage=3 * FULL)[-1]
    assert last.slip_fraction == 1
    assert -last.tangential_force_y == close_to(MU * LINE_LOAD, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "relaxed"), [(1e-5, True), (20.0, False)])
def test_creeping_body_rolls_as_an_elastic_one_in_the_limits_of_speed(speed, relaxed):
    """Slowly as one of J(inf), fast as one of J(0), whose error falls with the speed."""
    instant, late = 0.25e-6, 0.5e-6  # of J(0) and what is added [1/Pa], in 1 s
    material = vc.Material(vc.CreepSeries(2 * instant, [2 * late], [1.0]), 0.5)
    half = half_width(instant + late if relaxed else instant)
    given = {"material": material, "half": half, "tangential": pulled(0.64)}
    exact = MU * half / RADIUS * (1 - math.sqrt(1 - 0.64))
    found = [rolled(16, 8.0, speed=each, **given)[-1].creepage for each in (speed, _beyond(speed))]
    errors = [abs(each / exact - 1) for each in found]
    assert errors[1] < 2e-3
    assert errors[1] < max(errors[0] / 5, 1.2e-3)


def _beyond(speed: float) -> float:
    return speed / 10 if speed < 1 else speed * 10


#: Creepages of 56 steps of a cell (in parts of 1000) after the shift at rest that CONTACT prints.
#: E. A. H. Vollebregt, CONTACT (repository eve70a/CONTACT, commit d431cdb, 2025), cases 2 to 57 of
#: `catt_to_cart.ref_out`: J. J. Kalker, Three-dimensional elastic bodies in rolling contact (1990),
#: section 5.2.2.5.
CATTANEO_TO_CARTER = {
    **{1: 1.824, 2: 1.882, 3: 1.955, 4: 2.050, 5: 2.140, 6: 2.221, 7: 2.334, 8: 2.428},
    **{9: 2.551, 10: 2.676, 11: 2.801, 12: 2.968, 13: 3.184, 14: 3.403, 15: 3.402},
    **{16: 3.334, 24: 3.062, 30: 3.101, 36: 3.105, 42: 3.099, 48: 3.101, 56: 3.101},
}


def cattaneo_to_carter(steps: int, cells: int = 28) -> list[vc.ContactState]:
    """Two equal balls of G = 1, ν = 0.28, that are pulled at rest and then roll along x."""
    modulus, force, mu, radius = 1.0, 0.4705, 0.4013, 0.5 / 0.002963
    cell = 7.0 / cells
    shape = cells + 9 + steps, cells + 5  # the axis at the centre of a cell
    size = shape[0] * cell, shape[1] * cell
    grid = vc.Grid(shape, size, centre=(steps * cell / 2, 0.0))
    body = vc.Material(vc.Elastic(modulus), 0.28)
    return list(
        vc.march(
            vc.Paraboloid(radius, radius),
            body,
            vc.step(force, **HELD),
            grid,
            [1.0 + step for step in range(steps + 1)],
            indenter_material=body,
            friction=mu,
            tangential=vc.TangentialHistory([1.0], force_x=-0.657 * mu * force),
            motion=vc.Travel([1.0, 1.0 + steps], x=[0.0, steps * cell], rolling=True),
            tolerance=1e-7,
        )
    )


@pytest.mark.parametrize("steps", [12, pytest.param(56, marks=pytest.mark.slow)])
def test_onset_of_rolling_has_the_creepages_of_contact(monkeypatch, steps):
    """All printed digits, with new cells held from the begin of their step, as they are there."""

    def held(contact: Any, before: Any, *given: Any, **options: Any) -> Any:
        return np.zeros((3, *before.gap.shape))

    monkeypatch.setattr(slip_step, "entry_compliance", held)
    states = cattaneo_to_carter(steps)
    assert np.count_nonzero(states[0].slip_state == 1) == 305
    assert np.count_nonzero(states[1].slip_state == 1) == 422
    for step, creepage in CATTANEO_TO_CARTER.items():
        if step <= steps:
            assert 1e3 * states[step].creepage == close_to(creepage, rel=3e-4), step
    if steps == 56:
        assert np.count_nonzero(states[-1].slip_state == 1) == 346


@pytest.mark.slow
def test_cells_that_enter_within_a_step_make_the_creepage_of_second_order():
    """Held from the begin of the step they leave an error of 2.5 % on these cells."""
    found = [cattaneo_to_carter(cells, cells)[-1].creepage for cells in (14, 28, 56)]
    assert abs(found[1] / found[2] - 1) < 1e-3
    assert abs(found[0] / found[2] - 1) < 4e-3


#: C11 of a circle at ν = 0, 0.25 and 0.5: J. J. Kalker (1990), table E.3, to three digits.
LONGITUDINAL = {0.0: 3.40, 0.25: 4.12, 0.5: 5.20}


def ball_rolled(
    ratio: float,
    *,
    cells: int,
    share: float,
    along: str = "y",
    way: float = 8.0,
    speed: float = 0.1,
) -> tuple[vc.ContactState, float]:
    """Two equal balls over a way of some radii, and G a² creepage."""
    radius, half, modulus = 0.01, 1e-3, 1e6
    compliance = (1 - ratio) / modulus  # of both
    force, creepage = 4 * half**3 / (3 * radius * compliance), share * MU * half / radius
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
            [0.0, times[-1]], **{along: [0.0, steps * cell]}, rolling=True, creepage=creepage
        ),
    )
    return last, modulus * half**2 * creepage


@pytest.mark.slow
@pytest.mark.parametrize("ratio", LONGITUDINAL)
def test_small_creepage_of_balls_has_the_coefficient_of_kalker(ratio):
    """Of first order in the slip: Q = C11 G a² creepage (1 - ...); extrapolated to none."""
    found = []
    for share in (0.02, 0.04):
        last, unit = ball_rolled(ratio, cells=24, share=share)
        found.append(-last.tangential_force_y / unit)
    assert 2 * found[0] - found[1] == close_to(LONGITUDINAL[ratio], rel=0.01)


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


#: A roller of one metal on a plane of another (mm, N, MPa): that of `bentall.inp` of CONTACT, with
#: the contact of Hertz 0.1 mm wide to both sides. (1 - 2ν) J/(2 (1 - ν)) differs by 0.1438 of J.
ALUMINIUM, IRON = (
    vc.Material(vc.Elastic(g), ratio) for g, ratio in ((23000.0, 0.31), (8.2e4, 0.28))
)
DISSIMILAR_FORCE, DISSIMILAR_RADIUS = 16.2019, 25.0


def dissimilar(
    cells: int,
    way: float,
    friction: float,
    part: float = 0.0,
    *,
    exchanged: bool = False,
    creepage: float | None = None,
) -> vc.ContactState:
    """Coupled bodies, rolling under a part of what friction carries or under a creepage."""
    cell = 0.2 / cells
    steps = round(way * cells / 2)
    count = cells + 16 + steps
    count += count % 2
    plane, roller = (ALUMINIUM, IRON) if exchanged else (IRON, ALUMINIUM)
    force_y = part * friction * DISSIMILAR_FORCE
    path = {"y": [0.0, steps * cell], "rolling": True, "creepage": creepage}
    *_, last = vc.march(
        vc.Paraboloid(math.inf, DISSIMILAR_RADIUS),
        plane,
        vc.step(DISSIMILAR_FORCE, **HELD),
        vc.Grid((1, count), (1.0, count * cell), (True, False), centre=(0.0, steps * cell / 2)),
        np.arange(steps + 1) * cell,
        indenter_material=roller,
        friction=friction,
        tangential=vc.tangential_step(force_y=force_y) if creepage is None else None,
        motion=vc.Travel([0.0, steps * cell], **path),
    )
    return last


def bufler() -> tuple[float, float]:
    """Creepage, and largest pressure over Hertz', of free rolling without slip.

    With f = p + i q the stick condition of a long roller is (1/π) ∫ f ds/(y - s) + i c f = (y/R -
    i ξ)/(2J), solved by f ~ (a - y)^(1/2 + i ε) (a + y)^(1/2 - i ε) with ε = ln((1 + c)/(1 - c))
    over 2π; H. Bufler, Ing.-Arch. 28 (1959) 157; K. L. Johnson (1985), section 8.2.
    """
    whole = [(1 - m.poisson_ratio) / (2 * g) for m, g in ((ALUMINIUM, 23000.0), (IRON, 8.2e4))]
    own = [
        (1 - 2 * m.poisson_ratio) / (2 * (1 - m.poisson_ratio)) * each
        for m, each in zip((ALUMINIUM, IRON), whole, strict=True)
    ]
    c = (own[0] - own[1]) / sum(whole)
    exponent = math.log((1 + c) / (1 - c)) / (2 * math.pi)
    hertz = math.sqrt(4 * DISSIMILAR_FORCE * DISSIMILAR_RADIUS * sum(whole) / math.pi)
    half = hertz / math.sqrt(1 + 4 * exponent**2)
    return 2 * exponent * half / DISSIMILAR_RADIUS, half


@pytest.mark.slow
def test_free_rolling_of_dissimilar_bodies_that_stick_has_the_creepage_of_bufler():
    """Without slip nothing is lost: there is no resistance."""
    exact, half = bufler()
    errors = []
    for cells in (10, 20):
        last = dissimilar(cells, 8.0, 10.0)
        errors.append(abs(last.creepage / exact - 1))
        assert last.slip_fraction == 0
        assert abs(last.resistance_y) < 1e-6 * DISSIMILAR_FORCE
    assert errors[1] < 2e-3
    assert errors[1] < errors[0] / 2.5
    assert last.contact_width / 2 == close_to(half, rel=1e-2)


def test_exchanged_bodies_creep_the_other_way():
    """The plane is the roller and the roller the plane: q and the creepage change their sign."""
    last, other = (dissimilar(8, 2.0, 0.05, exchanged=each) for each in (False, True))
    assert last.creepage == close_to(-other.creepage, rel=1e-6)
    assert last.peak_pressure == close_to(other.peak_pressure, rel=1e-5)
    assert last.slip_fraction == other.slip_fraction


#: CREEP X, PMAX and cells in adhesion of 200 by FX/FSTAT/FN, cases 4 to 6 of `bentall.ref_out`:
#: friction 0.05; R. H. Bentall and K. L. Johnson, Int. J. Mech. Sci. 9 (1967) 389.
BENTALL = {0.0: (4.294e-4, 103.6, 125), 0.75: (2.108e-4, 103.2, 36), -0.75: (5.392e-4, 103.3, None)}


@pytest.mark.slow
@pytest.mark.parametrize("part", BENTALL)
def test_dissimilar_rollers_have_the_creepages_of_contact(part):
    """The pressure feels the tractions: its resultant and that of the work are ahead or behind."""
    creepage, peak, sticking = BENTALL[part]
    last = dissimilar(40, 3.0, 0.05, part)
    assert last.creepage == close_to(creepage, rel=4e-3)
    assert last.peak_pressure == close_to(peak, rel=1e-3)
    if sticking is not None:
        assert 1 - last.slip_fraction == close_to(sticking / 200, abs=0.03)
    # What the drive and the resistance do is heat of friction.
    put_in = last.resistance_y - last.tangential_force_y * last.creepage
    assert last.friction_power == close_to(put_in, rel=1.5e-2)


@pytest.mark.slow
def test_bodies_with_next_to_no_friction_roll_freely_at_the_creepage_of_bentall_and_johnson():
    """All slips: in the middle, which carries half the load, forth, and back beside it.

    Pressure stretches the surfaces by 2 Δ(c J) p against each other: the creepage is that at
    |y| = 0.4040 a. CONTACT has 5.260e-4 (cases 1 and 2 of `bentall.ref_out`).
    """
    creepage = 2 * 2.7890e-6 * math.sqrt(1 - 0.4040**2) * 103.13
    assert creepage == close_to(5.260e-4, rel=1e-3)
    # A cell that turns round on both sides changes the force by a ninth of what friction carries.
    below, above = (
        dissimilar(40, 2.2, 1e-4, creepage=share * creepage).tangential_force_y
        for share in (0.97, 1.03)
    )
    carried = 1e-4 * DISSIMILAR_FORCE
    assert 0 < below < 0.2 * carried
    assert 0 > above > -0.25 * carried


@pytest.mark.slow
def test_work_of_a_ball_on_a_dissimilar_plane_is_heat_of_friction():
    """In three dimensions, of a drive under half of what friction carries; on 10 and 16 cells."""
    soft, hard = vc.Material(vc.Elastic(1e6), 0.3), vc.Material(vc.Elastic(5e6), 0.2)
    half, mu = 1e-3, 0.2
    force = 4 * half**3 / (3 * RADIUS * (0.7 / 2e6 + 0.8 / 10e6))
    errors = []
    for cells in (10, 16):
        cell, steps = 2 * half / cells, 2 * cells
        count = cells + 8 + steps
        size = (cells + 8) * cell, count * cell
        *_, last = vc.march(
            vc.Paraboloid(RADIUS, RADIUS),
            soft,
            vc.step(force, **HELD),
            vc.Grid((cells + 8, count), size, centre=(0.0, steps * cell / 2)),
            np.arange(steps + 1) * cell / 0.1,
            indenter_material=hard,
            friction=mu,
            tangential=vc.tangential_step(force_y=-0.5 * mu * force),
            motion=vc.Travel([0.0, steps * cell / 0.1], y=[0.0, steps * cell], rolling=True),
        )
        put_in = 0.1 * (last.resistance_y - last.tangential_force_y * last.creepage)
        errors.append(abs(last.friction_power / put_in - 1))
    assert errors[1] < 5e-3
    assert errors[1] < errors[0] / 1.8
