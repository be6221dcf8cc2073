"""Moving contacts against exact solutions, symmetries and the conservation of energy."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
import xarray as xr

import viscontact as vc
from closeness import close_to
from viscontact.bodies.grid import AutomaticGrid
from viscontact.mechanics.contact.resistance import resistance_by_displacement
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.simulation import meshing
from viscontact.simulation.accuracy.coarser_runs import plan_coarser_runs
from viscontact.simulation.checks.motion import left_after
from viscontact.simulation.transient.setup import prepare_run

#: A Zener body that relaxes from 2000 to 200 with a retardation time of 10; J = Phi for nu = 0.
J0, J1, TIME = 1 / 2000, 1 / 200 - 1 / 2000, 10.0
ZENER = vc.Material(vc.CreepSeries(J0, [J1], [TIME]), poisson_ratio=0.0)
ELASTIC = vc.Material(vc.Elastic(1 / (2 * J0)), poisson_ratio=0.0)
BODY = vc.Paraboloid(10.0, 10.0)
LEVEL = vc.step(10.0, tilt_x=0.0, tilt_y=0.0)

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def travelled(
    material: vc.Material = ZENER,
    along: Literal["x", "y"] = "y",
    way: float = 1.6,
    *,
    cell: float = 0.08,
    cells_a_step: float = 1,
    speed: float = 0.1,
    load: Any = LEVEL,
    **options: Any,
) -> xr.Dataset:
    """A paraboloid pressed with 10 N, moved from rest over a way of some contact radii."""
    size, far = 3.2, abs(way)
    shape = [round(size / cell), round((size + far) / cell)]
    centre = [0.0, way / 2]
    if along == "x":
        shape, centre = shape[::-1], centre[::-1]
    grid = vc.Grid(
        (shape[0], shape[1]),
        (shape[0] * cell, shape[1] * cell),
        centre=(centre[0], centre[1]),
    )
    step = cells_a_step * cell / speed
    times = step * np.arange(round(far / speed / step) + 1)
    path = vc.Travel([0.0, times[-1]], **{along: [0.0, way]})
    options = {"fields": "none", "errors": False} | options
    return vc.simulate(BODY, material, load, grid, times, motion=path, **options)


@pytest.mark.slow
def test_wave_in_full_contact_loses_the_loss_modulus() -> None:
    # Without friction the wave's pressure lags by the loss angle of M*(k V): the mean of p dh/dy
    # is (k D)²/4 M''(k V), as each wave number of an elastic half-space has u = 2 J p/k.
    height, length, speed = 1e-4, 1.0, 0.05
    wave_number = 2 * np.pi / length
    loss = (1 / (J0 + J1 / (1 + 1j * wave_number * speed * TIME))).imag
    expected = wave_number**2 * height**2 / 4 * loss
    errors = []
    for count in (16, 32):
        grid = vc.Grid((4, count), (4 * length / count, length), periodic=True)
        times = np.arange(4 * count + 1) * length / count / speed
        path = vc.Travel([0.0, times[-1]], y=[0.0, 4 * length])
        ds = vc.simulate(
            vc.Waviness(height, wavelength_y=length),
            *(ZENER, vc.step(200 * grid.area), grid, times),
            motion=path,
            fields="none",
            errors=False,
        )
        assert float(ds.contact_area[-1]) == close_to(grid.area)
        errors.append(float(ds.resistance_y[-1]) / grid.area / expected - 1)
    assert errors[0] == close_to(1.77e-3, rel=0.1)
    assert 3.5 < errors[0] / errors[1] < 4.5  # of second order in step and cell


@pytest.mark.slow
def test_cylinder_reaches_the_steady_friction_of_hunter() -> None:
    # 8 times the way during the retardation time; Hunter's cylinder is in steady motion.
    speed, cell, way = 0.1, 0.02, 8.0
    count = round((way + 2.4) / cell)
    grid = vc.Grid((1, count), (1.0, count * cell), periodic=(True, False), centre=(0.0, way / 2))
    ds = vc.simulate(
        *(vc.Paraboloid(np.inf, 10.0), ZENER, LEVEL, grid),
        motion=vc.Travel([0.0, way / speed], y=[0.0, way]),
        fields="none",
        errors=False,
    )
    exact = vc.reference.moving_cylinder(10.0, 10.0, J0, J1, TIME, speed)
    assert float(ds.friction_coefficient[-1]) == close_to(exact.friction_coefficient, rel=1e-3)
    assert ds.heat.isnull().all()


def test_elastic_body_loses_nothing() -> None:
    ds = travelled(ELASTIC)
    assert float(abs(ds.resistance_y).max()) / 10 < 1e-9
    assert float(abs(ds.heat).max()) == float(abs(ds.dissipation).max()) == 0.0


def test_direction_of_motion_does_not_matter() -> None:
    first = travelled(way=0.4)
    for along, way in (("y", -0.4), ("x", 0.4), ("x", -0.4)):
        other = travelled(along=along, way=way)
        for name in ("friction_coefficient", "approach", "heat"):
            scale = float(abs(first[name]).max())
            assert other[name].values == close_to(first[name].values, abs=1e-6 * scale, nan_ok=True)
        held_back = float(other[f"resistance_{along}"][-1]) * np.sign(way)
        assert held_back == close_to(float(first.resistance_y[-1]), rel=1e-6)


def test_a_held_force_does_work_by_its_approach_alone_while_the_body_moves() -> None:
    """The motion's own work, which is most of all, is that of the resistance."""
    ds = travelled(way=0.8, cell=0.16, errors=False)
    np.testing.assert_allclose(np.diff(ds.work), 10.0 * np.diff(ds.approach), rtol=1e-6)
    assert float(ds.motion_work[-1]) > 0.1 * float(ds.work[-1] - ds.work[0])


