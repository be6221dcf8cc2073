"""What users rely on of results: their variables, what is without contact, fields and files."""

from __future__ import annotations

import json
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from project.promised_run import (
    BALL,
    ERRORS,
    FIELDS,
    GRID,
    LOAD,
    RUBBER,
    SCALARS,
    TIMES,
    check_variables,
    ds,
)

__all__ = ["ds"]  # a fixture

# A handful of steps is enough here; that they are few is warned about, and tested elsewhere.
pytestmark = [
    pytest.mark.filterwarnings("ignore:the load grows from nothing:viscontact.AccuracyWarning"),
    pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning"),
]


# --- results ------------------------------------------------------------------------------------


def test_result_has_every_variable_with_its_dimensions_unit_and_long_name(ds: xr.Dataset) -> None:
    check_variables(ds)
    assert ds.time.values.tolist() == TIMES
    np.testing.assert_array_equal(ds.x, GRID.x)
    np.testing.assert_array_equal(ds.y, GRID.y)


def test_result_carries_version_case_wall_time_tolerance_and_warnings(ds: xr.Dataset) -> None:
    assert ds.attrs["version"] == vc.__version__
    assert ds.attrs["tolerance"] == 1e-6
    assert ds.attrs["wall_time"] > 0
    assert ds.attrs["warnings"] == ""
    case = json.loads(ds.attrs["case"])
    assert case["indenter"] == {"type": "Sphere", "radius": 0.01}
    assert case["material"]["law"]["type"] == "Zener"
    assert case["load"]["force"] == LOAD.force.tolist()
    assert case["grid"]["shape"] == [32, 32]
    assert case["times"] == TIMES


def test_scalars_mean_what_their_names_say(ds: xr.Dataset) -> None:
    np.testing.assert_allclose(ds.pressure.sum(("x", "y")) * GRID.cell_area, ds.force, rtol=1e-12)
    np.testing.assert_allclose(ds.force, LOAD.force_at(TIMES), rtol=1e-6)
    np.testing.assert_array_equal(ds.pressure.max(("x", "y")), ds.peak_pressure)
    touching = ds.where(ds.contact_area > 0, drop=True)
    np.testing.assert_allclose(touching.force / touching.contact_area, touching.mean_pressure)
    # gap = initial gap + displacement - approach - tilts (eq. 1), to the solver's tolerance
    initial = xr.DataArray(BALL.gap(GRID.x[:, None], GRID.y[None, :]), dims=("x", "y"))
    rigid = ds.approach + ds.tilt_x * ds.x + ds.tilt_y * ds.y
    np.testing.assert_allclose(
        (initial + ds.displacement - rigid).transpose("time", "x", "y"), ds.gap, atol=1e-12
    )
    assert (ds.residual <= ds.attrs["tolerance"]).all()


def test_value_at_a_jump_is_the_one_just_after_it(ds: xr.Dataset) -> None:
    assert float(ds.force.sel(time=0.0)) == close_to(0.1)
    assert float(ds.force.sel(time=1.0)) == close_to(0.05)


def test_without_contact_everything_is_exactly_zero_and_the_march_continues(ds: xr.Dataset) -> None:
    apart = ds.sel(time=[2.0, 2.5, 3.0])
    assert (apart.outcome == vc.Outcome.NO_CONTACT).all()
    for name in (
        *("pressure", "force", "contact_area", "peak_pressure", "mean_pressure"),
        *("contact_length", "contact_width", "residual", "cells_across"),
    ):
        assert (apart[name] == 0.0).all(), name
    assert np.isnan(apart.eccentricity_x).all()
    assert np.isnan(apart.eccentricity_y).all()
    assert (apart.work == apart.work[0]).all()
    again = ds.sel(time=[3.1, 3.5, 4.0, 5.0])
    assert (again.outcome == vc.Outcome.CONVERGED).all()
    assert (again.contact_area > 0).all()


