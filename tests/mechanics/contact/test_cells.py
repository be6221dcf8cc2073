"""Cells of a contact: ends of the body, symmetry, chords, resistance."""

from __future__ import annotations

import numpy as np

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact import cell_fields, mirror_symmetry, resistance
from viscontact.mechanics.contact.body_edge import trace_outline
from viscontact.mechanics.contact.moving_domain import coarser_shape
from viscontact.mechanics.contact.rim_extent import mean_chords


def test_outline_of_a_round_punch_is_its_circle():
    outline = trace_outline(vc.FlatPunch(1.0), vc.Grid((8, 8), (4.0, 4.0)))
    # The rim is at x = sqrt(1 - 0.25²), the centre at 0.75, in cells of 0.5.
    exact = (np.sqrt(1 - 0.25**2) - 0.75) / 0.5
    assert outline.along_x[5, 4] == close_to(exact, abs=1e-6)


def test_heights_over_neighbours_are_zero_at_dips_and_ends():
    gap = np.array([[3.0], [1.0], [3.0], [2.0]])
    assert cell_fields.height_over_neighbours(gap, 0).ravel().tolist() == [0.0, 1.0, 0.0, 0.0]


def test_field_is_even_if_its_halves_are_mirror_images():
    assert mirror_symmetry.is_mirrored(np.array([[1.0, 2.0], [1.0, 2.0]]), 0)
    assert not mirror_symmetry.is_mirrored(np.array([[1.0, 2.0]]), 1)
    assert resistance.is_even(np.array([[1.0, 2.0], [1.0, 2.0]])) == (True, False)


def test_single_cells_are_not_halved():
    assert coarser_shape((64, 1)) == (32, 1)
    assert coarser_shape((64, 62)) is None


def test_chords_of_two_strips():
    spots = np.zeros((8, 8), dtype=bool)
    spots[1:3, 1:6] = spots[5:7, 1:6] = True
    assert mean_chords(spots).tolist() == [2.0, 5.0]


def test_resistance_is_the_force_times_the_slope_where_it_acts():
    grid, ahead = vc.Grid((4, 4), (4.0, 4.0)), np.zeros((4, 4))
    ahead[3, 1:3] = 1.0  # at x = 1.5, where the slope of the body is 1.5/R
    body = vc.Paraboloid(10.0, 10.0)
    found = resistance.resistance_by_slope(ahead, grid, body, (0.0, 0.0))
    assert found == close_to((0.3, 0.0), abs=1e-12)


def test_contact_reaches_the_nearer_end():
    punch = vc.FlatPunch(half_length=1.0, half_width=9.0)
    grid = vc.Grid((4, 4), (2.0, 2.0))
    assert resistance.reaches_end(np.ones((4, 4)), grid, punch) == (True, False)