def test_error_is_of_second_order_in_steps_of_whole_cells() -> None:
    found = [
        float(travelled(cell=0.04, cells_a_step=count).friction_coefficient[-1])
        for count in (8, 4, 2)
    ]
    finest = float(travelled(cell=0.04).friction_coefficient[-1])
    changes = np.diff([*found, finest])
    assert ((changes[:-1] / changes[1:] > 3.5) & (changes[:-1] / changes[1:] < 4.5)).all()


def test_body_with_free_tilt_turns_by_its_friction_coefficient() -> None:
    # The moment of a parabola about its axis is resistance times radius: with none, mu = -tilt.
    with pytest.warns(vc.AccuracyWarning, match="axle give tilt_y = 0"):
        ds = travelled(load=vc.step(10.0, tilt_x=0.0), fields=[16.0])
    assert ds.friction_coefficient.values[1:] == close_to(-ds.tilt_y.values[1:], rel=1e-6)
    # The slopes of the surface under it give the same force; that of a level body, which turns not,
    # is 2 % smaller so soon after the start.
    fields, grid = ds.isel(field_time=-1), vc.Grid((40, 60), (3.2, 4.8), centre=(0.0, 0.8))
    _, force = resistance_by_displacement(fields.pressure.values, fields.displacement.values, grid)
    assert float(ds.friction_coefficient[-1]) == close_to(force / 10, rel=3e-3)
    level = travelled()
    assert float(ds.friction_coefficient[-1] / level.friction_coefficient[-1]) == close_to(
        1.02, abs=0.01
    )


@pytest.mark.slow
def test_work_of_a_cycle_that_ends_unloaded_is_heat() -> None:
    # All stored energy is returned or lost until long after the load has gone.
    load = vc.ForceHistory([0, 1, 16, 17, 400], [0, 10, 10, 0, 0], tilt_x=0.0, tilt_y=0.0)
    rises, cycle = np.linspace(0, 1, 6), np.linspace(1, 16, 41)
    falls, rest = np.linspace(16, 17, 13), 17 + np.geomspace(0.2, 383, 16)
    times = np.unique(np.concatenate([rises, cycle, falls, rest]))
    grid = vc.Grid((28, 40), (3.08, 4.4))
    path = vc.reciprocating(0.6, 15.0, cycles=1)
    ds = vc.simulate(BODY, ZENER, load, grid, times, motion=path, fields="none", errors=False)
    work = float(ds.work[-1] + ds.motion_work[-1])
    assert float(ds.motion_work[-1]) > 0.3 * work
    assert float(ds.heat[-1]) == close_to(work, rel=2e-3)
    assert float(ds.dissipation[-1]) < 1e-9


