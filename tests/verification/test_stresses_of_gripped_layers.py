"""Stresses inside layers under friction, of whole results: half-spaces, thin covers, statics."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

RADIUS, MU, GSHEAR = 0.01, 0.3, 400e6
OWN = vc.Material(vc.Elastic(GSHEAR), 0.3)
UNCOUPLED = vc.Friction(MU, coupling=False)


def pulled(body, grid=None, **given):
    """A ball that is pressed, then pulled by half of what friction carries."""
    options = {"friction": UNCOUPLED, "indenter_material": None} | given
    return vc.simulate(
        *(vc.Paraboloid(RADIUS, RADIUS), body, vc.step(10.0)),
        grid or vc.Grid((32, 32), (1.1e-3, 1.1e-3)),
        [0.0, 1.0],
        tangential=vc.TangentialHistory([1.0], force_x=[0.5 * MU * 10.0]),
        errors=False,
        **options,
    )


def test_layers_of_one_material_have_the_stresses_of_its_half_space():
    layers = vc.Layered([vc.Layer(1e-4, OWN), vc.Layer(3e-4, OWN)], base=OWN)
    depths = np.linspace(2e-5, 1e-3, 12)
    one, other = (vc.section_stresses(pulled(body), depths) for body in (OWN, layers))
    assert abs(float(one.stress_xz.isel(time=1).mean())) > 0
    for name in ("stress_xx", "stress_zz", "stress_xz", "von_mises"):
        size = float(np.abs(one[name]).max())
        np.testing.assert_allclose(other[name].values, one[name].values, atol=1e-4 * size)


def test_the_bond_of_a_cover_carries_the_tangential_force():
    thickness = 2e-4
    grid = vc.Grid((96, 96), (4e-3, 4e-3))
    ds = pulled(vc.Layered([vc.Layer(thickness, OWN)], base="rigid"), grid)
    bond = vc.interface_stresses(ds).isel(interface=0)
    area = grid.cell_area
    for time, force in ((0, 0.0), (1, 0.5 * MU * 10.0)):
        carried = float(bond.interface_shear_stress_x[time].sum()) * area
        # The traction on the surface is -q of what is below it; a little lies beyond the grid.
        assert -carried == close_to(force, abs=0.01)
        pressed = float(bond.interface_normal_stress[time].sum()) * area
        assert -pressed == close_to(10.0, rel=5e-3)


def test_two_bodies_pull_at_each_other_with_opposite_tractions():
    like = vc.Layered([vc.Layer(2e-4, OWN)], base=OWN)
    ds = pulled(like, indenter_material=like, friction=MU)
    depths = np.array([1e-4, 3e-4])
    below, above = (
        vc.section_stresses(ds, depths, body=body, times=[1.0]).isel(time=0)
        for body in ("material", "indenter_material")
    )
    size = float(np.abs(below.stress_xz).max())
    assert size > 1e5
    # Mirrored at x = 0: pressure has the same stresses on both sides, traction the opposite ones.
    mirrored = -below.stress_xz.values[:, ::-1]
    np.testing.assert_allclose(above.stress_xz.values, mirrored, atol=2e-3 * size)


def test_layers_that_creep_differently_carry_a_uniform_traction_in_all_depths():
    soft = vc.Material(vc.CreepSeries(5e-9, [2e-8], [1.0]), 0.45)
    hard = vc.Material(vc.CreepSeries(1e-9, [4e-9], [30.0]), 0.3)
    body = vc.Layered([vc.Layer(1e-3, soft), vc.Layer(2e-3, hard)], base="rigid")
    grid = vc.Grid((4, 4), (1e-2, 1e-2), periodic=(True, True))
    ds = vc.simulate(
        *(vc.HeightMap(grid.x, grid.y, np.zeros((4, 4))), body, vc.step(200.0), grid),
        [0.0, 0.5, 2.0, 20.0],
        friction=1.0,
        tangential=vc.tangential_step(force_x=50.0),
        errors=False,
    )
    inside = vc.section_stresses(ds, [1e-4, 1.5e-3, 2.9e-3])
    np.testing.assert_allclose(inside.stress_xz.values, -50.0 / 1e-4, rtol=1e-6)
    np.testing.assert_allclose(inside.stress_zz.values, -200.0 / 1e-4, rtol=1e-6)


def test_a_driven_cover_is_sheared_at_its_bond_by_the_traction():
    body = vc.Layered([vc.Layer(1e-5, OWN)], base="rigid")
    grid = vc.Grid((1, 160), (1.0, 6e-4), periodic=(True, False))
    ds = vc.steady(
        *(vc.Paraboloid(np.inf, RADIUS), body, vc.step(3e4, tilt_y=0.0), 0.1),
        grid=grid,
        friction=UNCOUPLED,
        creepage=[0.002, 0.02],
        errors=False,
    )
    with pytest.raises(ValueError, match="over several creepages; choose one"):
        vc.section_stresses(ds)
    found, tractions = [], []
    for place in (0, 1):
        one = ds.isel(creepage=place)
        bond = vc.interface_stresses(one).interface_shear_stress_y.isel(time=0, interface=0, x=0)
        total = float(bond.sum()) * grid.cell_size[1]
        assert total == close_to(-float(one.tangential_force_y[0]), rel=1e-3)
        found.append(bond.values)
        tractions.append(one.traction_y.values[0, 0])
    # What one creepage adds to the other passes through, to the square of the thickness over the
    # half width, 0.5 % here, times a curvature of some units.
    more, below = tractions[1] - tractions[0], found[1] - found[0]
    middle = np.abs(ds.y.values) < 0.4 * float(ds.contact_width[0]) / 2
    np.testing.assert_allclose(below[middle], -more[middle], atol=0.03 * np.abs(more).max())


def test_a_traction_that_jumps_stresses_creeping_layers_from_then_on():
    soft = vc.Material(vc.CreepSeries(5e-9, [2e-8], [1.0]), 0.45)
    hard = vc.Material(vc.CreepSeries(1e-9, [4e-9], [30.0]), 0.3)
    body = vc.Layered([vc.Layer(2e-4, soft), vc.Layer(3e-4, hard)], base="rigid")
    pull = vc.TangentialHistory([0.0, 5.0, 5.0, 20.0], force_x=[0.0, 0.0, 0.5, 0.5])

    def stresses(times):
        ds = vc.simulate(
            *(vc.Paraboloid(RADIUS, RADIUS), body, vc.step(2.0)),
            *(vc.Grid((24, 24), (1.4e-3, 1.4e-3)), times),
            friction=UNCOUPLED,
            tangential=pull,
            errors=False,
        )
        return vc.section_stresses(ds, [1e-4, 3e-4], times=[6.0]).isel(time=0)

    # The step over the jump is as long as it likes.
    long, short = stresses([0.0, 4.0, 6.0]), stresses([0.0, 4.0, 4.999, 5.0, 5.001, 5.5, 6.0])
    for name in ("stress_xx", "stress_xz"):
        size = float(np.abs(short[name]).max())
        np.testing.assert_allclose(long[name].values, short[name].values, atol=0.02 * size)
