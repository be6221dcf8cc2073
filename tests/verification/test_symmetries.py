"""What must not matter: handedness, names of the axes, place, units, the clock, the route.

Truth: the equations of the half-space are covariant under all of these (Johnson 1985, ch. 3 and
4, for the elastic scaling; Lee & Radok 1960 for c J with W/c). A pair of runs differs by the
solver's tolerance times its conditioning; what is compared is relative to the largest value.
"""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from returned import some

TOLERANCE = 1e-8

# Ten times the tolerance, as pressure answers more sharply than the gap. Measured: 2e-8 where the
# runs of a pair take different routes, 1e-13 where they take the same.
BOUND = 10 * TOLERANCE

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

rubber = vc.Material(vc.Zener(1e6, 5e5, 5e5), 0.4)
axis_x, axis_y = np.linspace(-0.5, 0.5, 31), np.linspace(-0.4, 0.4, 27)
height = 2e-3 * np.random.default_rng(11).standard_normal((31, 27))
height -= 0.05 * (axis_x[:, None] ** 2 + 2 * axis_y[None, :] ** 2)
lump = vc.HeightMap(axis_x, axis_y, height)
grid = vc.Grid((45, 40), (1.2, 1.0))
times = vc.log_times(0.1, 6.0, 5)
load = vc.ForceHistory([0, 1, 3, 4], [0.0, 2e3, 2e3, 5e2], 0.03, -0.05)
SCALARS = ("force", "approach", "contact_area", "peak_pressure", "mean_pressure", "work")


def run(*case, tolerance=TOLERANCE, **options):
    return list(vc.march(*case, tolerance=tolerance, **options))


def distance(one, other):
    """Largest difference of two arrays, relative to their largest value."""
    one, other = np.asarray(one), np.asarray(other)
    finite = np.isfinite(one)
    assert (finite == np.isfinite(other)).all()
    worst = np.abs(one[finite] - other[finite]).max(initial=0.0)
    return worst / np.abs(one[finite]).max(initial=1e-300)


def assert_same(ours, theirs, picture=lambda field: field, names=SCALARS):
    for one, other in some(zip(ours, theirs, strict=True)):
        for name in ("pressure", "gap", "displacement"):
            assert distance(picture(getattr(one, name)), getattr(other, name)) < BOUND, name
        for name in names:
            assert distance(getattr(one, name), getattr(other, name)) < BOUND, name


def assert_tilts(ours, theirs, sign_x, sign_y):
    for tilt, sign in (("tilt_x", sign_x), ("tilt_y", sign_y)):
        mine = np.array([getattr(state, tilt) for state in ours])
        assert np.abs(mine).max() > 1e-4
        assert distance(mine, [sign * getattr(state, tilt) for state in theirs]) < BOUND


@pytest.fixture(scope="module")
def original():
    return run(lump, rubber, load, grid, times)


def test_mirrored_along_x_the_field_is_mirrored_and_the_tilt_opposite(original):
    mirrored = vc.HeightMap(axis_x, axis_y, height[::-1])
    other = vc.ForceHistory(load.times, load.force, -0.03, -0.05)
    theirs = run(mirrored, rubber, other, grid, times)
    assert_same(original, theirs, lambda field: field[::-1])
    assert_tilts(original, theirs, -1, 1)


def test_mirrored_along_y_the_field_is_mirrored_and_the_tilt_opposite(original):
    mirrored = vc.HeightMap(axis_x, axis_y, height[:, ::-1])
    other = vc.ForceHistory(load.times, load.force, 0.03, 0.05)
    theirs = run(mirrored, rubber, other, grid, times)
    assert_same(original, theirs, lambda field: field[:, ::-1])
    assert_tilts(original, theirs, 1, -1)


def test_axes_swapped_give_the_transposed_field(original):
    swapped = vc.HeightMap(axis_y, axis_x, height.T)
    other = vc.ForceHistory(load.times, load.force, -0.05, 0.03)
    theirs = run(swapped, rubber, other, vc.Grid((40, 45), (1.0, 1.2)), times)
    assert_same(original, theirs, lambda field: field.T)
    for state, turned in zip(original, theirs, strict=True):
        assert abs(state.tilt_x - turned.tilt_y) < BOUND
        assert abs(state.contact_length - turned.contact_width) < BOUND


def test_moved_body_and_moved_force_move_the_field(original):
    shift = 3 * grid.cell_size[0]
    moved = vc.HeightMap(axis_x + shift, axis_y, height)
    other = vc.ForceHistory(load.times, load.force, 0.03 + shift, -0.05)
    wide = vc.Grid((51, 40), (51 * grid.cell_size[0], 1.0))
    theirs = run(moved, rubber, other, wide, times)
    for one, state in some(zip(original, theirs, strict=True)):
        assert distance(one.pressure, state.pressure[6:]) < BOUND
        assert distance(one.displacement, state.displacement[6:]) < BOUND
        assert distance(one.tilt_x, state.tilt_x) < BOUND
        assert abs(one.approach - state.approach - state.tilt_x * shift) < BOUND * one.approach


