"""Cells that come into contact: oblique loads of a growing contact, where all of it sticks."""

import numpy as np
import pytest

from closeness import close_to
from mechanics.contact.friction.fixtures import (
    COMPLIANCE,
    CONTACT,
    FORCE,
    RADIUS,
    hertz,
    shear_block,
    solved,
    under,
)
from viscontact.mechanics.contact.friction.entry import entry_compliance
from viscontact.mechanics.contact.friction.normal_contact import NormalContact

KAPPAS = [0.0, 0.4, 1.0]
PART = 0.15  # tangential force over normal force, below the coefficient of friction


def entered(pressure, before, gap, cell_size, kappa):
    """Compliance of cells that enter, of the pressures after and before, and the gap before."""
    contact = NormalContact(pressure, np.zeros(gap.shape), pressure > 0)
    return entry_compliance(contact, NormalContact(before, gap, before > 0), cell_size, kappa)


def sphere_on(grid, part):
    """Means of Hertz's pressure and the gap at the centres, of a load whose radius is a part."""
    radius = part * CONTACT
    edge = grid.cell_size[0]
    places = ((np.arange(6) + 0.5) / 6 - 0.5) * edge
    pressure = np.zeros(grid.shape)
    peak = 2 * radius / (np.pi * COMPLIANCE * RADIUS)
    for along in places:
        for across in places:
            squared = (grid.x[:, None] + along) ** 2 + (grid.y[None, :] + across) ** 2
            pressure += peak * np.sqrt(np.maximum(1 - squared / radius**2, 0)) / 36
    r = np.hypot(grid.x[:, None], grid.y[None, :])
    # Johnson 1985, eq. 3.42a: displacement outside the contact.
    ratio = np.minimum(radius / np.maximum(r, radius), 1.0)
    outside = ((2 * radius**2 - r**2) * np.arcsin(ratio) + r**2 * ratio * np.sqrt(1 - ratio**2)) / (
        np.pi * RADIUS
    )
    gap = np.where(r > radius, r**2 / (2 * RADIUS) + outside - radius**2 / RADIUS, 0.0)
    return pressure, np.maximum(gap, 0.0)


def test_entries_of_a_part_of_the_grid_are_those_of_all_of_it():
    """With the edge and the area of the whole contact, which the part does not hold."""
    grid, pressure = hertz(12)
    before, gap = sphere_on(grid, 0.6)
    contacts = (
        NormalContact(pressure, 0 * gap, pressure > 0),
        NormalContact(before, gap, before > 0),
    )
    cut = slice(3, 9), slice(7, None)
    whole = entry_compliance(*contacts, grid.cell_size, 0.5)
    part = entry_compliance(*contacts, grid.cell_size, 0.5, cut=cut)
    assert np.count_nonzero(part[0]) > 10
    np.testing.assert_array_equal(part, whole[:, *cut])


@pytest.mark.parametrize("kappa", KAPPAS)
def test_a_first_oblique_load_sticks_everywhere(kappa):
    """q = κ p and δ_t = part (1 + κ/2) a²/R, whatever ν: Mindlin and Deresiewicz 1953, case 1."""
    grid, pressure = hertz(32)
    gap = (grid.x[:, None] ** 2 + grid.y[None, :] ** 2) / (2 * RADIUS)
    before = np.zeros(grid.shape)
    entry = entered(pressure, before, gap, grid.cell_size, kappa)
    block = shear_block(grid, kappa)
    found = solved(block, pressure, under((PART * FORCE, 0.0, 0.0)), entry=entry)
    assert found.converged
    # Elastic contact of a first load: the jump passes the whole path at once.
    assert found.motion[0] == close_to(PART * (1 + kappa / 2) * CONTACT**2 / RADIUS, rel=1e-2)


