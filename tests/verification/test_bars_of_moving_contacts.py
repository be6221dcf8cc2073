"""Error bars of moving contacts, and values that they leave unknown."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from verification.moving_bodies import BODY, LEVEL, ZENER, travelled
from viscontact.mechanics.contact.resistance import resistance_by_displacement
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.coarser_runs import plan_coarser_runs
from viscontact.simulation.transient.setup import prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


#: Scalars with error bars whose values depend on the motion.
ESTIMATED = ("resistance_y", "friction_coefficient", "motion_work", "dissipation", "heat")

#: Largest bars at the end of the run below over the values.
LARGEST_BARS = dict.fromkeys(ESTIMATED, 0.17) | {
    "approach": 0.015,
    "work": 0.03,
    "contact_area": 0.13,
    "peak_pressure": 0.6,
}


@pytest.mark.parametrize("cells_a_step", [1, pytest.param(0.7, marks=pytest.mark.slow)])
def test_error_bars_hold_the_values_on_finer_cells(cells_a_step: float) -> None:
    way = {"way": 1.68, "speed": 0.2}
    ds = travelled(cell=0.08, cells_a_step=cells_a_step, errors=True, **way)
    finer = travelled(cell=0.04, cells_a_step=cells_a_step, **way)
    finer = finer.sel(time=ds.time, method="nearest", tolerance=1e-9)
    for name, largest in LARGEST_BARS.items():
        error, bar = abs(ds[name] - finer[name]), ds[f"{name}_error"]
        assert float((error[1:] <= bar[1:]).mean()) > 0.9, name
        assert float(bar[-1] / ds[name][-1]) < largest, name


@pytest.mark.parametrize(
    ("body", "along"),
    [
        (ZENER, "y"),
        pytest.param(vc.Layered([vc.Layer(0.5, ZENER)], base="rigid"), "x", marks=pytest.mark.slow),
    ],
)
def test_area_of_a_moving_strip_is_about_as_certain_as_its_width(body: Any, along: str) -> None:
    """Both are off by the two straight rims, so that their relative errors are equal."""
    way, speed = 0.48, 0.2

    def strip(cell: float, *, errors: bool) -> xr.Dataset:
        count = round((way + 2.4) / cell)
        shape, size, centre = (1, count), (1.0, count * cell), (0.0, way / 2)
        radii = (np.inf, 10.0)
        if along == "x":
            shape, size, centre, radii = shape[::-1], size[::-1], centre[::-1], radii[::-1]
        grid = vc.Grid(shape, size, periodic=(along == "y", along == "x"), centre=centre)
        path = vc.Travel([0.0, way / speed], **{along: [0.0, way]})
        options = {"motion": path, "fields": "none", "errors": errors}
        return vc.simulate(vc.Paraboloid(*radii), body, LEVEL, grid, **options)

    ds = strip(0.04, errors=True)
    finer = strip(0.01, errors=False).sel(time=ds.time, method="nearest", tolerance=1e-9)
    error, bar = abs(ds.contact_area - finer.contact_area), ds.contact_area_error
    assert float((error[1:] <= bar[1:]).mean()) > 0.9
    width = "contact_width" if along == "y" else "contact_length"
    of_width = ds[f"{width}_error"] / ds[width]
    assert (bar / ds.contact_area).values[1:] == close_to(of_width.values[1:], rel=0.6)
    assert float((bar / ds.contact_area)[1:].max()) < 0.05


def test_nothing_is_uncertain_before_the_first_contact() -> None:
    load = vc.ForceHistory([0, 1, 4, 5], [0, 10, 10, 0], tilt_x=0.0, tilt_y=0.0)
    ds = travelled(way=0.64, load=load, errors=True)
    for name in ("resistance_y", "motion_work", "dissipation", "heat"):
        assert float(ds[f"{name}_error"][0]) == 0.0
    apart = (ds.force == 0).values
    assert (ds.resistance_y_error.values[apart] == 0).all()
    assert (ds.heat_error.values[apart][1:] > 0).all()


def test_coarser_runs_move_by_whole_cells_that_lie_alike() -> None:
    grid = vc.Grid((60, 80), (3.0, 4.0), centre=(0.0, 0.36))
    path = vc.Travel([0.0, 4.0, 8.0], y=[0.0, 0.6, 0.0])
    run = prepare_run(Problem(BODY, ZENER, LEVEL, grid, motion=path))
    history = {
        "time": run.problem.instants,
        "time_error": np.ones(run.problem.instants.size),
        "peak_pressure": np.ones(run.problem.instants.size),
        "cells_across": np.array([15.0]),
    }
    planned = list(plan_coarser_runs(run, history))
    assert [coarser.divides_steps for coarser in planned] == [False, False, True]
    for coarser in planned[:2]:
        own = (path.position_at(coarser.run.problem.instants) - coarser.run.grid.y[0])[:, 1]
        parts = own / coarser.run.grid.cell_size[1] % 1
        assert parts == close_to((0.0 - grid.y[0]) / 0.05 % 1)


def test_force_on_the_edge_of_a_punch_is_not_known() -> None:
    grid = vc.Grid((20, 24), (2.0, 2.4), centre=(0.0, 0.2))
    with pytest.warns(vc.AccuracyWarning, match="force on this edge is not computed"):
        ds = vc.simulate(
            *(vc.FlatPunch(0.5), ZENER, LEVEL, grid),
            motion=vc.Travel([0.0, 4.0], y=[0.0, 0.4]),
            errors=False,
        )
    for name in ("resistance_y", "friction_coefficient", "motion_work"):
        assert ds[name][1:].isnull().all()
    assert (ds.resistance_x == 0).all()
    assert (ds.dissipation > 0).all()


@pytest.mark.parametrize("moving", ["transient", "steady"])
def test_force_across_the_motion_is_unknown_at_sharp_ends_unless_the_contact_is_even(
    moving: str,
) -> None:
    """Both forms of the resistance agree on a smooth body; at a sharp end neither has a limit.

    By symmetry there is no force across under a level body.
    """
    rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    eccentric = vc.step(5.0, eccentricity_x=1e-3, tilt_y=0.0)
    level = vc.step(5.0, tilt_x=0.0, tilt_y=0.0)
    sharp, smooth = vc.Roller(20e-3, 5e-3), vc.Paraboloid(30e-3, 20e-3)
    grid = vc.Grid((36, 36), (16e-3, 12e-3), centre=(0.0, 0.5e-3))

    def last(body: vc.Indenter, load: Any) -> xr.Dataset:
        if moving == "steady":
            return vc.steady(body, rubber, load, 0.05, grid=grid, errors=False).isel(speed=0)
        path = vc.Travel([0.0, 0.02], y=[0.0, 1e-3])
        times = [0.0, 0.01, 0.02]
        ds = vc.simulate(body, rubber, load, grid, times, motion=path, errors=False)
        return ds.isel(time=-1)

    with pytest.warns(vc.AccuracyWarning, match="end of the body across the motion"):
        free = last(sharp, eccentric)
    assert np.isnan(free.resistance_x)
    assert free.friction_coefficient > 0
    assert float(last(sharp, level).resistance_x) == close_to(0.0, abs=1e-12)
    rounded = last(smooth, eccentric)
    pressure, displacement = rounded.pressure.values, rounded.displacement.values
    other = resistance_by_displacement(pressure, displacement, grid)[0]
    slope_part = abs(5.0 * float(rounded.tilt_x))  # cancels almost
    assert float(rounded.resistance_x) == close_to(other, abs=0.01 * slope_part)