def test_steps_of_a_cell_take_few_convolutions(monkeypatch: pytest.MonkeyPatch) -> None:
    import viscontact.simulation.transient.frictionless as frictionless

    counts, solve = [], frictionless.solve_contact

    def counted(*args: Any, **options: Any) -> Any:
        solution = solve(*args, **options)
        counts.append(solution.convolutions)
        return solution

    monkeypatch.setattr(frictionless, "solve_contact", counted)
    travelled(way=3.2)
    assert np.mean(counts) < 8  # 12 are allowed at a tolerance of 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("creepage", [None, 0.02])
def test_recorded_run_continues_to_the_same_bits(tmp_path: Path, creepage: float | None) -> None:
    grid = vc.Grid((20, 28), (3.2, 4.48), centre=(0.0, 0.64))
    path = vc.Travel([0.0, 6.4, 12.8], y=[0.0, 0.64, 1.28], creepage=creepage)
    grips = {} if creepage is None else {"friction": vc.Friction(0.3, coupling=False)}
    run = prepare_run(Problem(BODY, ZENER, LEVEL, grid, kept=NO_FIELDS, motion=path, **grips))
    for name, stops in (("whole", ()), ("stopped", (1, 5))):
        recorded = Recorded(tmp_path / name, OverTime(run))
        for stop in stops:
            record = _opened(recorded)
            for _ in range(stop):
                next(record.steps())
            record.checkpoint()
            record.close()
        record = _opened(recorded)
        for _ in record.steps():
            pass
        record.finish(record.estimate_errors())
        record.close()
    whole, stopped = (vc.open_results(tmp_path / name) for name in ("whole", "stopped"))
    whole.attrs = stopped.attrs = {}
    assert whole.identical(stopped)
    assert whole.sizes["time"] == 9
    assert float(whole.heat_error[-1]) > 0


def _opened(recorded: Recorded) -> Recorder:
    try:
        return Recorder.resume(recorded)
    except FileNotFoundError:
        recorded.directory.mkdir()
        return Recorder(recorded)


def test_result_is_read_as_it_was_saved(tmp_path: Path) -> None:
    ds = travelled(way=0.4)
    vc.save(ds, tmp_path / "result.nc")
    assert vc.open_results(tmp_path / "result.nc").equals(ds)


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


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"indenter_material": ZENER}, "rolling=True .* False"),
        ({"motion": vc.Travel([0, 1], y=[0, 9.0])}, "beyond the grid"),
        (
            {
                "indenter": vc.FlatPunch(0.5),
                "indenter_material": ZENER,
                "motion": vc.Travel([0, 1], y=[0, 0.4], rolling=True),
            },
            "no radius of curvature along the motion",
        ),
    ],
)
def test_what_is_not_available_is_refused_by_name(change: dict[str, Any], message: str) -> None:
    given = {"grid": vc.Grid((40, 40), (3.2, 3.2)), "motion": vc.Travel([0, 1], y=[0, 0.4])}
    given = {"indenter": BODY, "material": ZENER, "load": LEVEL} | given | change
    with pytest.raises(ValueError, match=message):
        next(vc.march(**given))


def test_contact_that_is_lost_has_no_resistance_and_returns() -> None:
    load = vc.ForceHistory([0, 2, 3, 5, 6], [10, 10, 0, 0, 10], tilt_x=0.0, tilt_y=0.0)
    ds = travelled(way=0.8, load=load)
    apart = (ds.force == 0).values
    assert apart.sum() == 3
    for name in ("resistance_y", "contact_area"):
        assert (ds[name].values[apart] == 0).all()
    assert ds.friction_coefficient.values[apart] == close_to(np.nan, nan_ok=True)
    assert (np.diff(ds.heat.values) > 0).all()  # the surface recovers
    assert float(ds.resistance_y[-1]) > 0.1


def test_given_approach_moves_at_the_height_of_its_force() -> None:
    held = travelled(way=0.4)
    load = vc.ApproachHistory(held.time.values, held.approach.values, tilt_x=0.0, tilt_y=0.0)
    given = travelled(way=0.4, load=load)
    # Between the times the approach is straight, the force of the first run is not.
    assert given.force.values == close_to(10.0, rel=1e-4)
    assert given.resistance_y.values == close_to(held.resistance_y.values, rel=1e-3, abs=1e-4)


