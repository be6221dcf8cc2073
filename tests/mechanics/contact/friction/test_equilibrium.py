"""Tractions under friction, with given pressures, against exact solutions and laws."""

import numpy as np
import pytest

from closeness import close_to
from mechanics.contact.friction.fixtures import (
    COMPLIANCE,
    CONTACT,
    FORCE,
    FRICTION,
    PEAK,
    hertz,
    shear_block,
    solved,
    under,
)
from viscontact.bodies.grid import Grid

LIMIT = FRICTION * FORCE


def cattaneo_mindlin(force, nu=0.0):
    """Stick radius over that of contact, and shift: Johnson 1985, eqs. 7.40 and 7.42."""
    left = 1 - force / LIMIT
    shift = 3 * LIMIT / (16 * CONTACT) * (2 - nu) * 2 * COMPLIANCE / (1 - nu)
    return left ** (1 / 3), shift * (1 - left ** (2 / 3))


@pytest.mark.parametrize("force", [0.75, 1.5, 2.4])
def test_a_sphere_shifts_after_cattaneo_and_mindlin_with_second_order(force):
    """Exact for ν = 0, where traction and slip have one direction."""
    errors = []
    for cells in (12, 24, 48):
        grid, pressure = hertz(cells)
        found = solved(shear_block(grid, 0.0), pressure, under((force, 0.0, 0.0)))
        assert found.converged
        assert found.duality_gap < 1e-8
        assert np.abs(found.traction[1]).max() < 1e-6 * PEAK
        errors.append(found.motion[0] / cattaneo_mindlin(force)[1] - 1)
    # Second order over two halvings; the stick radius jumps by cells.
    assert abs(errors[-1]) < 1.5e-3
    assert abs(errors[0] / errors[2]) > 8


def test_stick_zone_and_traction_of_a_sphere():
    """q = μ p - μ p of the stick zone (Johnson 1985, eq. 7.41)."""
    grid, pressure = hertz(48)
    force = 1.5
    found = solved(shear_block(grid, 0.0), pressure, under((force, 0.0, 0.0)))
    ratio = cattaneo_mindlin(force)[0]
    stuck = np.count_nonzero(found.state == 1) * grid.cell_area
    assert np.sqrt(stuck / np.pi) / CONTACT == close_to(ratio, rel=0.015)
    inside = np.hypot(grid.x[:, None], grid.y[None, :]) / CONTACT
    stick_part = PEAK * np.sqrt(np.maximum(ratio**2 - inside**2, 0))
    expected = FRICTION * (pressure - stick_part)
    # Largest beside the kink at the stick radius.
    assert np.abs(found.traction[0] - expected).max() < 0.03 * FRICTION * PEAK


def test_a_cylinder_shifts_no_datum_and_sticks_after_cattaneo():
    """Line contact: c/a = (1 - Q/(μ W))^(1/2) (Johnson 1985, eq. 7.30), between cell counts."""
    cells = 200
    edge = 2 * CONTACT / cells
    grid = Grid((1, cells + 4), (1.0, (cells + 4) * edge), periodic=(True, False))
    corners = np.clip((grid.y[:, None] + np.array([-edge / 2, edge / 2])) / CONTACT, -1, 1)
    primitive = (corners * np.sqrt(1 - corners**2) + np.arcsin(corners)) / 2
    pressure = (np.diff(primitive, axis=1)[:, 0] * CONTACT / edge)[None, :]
    total = float(pressure.sum()) * grid.cell_area
    block = shear_block(grid, 0.5)
    for part in (0.2, 0.5, 0.9):
        force = part * FRICTION * total
        found = solved(block, pressure, under((0.0, force, 0.0), (None, None, 0.0)))
        assert found.converged
        width = np.count_nonzero(found.state == 1) * edge / (2 * CONTACT)
        assert width == close_to(np.sqrt(1 - part), abs=1.5 / cells)


