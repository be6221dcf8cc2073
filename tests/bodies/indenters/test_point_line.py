"""Curves through points, arcs and arguments of shapes."""

from __future__ import annotations

import math

from viscontact.bodies.indenters.arc import arc_drop
from viscontact.bodies.indenters.named_profiles import named_profile, profile_from_table
from viscontact.bodies.indenters.point_line import TableLine, mirrored, numbers
from viscontact.bodies.indenters.position_checks import acute_angle


def test_arc_of_radius_five_drops_by_one_at_three():
    assert arc_drop(3.0, 5.0) == 1.0


def test_kink_of_a_smooth_curve_is_a_point_given_twice():
    roof = TableLine("roof", (0.0, 1.0, 1.0, 2.0), (0.0, 1.0, 1.0, 1.0), "smooth")
    assert roof([0.5, 1.5, 2.5]).tolist() == [0.5, 1.0, math.inf]


def test_symmetric_curve_is_completed():
    positions, drops = mirrored((0.0, 1.0, 3.0), (0.0, 2.0, 4.0))
    assert positions == (-3.0, -1.0, 0.0, 1.0, 3.0)
    assert drops == (4.0, 2.0, 0.0, 2.0, 4.0)


def test_arguments_of_shapes_are_floats():
    assert numbers("TabulatedProfile: x", [0, 1]) == (0.0, 1.0)
    assert acute_angle("Cone: half_angle", 1) == 1.0


def test_profiles_are_made_by_name_and_from_tables():
    found = named_profile("iso-16281", {"radius": 5e-3, "half_length": 6e-3}, {})
    assert found.crown_ratio == 1.0
    table = profile_from_table([(0, 0), (1e-3, 0), (2e-3, 1e-6)])
    assert table.drop(2e-3, 2e-3) == 1e-6
