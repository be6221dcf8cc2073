"""Bodies whose pressure and tractions are coupled, against exact solutions, limits and symmetry."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import convolve

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.halfspace.coupling_influence import coupling_coefficient
from viscontact.mechanics.halfspace.influence import influence_coefficient
from viscontact.simulation.transient import setup

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

MODULUS, FORCE = 1e6, 0.1
NO_PULL = vc.tangential_step(force_x=0.0)
#: No mirror planes.
NOWHERE = False, False
#: A coefficient under which nothing slips.
ROUGH = 9.0


def elastic(ratio: float, shear_modulus: float = MODULUS) -> vc.Material:
    return vc.Material(vc.Elastic(shear_modulus), ratio)


def pressed(body, material, load, grid, times=(1.0,), **given):
    given = {"tangential": NO_PULL, "friction": ROUGH} | given
    return list(vc.march(body, material, load, grid, list(times), **given))


def punch(cells: int, material: vc.Material, friction: vc.Friction, **given) -> vc.ContactState:
    grid = vc.Grid((cells, cells), (1.2e-3, 1.2e-3))
    return pressed(
        vc.FlatPunch(0.5e-3), material, vc.step(FORCE), grid, friction=friction, **given
    )[-1]


@pytest.mark.parametrize("ratio", [0.0, 0.3])
def test_a_punch_that_sticks_is_stiffer_after_mossakovski(ratio):
    """By (1 - ν) ln(3 - 4 ν)/(1 - 2 ν): Mossakovski 1954, Spence 1968; of first order in cells."""
    found = []
    for cells in (24, 48):
        sticks = punch(cells, elastic(ratio), vc.Friction(ROUGH))
        slides = punch(cells, elastic(ratio), vc.Friction(ROUGH, coupling=False))
        assert sticks.slip_fraction == 0.0
        found.append(slides.approach / sticks.approach)
    exact = (1 - ratio) * np.log(3 - 4 * ratio) / (1 - 2 * ratio)
    assert 2 * found[1] - found[0] == close_to(exact, rel=2e-4)


def test_a_line_punch_that_sticks_has_the_pressure_of_muskhelishvili():
    """p(0) = 2 (1 - ν)/(3 - 4 ν)^(1/2) W/(π a) (Johnson 1985, eq. 2.69)."""
    ratio, half, found = 0.0, 1e-3, []
    for cells in (40, 80):
        edge = 2 * half / cells
        grid = vc.Grid((1, cells + 10), (1e-3, (cells + 10) * edge), periodic=(True, False))
        body = vc.FlatPunch(half_length=1.0, half_width=half)
        (state,) = pressed(body, elastic(ratio), vc.step(FORCE), grid)
        mean = FORCE / (1e-3 * np.pi * half)
        middle = (cells + 10) // 2
        found.append(state.pressure[0, middle - 1 : middle + 1].mean() / mean)
        assert state.traction_y[0, middle] == close_to(-state.traction_y[0, middle - 1], rel=1e-4)
    exact = 2 * (1 - ratio) / np.sqrt(3 - 4 * ratio)
    assert 2 * found[1] - found[0] == close_to(exact, rel=1e-3)


def test_punch_and_sphere_stick_within_the_same_part_after_spence():
    """Whatever the profile, of a load that grows: Spence 1975."""
    ratio, mu, steps = 0.3, 0.15, 12
    flat = punch(36, elastic(ratio), vc.Friction(mu))
    stick = np.sqrt(1 - flat.slip_fraction)
    radius = (0.75 * FORCE * 1e-2 * (1 - ratio) / (2 * MODULUS)) ** (1 / 3)
    grid = vc.Grid((36, 36), (2.3 * radius, 2.3 * radius))
    parts = np.arange(1, steps + 1) / steps
    load = vc.ForceHistory([0, *parts], [0, *FORCE * parts**3])
    sphere = pressed(vc.Paraboloid(1e-2, 1e-2), elastic(ratio), load, grid, parts, friction=mu)
    # To a cell: 0.502, 0.494 on 128 cells and 32 steps with mu/β alike.
    assert np.sqrt(1 - sphere[-1].slip_fraction) == close_to(stick, rel=0.06)


def test_tractions_under_pressure_alone_are_radial_and_outward():
    """The rigid body hinders the surface from moving inwards."""
    state = punch(32, elastic(0.2), vc.Friction(0.3))
    x = state.traction_x
    np.testing.assert_allclose(x, -x[::-1], atol=1e-4 * x.max())
    np.testing.assert_allclose(state.traction_y, x.T, atol=1e-4 * x.max())
    outward = x * np.sign(np.arange(32) - 15.5)[:, None]
    assert (outward[state.in_contact] > -1e-6 * x.max()).all()


def test_roles_of_the_bodies_can_be_exchanged():
    """Pressure and tractions of A on B are those of B on A, mirrored."""
    soft, hard = elastic(0.1), elastic(0.4, 3e6)
    one = punch(24, soft, vc.Friction(0.2), indenter_material=hard)
    other = punch(24, hard, vc.Friction(0.2), indenter_material=soft)
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=1e-4)
    np.testing.assert_allclose(one.traction_x, -other.traction_x, atol=1e-4 * one.peak_pressure)


def test_a_body_that_creeps_ends_as_the_elastic_one_of_its_late_modulus():
    """A punch that sticks is linear: its p and q do not change, its approach follows J(t)."""
    law = vc.Zener(MODULUS, 0.5 * MODULUS, MODULUS)
    grid = vc.Grid((24, 24), (1.2e-3, 1.2e-3))
    body = vc.FlatPunch(0.5e-3)
    first, last = pressed(body, vc.Material(law, 0.3), vc.step(FORCE), grid, [0.0, 60.0])
    np.testing.assert_allclose(last.traction_x, first.traction_x, atol=1e-5 * first.peak_pressure)
    creep = float(law(60.0) / law(0.0))
    assert last.approach / first.approach == close_to(creep, rel=1e-5)


def test_bodies_that_creep_differently_end_as_the_elastic_ones():
    """Of a punch that sticks: the final values do not depend on the way of the creep."""
    creeping = vc.Zener(MODULUS, 0.5 * MODULUS, MODULUS)
    late = vc.Elastic(0.5 / float(creeping(1e4)))
    grid = vc.Grid((24, 24), (1.2e-3, 1.2e-3))
    states = [
        pressed(
            vc.FlatPunch(0.5e-3),
            vc.Material(law, 0.1),
            vc.step(FORCE),
            grid,
            [0.0, 2.0, 1e3],
            indenter_material=elastic(0.45),
        )[-1]
        for law in (creeping, late)
    ]
    scale = states[1].peak_pressure
    np.testing.assert_allclose(states[0].traction_x, states[1].traction_x, atol=1e-4 * scale)
    assert states[0].approach == close_to(states[1].approach, rel=1e-5)


def test_an_elastic_bulk_modulus_couples_as_its_instant_poisson_ratio():
    """At a jump the body is elastic, of the shear modulus at once."""
    bulk = 2e6
    law = vc.Zener(MODULUS, 0.5 * MODULUS, MODULUS)
    shear = 0.5 / float(law(0.0))
    ratio = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
    grid = vc.Grid((24, 24), (1.2e-3, 1.2e-3))
    states = [
        pressed(vc.FlatPunch(0.5e-3), each, vc.step(FORCE), grid, [0.0], friction=0.2)[0]
        for each in (vc.Material(law, bulk_modulus=bulk), elastic(ratio, shear))
    ]
    np.testing.assert_allclose(
        states[0].traction_x, states[1].traction_x, atol=1e-5 * states[1].peak_pressure
    )


def test_pull_after_pressing_balances_the_force():
    tangential = vc.TangentialHistory([0, 1, 2, 3], force_x=[0, 0, 0.02, -0.01])
    states = pressed(
        vc.Sphere(1e-2),
        elastic(0.2),
        vc.ForceHistory([0, 1], [0, FORCE]),
        vc.Grid((28, 28), (3e-3, 3e-3)),
        [0.25, 0.5, 0.75, 1, 1.5, 2, 2.5, 3],
        friction=0.3,
        tangential=tangential,
    )
    for state, force in zip(states, [0, 0, 0, 0, 0.01, 0.02, 0.005, -0.01], strict=True):
        assert state.tangential_force_x == close_to(force, abs=1e-8)
        assert state.duality_gap < 1e-6
        size = np.hypot(state.traction_x, state.traction_y)
        assert (size <= 0.3 * state.pressure * (1 + 1e-9)).all()
    # The traction lifts the surface behind it and lowers that ahead.
    odd = [np.abs(states[k].pressure - states[k].pressure[::-1]).max() for k in (3, 5)]
    assert odd[1] > 0.01 * states[5].peak_pressure > 1e3 * odd[0]


@pytest.mark.parametrize(
    "along", [{"force_x": 0.01}, {"force_y": 0.01}, {}, {"displacement_x": 1e-6}]
)
def test_a_mirror_plane_changes_nothing_but_the_time(along, monkeypatch):
    """All cells, one half, and one quarter under pressure alone."""
    creeping = vc.Material(vc.Zener(MODULUS, 0.5 * MODULUS, MODULUS), 0.2)
    pull = vc.TangentialHistory([1, 2], **{name: [0, last] for name, last in along.items()})

    def marched():
        return pressed(
            *(vc.Sphere(1e-2), creeping, vc.ForceHistory([0, 1], [0.5 * FORCE, FORCE])),
            *(vc.Grid((20, 24), (3e-3, 3e-3)), [0.0, 0.5, 1, 1.5, 2]),
            **{"friction": 0.3, "tangential": pull, "tolerance": 1e-8},
        )

    mirrored, loads = marched(), []
    whole_of = setup._even
    monkeypatch.setattr(setup, "_even", lambda *what: loads.append(whole_of(*what)) or NOWHERE)
    whole = marched()
    assert loads[0] == (
        "force_x" not in along and "displacement_x" not in along,
        "force_y" not in along,
    )
    scale = whole[-1].peak_pressure
    for one, other in zip(mirrored, whole, strict=True):
        for name in ("pressure", "traction_x", "traction_y"):
            np.testing.assert_allclose(
                getattr(one, name), getattr(other, name), atol=1e-5 * scale, err_msg=name
            )
        np.testing.assert_allclose(one.displacement, other.displacement, rtol=1e-6)
        assert one.approach == close_to(other.approach, rel=1e-7)
        # Slip is known to the tolerance times the displacement, in each of five steps.
        lost = 5e-8 * 0.3 * FORCE * other.approach
        assert one.friction_heat == close_to(other.friction_heat, rel=1e-6, abs=lost)
        assert one.tangential_displacement_x == close_to(
            other.tangential_displacement_x, rel=1e-5, abs=1e-6 * other.approach
        )


def test_an_oblique_push_is_warned_of_where_coupling_is_neglected_only():
    material, grid = elastic(0.2), vc.Grid((12, 12), (1.2e-3, 1.2e-3))
    for coupling in (True, False):
        friction = vc.Friction(0.3, coupling=coupling)
        (state,) = pressed(
            vc.FlatPunch(0.5e-3), material, vc.step(FORCE), grid, [0.0], friction=friction
        )
        assert any("is neglected" in text for text in state.warnings) is not coupling


@pytest.mark.parametrize("body", [vc.Sphere(1e-2), vc.FlatPunch(0.5e-3)])
def test_a_contact_that_grows_at_once_is_warned_of(body):
    """The stick radius of a sphere depends on the steps, that of a punch does not (Spence 1975)."""
    found, grid = [], vc.Grid((28, 28), (1.8e-3, 1.8e-3))
    for steps in (1, 16):
        parts = np.arange(1, steps + 1) / steps
        load = vc.ForceHistory([0, *parts], [0, *FORCE * parts**3])
        given = {"friction": 0.15, "tangential": NO_PULL, "errors": False, "fields": "none"}
        ds = vc.simulate(body, elastic(0.3), load, grid, parts, **given)
        warned = "the contact of dissimilar bodies grows" in "".join(ds.attrs["warnings"])
        found.append((warned, float(np.sqrt(1 - ds.slip_fraction[-1]))))
    grows = isinstance(body, vc.Sphere)
    assert [warned for warned, _ in found] == [grows, False]
    differs = abs(found[0][1] / found[1][1] - 1) > 0.05
    assert differs == grows


def test_tractions_meet_a_tight_tolerance_by_direct_sums():
    """The gap by the closed forms of all cells (Johnson 1985, eqs. 3.25 and 3.75c)."""
    grid, ratio, tolerance = vc.Grid((32, 32), (4e-3, 4e-3)), 0.2, 1e-10
    ball, load = vc.Sphere(1e-2), vc.ForceHistory([0, 0.5], [0, FORCE])
    pull = vc.TangentialHistory([0.5, 1], force_x=[0, 0.02])
    given = {"friction": 0.3, "tangential": pull, "tolerance": tolerance}
    states = pressed(ball, elastic(ratio), load, grid, [0.5, 1.0], **given)
    x, y = (np.arange(1 - n, n) * edge for n, edge in zip(grid.shape, grid.cell_size, strict=True))
    x, y, size = x[:, None], y[None, :], grid.cell_size
    kernels = (
        (1 - ratio) / (2 * MODULUS) * influence_coefficient(x, y, size),
        (1 - 2 * ratio) / (4 * MODULUS) * coupling_coefficient(x, y, size),
        (1 - 2 * ratio) / (4 * MODULUS) * coupling_coefficient(y.T, x.T, size[::-1]).T,
    )
    across, along = np.meshgrid(grid.y, grid.x)
    profile = ball.radius - np.sqrt(ball.radius**2 - along**2 - across**2)
    assert len(states) == 2
    for state in states:
        fields = state.pressure, state.traction_x, state.traction_y
        moved, by_x, by_y = (
            convolve(field, kernel, "valid", "direct")
            for field, kernel in zip(fields, kernels, strict=True)
        )
        assert np.abs(by_x).max() > 0.01 * moved.max()
        touching = state.pressure > 0
        gap = (profile + moved + by_x + by_y)[touching]
        # Without moments the body tilts as it may.
        planes = np.stack([np.ones(gap.shape), along[touching], across[touching]], axis=1)
        gap -= planes @ np.linalg.lstsq(planes, gap, rcond=None)[0]
        assert np.abs(gap).max() <= 1.1 * tolerance * moved.max()
