"""Readers of recorded results: case, events, motion, axis, errors, grids."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from viscontact.bodies.grid import Grid
from viscontact.results.creep_times import law_times
from viscontact.results.enlarged_grid import enlargement, line_on_wider, on_wider
from viscontact.results.last_cycle_values import first_largest, notable_largest
from viscontact.results.recorded_case import across_period, is_prescribed, recorded_poisson_ratio
from viscontact.results.recorded_events import RecordedEvent, recorded_events
from viscontact.results.recorded_motion import (
    body_axis_at,
    contact_edges,
    direction_at,
    motion_axis,
)
from viscontact.results.run_axis import SPEED, TIME, in_order, require_time, run_axis
from viscontact.results.shown_scalars import is_long, lacks_datum
from viscontact.results.snapshot import Snapshot
from viscontact.results.snapshots import take_snapshots
from viscontact.results.stated_errors import (
    LargestError,
    drawn_values,
    largest_error,
    mesh_dependent,
    stated_error,
)
from viscontact.results.stored_result import stored_result


def test_gap_beyond_the_grid_of_its_instant_is_unknown() -> None:
    small = Grid((4, 4), (1.0, 1.0))
    found = on_wider("gap", np.ones((4, 4)), small, small.widened((6, 4)))[:, 0]
    np.testing.assert_array_equal(found, [np.nan, 1.0, 1.0, 1.0, 1.0, np.nan])


def test_line_load_beyond_the_grid_of_its_instant_is_zero() -> None:
    small = Grid((4, 4), (1.0, 1.0))
    found = line_on_wider(np.ones(4), small, small.widened((6, 4))).tolist()
    assert found == [0.0, 1.0, 1.0, 1.0, 1.0, 0.0]


def test_first_of_values_equal_up_to_rounding_is_the_largest() -> None:
    assert first_largest(np.array([1.0, 3.0, 3.000001, 2.0])) == 1


def test_largest_value_is_notable_if_it_exceeds_the_shown_one() -> None:
    ds = xr.Dataset({"peak_pressure": ("time", [3.0, 2.0])}, {"time": [0.0, 1.0]})
    assert notable_largest(ds, "peak_pressure", shown=-1) == 0
    assert notable_largest(ds, "peak_pressure", 0) is None


def test_rigid_indenter_has_no_stresses() -> None:
    ball = {"case": '{"indenter_material": null}'}
    with pytest.raises(ValueError, match="stresses: the indenter of this result is rigid"):
        recorded_poisson_ratio(xr.Dataset(attrs=ball), "indenter_material")


def test_grid_periodic_along_x_has_y_across() -> None:
    found = across_period(xr.Dataset(attrs={"case": '{"grid": {"periodic": [true, false]}}'}))
    assert found == "y"


def test_force_and_tilt_of_a_load_are_prescribed() -> None:
    case = '{"load": {"type": "ForceHistory", "tilt_x": [0.0], "tilt_y": null}}'
    ds = xr.Dataset(attrs={"case": case})
    found = [is_prescribed(ds, name) for name in ("force", "approach", "tilt_x", "tilt_y")]
    assert found == [True, False, True, False]


def test_place_of_the_force_is_prescribed_unless_a_tilt_or_the_approach_is() -> None:
    loads = (
        {"type": "ForceHistory", "tilt_x": None},
        {"type": "ForceHistory", "tilt_x": 0.0},
        {"type": "ApproachHistory", "tilt_x": None},
    )
    runs = [xr.Dataset(attrs={"case": json.dumps({"load": load})}) for load in loads]
    found = [is_prescribed(run, "eccentricity_x") for run in runs]
    assert found == [True, False, False]


def test_event_has_its_instant_and_text() -> None:
    about = {"events": "218 ms: force reaches 50 mN", "event_times": 0.218}
    found = recorded_events(xr.Dataset(attrs=about))
    assert found == [RecordedEvent(time=0.218, text="218 ms: force reaches 50 mN")]


def test_axis_of_motion_is_that_of_the_longer_travel() -> None:
    moved = xr.Dataset({"position_x": ("time", [0.0, 0.0]), "position_y": ("time", [0.0, 1.0])})
    assert motion_axis(moved) == "y"
    assert motion_axis(xr.Dataset()) is None


def test_direction_is_that_of_arrival_and_none_at_rest() -> None:
    moved = xr.Dataset(
        {"position_x": ("time", [0.0, 0.0, 0.0]), "position_y": ("time", [0.0, -2.0, -2.0])},
        {"time": [0.0, 1.0, 2.0]},
    )
    found = [direction_at(moved, time) for time in (0.0, 1.0, 2.0)]
    assert found == [(0.0, -1.0), (0.0, -1.0), None]


def test_standing_body_stays_at_the_origin() -> None:
    moved = xr.Dataset({f"position_{axis}": ("time", [0.0, 2.0]) for axis in "xy"})
    assert body_axis_at(moved.assign_coords(time=[0.0, 1.0]), 0.9) == (2.0, 2.0)
    assert body_axis_at(xr.Dataset(), 0.9) == (0.0, 0.0)


def test_leading_edge_is_the_one_in_the_direction_of_motion() -> None:
    at = np.array([0.0, 1.0, 2.0, 3.0])
    assert contact_edges(at, np.array([False, True, True, False]), -0.1) == (0.5, 2.5)


@pytest.mark.parametrize("touched", [[True, True, False, False], [False, False, True, True]])
def test_edges_at_the_border_of_the_grid_are_those_of_its_last_cells(touched: list[bool]) -> None:
    at = np.array([0.0, 1.0, 2.0, 3.0])
    low, high = (-0.5, 1.5) if touched[0] else (1.5, 3.5)
    assert contact_edges(at, np.array(touched), 0.1) == (high, low)


def test_place_has_the_unit_of_its_axis() -> None:
    assert TIME.place(2.0) == "t = 2 s"
    assert SPEED.place(0.5) == "500 mm/s"


def test_axis_is_the_dimension_of_the_result() -> None:
    assert run_axis(xr.Dataset({"force": ("speed", [1.0])})).row == "speed"


def test_result_over_speed_is_ordered_from_the_slowest() -> None:
    fast_first = xr.Dataset({"force": ("speed", [1.0, 2.0])}, {"speed": [3.0, 0.5]})
    fast_first.encoding["source"] = "result.nc"
    assert in_order(fast_first)["force"].values.tolist() == [2.0, 1.0]
    assert in_order(fast_first).encoding["source"] == "result.nc"


def fields_over(axis: str, places: np.ndarray) -> xr.Dataset:
    """Pressure and gap of one everywhere on four cells times four."""
    ones, at = np.ones((len(places), 4, 4)), np.arange(-1.5, 2.0)
    fields = dict.fromkeys(("pressure", "gap"), ((axis, "x", "y"), ones))
    return xr.Dataset(fields, {axis: places, "x": at, "y": at})


def test_some_speeds_of_many_are_drawn_from_the_slowest_and_one_is_the_fastest() -> None:
    run = fields_over("speed", np.array([3.0, 0.5, 1.0]))
    some = [[each.time for each in take_snapshots(run, None, "map", count=n)] for n in (2, 1)]
    assert some == [[0.5, 3.0], [3.0]]


def test_instants_that_are_drawn_are_those_before_creep_is_over() -> None:
    """A contact that grows with t/(t + 0.01 s) to within 1 % by t = 1 s, of a run up to 1000 s."""
    times = np.append(0.0, np.geomspace(1e-4, 1e3, 71))
    run = fields_over("time", times)
    run["contact_area"] = ("time", 1 + times / (times + 0.01))
    drawn = [each.time for each in take_snapshots(run, None, "map", count=5)]
    assert (drawn[0], drawn[-1]) == (0.0, 1000.0)
    assert all(0.005 < time < 1.3 for time in drawn[1:-1])


def test_figure_over_time_refuses_a_result_over_speed() -> None:
    expected = (
        "history: shows a run over time, and this result is of steady motion, over speed; "
        "draw friction, motion-profile, pressure-map or pressure-profile"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(expected)}$"):
        require_time(xr.Dataset({"force": ("speed", [1.0])}), "history")


def test_times_of_the_law_are_passages_in_steady_motion() -> None:
    passed = {"contact_width": ("speed", [0.02, 0.01])}
    found = law_times(xr.Dataset(passed, {"speed": [1.0, 2.0]}, {"along": "y"})).tolist()
    assert found == [0.005, 0.02]


def test_contact_is_long_from_three_widths_on() -> None:
    sizes = {"contact_area": [0.0, 5.0], "contact_length": [0.0, 6.0]}
    run = xr.Dataset({name: ("time", each) for name, each in sizes.items()})
    found = [is_long(run.assign(contact_width=("time", [0.0, width]))) for width in (1.0, 3.0)]
    assert found == [True, False]
    # Of a contact that has shrunk since, the largest one counts.
    sizes = {"contact_area": [5.0, 1.0], "contact_length": [6.0, 1.0], "contact_width": [2.0, 1.0]}
    assert is_long(xr.Dataset({name: ("time", each) for name, each in sizes.items()}))


def test_contact_through_the_period_along_x_is_long_however_short_the_period() -> None:
    sizes = {"contact_area": 2.0, "contact_length": 2.0, "contact_width": 1.0}
    case = '{"grid": {"size": [2.0, 8.0], "periodic": [true, false]}}'
    run = xr.Dataset({name: ("time", [size]) for name, size in sizes.items()}, attrs={"case": case})
    run = run.assign_coords(x=np.arange(-0.75, 1.0, 0.5), y=np.arange(-3.5, 4.0))
    assert is_long(run)
    assert not is_long(run.assign(contact_length=("time", [1.9])))


def test_unknown_approach_has_no_datum() -> None:
    found = [lacks_datum(xr.Dataset({"approach": ("time", [one])})) for one in (np.nan, 1e-6)]
    assert found == [True, False]


def test_border_of_a_periodic_snapshot_is_the_next_period() -> None:
    at = np.array([-1.5, -0.5, 0.5, 1.5])
    pressure = np.arange(16.0).reshape(4, 4)
    period = Snapshot(0.0, at, at, pressure, 0 * pressure, pressure != 0, periodic=True)
    last_row_again = [15.0, 12.0, 13.0, 14.0, 15.0, 12.0]
    assert period.with_border(1).pressure[0].tolist() == last_row_again


def test_error_that_is_not_stated_is_none() -> None:
    run = xr.Dataset({"approach": ("time", [1e-5]), "approach_error": ("time", [1e-7])})
    np.testing.assert_array_equal(stated_error(run, "approach"), [1e-7])
    assert stated_error(run, "force") is None


def test_infinite_error_means_dependence_on_the_mesh() -> None:
    run = xr.Dataset({"force": ("time", [1.0, 2.0]), "force_error": ("time", [0.0, np.inf])})
    assert mesh_dependent(run, "force").tolist() == [False, True]


def test_values_that_depend_on_the_mesh_are_not_drawn() -> None:
    peak = xr.Dataset({"p": ("time", [0.0, 2.0, 3.0]), "p_error": ("time", [0.0, np.inf, 0.1])})
    np.testing.assert_array_equal(drawn_values(peak, "p"), [0.0, np.nan, 3.0])
    np.testing.assert_array_equal(drawn_values(peak.isel(time=[0, 1]), "p"), [np.nan, np.nan])


def test_largest_error_is_counted_with_the_unknown_ones() -> None:
    force = {"force": ("time", [2.0, 4.0]), "force_error": ("time", [0.1, np.nan])}
    found = largest_error(xr.Dataset(force, {"time": [0.0, 1.0]}), "force")
    assert found == LargestError(half_width=0.1, part=0.025, unknown=1, place=0.0)


def test_of_equal_errors_the_first_is_the_largest() -> None:
    force = {
        "force": ("time", [4.0, 4.0, 4.0]),
        "force_error": ("time", [0.05, 0.1, 0.1 * (1 + 1e-9)]),
    }
    found = largest_error(xr.Dataset(force, {"time": [0.0, 1.0, 2.0]}), "force")
    assert found is not None
    assert found.place == 1.0


def test_stored_result_has_sizes_and_values(tmp_path: Path) -> None:
    xr.Dataset({"force": ("time", [1.0, 2.0])}).to_netcdf(tmp_path / "result.nc")
    with stored_result(tmp_path) as found:
        assert (found.sizes, found["force"].values.tolist()) == ({"time": 2}, [1.0, 2.0])


def test_enlargement_is_logged_with_cells_and_extents() -> None:
    small = Grid((32, 16), (2e-3, 1e-3))
    found = enlargement(1.5, small, small.widened((48, 16)))
    assert found == "t = 1.5 s: from 32 x 16 cells on 2 mm x 1 mm to 48 x 16 cells on 3 mm x 1 mm"