def test_without_contact_the_body_just_touches_its_indentation(ds: xr.Dataset) -> None:
    apart = ds.sel(time=[2.0, 2.5, 3.0])
    np.testing.assert_allclose(apart.gap.min(("x", "y")), 0.0, atol=1e-18)
    # the dent heals, so the touching body rises
    assert (apart.approach > 0).all()
    assert (apart.approach.diff("time") < 0).all()


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_without_contact_free_tilts_keep_their_last_value() -> None:
    load = vc.ForceHistory([0, 1, 1, 2], [0.1, 0.1, 0, 0], eccentricity_x=1e-4)
    punch = vc.FlatPunch(half_length=1e-3, half_width=1e-3)
    ds = vc.simulate(punch, RUBBER, load, GRID, [0.0, 0.5, 0.999, 1.0, 2.0], fields="none")
    assert float(ds.tilt_x[0]) > 1e-4  # a force towards +x presses that end deeper
    # up to the jump at 1 s the tilt still creeps a little, and that is the value kept
    assert float(ds.tilt_x[3]) == close_to(float(ds.tilt_x[2]), rel=2e-3)
    assert float(ds.tilt_x[4]) == float(ds.tilt_x[3])
    assert (ds.outcome.values[3:] == vc.Outcome.NO_CONTACT).all()


def test_given_tilt_replaces_the_moment_equation() -> None:
    ds = vc.simulate(BALL, RUBBER, vc.step(0.1, tilt_x=1e-3), GRID, [0.0], fields="none")
    assert float(ds.tilt_x[0]) == 1e-3
    # a sphere rolls: it touches where its slope is the tilt's, x = R tilt
    assert float(ds.eccentricity_x[0]) == close_to(0.01 * 1e-3, rel=0.01)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_eccentric_force_has_its_moments_about_both_axes() -> None:
    punch = vc.FlatPunch(half_length=1e-3, half_width=1e-3)
    load = vc.step(0.1, eccentricity_x=1e-4, eccentricity_y=-5e-5)
    ds = vc.simulate(punch, RUBBER, load, GRID, [0.0], fields="none")
    assert float(ds.eccentricity_x[0]) == close_to(1e-4, rel=1e-5)
    assert float(ds.eccentricity_y[0]) == close_to(-5e-5, rel=1e-5)
    assert float(ds.tilt_x[0]) > 0 > float(ds.tilt_y[0])


def test_times_that_begin_later_see_the_whole_history(ds: xr.Dataset) -> None:
    late = vc.simulate(BALL, RUBBER, LOAD, GRID, [1.5, 2.5], fields="none")
    whole = ds.sel(time=[1.5, 2.5])
    # Other steps, so only as close as the steps' own error, up to 1e-3; without its past the
    # ball would stand a third higher at 1.5 s.
    np.testing.assert_allclose(late.approach, whole.approach, rtol=3e-3)


def test_kinks_are_stepped_and_not_added() -> None:
    load = vc.ForceHistory([0, 1, 2], [0.05, 0.1, 0.05])
    one, two = (vc.simulate(BALL, RUBBER, load, GRID, t) for t in ([2.0], [1.0, 2.0]))
    assert one.time.values.tolist() == [2.0]
    np.testing.assert_allclose(one.approach[-1], two.approach[-1], rtol=1e-12)


def test_load_is_zero_before_its_first_point_and_held_after_its_last() -> None:
    load = vc.ForceHistory([1.0, 2.0], [0.1, 0.1])
    ds = vc.simulate(BALL, RUBBER, load, GRID, [0.0, 0.5, 1.0, 2.0, 4.0], fields="none")
    assert ds.force.values[:2].tolist() == [0.0, 0.0]
    np.testing.assert_allclose(ds.force[2:], 0.1, rtol=1e-6)
    assert float(ds.approach[4]) > float(ds.approach[3])


def test_default_times_hold_the_kinks() -> None:
    ds = vc.simulate(BALL, RUBBER, vc.triangle(0.1, 0.3, 0.7), GRID, fields="none")
    assert {0.0, 0.3, 1.0} <= set(ds.time.values.tolist())


# --- fields, march, arguments -------------------------------------------------------------------