def test_moved_body_force_and_grid_keep_the_field_and_move_its_moments(original):
    shift = np.array([2.5, -1.75])
    moved = vc.HeightMap(axis_x + shift[0], axis_y + shift[1], height)
    other = vc.ForceHistory(load.times, load.force, 0.03 + shift[0], -0.05 + shift[1])
    there = vc.Grid(grid.shape, grid.size, centre=tuple(shift))
    theirs = run(moved, rubber, other, there, times)
    names = [name for name in SCALARS if name != "approach"]
    assert_same(original, theirs, names=names)
    assert_tilts(original, theirs, 1, 1)
    for one, state in zip(original, theirs, strict=True):
        tilts = np.array([state.tilt_x, state.tilt_y])
        assert abs(one.approach - state.approach - tilts @ shift) < BOUND * abs(one.approach)
        at, there = ([each.eccentricity_x, each.eccentricity_y] for each in (one, state))
        assert one.force == 0 or distance(np.add(at, shift), there) < BOUND


def test_level_ball_on_a_grid_around_it_has_its_values_bars_and_place_anywhere():
    """Even about the middle of its grid, which is no symmetry of the moments about the origin."""
    ball, gentle = vc.Paraboloid(1.0, 1.2), vc.triangle(300.0, 1.0, tilt_x=0.0, tilt_y=0.0)
    (x, y), cells = (3.0, -0.5), ((36, 32), (1.1, 1.1))
    here, there = (
        vc.simulate(body, rubber, gentle, where, vc.uniform_times(2.0, 12), tolerance=TOLERANCE)
        for body, where in (
            (ball, vc.Grid(*cells)),
            (ball.shifted(x, y), vc.Grid(*cells, centre=(x, y))),
        )
    )
    assert distance(here.pressure, there.pressure) < BOUND
    assert here.pressure.values.max() > 0
    for name in SCALARS:
        assert distance(here[name], there[name]) < BOUND, name
        assert distance(here[f"{name}_error"], there[f"{name}_error"]) < 1e-3, name
    touching = here.force.values > 0
    assert there.eccentricity_x.values[touching] == close_to(x, abs=1e-7)
    assert there.eccentricity_y.values[touching] == close_to(y, abs=1e-7)
    assert np.allclose(there.x - x, here.x, rtol=0, atol=1e-15)


@pytest.mark.parametrize("c", [7.0, 1e-4])
def test_softer_body_and_smaller_force_keep_the_contact(original, c):
    softer = vc.Material(vc.Zener(1e6 / c, 5e5 / c, 5e5 / c), 0.4)
    other = vc.ForceHistory(load.times, load.force / c, 0.03, -0.05)
    theirs = run(lump, softer, other, grid, times)
    for one, state in some(zip(original, theirs, strict=True)):
        assert ((one.pressure > 0) == (state.pressure > 0)).all()
        assert distance(one.pressure, c * state.pressure) < BOUND
        for name in ("approach", "contact_area", "tilt_x", "tilt_y", "displacement"):
            assert distance(getattr(one, name), getattr(state, name)) < BOUND, name


def test_two_alike_bodies_are_one_of_twice_the_compliance():
    softer = vc.Material(vc.Zener(5e5, 2.5e5, 2.5e5), 0.4)
    both = run(lump, rubber, load, grid, times, indenter_material=rubber)
    assert_same(run(lump, softer, load, grid, times), both)


def test_a_later_start_only_shifts_the_clock(original):
    late = vc.ForceHistory(load.times + 100.0, load.force, 0.03, -0.05)
    before, *theirs = run(lump, rubber, late, grid, np.concatenate([[50.0], times + 100.0]))
    assert before.force == 0.0
    assert_same(original, theirs)


def test_a_long_rest_after_unloading_forgets():
    # The dent of a Zener body fades as exp(-t/tau), tau = 1 s: after 40 s by 4e-18.
    again = vc.ForceHistory([0, 1, 1, 41, 41], [2e3, 2e3, 0, 0, 1e3], 0.03, -0.05)
    fresh = vc.ForceHistory([0], [1e3], 0.03, -0.05)
    *_, second = run(lump, rubber, again, grid, [0.0, 1.0, 41.0])
    (first,) = run(lump, rubber, fresh, grid, [0.0])
    assert distance(first.pressure, second.pressure) < BOUND
    assert distance(first.approach, second.approach) < BOUND


@pytest.mark.parametrize("shape", [(64, 40), (63, 40)])
@pytest.mark.parametrize("eccentricity", [0.0, 1.2])
def test_working_with_one_half_of_a_symmetric_problem_changes_nothing(shape, eccentricity):
    # A force beside the axis by a part in 1e30 is on it for all but the choice of the route.
    roller, cells = vc.Roller(1.0, 2.0, 15.0), vc.Grid(shape, (6.0, 0.6))
    centred = vc.step(2e4, eccentricity_x=eccentricity)
    beside = vc.step(2e4, eccentricity_x=eccentricity, eccentricity_y=1e-30)
    # Two searches of different sizes stop at different pressures, so both go farther than usual.
    half, whole = (
        run(roller, rubber, each, cells, times, tolerance=TOLERANCE / 100)
        for each in (centred, beside)
    )
    assert_same(half, whole)
    assert all((state.pressure == state.pressure[:, ::-1]).all() for state in half)
