"""Rolling with traction against Carter, from rest and in creeping bodies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.rolling_bodies import (
    FULL,
    HALF,
    HELD,
    LINE_LOAD,
    MU,
    RADIUS,
    half_width,
    pulled,
    rolled,
)
from viscontact.simulation.transient import slip_step

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


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


@pytest.mark.slow
def test_a_roller_under_lateral_creepage_has_the_force_of_carter_in_antiplane_strain():
    """The line moves by 1/(1 - ν) times as much across: twice the creepage at ν = 1/2 (8.3)."""
    creepage, errors = 2 * FULL * (1 - math.sqrt(1 - 0.64)), []
    for cells in (10, 20, 40):
        last = rolled(cells, 40.0, creepage=0.0, lateral=creepage)[-1]
        assert last.tangential_force_y == close_to(0.0, abs=1e-6 * LINE_LOAD)
        errors.append(abs(last.tangential_force_x / (MU * LINE_LOAD) - 0.64))
    assert errors[2] < 2e-4
    assert errors[0] > 3 * errors[1] > 9 * errors[2]


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
        return np.zeros((3, *before.gap[options["cut"]].shape))

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
