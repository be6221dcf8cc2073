"""Peak pressure of a growing contact on cells: strips, their history, and the cells chosen."""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing import mesh_choice
from viscontact.simulation.meshing.contact_extent import (
    contacts_of_history,
    largest_compliance,
)
from viscontact.simulation.meshing.creeping_peak import contact_growth
from viscontact.simulation.meshing.strip_contact import mean_pressure, strip_contact

BALL = vc.Paraboloid(0.01, 0.01)
QUANTITIES = ("peak_pressure", "contact_area", "approach")

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def relaxing(ratio, time=1.0):
    """A body whose modulus relaxes by a ratio within a time [s]."""
    return vc.Material(vc.RelaxationSeries(1e9 / ratio, [1e9 - 1e9 / ratio], [time]), 0.5)


def growth_of(indenter, material, load, end):
    compliance = material.contact_compliance()
    (*_, largest) = sorted(
        contacts_of_history(indenter, largest_compliance(compliance, end), load, end),
        key=lambda each: each.point.level,
    )
    return contact_growth(indenter, compliance, load, end, largest)


def chosen(material, load, end, tolerance=0.01, indenter=BALL):
    request = vc.AutomaticGrid(tolerance)
    problem = Problem(indenter, material, load, request, [0.0, end])
    return mesh_choice.choose_mesh(problem, end)


def test_pressure_of_strips_converges_to_hertzs():
    """p = sqrt(a² - x²) (Johnson 1985, eq. 4.45), its mean over the strip in the middle."""
    errors = []
    for strips in (16, 32, 64, 128):
        half_width = 0.8 * strips
        found = strip_contact(strips).pressure(half_width)
        exact = mean_pressure(half_width, np.arange(2.0))[0]
        errors.append(abs(found[0] / half_width - exact))
        # The force is Hertz's.
        assert 2 * found.sum() == close_to(math.pi * half_width**2 / 2, rel=1e-12)
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders > 0.9).all()
    assert errors[-1] < 1e-4


@pytest.mark.parametrize(
    ("indenter", "load", "exponents"),
    [
        # Hertz: a ~ S^(1/3), p ~ S^(1/3); under an approach a ~ d^(1/2).
        (BALL, vc.ramp(10.0, 5.0), (1 / 3, 1 / 3, 1 / 3)),
        (vc.Paraboloid(0.1, 0.01), vc.ramp(10.0, 5.0), (1 / 3, 1 / 3, 1 / 3)),
        (BALL, vc.ramp(approach=1e-5, duration=5.0), (1 / 2, 1 / 2, 1 / 2)),
        # A flat punch has its contact from the start; its pressure has no limit.
        (vc.FlatPunch(0.01), vc.ramp(10.0, 5.0), (0.0, 0.0, None)),
    ],
)
def test_contact_grows_with_the_power_of_theory(indenter, load, exponents):
    growth = growth_of(indenter, relaxing(10.0), load, 30.0)
    # The estimates are made on 48 cells; measured: within 0.005.
    found = [*growth.extents, None if exponents[2] is None else growth.peak]
    assert found == close_to(exponents, abs=0.02)


def test_error_depends_on_ratios_of_times_only():
    cells = [30.0, 60.0, 120.0]
    slow = growth_of(BALL, relaxing(10.0), vc.ramp(10.0, 5.0), 30.0).peak_errors(0, cells)
    fast = growth_of(BALL, relaxing(10.0, 1e-6), vc.ramp(10.0, 5e-6), 3e-5).peak_errors(0, cells)
    np.testing.assert_allclose(fast, slow, rtol=1e-6)


@pytest.mark.parametrize("material", [vc.Material(vc.Elastic(1e9), 0.5), relaxing(1.05)])
def test_bodies_that_hardly_creep_have_no_ring(material):
    assert growth_of(BALL, material, vc.ramp(10.0, 5.0), 30.0) is None


