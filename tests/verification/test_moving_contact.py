"""Moving contacts against exact solutions, symmetries and the conservation of energy."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.moving_bodies import BODY, ELASTIC, J0, J1, LEVEL, TIME, ZENER, travelled
from viscontact.bodies.grid import AutomaticGrid
from viscontact.mechanics.contact.resistance import resistance_by_displacement
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_time import OverTime
from viscontact.simulation import meshing
from viscontact.simulation.transient.setup import prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


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
