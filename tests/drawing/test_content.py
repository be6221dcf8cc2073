"""Content of figures: axes, scales, windows, notes, reliefs."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from closeness import close_to
from viscontact.bodies.indenters import Sphere
from viscontact.bodies.laws import Elastic, Maxwell
from viscontact.drawing.content.along_run import along_run, suits_log_time, within_span
from viscontact.drawing.content.design import profile_panel, trial_panels
from viscontact.drawing.content.friction import limit_speeds
from viscontact.drawing.content.history import event_marks, limits_around
from viscontact.drawing.content.key_axis import numbered_texts
from viscontact.drawing.content.law_curves import creep_panels, material_panels
from viscontact.drawing.content.look import DARK, LIGHT, PRESSURE, Look, shades
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.ordered_names import in_order
from viscontact.drawing.content.panel import Axis, Curve, Ink, Panel
from viscontact.drawing.content.pressure_relief import thinned
from viscontact.drawing.content.relief import relief
from viscontact.drawing.content.scale import pressure_scale, round_step
from viscontact.drawing.content.sensitivity import tornado_panels
from viscontact.drawing.content.shape import natural_size, stretch_note
from viscontact.drawing.content.stress_planes import StressPlane
from viscontact.drawing.content.window import window_over
from viscontact.drawing.figures import names_of
from viscontact.results.snapshots import Snapshot


def test_rising_load_has_a_linear_axis_of_time() -> None:
    ramp = {name: ("time", np.arange(5.0)) for name in ("force", "approach")}
    found = along_run([xr.Dataset(ramp, {"time": [0.0, 1.0, 2.0, 4.0, 1000.0]})]).scale
    assert found == "linear"


def test_run_is_cut_to_the_span() -> None:
    run = xr.Dataset({"force": ("time", [0.0, 1.0, 2.0])}, coords={"time": [0.0, 1.0, 2.0]})
    found = within_span(run, ["force"], [0.0, 1.5], "history", "").force.values.tolist()
    assert found == [0.0, 1.0]


def test_held_load_over_decades_suits_a_logarithmic_axis() -> None:
    times = [0.0, 1.0, 2.0, 4.0, 1000.0]
    held = xr.Dataset({name: ("time", [1.0] * 5) for name in ("force", "approach")})
    assert suits_log_time(held.assign_coords(time=times))


def test_limits_are_drawn_from_the_least_to_the_largest_speed() -> None:
    found = limit_speeds(xr.Dataset(coords={"speed": [10.0, 0.1]}))[[0, -1]].tolist()
    assert found == [0.1, 10.0]


def test_range_of_a_history_holds_its_errors_up_to_its_own_span() -> None:
    at = np.array([0.0, 1.0])
    curve = Curve(at, at + 1.0, error=np.array([0.5, np.nan]))
    assert limits_around([curve]) == close_to((0.425, 2.075))  # 5 % beyond 0.5 and 2
    wide = Curve(at, at + 1.0, error=np.array([9.0, 9.0]))
    assert limits_around([wide]) == close_to((0.0, 3.15))  # 5 % beyond 3, and none at 0
    assert limits_around([Curve(at, 0 * at + 2.0)]) == close_to((0.0, 2.3))


def test_shades_have_equal_steps() -> None:
    assert shades("000000 ffffff", 3) == ["#000000", "#808080", "#ffffff"]
    assert shades(PRESSURE, 1) == ["#ffffd9"]


def test_note_on_the_peak_concerns_the_drawn_instants_only() -> None:
    peak = ("time", [np.inf, 1.0])
    run = xr.Dataset({"peak_pressure_error": peak}, coords={"time": [0.0, 1.0]})
    assert peak_note([run]) == "peak depends on the mesh"
    assert peak_note([run], [0.9]) == ""


def test_runs_are_ordered_by_the_quantity_in_their_names() -> None:
    assert list(in_order({"F=1kN": 0, "F=200N": 1})) == ["F=200N", "F=1kN"]


def test_block_of_cells_has_its_largest_pressure() -> None:
    at = np.arange(5.0)
    pressure = np.arange(25.0).reshape(5, 5)
    thin = thinned(Snapshot(0.0, at, at, pressure, 0 * pressure, pressure != 0), (2, 1))
    assert thin.x.tolist() == [0.5, 2.5]
    assert thin.pressure[0].tolist() == [5.0, 6.0, 7.0, 8.0, 9.0]


def test_quadrilateral_with_a_hidden_corner_is_left_out() -> None:
    x, y = np.meshgrid([0.0, 1.0, 2.0], [0.0, 1.0], indexing="ij")
    there = np.array([[True, True], [True, True], [True, False]])
    assert relief(x, y, x + y, x + y, there).values.tolist() == [1.0]


def test_colours_of_a_signed_scale_are_neutral_at_zero() -> None:
    assert pressure_scale(0.0, 1e6).colours(2) == ["#f1f9b9", "#2072b2"]
    assert pressure_scale(-1e6, 1e6).colours(3)[1] == "#f7f7f7"
    # The larger side has the full colour, and equal sizes have colours of equal strength.
    whole = pressure_scale(-4e6, 4e6).colours(9)
    assert pressure_scale(-4e6, 2e6).colours(7) == whole[:7]
    assert pressure_scale(-2e6, 4e6).colours(7) == whole[2:]


def test_levels_of_pressure_are_round_and_include_zero() -> None:
    scale = pressure_scale(0.0, 152e6)
    found = scale.unit(scale.levels).tolist()
    assert found == [0.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0, 160.0]
    assert scale.label == "Pressure [MPa]"
    signed = pressure_scale(-30e3, 90e3)
    assert signed.unit(signed.levels)[:4].tolist() == [-40.0, -20.0, 0.0, 20.0]
    assert signed.diverges


def test_levels_end_at_the_largest_pressure_that_does_not_depend_on_the_mesh() -> None:
    scale = pressure_scale(0.0, 900e6, ordinary=152e6)
    assert (scale.is_open, scale.limits[1]) == (True, 900e6)
    assert scale.unit(scale.levels)[-1] == 160.0


def test_round_step_is_not_below_the_least() -> None:
    assert round_step(0.021) == 0.025
    assert round_step(7.0) == 10.0


def test_stretch_is_noted_unless_the_shape_is_true() -> None:
    assert stretch_note("heights", 123.4) == "heights 100×"
    assert stretch_note("y", 1.04) == "true shape"


def test_sphere_is_drawn_over_less_than_its_radius_on_both_sides() -> None:
    assert [round(extent, 3) for extent in natural_size(Sphere(radius=1.0))] == [0.968, 0.968]


def test_window_holds_all_boxes_with_a_margin() -> None:
    assert window_over([(-1.0, 1.0, -0.5, 0.5), (-2.0, 0.0, -0.5, 0.5)]).x == (-2.21, 1.21)


def test_window_ends_with_the_period_along_each_axis() -> None:
    window = window_over([(-1.0, 1.0, -3.0, 3.0)], (-1.05, 1.02, -2.0, 5.0))
    assert (window.x, window.y) == ((-1.05, 1.02), (-2.0, 3.42))


@pytest.mark.parametrize(("box", "note"), [((10.0, 0.5), "y"), ((0.5, 10.0), "x")])
def test_slender_contact_is_stretched_across(box: tuple[float, float], note: str) -> None:
    """A ratio of 20 is drawn at 5: at least 4.5 by a round factor."""
    along, across = box
    window = window_over([(-along, along, -across, across)])
    assert window.note == f"{note} stretched 4×"
    assert max(window.height_to_width, 1 / window.height_to_width) == close_to(5.0)


def test_events_beyond_the_drawn_instants_have_no_marks() -> None:
    about = {"events": "1 s: force reaches 2 N\n5 s: contact is lost", "event_times": [1.0, 5.0]}
    run = xr.Dataset({"force": ("time", [0.0, 2.0])}, {"time": [0.0, 3.0]}, about)
    assert [mark.text for mark in event_marks(run)] == ["1 s: force reaches 2 N"]


def test_depth_of_the_largest_stress_lies_between_the_depths_of_a_section() -> None:
    """A parabola through three depths has its vertex where it was put."""
    depths = np.arange(8.0)
    stress = (9.0 - (depths[:, None] - 3.3) ** 2) * np.array([0.5, 1.0, 0.5])
    plane = StressPlane(0.0, np.array([-1.0, 0.0, 1.0]), depths, stress, "y", None, 2.0)
    assert plane.largest[1:] == close_to((3.3, 0.0), rel=1e-12)


def test_animations_are_not_among_the_figures() -> None:
    assert names_of("speed") == ["friction", "traction-creepage", "motion-profile"]
    assert names_of("sweep") == ["response", "pull-off"]


def test_panel_has_numbers_in_si_and_an_axis_with_the_unit_in_which_they_are_drawn() -> None:
    times, areas = np.array([0.0, 1.0]), np.array([1e-6, 2e-6])
    panel = Panel(
        Axis.of("Time", "s", times),
        Axis.of("Contact area", "m2", areas),
        (Curve(times, areas, error=0.1 * areas),),
    )
    assert panel.y.label == "Contact area [mm²]"
    assert panel.y.unit(panel.curves[0].y).round(6).tolist() == [1.0, 2.0]


def test_trials_are_told_apart_and_the_best_one_is_marked() -> None:
    data = {"force": ("trial", [3.0, 2.0, 4.0]), "force_error": ("trial", [0.1, np.inf, 0.3])}
    data |= {"feasible": ("trial", [True, True, False]), "level": ("trial", 3 * ["case"])}
    keys = {"load.force": ("trial", [1.0, 2.0, 3.0], {"units": "N"})}
    (panel,) = trial_panels(xr.Dataset(data, keys, {"goal": "force", "best": 1}))
    found = {curve.name: (curve.look, curve.x.tolist()) for curve in panel.curves}
    assert found["cells of the case"] == ("points", [1.0, 2.0])
    assert found["not feasible"] == ("cross", [3.0])
    assert found["best"] == ("square", [2.0])
    assert panel.x.label == "Load force [N]"


def test_profiles_are_cut_off_where_they_drop_steeply_at_the_ends() -> None:
    data = {"drop": (("profile", "x"), [[1e-3, 2e-6, 0.0, 2e-6, 1e-3]])}
    x = [-1.0, -0.5, 0.0, 0.5, 1.0]
    panel = profile_panel(xr.Dataset(data, {"profile": ["free"], "x": x}))
    assert panel.y.limits == close_to((-0.4e-6, 8e-6))


def test_bars_are_the_known_elasticities_the_largest_first() -> None:
    data = {"elasticity": (("output", "input"), [[0.1, np.nan, -2.0]])}
    data |= {"elasticity_error": (("output", "input"), [[0.01, 0.0, 0.1]])}
    inputs = ["load.force", "load.time", "indenter.radius"]
    (panel,) = tornado_panels(xr.Dataset(data, {"output": ["force"], "input": inputs}))
    assert panel.y.texts == ("Indenter radius", "Load force")
    assert {curve.y[0]: (curve.x[0], curve.ink.place) for curve in panel.curves} == {
        0.0: (-2.0, 1),
        1.0: (0.1, 0),
    }


def test_curve_of_a_law_has_its_value_at_time_zero_only_if_it_is_alone() -> None:
    law, times = Maxwell(1e9, 1e11), np.geomspace(1.0, 100.0, 3)
    compliance, modulus = creep_panels({"": law}, times)
    assert [mark.place for mark in (*compliance.marks, *modulus.marks)] == close_to([5e-10, 1e9])
    assert creep_panels({"one": law, "two": law}, times)[0].marks == ()


def test_known_range_of_a_material_is_shaded_over_time_and_over_frequency() -> None:
    panels = material_panels(Maxwell(1e9, 1e9), (0.01, 100.0), (0.0, 10.0), ())
    assert [panel.shaded for panel in panels] == [(0.01, 10.0), (0.01, 10.0), (0.1, 100.0)]
    assert [panel.y.scale for panel in panels] == 3 * ["log"]
    narrow = material_panels(Maxwell(1e9, 1e9), (0.1, 0.2), None, ())
    assert [panel.y.scale for panel in narrow] == ["linear", "linear", "log"]
    assert material_panels(Elastic(1e6), (0.1, 1.0), None, ())[1].shaded is None


@pytest.mark.parametrize("look", [LIGHT, DARK])
def test_runs_have_distinct_colours_that_differ_from_the_page(look: Look) -> None:
    colours = [look.colour(Ink(place=number)) for number in range(7)]
    assert len({*colours, look.card}) == 8
    assert look.colour(Ink(place=7)) == colours[0]
    instants = [look.colour(Ink("ordered", place)) for place in (0.0, 0.5, 1.0)]
    assert instants == look.instants(3)


def test_texts_that_differ_in_spaces_only_have_no_number() -> None:
    same = xr.Dataset(coords={"load": ("run", ["hold for 1 s", "hold for 1s"])})
    assert numbered_texts(same, ["load"]) == {}
    unlike = xr.Dataset(coords={"load": ("run", ["hold for 1 s", "hold for 20 s"])})
    assert numbered_texts(unlike, ["load"])["load"].values.tolist() == [1.0, 20.0]