@pytest.mark.parametrize("speed", [0.1, pytest.param(0.03, marks=pytest.mark.slow)])
def test_adaptive_steps_see_the_loss_and_meet_whole_cells(speed: float) -> None:
    grid = vc.Grid((40, 56), (3.2, 4.48), centre=(0.0, 0.64))
    given, end = (BODY, ZENER, LEVEL, grid), 1.28 / speed
    options: Any = {"motion": vc.Travel([0.0, end], y=[0.0, 1.28]), "errors": False}
    fine = vc.simulate(*given, np.linspace(0.0, end, 65), fields="none", **options)
    found = vc.simulate(*given, vc.adaptive_times(end, 1e-2), fields="none", **options)
    exact = float(fine.friction_coefficient[-1])
    # A tenth of the tolerance: measured 4e-4 and 1e-4.
    assert float(found.friction_coefficient[-1]) == close_to(exact, rel=1e-3)
    cells = found.position_y.values / 0.08
    steps = np.diff(cells)
    # Steps of up to 0.4 cells end at each cell; behind the start, of less than a tenth, at none.
    assert steps.max() < 0.5
    assert all(np.isclose(cells, cell, atol=1e-9).any() for cell in range(1, 17))
    assert len(cells) < 70


COARSE = AutomaticGrid(0.2, ["approach"])


def test_automatic_grid_covers_the_path_in_steps_of_its_cells() -> None:
    path = vc.Travel([0.0, 4.0], x=[0.3, -0.5])
    ds = vc.simulate(BODY, ELASTIC, LEVEL, COARSE, motion=path, fields=[0.0, 1.0])
    cell, reach = float(ds.x[1] - ds.x[0]), float(ds.y[-1])
    assert float(ds.x[0]) < -0.5 - 0.9 * reach
    assert float(ds.x[-1]) > 0.3 + 0.9 * reach
    ways = np.diff(ds.position_x.sel(time=ds.time != 1.0))[:-1] / cell
    assert ways == close_to(-1.0)
    assert 1.0 in ds.time
    assert ds.field_time.values.tolist() == [0.0, 1.0]


def test_automatic_grid_grows_where_a_moving_contact_outgrows_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    given = (BODY, ZENER, LEVEL, COARSE, np.linspace(0.0, 8.0, 17))
    options: Any = {"motion": vc.Travel([0.0, 8.0], y=[0.0, 0.6]), "errors": False}
    whole = vc.simulate(*given, **options)
    monkeypatch.setattr(meshing, "grid_over_path", lambda grid, motion: grid)
    grown = vc.simulate(*given, **options)
    assert "grid_enlarged" in grown.attrs
    for name in ("resistance_y", "approach", "heat"):
        scale = float(abs(whole[name]).max())
        assert grown[name].values == close_to(whole[name].values, abs=2e-3 * scale)


def test_a_jump_of_the_position_is_refused() -> None:
    with pytest.raises(ValueError, match="the position cannot jump"):
        vc.Travel([0.0, 1.0, 1.0], y=[0.0, 1.0, 2.0])


def test_two_rolling_bodies_have_the_compliance_of_both() -> None:
    path = {"way": 0.8}
    twice = vc.Material(vc.CreepSeries(2 * J0, [2 * J1], [TIME]), poisson_ratio=0.0)
    one = travelled(twice, **path)
    grid = vc.Grid((40, 50), (3.2, 4.0), centre=(0.0, 0.4))
    both = vc.simulate(
        *(BODY, ZENER, LEVEL, grid, one.time.values),
        indenter_material=ZENER,
        motion=vc.Travel([0.0, 8.0], y=[0.0, 0.8], rolling=True),
        fields="none",
        errors=False,
    )
    # Both are solved to 1e-6 of the pressure, and differ by the rounding of their compliances.
    assert both.resistance_y.values == close_to(one.resistance_y.values, rel=1e-7)


def test_long_steps_are_reported() -> None:
    with pytest.warns(vc.AccuracyWarning, match="move at most"):
        travelled(cells_a_step=5)
    with pytest.warns(vc.AccuracyWarning, match="retardation times that cause 100% of the loss"):
        travelled(speed=1e-3, way=0.4)


