"""Estimated contacts, trial meshes and grids of a path."""

from __future__ import annotations

import numpy as np

import viscontact as vc
from closeness import close_to
from viscontact.simulation.meshing.contact_extent import contacts_of_history, smallest_contact
from viscontact.simulation.meshing.contact_place import grid_centre, locate_contact
from viscontact.simulation.meshing.elastic_estimate import estimate_contact
from viscontact.simulation.meshing.height_map_error import facet_error
from viscontact.simulation.meshing.path_extent import grid_over_path
from viscontact.simulation.meshing.refinement import refine_mesh
from viscontact.simulation.meshing.strip_contact import strip_contact
from viscontact.simulation.meshing.trial_mesh import ElasticContact, try_mesh

BALL = ElasticContact(vc.Sphere(0.01), 1e-6, vc.step(0.1).at(0.0), (2.4e-3, 2.4e-3))


def test_small_contact_is_found_far_from_the_origin():
    """Its 0.18 mm are smaller than the cells of a grid around the origin."""
    ball, load = vc.Paraboloid(0.01, 0.01).shifted(x=5e-3), vc.step(0.1, tilt_x=0.0, tilt_y=0.0)
    found = locate_contact(ball, 1e-9, load.at(0.0))
    hertz = 2 * (0.75 * 0.1 * 0.01 * 1e-9) ** (1 / 3)
    assert found.centre == close_to((5e-3, 0.0), abs=5e-6)
    assert found.length == close_to(hertz, rel=0.03)


def test_grid_of_a_contact_at_the_origin_is_centred_there():
    contact = estimate_contact(vc.Sphere(0.01), 1e-9, vc.step(100.0).at(0.0))
    assert grid_centre([contact]) == (0.0, 0.0)


def test_facets_of_a_measured_ball_raise_the_peak_pressure():
    """Points every 20 um, fifty across the contact."""
    x = np.linspace(-1e-3, 1e-3, 101)
    ball = vc.HeightMap(x, x, -vc.Sphere(0.01).gap(x[:, None], x[None, :]))
    found = estimate_contact(ball, 1e-9, vc.step(17.0).at(0.0))
    assert facet_error(ball, found, 1e-9) == close_to(0.05, abs=5e-3)


def test_facets_along_either_axis_count_by_their_own_length():
    """A ball measured every 20 um along one axis and every 50 um along the other."""
    fine, coarse = np.linspace(-1e-3, 1e-3, 101), np.linspace(-1e-3, 1e-3, 41)
    errors = []
    for x, y in ((fine, coarse), (coarse, fine)):
        ball = vc.HeightMap(x, y, -vc.Sphere(0.01).gap(x[:, None], y[None, :]))
        found = estimate_contact(ball, 1e-9, vc.step(17.0).at(0.0))
        errors.append(facet_error(ball, found, 1e-9))
    assert errors[0] == close_to(errors[1], rel=1e-6)


def test_stiffest_contact_under_a_ramp_has_the_mean_compliance_over_its_rise():
    """A contact that has only grown has crept by the mean of J over the ages of its load."""
    creeping = vc.Material(vc.Maxwell(1e9, 1e9), 0.5).contact_compliance()  # J = (1 + t)/(4 GPa)
    load = vc.ramp(10.0, 4.0)
    latest = float(creeping(100.0))
    found = contacts_of_history(vc.Sphere(0.01), latest, load, 100.0)
    smallest = smallest_contact(vc.Sphere(0.01), creeping, load, 100.0, found)
    assert smallest.compliance == close_to((1 + 4.0 / 2) / 4e9, rel=1e-9)


def test_grid_of_a_path_has_the_same_cells():
    grid = grid_over_path(vc.Grid((4, 4), (4.0, 4.0)), vc.Travel([0, 1], y=[0, 4.5]))
    assert grid == vc.Grid((4, 9), (4.0, 9.0), centre=(0.0, 2.5))


def test_mesh_is_refined_until_the_tolerance_is_met():
    assert try_mesh(BALL, (24, 24), 1e-4).errors["approach"] < 0.01
    found = refine_mesh(BALL, ["contact_area"], 0.01, fewest=(24, 24))
    assert (found.is_enough, found.trial.shape) == (True, (48, 48))


def test_pressure_of_strips_is_hertzian_in_the_middle():
    assert strip_contact(64).pressure(40.0).max() == close_to(40.0, abs=5e-3)