@pytest.mark.parametrize("kappa", KAPPAS)
def test_an_oblique_load_that_grows_sticks_everywhere(kappa):
    """The contact grows by a tenth in radius; without the entry the new cells slip."""
    grid, pressure = hertz(64)
    earlier, gap = sphere_on(grid, 0.9)
    block = shear_block(grid, kappa)
    entry = entered(pressure, earlier, gap, grid.cell_size, kappa)
    before = PART * np.stack([earlier, np.zeros(grid.shape)])
    constraints = under((PART * float(pressure.sum()) * grid.cell_area, 0.0, 0.0))
    found = solved(block, pressure, constraints, before=before, entry=entry)
    way = PART * (1 + kappa / 2) * (1 - 0.9**2) * CONTACT**2 / RADIUS
    held = solved(block, pressure, constraints, before=before)
    assert found.converged
    assert np.count_nonzero(found.state == 2) < 0.04 * np.count_nonzero(found.state)
    assert np.count_nonzero(held.state == 2) > 0.08 * np.count_nonzero(held.state)
    assert found.motion[0] == close_to(way, rel=5e-3)


def test_the_compliance_of_entry_goes_from_the_edge_to_a_first_contact():
    """Modes II and III of a crack at the edge; Hertz's field far from a small contact."""
    kappa = 0.8
    gap = np.linspace(1.0, 2.0, 40_000).reshape(1, -1)
    before = np.zeros(gap.shape)
    before[0, :8] = 1.0
    pressure = np.ones(gap.shape)
    xx, _, yy = entered(pressure, before, gap, (1.0, 1.0), kappa) / gap
    # The gap opens along y.
    assert yy[0, -1] == close_to(1 + kappa / 4, rel=0.05)
    assert xx[0, -1] == close_to(1 + 3 * kappa / 4, rel=0.05)
    before[0, :39_990] = 1.0
    xx, _, yy = entered(pressure, before, gap, (1.0, 1.0), kappa) / gap
    assert (yy[0, -1], xx[0, -1]) == close_to((1.0, 1 + kappa), rel=1e-3)
    before[:] = 0.0
    xx, _, yy = entered(pressure, before, gap, (1.0, 1.0), kappa) / gap
    assert (yy[0, 9], xx[0, 9]) == close_to((1 + kappa / 4, 1 + 3 * kappa / 4), rel=1e-12)


def test_no_entry_in_cells_that_were_in_contact():
    pressure = np.array([[0.0, 1.0], [2.0, 4.0]])
    before = np.array([[0.0, 1.0], [1.0, 0.0]])
    gap = np.array([[1.0, 0.0], [0.0, 2.0]])
    xx, xy, yy = entered(pressure, before, gap, (1.0, 1.0), 0.0)
    np.testing.assert_allclose(xx, [[0.0, 0.0], [0.0, 0.5]])
    np.testing.assert_allclose(yy, xx)
    assert not xy.any()


def test_the_edge_of_the_body_has_no_slope():
    gap = np.array([[0.0, 1.0, np.inf], [0.0, 1.0, np.inf], [0.0, 1.0, np.inf]])
    pressure = np.where(np.isfinite(gap), 1.0, 0.0)
    found = entered(pressure, np.zeros(gap.shape), gap, (1.0, 1.0), 1.0)
    assert np.isfinite(found).all()


def test_mirror_images_enter_alike():
    """Though rounding tells their gaps apart: the area inside is of all cells of one gap."""
    grid, pressure = hertz(32)
    before, gap = sphere_on(grid, 0.6)
    noisy = gap * (1 + 1e-12 * np.random.default_rng(0).normal(size=gap.shape))
    xx, _, yy = entered(pressure, before, noisy, grid.cell_size, 0.4)
    assert xx.any()
    np.testing.assert_allclose(xx, xx[::-1], rtol=1e-9, atol=1e-9 * xx.max())
    np.testing.assert_allclose(xx, yy.T, rtol=1e-9, atol=1e-9 * xx.max())