@pytest.mark.parametrize(
    ("indenter", "material", "load"),
    [
        (BALL, vc.Material(vc.Elastic(1e9), 0.5), vc.ramp(10.0, 5.0)),
        (BALL, relaxing(2.0), vc.ramp(10.0, 5.0)),  # creeps, but its ring is resolved
        (BALL, relaxing(100.0), vc.step(10.0)),  # out of reach
        # No growth, and no limit.
        pytest.param(
            *(vc.FlatPunch(0.01), relaxing(10.0), vc.ramp(10.0, 5.0)), marks=pytest.mark.slow
        ),
    ],
)
def test_grid_of_elastic_contacts_is_kept_where_more_cells_are_of_no_use(
    monkeypatch, indenter, material, load
):
    mesh = chosen(material, load, 300.0, indenter=indenter)
    monkeypatch.setattr(mesh_choice, "contact_growth", lambda *_: None)
    assert mesh.grid == chosen(material, load, 300.0, indenter=indenter).grid


@pytest.mark.parametrize(
    "tolerances",
    [(0.05, 0.01), pytest.param((0.05, 0.02, 0.01, 0.005), marks=pytest.mark.slow)],
)
def test_tighter_tolerance_gives_more_cells_on_a_relaxing_body(tolerances):
    cells, errors = [], []
    for tolerance in tolerances:
        mesh = chosen(relaxing(10.0), vc.ramp(10.0, 1.0), 30.0, tolerance)
        assert mesh.grid.shape[0] == mesh.grid.shape[1]
        cells.append(mesh.grid.shape[0])
        errors.append(mesh.errors["peak_pressure"])
        assert "ring" not in mesh.warnings
    assert cells == sorted(set(cells))
    assert (np.array(errors) <= tolerances).all()


@pytest.mark.slow
def test_cells_along_the_edges_of_a_turned_roller_are_turned():
    roller, load = vc.Roller(5e-3, 9.565e-3, 75e-3), vc.ramp(1000.0, 2.0)
    straight = chosen(relaxing(10.0), load, 20.0, indenter=roller)
    turned = chosen(relaxing(10.0), load, 20.0, indenter=roller.rotated(math.pi / 2))
    assert turned.grid.shape == straight.grid.shape[::-1]


def test_cells_resolve_the_ring_along_the_edges_that_move(monkeypatch):
    """The contact of a roller grows in width; its length is the roller's, but for the crowns."""
    roller, load = vc.Roller(5e-3, 9.565e-3, 75e-3), vc.ramp(1000.0, 2.0)
    nx, ny = chosen(relaxing(10.0), load, 20.0, indenter=roller).grid.shape
    monkeypatch.setattr(mesh_choice, "contact_growth", lambda *_: None)
    elastic_x, elastic_y = chosen(relaxing(10.0), load, 20.0, indenter=roller).grid.shape
    assert nx == elastic_x
    assert ny > 1.5 * elastic_y


def test_ring_that_cells_cannot_resolve_is_reported_with_the_error():
    mesh = chosen(relaxing(100.0), vc.step(10.0), 300.0)
    assert mesh.errors["peak_pressure"] > 0.03
    assert "ring of high pressure along its edge" in mesh.warnings["ring"]
    assert "9 % of its largest value" in mesh.warnings["ring"]


@pytest.mark.parametrize("material", [relaxing(2.0), vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.4)])
def test_grid_beyond_the_cells_that_a_ring_may_take_stays_as_it_is(material, monkeypatch):
    load = vc.step(0.5)
    monkeypatch.setattr(mesh_choice, "MAX_CELLS_EARLY", 2)
    limited = chosen(material, load, 2.0, tolerance=2e-3)
    monkeypatch.setattr(mesh_choice, "contact_growth", lambda *_: None)
    assert limited.grid.shape == chosen(material, load, 2.0, tolerance=2e-3).grid.shape


def test_cells_remain_as_large_as_the_steps_of_a_height_map():
    lines = np.linspace(-1e-3, 1e-3, 81)
    ball = vc.HeightMap(lines, lines, -BALL.gap(lines[:, None], lines[None, :]))
    mesh = chosen(relaxing(10.0), vc.ramp(10.0, 5.0), 30.0, indenter=ball)
    assert min(mesh.grid.cell_size) > 0.8 * (lines[1] - lines[0])  # but for sizes of transforms
    assert "ring" in mesh.warnings