def messages(body: vc.Indenter, load: Any, grid: vc.Grid, motion: vc.Motion, **more: Any) -> str:
    """Warnings of the first state of a run."""
    return "; ".join(next(vc.march(body, ZENER, load, grid, motion=motion, **more)).warnings)


@pytest.mark.parametrize(("turns", "warned"), [(0.9, False), (1.1, True)])
def test_material_of_a_roller_that_returns_unrecovered_is_reported(
    turns: float, warned: bool
) -> None:
    radius = 1.0
    way = turns * 2 * np.pi * radius
    grid = vc.Grid((1, 80), (1.0, 10.0), periodic=(True, False), centre=(0.0, way / 2))
    path = vc.Travel([0.0, way / 0.5], y=[0.0, way], rolling=True)
    body, load = vc.Paraboloid(np.inf, radius), vc.step(10.0, tilt_y=0.0)
    found = messages(body, load, grid, path, indenter_material=ZENER)
    assert ("earlier turns are not included" in found) is warned


def test_deflection_left_after_a_turn_is_that_of_a_kelvin_body() -> None:
    """A Kelvin body that is unloaded recovers as the exponential of time over its retardation."""
    turn, load = 3.0, 0.3
    held = J1 * (1 - np.exp(-load / TIME))
    exact = held * np.exp(-turn / TIME) / (J0 + held)
    compliance = vc.Material(vc.CreepSeries(J0, [J1], [TIME]), 0.0).contact_compliance()
    assert left_after(compliance, turn) == close_to(exact, rel=1e-9)


def test_free_tilt_along_the_motion_is_reported_for_a_line_contact_as_well() -> None:
    body, free = vc.Paraboloid(np.inf, 10.0), vc.step(10.0)
    strip = vc.Grid((1, 60), (1.0, 4.0), periodic=(True, False))
    path = vc.Travel([0.0, 1.0], y=[0.0, 0.1])
    assert "tilt_y is free of moment" in messages(body, free, strip, path)
    assert "tilt_x" not in messages(body, free, strip, path)
    held = vc.step(10.0, tilt_y=0.0)
    assert "free of moment" not in messages(body, held, strip, path)


def test_punch_that_moves_by_parts_of_cells_has_no_pressure_beyond_its_ends() -> None:
    """A path and its mirror image are alike, on a grid whose cells the ends of the body cross."""
    ways = []
    for sign in (1.0, -1.0):
        path = vc.Travel([0.0, 5.0], y=[0.0, sign * 0.5])
        grid, times = vc.Grid((16, 24), (4.0, 6.0)), np.linspace(0.0, 5.0, 11)
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            states = list(vc.march(vc.FlatPunch(1.0), ZENER, LEVEL, grid, times, motion=path))
        for state in states:
            offset = np.hypot(state.grid.x[:, None], state.grid.y - sign * 0.1 * state.time)
            assert (state.pressure[offset > 1.0] == 0).all()
            assert state.force == close_to(10.0, rel=1e-6)
        ways.append([state.approach for state in states])
    assert ways[0] == close_to(ways[1], rel=1e-5)


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


@pytest.mark.parametrize("periodic", [(False, True), (True, False), (False, False), (True, True)])
def test_bodies_that_follow_each_other_are_reported(periodic: tuple[bool, bool]) -> None:
    """The track of the body ahead lowers the friction of one that meets it."""
    grid = vc.Grid((24, 24), (3.2, 3.2), periodic=periodic)
    load = vc.step(10.0, tilt_x=0.0, tilt_y=0.0)
    found = messages(BODY, load, grid, vc.Travel([0.0, 1.0], y=[0.0, 0.1]))
    assert ("meets their tracks" in found) is (periodic == (False, True))


def test_heat_that_is_not_known_has_a_reason() -> None:
    power = vc.Material(vc.PowerLaw(1e-3, 0.3, 1.0, instant=J0), poisson_ratio=0.5)
    grid, path = vc.Grid((24, 24), (4.0, 4.0)), vc.Travel([0.0, 1.0], y=[0.0, 0.1])
    state = next(vc.march(BODY, power, LEVEL, grid, motion=path))
    assert np.isnan(state.heat)
    assert any("dissipation and heat are not known" in text for text in state.warnings)
    assert "heat are not known" not in messages(BODY, LEVEL, grid, path)