def test_fields_are_kept_at_all_instants_at_none_or_at_those_asked_for(ds: xr.Dataset) -> None:
    some = vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES, fields=[5.0, 0.0])
    assert some.field_time.values.tolist() == [0.0, 5.0]
    assert some.field_time.attrs["units"] == "s"
    for name in FIELDS:
        assert some[name].dims == ("field_time", *ds[name].dims[1:])
        np.testing.assert_array_equal(some[name], ds[name].sel(time=[0.0, 5.0]))
    by_array = vc.simulate(BALL, RUBBER, LOAD, GRID, np.array(TIMES), fields=np.array([0.0, 5.0]))
    np.testing.assert_array_equal(by_array.pressure, some.pressure)
    none = vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES, fields="none")
    assert set(none.data_vars) == {*SCALARS, *ERRORS}
    np.testing.assert_array_equal(none.approach, ds.approach)
    with pytest.raises(ValueError, match=r"fields: 700 ms is not among the run's times"):
        vc.simulate(BALL, RUBBER, LOAD, GRID, TIMES, fields=[0.7])


def test_march_yields_the_dataset_state_by_state_and_reports_progress(ds: xr.Dataset) -> None:
    seen: list[tuple[float, int, int]] = []
    states = vc.march(
        *(BALL, RUBBER, LOAD, GRID, TIMES),
        progress=lambda state, done, total: seen.append((state.time, done, total)),
    )
    for k, state in enumerate(states):
        assert isinstance(state, vc.ContactState)
        assert state.time == TIMES[k]
        for name in (*SCALARS, *FIELDS):
            np.testing.assert_array_equal(getattr(state, name), ds[name][k], err_msg=name)
    assert seen == [(time, k + 1, len(TIMES)) for k, time in enumerate(TIMES)]


def test_march_refuses_bad_input_before_it_is_iterated() -> None:
    with pytest.raises(ValueError, match="indenter must be"):
        vc.march("ball", RUBBER, LOAD)


def test_indenter_of_the_same_material_doubles_the_compliance(ds: xr.Dataset) -> None:
    both = vc.simulate(
        *(BALL, RUBBER, vc.step(0.05), GRID, [0.0]), indenter_material=RUBBER, threads=2
    )
    # Hertz: a^3 ~ F J, so half the force on twice the compliance has the same contact
    np.testing.assert_allclose(both.contact_area[0], ds.contact_area[0], rtol=1e-6)


def test_tolerance_bounds_the_residual() -> None:
    for tolerance in (1e-3, 1e-9):
        ds = vc.simulate(BALL, RUBBER, vc.step(0.1), GRID, [0.0, 1.0], tolerance=tolerance)
        assert (ds.residual <= tolerance).all()
        np.testing.assert_allclose(ds.force, 0.1, rtol=tolerance)


# --- files --------------------------------------------------------------------------------------


def test_saved_result_comes_back_the_same(ds: xr.Dataset, tmp_path: Path) -> None:
    vc.save(ds, tmp_path / "run.nc")
    with vc.open_results(tmp_path / "run.nc") as back:
        xr.testing.assert_identical(back.load(), ds)
        check_variables(back)


def test_file_is_cf_netcdf_for_others_too(ds: xr.Dataset, tmp_path: Path) -> None:
    vc.save(ds, str(tmp_path / "run.nc"))
    with netCDF4.Dataset(tmp_path / "run.nc") as file:
        assert file.data_model == "NETCDF4"
        assert file.Conventions.startswith("CF-")
        assert file["pressure"].dimensions == ("time", "x", "y")
        assert file["contact_area"].units == "m2"
        assert file["time"].dtype == np.float64
        assert file["time"].units == "s"
        assert file["outcome"].flag_meanings == "converged no_contact not_converged pulled_off"
        np.testing.assert_array_equal(file["pressure"][:], ds.pressure)


def test_open_results_says_what_is_missing_or_wrong(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no result at"):
        vc.open_results(tmp_path)
    (tmp_path / "text.nc").write_text("not a result")
    with pytest.raises(ValueError, match="cannot be read"):
        vc.open_results(tmp_path / "text.nc")