def test_full_sliding_under_a_large_shift():
    """Far beyond the limit all of the contact slides, against the shift, with μ p."""
    grid, pressure = hertz(24)
    block = shear_block(grid, 1.0)
    way = 100 * cattaneo_mindlin(LIMIT, 0.5)[1]
    found = solved(block, pressure, under(motions=(way, 0.0, 0.0)))
    assert found.converged
    forces = block.shift.resultants(found.traction)
    assert forces == close_to([LIMIT, 0.0, 0.0], rel=1e-4, abs=1e-8)
    touching = pressure > 0
    assert (found.state[touching] == 2).all()
    np.testing.assert_allclose(found.slip[0][touching], -way, rtol=0.02)


def test_a_force_beyond_friction_is_not_met():
    grid, pressure = hertz(12)
    found = solved(shear_block(grid, 0.0), pressure, under((1.001 * LIMIT, 0.0, 0.0)))
    assert not found.converged


def test_a_torque_beyond_friction_is_not_met():
    """Lubkin 1951: a sphere slides at 3π/16 μ W a."""
    grid, pressure = hertz(24)
    block = shear_block(grid, 0.0)
    most = 3 * np.pi / 16 * LIMIT * CONTACT
    assert solved(block, pressure, under((0.0, 0.0, 0.99 * most))).converged
    assert not solved(block, pressure, under((0.0, 0.0, 1.01 * most))).converged


def test_turned_loads_turn_the_solution():
    grid, pressure = hertz(16)
    block = shear_block(grid, 0.6)
    one = solved(block, pressure, under((1.2, 0.0, 0.0)))
    other = solved(block, pressure, under((0.0, 1.2, 0.0)))
    np.testing.assert_allclose(other.traction[1], one.traction[0].T, atol=1e-6 * PEAK)
    assert other.motion[1] == close_to(one.motion[0], rel=1e-6)


def test_a_sphere_under_shear_has_traction_across_unless_nu_is_zero():
    """A tenth of the traction along the force at ν = 1/2: even and odd across both axes."""
    grid, pressure = hertz(24)
    found = solved(shear_block(grid, 1.0), pressure, under((1.5, 0.0, 0.0)))
    along, across = found.traction
    for axis in (0, 1):
        np.testing.assert_allclose(along, np.flip(along, axis), atol=1e-5 * PEAK)
        np.testing.assert_allclose(across, -np.flip(across, axis), atol=1e-5 * PEAK)
    assert 0.03 < np.abs(across).max() / np.abs(along).max() < 0.2


def test_a_small_force_holds_all_but_the_rim():
    """Mindlin 1949: the shift of full stick, (2 - ν)/(8 a G) Q."""
    nu, errors = 0.3, []
    for cells in (16, 32):
        grid, pressure = hertz(cells)
        constraints = under((1e-3 * LIMIT, 0.0, 0.0))
        found = solved(shear_block(grid, nu / (1 - nu)), pressure, constraints)
        full = (2 - nu) / (8 * CONTACT) * 2 * COMPLIANCE / (1 - nu) * 1e-3 * LIMIT
        errors.append(found.motion[0] / full - 1)
    # Of first order, as the traction of full stick is singular at the rim.
    assert abs(errors[1]) < 0.03
    assert 1.6 < errors[0] / errors[1] < 2.5


def test_cells_under_a_pressure_of_rounding_carry_nothing():
    """Rim cells at 1e-17 of the pressure, which might stick or slip, do not stop the search."""
    grid, pressure = hertz(24)
    block, rim = shear_block(grid, 0.26), (pressure == 0) & (np.roll(pressure, 1, 0) > 0)
    touched = np.where(rim, 1e-17 * PEAK, pressure)
    before = solved(block, pressure, under((0.8 * LIMIT, 0.0, 0.0))).traction
    for force in (-0.05, 0.3):
        constraints = under((force * LIMIT, 0.0, 0.0))
        found = solved(block, touched, constraints, before=before, tolerance=1e-6)
        assert found.converged
        assert found.iterations < 40
        assert not found.state[rim].any()
        without = solved(block, pressure, constraints, before=before, tolerance=1e-6)
        np.testing.assert_allclose(found.traction, without.traction, atol=1e-5 * PEAK)


