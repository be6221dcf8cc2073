"""Height maps that are wholly in contact."""

from __future__ import annotations

import re

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.simulation.meshing.contact_extent import PointContact
from viscontact.simulation.meshing.elastic_estimate import (
    elastic_contact,
    estimate_contact,
    estimate_period,
)
from viscontact.simulation.meshing.full_contact_warning import opening_force, whole_map_warning
from viscontact.units.parsing import parse_quantity

COMPLIANCE = 1e-9

#: Cells as long as the steps of `rough_map`, and some beyond its edge.
CELLS = vc.Grid((51, 51), (51 / 40 * 20e-6, 51 / 40 * 20e-6))


def rough_map(length: float) -> vc.HeightMap:
    """Waves of two directions, 60 nm high, on a square of a length [m]."""
    x = np.linspace(-length / 2, length / 2, 41)
    waves = np.cos(3 * np.pi * x[:, None] / length) + 0.5 * np.cos(5 * np.pi * x / length + 1.0)
    return vc.HeightMap(x, x, 20e-9 * waves)


def pressed(surface: vc.HeightMap, force: float) -> PointContact:
    load = vc.step(force).at(0.0)
    return PointContact(load, COMPLIANCE, estimate_contact(surface, COMPLIANCE, load))


@pytest.mark.parametrize("length", [20e-6, 2e-6])
def test_map_opens_just_below_the_named_force(length: float) -> None:
    """Solved again at 1 % less and 1 % more; the cells of a first grid were longer than the map."""
    surface = rough_map(length)
    whole = pressed(surface, 1.0)
    force = opening_force(whole)
    assert force < 1.0
    open_gap, grid = whole.estimate.open_gap, whole.estimate.grid
    covered = np.isfinite(open_gap)
    for part, is_whole in ((0.99, False), (1.01, True)):
        load = vc.step(part * force).at(0.0)
        found = elastic_contact(open_gap, COMPLIANCE, load, ContactDomain(grid))
        assert (found.pressure[covered] > 0).all() == is_whole


def test_warning_names_the_size_of_the_map_and_the_force() -> None:
    surface = rough_map(20e-6)
    whole = pressed(surface, 1.0)
    (said,) = whole_map_warning(surface, whole, CELLS).values()
    assert said.startswith("the whole map (20 µm x 20 µm) is in contact")
    assert "press with less than about" in said
    half = pressed(surface, 0.5 * opening_force(whole))
    assert not whole_map_warning(surface, half, CELLS)


def test_short_waves_that_the_coarse_estimate_leaves_out_open_first() -> None:
    """Solved on cells of the map just below and above the force in the warning."""
    x = np.linspace(-10e-6, 10e-6, 101)
    rough = np.random.default_rng(3).standard_normal((101, 101))
    surface = vc.HeightMap(x, x, 1e-9 * rough)
    cells = vc.Grid((101, 101), (20.2e-6, 20.2e-6))
    (said,) = whole_map_warning(surface, pressed(surface, 1.0), cells).values()
    named = parse_quantity(said.split("less than about ")[1].split(",")[0], "force")
    for part, is_whole in ((0.9, False), (1.1, True)):
        load = vc.step(part * named).at(0.0)
        open_gap = surface.gap(cells.x[:, None], cells.y)
        found = elastic_contact(open_gap, COMPLIANCE, load, ContactDomain(cells))
        assert (found.pressure > 0).all() == is_whole


@pytest.mark.parametrize("count", [16, 32, 64])
def test_waves_open_at_the_pressure_of_full_contact(count: int) -> None:
    """p* = pi E* amplitude / wavelength: Johnson, Contact Mechanics (1985), eq. 13.6.

    The valley between two centres opens first; the next centres are half a cell beside it.
    """
    grid = vc.Grid((count, 4), (1e-3, 1e-3), periodic=True)
    waves, full = vc.Waviness(1e-6, wavelength_x=1e-3), np.pi * 1e-6 / 1e-3 / COMPLIANCE
    load = vc.step(1.5 * full * grid.area).at(0.0)
    whole = PointContact(load, COMPLIANCE, estimate_period(waves, COMPLIANCE, load, grid))
    expected = full * np.cos(np.pi / count)
    assert opening_force(whole) / grid.area == close_to(expected, rel=1e-5)


def test_approach_names_no_force() -> None:
    surface = rough_map(20e-6)
    load = vc.step(approach=10e-6, tilt_x=0.0, tilt_y=0.0).at(0.0)
    whole = PointContact(load, COMPLIANCE, estimate_contact(surface, COMPLIANCE, load))
    (said,) = whole_map_warning(surface, whole, CELLS).values()
    assert "press less, or measure" in said


def test_body_that_is_no_map_has_no_such_warning() -> None:
    punch, load = vc.FlatPunch(1e-3), vc.step(1.0).at(0.0)
    estimate = estimate_contact(punch, COMPLIANCE, load)
    assert not whole_map_warning(punch, PointContact(load, COMPLIANCE, estimate), estimate.grid)


def test_error_as_large_as_the_value_is_unknown() -> None:
    """The facets of a map of a few waves, each of four points, under a small force."""
    x = np.linspace(-10e-6, 10e-6, 65)
    heights = 50e-9 * np.random.default_rng(0).standard_normal((65, 65))
    rubber = vc.Material(vc.Elastic(1e9), poisson_ratio=0.3)
    load = vc.step(1e-4, tilt_x=0.0, tilt_y=0.0)
    with pytest.warns(vc.AccuracyWarning) as caught:
        vc.simulate(vc.HeightMap(x, x, heights), rubber, load, times=[0.0], errors=False)
    said = " ".join(str(each.message) for each in caught)
    assert "an error of unknown size" in said
    assert re.search(r"the contact is only \d+ x \d+ of its points", said)
