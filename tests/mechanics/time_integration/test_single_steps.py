"""Single steps: rises, heat, instants of cells, and moved fields."""

from __future__ import annotations

import numpy as np

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.mechanics.time_integration.dissipation import heat_of_step
from viscontact.mechanics.time_integration.extrapolation import shifted
from viscontact.mechanics.time_integration.fixed_steps import snap_to_kink
from viscontact.mechanics.time_integration.hereditary_integral import is_resolved
from viscontact.mechanics.time_integration.moving_times import moving_times
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.mechanics.time_integration.run_times import run_instants
from viscontact.mechanics.time_integration.step_estimate import estimated_steps
from viscontact.mechanics.time_integration.step_shape import longest_smooth_rise

ELASTIC = SeriesCompliance(1.0, (), ())


def test_number_of_adaptive_steps_is_estimated():
    zener = SeriesCompliance(1.0, [1.0], [2.0])
    assert estimated_steps(AdaptiveTimes(10.0, 1e-3), vc.step(1.0), zener) == 25.0


def test_heat_of_a_kelvin_unit_under_constant_load_is_half_its_work():
    unit, load = SeriesCompliance(0.0, [1.0], [1.0]), np.ones((2, 1, 1))
    heat = heat_of_step(unit, np.zeros((1, 2, 1, 1)), [(50.0, load, load)])
    assert heat == close_to(0.5, rel=1e-12)


def test_moved_field_enters_with_the_values_at_its_border():
    moved = shifted(np.array([[1.0, 2.0, 3.0]]), (0, 1), periodic=(False, False))
    assert moved.tolist() == [[1.0, 1.0, 2.0]]


def test_time_beside_a_kink_by_rounding_is_the_kink():
    assert snap_to_kink(0.1 + 0.2, np.array([0.3])) == 0.3
    assert snap_to_kink(0.31, np.array([0.3])) == 0.31


def test_step_is_short_if_little_creeps_over_it():
    assert is_resolved(0.4, 1.0, whole=True)
    assert not is_resolved(0.6, 1.0, whole=True)


def test_moving_times_are_those_of_whole_cells():
    path = vc.Travel([0.0, 1.0], y=[0.0, 1e-3])
    times = moving_times(path, vc.step(1.0), (1e-4, 2.5e-4))
    assert times == close_to([0.0, 0.25, 0.5, 0.75, 1.0])
    # A run may end before its motion does.
    assert moving_times(path, vc.step(1.0), (1e-4, 2.5e-4), end=0.6) == close_to(
        [0, 0.25, 0.5, 0.6]
    )


def test_adaptive_run_does_not_go_on_to_fields_that_are_wanted_after_its_end():
    found = run_instants(AdaptiveTimes(10.0, 1e-3), [2.0, 20.0], vc.step(1.0), ELASTIC)
    assert found.tolist() == [0.0, 2.0, 10.0]


def test_longest_rise_on_a_fluid_keeps_the_old_weight_at_the_instant_compliance():
    """J = 1 + t has the old weight r/2."""
    fluid = SeriesCompliance(1.0, (), (), 1.0)
    assert longest_smooth_rise(fluid, 1.5) == 1.5
    assert longest_smooth_rise(fluid, 9.0) == close_to(2.0, abs=1e-9)
