"""Stability of an adhesive contact: the factor of the descent, and 1 where a state ends."""

from dataclasses import replace

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from mechanics.contact.adhesion.spheres import DEPTH, Sphere
from viscontact.mechanics.contact.adhesion.descent import Descent
from viscontact.mechanics.contact.adhesion.equilibrium import solve_from, traction_at
from viscontact.mechanics.contact.adhesion.problem import attraction
from viscontact.mechanics.contact.adhesion.stability import stability
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.rigid_balance import Constraints


def test_contact_under_a_force_becomes_unstable_where_the_force_is_least():
    # The force over the approach has no slope there: without a change of the force the body moves.
    sphere = Sphere("exponential", 1.0, 96, 5.0)
    approaches = np.linspace(-0.3, -0.7, 11) * DEPTH
    found = sphere.retracted(approaches)
    forces = np.array([sphere.force(each) for each in found])
    factors = [stability(sphere.problem(force=-1.0), sphere.domain, each)[0] for each in found]
    bend, slope, _ = np.polyfit(approaches / DEPTH, forces, 2)
    # The contact gives up cell by cell, which moves the factor to and fro by a few percents.
    growth, level = np.polyfit(approaches / DEPTH, factors, 1)
    assert (1 - level) / growth == close_to(-slope / (2 * bend), abs=0.04)


@pytest.mark.parametrize("law", ["exponential", "lennard-jones"])
def test_contact_under_an_approach_is_stable_past_the_least_force(law):
    sphere = Sphere(law, 1.0, 64, 6.0)
    approaches = np.array([-0.2, -0.6, -0.94]) * DEPTH
    factors = [
        stability(sphere.problem(approach=approach), sphere.domain, found)[0]
        for approach, found in zip(approaches, sphere.retracted(approaches), strict=True)
    ]
    assert 0.4 < factors[0] < factors[1] < factors[2] < 1


@pytest.mark.parametrize("tabor", [0.5, 1.0])
def test_stability_is_the_ratio_of_successive_changes_of_the_descent(tabor):
    sphere = Sphere("exponential", tabor, 48, 5.0)
    problem = sphere.problem(approach=-0.1)
    state = sphere.contact(1e-9, approach=-0.1)
    factor, _ = stability(problem, sphere.domain, state)
    descent = Descent(problem, sphere.domain, state.traction * 1.01)
    changes = [descent._iterate().growth for _ in range(6)]
    assert factor == close_to(changes[-1] / changes[-2], rel=2e-3)


@pytest.mark.parametrize("law", ["exponential", "dugdale"])
def test_stability_from_the_change_of_the_state_before_is_that_from_none(law):
    sphere, known = Sphere(law, 1.0, 48, 6.0), None
    approaches = np.array([-0.2, -0.4, -0.6]) * DEPTH
    for approach, found in zip(approaches, sphere.retracted(approaches), strict=True):
        given = sphere.problem(approach=approach), sphere.domain, found
        factor, _ = stability(*given)
        continued, known = stability(*given, known)
        assert continued == close_to(factor, rel=2e-2)


def freed(resultants):
    """A sphere off the middle of its grid, whose motions are free or held from its state on."""
    sphere = Sphere("exponential", 1.0, 24, 5.0)
    domain = ContactDomain(vc.Grid((24, 24), (5.0, 5.0)))
    x, y = domain.grid.x[:, None], domain.grid.y
    gap = vc.Paraboloid(1.0, 1.0).gap(x - 0.4, y + 0.2)
    held = sphere.problem(approach=0.2)
    held = replace(held, contact=replace(held.contact, open_gap=gap))
    start = traction_at(held, domain, np.maximum(gap - 0.2, 0.0))
    state = solve_from(held, domain, start, 1e-7)
    posed = replace(held.contact, constraints=Constraints(resultants, (0.2, 0.0, 0.0)))
    return replace(held, contact=posed), domain, state


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ((0.0, None, None), (None, None, None)),
        ((None, None, None), (0.0, None, None)),
        ((None, 0.0, None), (None, None, None)),
        ((None, None, 0.0), (None, 0.0, None)),
        ((0.0, 0.0, 0.0), (0.0, None, None)),
        ((None, None, None), (0.0, 0.0, 0.0)),
    ],
)
def test_stability_after_a_change_of_control_is_that_from_none(before, after):
    # What moved under a force, or tilted, is held now, or the other way round.
    _, known = stability(*freed(before))
    factor, _ = stability(*freed(after))
    continued, _ = stability(*freed(after), known)
    assert continued == close_to(factor, rel=2e-2)


