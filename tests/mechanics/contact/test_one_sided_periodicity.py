"""Grids that are periodic along one axis only: the pair, what is refused, symmetries."""

import json
import math
import pickle

import numpy as np
import pytest
from scipy.special import zeta

import viscontact as vc
from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.problem import Problem
from viscontact.results.descriptions import describe, rebuild
from viscontact.results.recorded_case import recorded_grid
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.setup import prepare_run

RUBBER = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
CYLINDER = vc.Paraboloid(math.inf, 0.01)
#: A line load of 100 N/m: half width 0.56 mm.
PERIOD, LOAD = 1e-3, vc.step(0.1)
STRIP = Grid((1, 48), (PERIOD, 2.4e-3), periodic=(True, False))

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def run(indenter=CYLINDER, load=LOAD, grid=STRIP, **options):
    return vc.simulate(indenter, RUBBER, load, grid, [0.0], errors=False, **options)


@pytest.mark.parametrize("one", [True, False])
def test_a_pair_of_equals_is_that_bool(one):
    """It compares, hashes, prints and is recorded as the bool that earlier versions knew."""
    single, pair = (Grid((4, 8), (0.1, 0.2), periodic=each) for each in (one, (one, one)))
    assert single == pair
    assert hash(single) == hash(pair)
    assert f"{single!r}" == f"{pair!r}"
    assert f"periodic={one}" in f"{pair!r}"
    assert describe(pair)["periodic"] is one
    assert rebuild(describe(pair)) == single
    assert tuple(single.periodic) == (one, one)
    assert bool(single.periodic) is one


def test_a_pair_is_kept():
    assert STRIP.periodic == (True, False)
    assert Grid(STRIP.shape, STRIP.size, periodic=True) != STRIP
    assert pickle.loads(pickle.dumps(STRIP)) == STRIP
    assert rebuild(json.loads(json.dumps(describe(STRIP)))) == STRIP
    assert "periodic=(True, False)" in repr(STRIP)
    with pytest.raises(ValueError, match=r"\(True, False\) is neither true nor false"):
        bool(STRIP.periodic)


@pytest.mark.parametrize("given", [(True,), (1, 0), (True, None), (True, False, True)])
def test_anything_else_is_refused(given):
    with pytest.raises(ValueError, match=r"grid\.periodic must be true or false, got"):
        Grid((4, 8), (0.1, 0.2), periodic=given)


@pytest.mark.parametrize("shape", [(1, 8), (3, 8), (8, 3), (2, 8)])
def test_single_cells_need_a_period(shape):
    with pytest.raises(ValueError, match=r"grid\.shape: n[xy] must be a whole number >= 4"):
        Grid(shape, (1.0, 1.0), periodic=(shape[0] > 1, shape[0] == 3))


def test_approach_and_work_have_no_datum():
    """They are NaN, and one warning gives the reason."""
    ds = run()
    for name in ("approach", "work", "loss_per_cycle", "eccentricity_x"):
        assert np.isnan(ds[name].values).all()
    assert float(ds.force[0]) == close_to(0.1)
    assert float(abs(ds.eccentricity_y[0])) < 1e-9
    assert ds.attrs["warnings"].count("has no datum") == 1


@pytest.mark.parametrize(
    ("indenter", "load", "message"),
    [
        (CYLINDER, vc.step(approach=1e-5), r"load\.approach: .* give the force, or use .*=False"),
        (CYLINDER, vc.step(0.1, eccentricity_x=1e-5), r"load\.eccentricity_x: must be 0"),
        (CYLINDER, vc.step(0.1, tilt_x=1e-5), r"load\.tilt_x: must be 0"),
        (CYLINDER, vc.step(0.1, eccentricity_y=2e-3), r"load\.eccentricity_y: the force acts at"),
        (vc.Sphere(0.01), LOAD, r"grid\.shape: a single cell along x holds a body along which"),
        (CYLINDER.rotated(math.pi / 2), LOAD, r"grid\.periodic: the body continues along y"),
        (CYLINDER.rotated(0.1), LOAD, r"grid\.periodic: the body continues along y"),
    ],
)
def test_refused_on_a_strip(indenter, load, message):
    with pytest.raises(ValueError, match=message):
        run(indenter, load)


def test_a_cylinder_needs_a_period_along_it():
    with pytest.raises(ValueError, match=r"grid\.periodic: the body continues along x without"):
        run(grid=Grid((48, 48), (2.4e-3, 2.4e-3)))


def test_automatic_grids_of_a_cylinder_have_a_period_of_a_metre_in_one_cell():
    grid = vc.auto_grid(CYLINDER, RUBBER, LOAD)
    assert tuple(grid.periodic) == (True, False)
    assert (grid.shape[0], grid.size[0]) == (1, 1.0)


def test_two_crossed_cylinders_need_none():
    """Their sum is a paraboloid."""
    grid = Grid((24, 24), (2e-3, 2e-3))
    crossed = run(CYLINDER + CYLINDER.rotated(math.pi / 2), grid=grid)
    assert crossed.pressure.equals(run(vc.Paraboloid(0.01, 0.01), grid=grid).pressure)


def test_contact_at_the_free_rim_stops_the_run():
    with pytest.raises(vc.DomainError, match="the contact reaches the edge of the grid"):
        run(grid=Grid((1, 16), (PERIOD, 1e-3), periodic=(True, False)))


