"""Limits of the warnings: values that are warned of, and values that are not."""

from __future__ import annotations

import re

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.material import law_warnings, origin_warnings, splitting_warnings
from viscontact.simulation.checks.mesh import layer_warnings
from viscontact.simulation.checks.motion import (
    axle_warnings,
    free_tilt_warnings,
    left_after,
    retardation_warnings,
    turn_warnings,
    unresolved_loss,
    way_warnings,
)
from viscontact.simulation.checks.periodicity import check_endless, datum_warnings
from viscontact.simulation.checks.problem_checks import unusual_radius
from viscontact.simulation.checks.sampling import local_approach
from viscontact.simulation.checks.singularities import bend_at, cells_at_end, is_sharp, strain_of


def test_radius_of_metres_is_unusual():
    assert unusual_radius(vc.Sphere(10)) == (
        "the radius of the indenter is 10 m: lengths are in metres in Python; write 0.01 for 10 mm"
    )
    assert unusual_radius(vc.Sphere(10e-3)) is None


def test_law_may_deviate_by_a_small_error():
    assert list(law_warnings(0.1, 0.0)) == ["memory"]
    assert list(law_warnings(1e-3, 0.02)) == ["conversion"]
    assert law_warnings(1e-3, 1e-3) == {}
    assert list(splitting_warnings(0.02)) == ["splitting"]
    assert splitting_warnings(1e-4) == {}


def test_warning_of_a_law_is_repeated():
    fitted = vc.Material(vc.Elastic(1e9), 0.4, warning="the fit misses storage by 20 %")
    assert origin_warnings([fitted]) == {"origin": "the fit misses storage by 20 %"}


def test_cells_are_compared_with_the_thinnest_layer():
    assert list(layer_warnings(1e-3, (5e-3, 1.2e-3))) == ["layers"]
    assert layer_warnings(1e-3, (5e-3, 1e-4)) == {}


def test_way_of_a_step_is_compared_with_the_contact():
    assert way_warnings(1e-4, 1e-3) == {}
    assert list(way_warnings(1e-3, 1e-3)) == ["way"]
    assert list(free_tilt_warnings(["tilt_y"])) == ["axle"]


def test_loss_of_times_shorter_than_a_step_is_unresolved():
    series = SeriesCompliance(1.0, [1.0], [2.0])
    assert unresolved_loss(series, rate=0.1, duration=3.0) == close_to(1.0)
    assert unresolved_loss(series, rate=0.1, duration=1.0) == 0.0
    several = SeriesCompliance(1.0, [1.0, 1.0, 1.0], [0.5, 2.0, 50.0])
    [text] = retardation_warnings(several, rate=0.3, duration=10.0).values()
    assert "longer than retardation times that cause" in text
    assert ", up to 2 s;" in text


def test_deflection_left_after_a_turn_is_that_of_a_kelvin_unit():
    """After a load for any time an exponential body recovers as exp(-t/τ)."""
    kelvin = SeriesCompliance(0.0, [3e-9], [2.0])
    assert left_after(kelvin, 5.0) == close_to(np.exp(-5.0 / 2.0), rel=1e-12)


def test_tilt_along_a_motion_that_a_period_holds_level_is_not_free():
    slides = vc.Travel([0.0, 1.0], y=[0.0, 1e-3], rolling=False)
    steel = vc.Material(vc.Elastic(80e9), 0.3)
    warned = []
    for periodic in (False, True):
        grid = vc.Grid((8, 8), (1e-3, 1e-3), periodic=periodic)
        problem = Problem(vc.Sphere(0.01), steel, vc.step(1.0), grid, [0.0], motion=slides)
        warned.append(list(axle_warnings(problem)))
    assert warned == [["axle"], []]


@pytest.mark.parametrize("angle", [0.0, 0.5, np.pi / 4])
def test_a_ball_that_rolls_any_way_comes_round_after_its_circumference(angle):
    rubber, steel = vc.Material(vc.Maxwell(1e6, 1e5), 0.5), vc.Material(vc.Elastic(80e9), 0.3)
    x, y = 10e-3 * np.cos(angle), 10e-3 * np.sin(angle)
    rolls = vc.Travel([0.0, 0.1], x=[0.0, x], y=[0.0, y], rolling=True)
    grid, load = vc.Grid((8, 8), (1e-3, 1e-3)), vc.step(1.0)
    problem = Problem(
        *(vc.Sphere(1e-3), steel, load, grid, [0.0]), motion=rolls, indenter_material=rubber
    )
    [text] = turn_warnings(problem).values()
    assert "rolls over 10 mm, more than its circumference of 6.28 mm" in text


@pytest.mark.parametrize(
    ("radii", "periodic"), [((np.inf, 0.01), "[true, false]"), ((0.01, np.inf), "[false, true]")]
)
def test_endless_body_needs_a_grid_that_is_periodic_along_it(radii, periodic):
    with pytest.raises(ValueError, match=re.escape(f"'periodic: {periodic}'")):
        check_endless(vc.Paraboloid(*radii), vc.Grid((8, 8), (1e-3, 1e-3)))


def test_approach_has_no_datum_along_one_periodic_axis():
    grid = vc.Grid((1, 8), (1e-3, 1e-3), periodic=(True, False))
    assert list(datum_warnings(grid, ["approach"])) == ["datum"]


def test_approach_in_the_middle_of_a_grid_has_the_tilt_there():
    grid = vc.Grid((4, 4), (1.0, 1.0), centre=(100.0, 0.0))
    assert local_approach(grid, np.array([2.0, -0.01, 0.0])) == 1.0


def test_pressures_at_the_end_of_a_body_are_apart_from_those_inside():
    ends = cells_at_end(np.array([[0.0, 0.0, 0.0, np.inf]]))
    assert ends.pressures(np.array([[1.0, 2.0, 3.0, 0.0]])) == (3.0, 1.0)


def test_wedge_bends_by_twice_its_slope():
    grid = vc.Grid((5, 5), (5.0, 5.0))
    assert bend_at(np.abs(grid.x)[:, None] + 0 * grid.y, grid, (2, 2)) == 2.0


def test_cone_is_sharp_and_a_sphere_is_not():
    near = (0.0, 0.0), (1e-4, 1e-4), (1e-4, 1e-4)
    assert is_sharp(vc.Cone(1.5), *near, strain=0.07)
    assert not is_sharp(vc.Sphere(0.01), *near, strain=0.01)


def test_strain_of_a_peak_is_hertzian():
    """p0 = 2/pi E* delta/a, with the compliance 1/E*."""
    assert strain_of(1e6, 1e-9) == close_to(np.pi / 2 * 1e6 * 1e-9)