def test_stability_does_without_a_change_of_cells_that_the_front_has_left():
    # Dugdale's attraction falls at its front alone, which is elsewhere after a long way.
    sphere = Sphere("dugdale", 1.0, 64, 6.0)
    known = stability(sphere.problem(approach=5.0), sphere.domain, sphere.contact(approach=5.0))[1]
    given = sphere.problem(approach=-0.5), sphere.domain, sphere.contact(approach=-0.5)
    left, right = stability(*given)[0], stability(*given, known)[0]
    assert right == close_to(left, rel=2e-2)


def long_contact(law):
    """A body six times as long as wide that adheres, under a force, with its state."""
    sphere = Sphere(law, 1.0, 24, 5.0)
    domain = ContactDomain(vc.Grid((36, 24), (12.0, 5.0)))
    gap = vc.Paraboloid(6.0, 1.0).gap(domain.grid.x[:, None], domain.grid.y)
    held = sphere.problem(approach=0.3)
    held = replace(held, contact=replace(held.contact, open_gap=gap))
    state = solve_from(held, domain, traction_at(held, domain, np.maximum(gap - 0.3, 0.0)), 1e-7)
    free = Constraints((0.0, 0.0, 0.0), (0.3, 0.0, 0.0))
    return replace(held, contact=replace(held.contact, constraints=free)), domain, state


def eigenvalue_of_matrices(problem, domain, state):
    """Largest eigenvalue of D S, with S of the influence coefficients of all cells, by LAPACK."""
    falls = np.where(
        state.in_contact, 0.0, -attraction(problem.law, state.gap, domain.periodic).slope
    )
    opens, touches = np.flatnonzero(falls), np.flatnonzero(state.in_contact)
    cells = np.concatenate([opens, touches])
    influence, unit = np.empty((cells.size, cells.size)), np.zeros(domain.shape)
    for column, cell in enumerate(cells):
        unit.flat[cell] = 1.0
        influence[:, column] = domain.whole.convolution.apply(unit).ravel()[cells]
        unit.flat[cell] = 0.0
    influence *= problem.contact.compliance
    along = np.meshgrid(domain.grid.x, domain.grid.y, indexing="ij")
    planes = np.stack([np.ones(domain.shape), *along]).reshape(3, -1)[:, cells]
    size, nothing = opens.size, np.zeros((3, 3))
    # Pressures in contact and motions leave contact closed, and resultants as they are.
    closed = planes[:, size:]
    held = np.block([[influence[size:, size:], -closed.T], [closed, nothing]])
    found = np.linalg.solve(held, np.vstack([influence[size:, :size], planes[:, :size]]))
    pressures, motions = found[:-3], found[-3:]
    moves = influence[:size, :size] - influence[:size, size:] @ pressures
    moves += planes[:, :size].T @ motions
    return float(np.linalg.eigvals(falls.ravel()[opens][:, None] * moves).real.max())


@pytest.mark.parametrize("law", ["exponential", "dugdale"])
def test_stability_of_a_long_contact_is_the_eigenvalue_of_its_matrices(law):
    """The body tips before it parts, which no change finds that is as symmetric as the contact."""
    given = long_contact(law)
    assert stability(*given)[0] == close_to(eigenvalue_of_matrices(*given), rel=1e-2)


def test_bodies_far_apart_are_stable():
    sphere = Sphere("dugdale", 0.5, 16, 5.0)
    apart = sphere.contact(approach=-20.0)
    assert stability(sphere.problem(approach=-20.0), sphere.domain, apart)[0] == 0.0