def test_periods_along_x_and_along_y_are_the_same():
    """Turned by a quarter, and on as many cells along as one likes."""
    along = run(grid=Grid((6, 48), STRIP.size, periodic=(True, False)), tolerance=1e-9)
    turned = run(
        CYLINDER.rotated(math.pi / 2),
        grid=Grid((48, 6), STRIP.size[::-1], periodic=(False, True)),
        tolerance=1e-9,
    )
    peak = float(along.peak_pressure[0])
    fields = along.pressure.values[0], turned.pressure.values[0].T
    assert np.abs(fields[0] - fields[1]).max() < 1e-8 * peak
    assert np.abs(fields[0] - run(tolerance=1e-9).pressure.values[0]).max() < 1e-8 * peak
    assert float(turned.contact_length[0]) == close_to(float(along.contact_width[0]))
    assert float(along.contact_length[0]) == PERIOD


def test_length_of_the_period_does_not_matter():
    """The line load does: force / lx."""
    longer = Grid((1, 48), (100 * PERIOD, STRIP.size[1]), periodic=(True, False))
    one, other = run(tolerance=1e-9), run(load=vc.step(10.0), grid=longer, tolerance=1e-9)
    assert np.allclose(one.pressure, other.pressure, rtol=1e-7, atol=1e-7 * one.peak_pressure)
    assert float(one.peak_line_load[0]) == close_to(100.0)


def test_a_ball_in_a_row_has_the_contact_of_a_longer_paraboloid():
    """The others displace the surface under it as forces at points, F/(π E* r) (Boussinesq).

    Its curvature, 2 F/(π E* r³) along the row and minus half of it across, is added to the ball's.
    """
    ball, pitch, force, cells = vc.Paraboloid(0.01, 0.01), 1.2e-3, 0.03, (24, 24)
    curved = 4 * zeta(3) * force / (np.pi * 4e6 * pitch**3)
    alike = vc.Paraboloid(1 / (100 + curved), 1 / (100 - curved / 2))
    row = run(ball, vc.step(force), Grid(cells, (pitch, pitch), periodic=(True, False)))
    one, alone = (run(body, vc.step(force), Grid(cells, (pitch, pitch))) for body in (alike, ball))
    for name in ("contact_length", "contact_width", "peak_pressure"):
        change, expected = (float(each[name][0] - alone[name][0]) for each in (row, one))
        # The next term is of the order (a/pitch)² = 0.1 of the change.
        assert change == close_to(expected, rel=0.15), name
        assert abs(expected) > 0.01 * float(alone[name][0])


def test_a_moved_body_moves_its_contact():
    """Across by whole cells, with the load on its axis."""
    ball, grid = vc.Paraboloid(0.01, 0.01), Grid((24, 32), (1.2e-3, 1.6e-3), periodic=(True, False))
    still = run(ball, vc.step(0.03), grid, tolerance=1e-9).pressure.values[0]
    moved = run(
        ball.shifted(y=2 * grid.cell_size[1]),
        vc.step(0.03, eccentricity_y=2 * grid.cell_size[1]),
        grid,
        tolerance=1e-9,
    ).pressure.values[0]
    assert np.abs(np.roll(still, 2, axis=1) - moved).max() < 1e-7 * still.max()


def test_result_is_read_back(tmp_path):
    """A single cell's length is not in the coordinates."""
    path = tmp_path / "strip.nc"
    vc.save(run(), path)
    with vc.open_results(path) as ds:
        assert recorded_grid(ds).periodic == STRIP.periodic
        assert recorded_grid(ds).size == close_to(STRIP.size)
        for figure in (vc.plot.pressure_map, vc.plot.pressure_profile, vc.plot.line_load):
            figure(ds)


def test_a_stopped_run_continues():
    """To the same numbers, with a work that is not a number."""
    rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    setup = prepare_run(Problem(CYLINDER, rubber, LOAD, STRIP, [0.0, 0.5, 1.0]))
    begun = March(setup)
    steps = iter(begun)
    next(steps)
    resumed = list(March(setup, begun.restart_data()))
    assert resumed
    for one, other in zip(steps, resumed, strict=True):
        assert np.array_equal(one.pressure, other.pressure)
        assert math.isnan(other.work)


def test_the_card_of_a_grid_names_the_axis():
    assert "periodic  along x" in str(STRIP)


@pytest.mark.parametrize("body", [vc.Wedge(1.5), vc.Swept([0.0, 1e-3], [0.0, 1e-4])])
def test_edges_without_end_need_a_period_along_them(body):
    assert body.endless == (True, False)
    with pytest.raises(ValueError, match=r"grid\.periodic: the body continues along x without"):
        run(body, grid=Grid((24, 24), (2e-3, 2e-3)))
    assert float(run(body).force[0]) == close_to(0.1)


def test_figures_of_a_cylinder_are_across_it():
    """Its force per length is its line load, which the history draws where it varies."""
    ds = vc.simulate(CYLINDER, RUBBER, vc.ramp(0.1, 1.0), STRIP, [0.5, 1.0], errors=False)
    assert vc.plot.pressure_profile(ds).axes[0].get_xlabel() == "y [µm]"
    assert vc.plot.pressure_profile(ds, along="x").axes[0].get_xlabel() == "x [µm]"
    labels = [axes.get_ylabel() for axes in vc.plot.history(ds).axes]
    assert labels[0].startswith("Force per length")
    assert not any("pproach" in label for label in labels)
    held = vc.simulate(CYLINDER, RUBBER, LOAD, STRIP, [0.5, 1.0], errors=False)
    labels = [axes.get_ylabel() for axes in vc.plot.history(held).axes]
    assert labels
    assert not any("line load" in label for label in labels)