def test_earlier_tractions_count_as_their_displacement():
    """Linearity: J T (q + e) is J T q and the displacement by e; on the way back from 0.8 μ W."""
    grid, pressure = hertz(24)
    block, constraints = shear_block(grid, 0.6), under((-0.3 * LIMIT, 0.2 * LIMIT, 0.0))
    before = solved(block, pressure, under((0.8 * LIMIT, 0.0, 0.0))).traction
    moved = solved(block, pressure, constraints, before=before)
    loaded = solved(block, pressure, constraints, before=before, as_loads=True)
    assert loaded.converged
    np.testing.assert_allclose(loaded.traction, moved.traction, atol=1e-6 * PEAK)
    assert loaded.motion == close_to(moved.motion, rel=1e-6, abs=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_random_steps_follow_coulombs_law(seed):
    """Steps of force, torque and shift: the law in each cell, balances, and a small duality gap."""
    random = np.random.default_rng(seed)
    grid, pressure = hertz(int(random.integers(8, 24)), samples=2)
    block = shear_block(grid, random.uniform(0, 1))
    scale = cattaneo_mindlin(LIMIT)[1]
    before = None
    for _ in range(4):
        angle, part = random.uniform(0, 2 * np.pi), random.choice([0.1, 0.5, 0.95])
        forces = LIMIT * part * np.array([np.cos(angle), np.sin(angle)])
        torque = 0.3 * (1 - part) * LIMIT * CONTACT * random.uniform(-1, 1)
        way = scale * random.normal() * random.choice([0.1, 1.0, 10.0])
        constraints = [
            under((*forces, torque)),
            under(motions=(way, -way / 2, way / CONTACT)),
            under((0.0, 0.5 * forces[1], 0.0), (way, None, 0.0)),
        ][random.integers(3)]
        found = solved(block, pressure, constraints, before=before, tolerance=1e-6)
        assert found.converged
        assert found.duality_gap < 1e-5
        size = np.hypot(*found.traction)
        assert (size <= FRICTION * pressure * (1 + 1e-12)).all()
        slips = found.state == 2
        power = (found.slip * found.traction).sum(axis=0)[slips]
        lost = (FRICTION * pressure * np.hypot(*found.slip))[slips]
        assert np.abs(power + lost).max(initial=0.0) <= 1e-4 * lost.max(initial=1.0)
        missing = constraints.lacking(block.shift.resultants(found.traction))
        assert np.abs(missing).max() < 1e-8 * LIMIT
        before = found.traction


@pytest.mark.parametrize("left", [1e-3, 1e-8])
def test_rough_contacts_close_to_full_sliding_are_solved(left):
    """Held under a pressure that changes: next to no cell tells the motion. Seeds 0 to 7."""
    grid = Grid((24, 24), (1.0, 1.0), periodic=(True, True))
    block, force = shear_block(grid, 0.4), LIMIT * (1 - left)
    constraints = under((force, 0.0, 0.0), (None, None, 0.0))
    for seed in range(8):
        random, traction = np.random.default_rng(seed), None
        heights = random.normal(size=grid.shape)
        for change in (0.0, 0.1):
            changed = heights + change * random.normal(size=grid.shape)
            pressure = np.where(heights > 0, np.maximum(changed, 0), 0.0)
            pressure *= FORCE / (pressure.sum() * grid.cell_area)
            found = solved(block, pressure, constraints, before=traction, tolerance=1e-6)
            traction = found.traction
            assert found.converged
            assert traction[0].sum() * grid.cell_area == close_to(force, rel=1e-9)
            assert found.duality_gap < 1e-6
            # Exactly full sliding has q = (μ p, 0); what is left turns or shortens them.
            turned = FRICTION * pressure - traction[0]
            assert turned.sum() * grid.cell_area == close_to(left * LIMIT, abs=1e-9 * LIMIT)
            assert (turned >= -1e-9 * pressure).all()
