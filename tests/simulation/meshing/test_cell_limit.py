"""Automatic grids whose cells are no larger than a limit."""

import math

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.meshing.cell_limit import with_small_cells
from viscontact.simulation.transient.setup import prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

STIFF = vc.Material(vc.Elastic(1e9), 0.4)
ROLLER = vc.Roller(5e-3, 8e-3)


def grid_of(body, load, **limits):
    return prepare_run(Problem(body, STIFF, load, vc.AutomaticGrid(**limits), [0.0])).grid


@pytest.mark.parametrize("part", [(0.3, 0.9), (0.9, 0.3), (2.0, 0.5), (0.7, 2.0)])
def test_cells_have_the_limit_where_the_tolerance_allows_larger_ones(part):
    ball, load = vc.Sphere(0.01), vc.step(50.0)
    own = grid_of(ball, load)
    limit = tuple(length * p for length, p in zip(own.cell_size, part, strict=True))
    grid = grid_of(ball, load, largest_cell=limit)
    assert grid.cell_size == close_to(np.minimum(own.cell_size, limit).tolist(), rel=1e-12)
    assert all(np.greater_equal(grid.size, np.multiply(own.size, 1 - 1e-6)))
    assert not any(count % 4 for count in grid.shape)


def test_limits_above_the_chosen_cells_change_nothing():
    load = vc.step(200.0)
    own = grid_of(ROLLER, load)
    assert grid_of(ROLLER, load, largest_cell=own.cell_size) == own
    assert grid_of(ROLLER, load, largest_cell=(1.0, 1.0)) == own


def test_small_cells_end_where_the_body_ends():
    for limit in (260e-6, 110e-6):
        dx, dy = grid_of(ROLLER, vc.step(200.0), largest_cell=(limit, 8e-6)).cell_size
        assert dy == close_to(8e-6, rel=1e-12)
        assert 0.9 * limit < dx <= limit
        assert 8e-3 / (2 * dx) == close_to(round(8e-3 / (2 * dx)), abs=1e-9)


def test_limit_that_divides_the_body_is_the_cell_in_spite_of_rounding():
    """2.6 mm are 13 pairs of 0.1 mm, and in floating point a little more."""
    grid = vc.Grid((16, 16), (8e-3, 8e-3))
    end = 26 * 1e-4
    assert end / (2 * 1e-4) > 13
    found = with_small_cells(grid, (1e-4, 1.0), (end, np.inf))
    assert found.cell_size == close_to((1e-4, 0.5e-3), rel=1e-12)


def test_equal_cells_give_equal_limits_of_rollers_on_any_load():
    """The cells of one load, written with nine digits, are those of every other."""
    dx, dy = grid_of(ROLLER, vc.step(75.0)).cell_size
    limit = (float(f"{dx:.9g}"), float(f"{dy:.9g}"))
    for force in (75.0, 400.0):
        assert grid_of(ROLLER, vc.step(force), largest_cell=limit).cell_size == close_to(
            (dx, dy), rel=2e-9
        )


def test_errors_expected_on_larger_cells_hold_on_smaller_ones():
    """Hertz (1882): peak pressure, area and approach of a ball."""
    ball, load, modulus = vc.Sphere(0.01), vc.step(50.0), 1 / STIFF.contact_compliance()(0.0)
    own = grid_of(ball, load)
    limit = (0.37 * own.cell_size[0], 0.45 * own.cell_size[1])
    run = prepare_run(Problem(ball, STIFF, load, vc.AutomaticGrid(largest_cell=limit), [0.0]))
    ds = vc.simulate(ball, STIFF, load, run.grid, [0.0], errors=False)
    exact = vc.reference.hertz_sphere(50.0, 0.01, modulus)
    truths = {
        "peak_pressure": exact.peak_pressure,
        "contact_area": math.pi * exact.contact_radius**2,
        "approach": exact.approach,
    }
    assert run.mesh is not None
    for name, truth in truths.items():
        assert abs(float(ds[name][0]) / truth - 1) <= run.mesh.errors[name]


def test_cells_beyond_any_grid_are_refused():
    with pytest.raises(
        ValueError, match=r"grid\.largest_cell: .* 4e\+08, more than .* allow larger"
    ):
        with_small_cells(Grid((40, 40), (1.0, 1.0)), (5e-5, 5e-5), (math.inf, math.inf))


@pytest.mark.parametrize(
    ("given", "complaint"),
    [
        (1e-5, "grid.largest_cell needs two entries"),
        ((1e-5, -1e-5), "grid.largest_cell: dy must be"),
        ((math.inf, 1e-5), "grid.largest_cell: dx must be"),
    ],
)
def test_limits_that_are_no_lengths_are_refused(given, complaint):
    with pytest.raises(ValueError, match=complaint):
        vc.AutomaticGrid(largest_cell=given)
