"""Bars of sequences of values whose limit is known by construction.

The scalars of the run and of its coarser runs are replaced by values with a given error of the
cells and of the steps. The error of the run's own values is then known without any contact theory.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.coarser_results import CoarserResult, History, history_of
from viscontact.simulation.accuracy.coarser_runs import march_coarser_run, plan_coarser_runs
from viscontact.simulation.accuracy.error_bars import error_bars_from
from viscontact.simulation.accuracy.least_bars import least_resistance_bar
from viscontact.simulation.accuracy.least_peak_bars import entry_rise
from viscontact.simulation.transient.setup import RunSetup, prepare_run
from viscontact.simulation.transient.state_generator import march_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

Solved = tuple[RunSetup, History, list[CoarserResult]]

TABLE_TIMES = np.geomspace(1e-2, 100.0, 13)
ZENER = vc.Zener(1e6, 1e6, 1e6)
MEASURED = vc.TabulatedRelaxation(TABLE_TIMES, 1e6 * (1 + TABLE_TIMES) ** -0.3)

PRESCRIBED = ("force", "eccentricity_x", "eccentricity_y")
#: Bars are at most so many times the error, as the manual states of the median.
WIDEST = 5.0
ERROR = 0.05  # relative to the values; the lower limits of bars are smaller


def coarser_results_that_agree(run: RunSetup, history: History, name: str) -> list[CoarserResult]:
    """Coarser results of a single instant, with a scalar of the run."""
    return [
        replace(each, scalars=each.scalars | {name: history[name]})
        for each in map(march_coarser_run, plan_coarser_runs(run, history))
        if each is not None
    ]


def solved(law: vc.Law = ZENER, tolerance: float = 1e-7, steps: int = 5) -> Solved:
    """A ball beside the origin with its coarser runs, 16 to 20 cells across."""
    ball = vc.Paraboloid(0.01, 0.01).shifted(1e-4, 5e-5)
    load = vc.step(0.1, eccentricity_x=1e-4, eccentricity_y=5e-5)
    material, grid = vc.Material(law, 0.5), vc.Grid((32, 40), (2.7e-3, 2.7e-3))
    times = vc.uniform_times(3.0, steps)
    run = prepare_run(Problem(ball, material, load, grid, times, tolerance=tolerance))
    history = history_of(list(march_run(run)))
    results = [march_coarser_run(each) for each in plan_coarser_runs(run, history)]
    return run, history, [each for each in results if each is not None]


@pytest.fixture(scope="module")
def ball() -> Solved:
    return solved()


def with_error(
    ball: Solved, name: str, *, cells: float = 0.0, steps: float = 0.0, order: float = 2.0
) -> list[CoarserResult]:
    """Coarser results with a scalar of constant size and known relative errors of the run's."""
    _, history, results = ball
    size, changed = 1e-3, []
    history[name][:] = size * (1 + cells + steps * step_error(history["time"], history["time"]))
    for each in results:
        times = each.scalars["time"]
        by_steps = steps * step_error(times, history["time"])
        values = size * (1 + cells * each.spacing**order + by_steps)
        changed.append(replace(each, scalars=each.scalars | {name: values}))
    return changed


def step_error(times: np.ndarray, own: np.ndarray) -> np.ndarray:
    """Accumulated cubes of the steps, of second order, in that of the last of the run's times."""
    total = np.sum(np.diff(own) ** 3)
    return np.append(0.0, np.cumsum(np.diff(times) ** 3)) / total


def bar_over_error(ball: Solved, name: str, results: list[CoarserResult]) -> float:
    """Half width of the last bar in known errors."""
    run, history, _ = ball
    bars = error_bars_from(run, history, results).values[name]
    return float(bars[-1] / (ERROR * 1e-3))


@pytest.fixture
def known(ball: Solved) -> Solved:
    """The run with a history that a test may change."""
    run, history, results = ball
    return run, {name: values.copy() for name, values in history.items()}, results


SMOOTH = [
    *PRESCRIBED,
    *("approach", "tilt_x", "tilt_y", "contact_area", "contact_length", "contact_width"),
    *("peak_pressure", "peak_line_load", "work", "loss_per_cycle"),
]
#: Extents at the end of a body are those of its outline, and the peak has a rule of its own.
AT_END = [each for each in SMOOTH if not each.startswith(("contact_", "peak_pressure"))]


@pytest.mark.parametrize("name", SMOOTH)
def test_bar_holds_an_error_of_second_order_in_the_cells(known: Solved, name: str) -> None:
    """v(h) = v0 (1 + c h²): the run's own error is c v0."""
    results = with_error(known, name, cells=ERROR)
    assert 0.99 < bar_over_error(known, name, results) < WIDEST


@pytest.mark.parametrize("name", AT_END)
def test_bar_at_the_end_of_a_body_holds_an_error_of_first_order(known: Solved, name: str) -> None:
    """v(h) = v0 (1 + c h): cells replace the end of the body by whole cells."""
    results = [
        replace(
            each, at_end=np.ones_like(each.at_end), end_pressures=np.ones_like(each.end_pressures)
        )
        for each in with_error(known, name, cells=ERROR, order=1.0)
    ]
    assert 0.99 < bar_over_error(known, name, results) < WIDEST


def test_bar_keeps_the_error_after_the_contact_has_left_the_end() -> None:
    """A creeping body remembers the pressure at the end: its later approach has the same error."""
    known = solved(steps=12)
    results = []
    for each in with_error(known, "approach", cells=ERROR, order=1.0):
        at_end = each.scalars["time"] < 0.1
        ends = at_end[:, None] * [1.0, 1.0]
        results.append(replace(each, end_pressures=ends, at_end=at_end))
    assert 0.99 < bar_over_error(known, "approach", results) < WIDEST


@pytest.mark.parametrize("name", SMOOTH)
def test_bar_holds_an_error_of_the_steps(known: Solved, name: str) -> None:
    """Trapezoids are of second order: a step divided at its quarter and middle has 5/32 of it."""
    results = with_error(known, name, steps=ERROR)
    assert [each.divides_steps for each in results] == [False, False, True]
    assert 0.99 < bar_over_error(known, name, results) < WIDEST


def test_bar_holds_an_error_of_many_steps() -> None:
    """Both coarser runs take fewer steps where those of the run hardly change the pressure."""
    run, history, results = solved(vc.Zener(1e6, 1e8, 1e8), steps=20)
    assert [each.divides_steps for each in results] == [False, False]
    for name in SMOOTH:
        known = run, {key: values.copy() for key, values in history.items()}, results
        ratio = bar_over_error(known, name, with_error(known, name, steps=ERROR))
        # The coarsest steps, of four, have an error of 16.
        assert 0.99 < ratio < 16.0, name


def test_few_steps_are_divided_however_small_their_estimated_errors() -> None:
    """The first step behind a jump of the load has no estimate."""
    run, history, results = solved(vc.Zener(1e6, 1e8, 1e8), steps=8)
    assert np.nanmax(history["time_error"]) < 1e-3
    assert [each.divides_steps for each in results] == [False, False, True]
    for name in SMOOTH:
        known = run, {key: values.copy() for key, values in history.items()}, results
        ratio = bar_over_error(known, name, with_error(known, name, steps=ERROR))
        # Steps of twice the length have an error of 4, and that of the divided ones is added.
        assert 0.99 < ratio < 8.0, name


def test_coarser_runs_keep_the_few_times_between_which_the_run_takes_steps() -> None:
    """A cycle sampled three times has more steps, which become longer between the times."""
    load = vc.harmonic(approach=1e-5, amplitude=2e-6, period=1.0, cycles=2)
    ball, material = vc.Paraboloid(0.01, 0.01), vc.Material(ZENER, 0.5)
    times = np.linspace(0.0, 2.0, 6)
    run = prepare_run(Problem(ball, material, load, vc.Grid((32, 32), (1e-3, 1e-3)), times))
    history = history_of(list(march_run(run)))
    for each in some(plan_coarser_runs(run, history)):
        assert set(times) <= set(each.run.problem.times)


def test_bar_holds_an_error_of_the_first_step_at_times_that_coarser_runs_leave_out() -> None:
    """All runs but the third take the same first step: trapezoids of a quarter have 5/32 of it."""
    run, history, results = solved(vc.Zener(1e6, 1e6, 1e5), steps=24)
    kept = [len(each.scalars["time"]) for each in results]
    assert [each.divides_steps for each in results] == [False, False, True]
    assert kept[0] < kept[1] < len(history["time"])
    history["work"][:] = 1e-3 * (1 + ERROR)
    changed = []
    for each in results:
        work = np.full(len(each.scalars["time"]), 1e-3 * (1 + ERROR))
        if each.divides_steps:
            work[1:] = 1e-3 * (1 + 5 / 32 * ERROR)
        changed.append(replace(each, scalars=each.scalars | {"work": work}))
    bars = error_bars_from(run, history, changed).values["work"]
    assert (bars[1:] > 0.99 * ERROR * 1e-3).all()
    assert (bars[1:] < WIDEST * ERROR * 1e-3).all()


@pytest.mark.parametrize("cells", [25, 36])
@pytest.mark.parametrize("shape", ["ball", "punch"])
def test_bar_holds_the_error_of_runs_that_agree_by_chance(shape: str, cells: int) -> None:
    """Approach of a ball, a²/R (Hertz 1882), and of a punch, F/(2 E* a) (Boussinesq 1885).

    A quarter of a cell beside the grid's middle: where the rim crosses many cells at once, on a
    body in the middle, the error scatters more.
    """
    radius, reduced, force = 0.01, 4e6, 1.0
    a = (3 * force * radius / (4 * reduced)) ** (1 / 3)
    body = vc.Paraboloid(radius, radius) if shape == "ball" else vc.FlatPunch(a)
    exact = a**2 / radius if shape == "ball" else force / (2 * reduced * a)
    material, grid = vc.Material(vc.Elastic(1e6), 0.5), vc.Grid((cells, cells), (2.6 * a, 2.6 * a))
    x, y = np.array(grid.cell_size) / 4
    load = vc.step(force, eccentricity_x=x, eccentricity_y=y)
    run = prepare_run(Problem(body.shifted(x, y), material, load, grid, [0.0]))
    history = history_of(list(march_run(run)))
    results = coarser_results_that_agree(run, history, "approach")
    (bar,) = error_bars_from(run, history, results).values["approach"]
    (error,) = np.abs(history["approach"] - exact)
    assert 1.0 < bar / error < WIDEST


@pytest.mark.parametrize("part", [0.0, 0.25, 0.4, 0.5])
def test_bar_holds_the_height_of_a_crest_between_cells_of_a_contact_without_rim(
    part: float,
) -> None:
    """Pressure π E* Δ/λ cos(2π x/λ) on waves pressed flat (Westergaard 1939), largest at a crest.

    Coarser runs agree with the cells beside it by chance: the bar then holds, where the crest lies
    midway between two of them, all of what they miss, and is five times that at most.
    """
    length, amplitude, count, reduced = 1e-3, 1e-6, 48, 4e6
    body = vc.Waviness(amplitude, wavelength_x=length, phase_x=2 * np.pi * (part - 0.5) / count)
    wave = np.pi * reduced * amplitude / length
    material, load = vc.Material(vc.Elastic(1e6), 0.5), vc.step(1.5 * wave * length**2)
    grid = vc.Grid((count, count), (length, length), periodic=True)
    run = prepare_run(Problem(body, material, load, grid, [0.0], tolerance=1e-8))
    history = history_of(list(march_run(run)))
    results = coarser_results_that_agree(run, history, "peak_pressure")
    (bar,) = error_bars_from(run, history, results).values["peak_pressure"]
    (missed,) = 2.5 * wave - history["peak_pressure"]
    assert missed == close_to(wave * (1 - np.cos(2 * np.pi * part / count)), abs=1e-6 * wave)
    assert bar > missed
    assert bar < WIDEST * wave * (1 - np.cos(np.pi / count))


def test_bars_hold_the_error_of_the_compliance() -> None:
    """Where all grids agree, what is left is the error of the law: here of a measured modulus."""
    run, history, results = solved(MEASURED, tolerance=1e-8)
    inverted = run.problem.compliance.inversion_error
    assert inverted > 100 * run.problem.tolerance
    agreed = with_error((run, history, results), "force")
    (bar,) = set(error_bars_from(run, history, agreed).values["force"])
    assert 1.0 <= bar / (1e-3 * inverted) < 1.1
    remembered = replace(run, hereditary=replace(run.hereditary, error=0.02))
    (bar,) = set(error_bars_from(remembered, history, agreed).values["force"])
    assert 1.0 <= bar / (1e-3 * 0.02) < 1.1


@pytest.mark.parametrize("part", [0.1, 0.4, 0.8, 1000.0])
def test_bar_of_mean_pressure_holds_the_error_of_an_area_that_is_too_large(
    known: Solved, part: float
) -> None:
    """Area A (1 + c) instead of A: the mean pressure F/A is too small by c/(1 + c) of itself.

    Where the area may vanish within its bar, nothing bounds the mean pressure.
    """
    results = with_error(known, "contact_area", cells=part)
    run, history, _ = known
    history["mean_pressure"] = history["force"] / history["contact_area"]
    values = error_bars_from(run, history, results).values
    bar, mean = values["mean_pressure"][-1], history["mean_pressure"][-1]
    assert bool(values["contact_area"][-1] < history["contact_area"][-1]) is (part < 1)
    if part < 1:
        assert part < bar / mean < WIDEST * part  # exact F/A is 1 + c times as large
    else:
        assert np.isnan(bar)


def test_error_of_a_step_that_coarser_runs_leave_out_is_at_least_a_large_estimate() -> None:
    """The last step before the contact is lost is not theirs: the run's own estimate counts."""
    known = run, history, _ = solved(steps=8)
    agreed = with_error(known, "contact_area")
    left_out = np.array([time not in agreed[-1].scalars["time"] for time in history["time"]])
    assert agreed[-1].divides_steps
    assert left_out.any()
    before = error_bars_from(run, history, agreed).values["contact_area"]
    history["time_error"] = np.where(left_out, 0.8, 0.0)
    after = error_bars_from(run, history, agreed).values["contact_area"]
    assert (before < 0.01 * history["contact_area"]).all()
    assert (after[left_out] > 0.4 * history["contact_area"][left_out]).all()


@pytest.mark.parametrize("tolerance", [1e-7, 1e-3])
def test_bars_of_moments_are_at_least_what_the_tolerance_allows(tolerance: float) -> None:
    """The moments are met to the tolerance, times force and extent: a body may rest so far off.

    Grids that agree by symmetry do not show it.
    """
    egg = vc.Paraboloid(0.08, 0.005)  # the contact is six times as long as wide
    grid, load = vc.Grid((32, 40), (6e-3, 1.6e-3)), vc.step(0.1)
    times = vc.uniform_times(3.0, 5)
    run = prepare_run(Problem(egg, vc.Material(ZENER, 0.5), load, grid, times, tolerance=tolerance))
    history = history_of(list(march_run(run)))
    results = [march_coarser_run(each) for each in plan_coarser_runs(run, history)]
    for each in some(results):
        assert np.abs(each.scalars["eccentricity_x"]).max() < 1e-15  # 1e-12 of the extent
    bars = error_bars_from(run, history, results).values
    for axis, extent in (("x", "contact_length"), ("y", "contact_width")):
        far = tolerance * history[extent]
        assert np.all(bars[f"eccentricity_{axis}"] >= far)
        assert np.all(bars[f"eccentricity_{axis}"] <= 10 * far)
        # Over the extent the tilt changes the gap by so much of the approach.
        slope = tolerance * history["approach"] / history[extent]
        assert np.all(bars[f"tilt_{axis}"] >= slope)
        assert np.all(bars[f"tilt_{axis}"] <= 10 * slope)


def test_bar_of_motion_work_adds_up_over_the_whole_path() -> None:
    """There and back, with the friction coefficient tolerance times slope of the indentation."""
    path = vc.Travel([0.0, 1.0, 2.0], x=[0.0, 3e-3, 0.0], y=[0.0, 4e-3, 0.0])
    ball, grid = vc.Paraboloid(0.01, 0.01), vc.Grid((40, 40), (12e-3, 12e-3))
    problem = Problem(ball, vc.Material(ZENER, 0.5), vc.step(0.1), grid, [0.0], motion=path)
    run = prepare_run(problem)
    history = {
        "time": np.array([0.0, 0.5, 1.0, 1.2, 2.0]),
        "force": np.array([0.1, 0.1, 0.1, 0.2, 0.2]),
        "approach": np.full(5, 1e-5),
        "contact_length": np.full(5, 4e-4),
        "contact_width": np.full(5, 5e-4),
    }
    coefficient = run.problem.solver_error * 1e-5 / 5e-4
    assert least_resistance_bar(run, "friction_coefficient", history) == close_to([coefficient] * 5)
    along = coefficient * np.array([0.1, 0.1, 0.1, 0.2, 0.2])
    assert least_resistance_bar(run, "resistance_x", history) == close_to(along)
    ways = 5e-3 * np.array([0.0, 0.5, 0.5, 0.2, 0.8])
    assert least_resistance_bar(run, "motion_work", history) == close_to(np.cumsum(along * ways))


def test_pressure_where_a_body_enters_may_rise_with_the_root_of_the_stiffness() -> None:
    """On cells of 0.1 mm and 0.3 mm, at 1 mm/s and at rest, of a Maxwell body, J = (1 + t/τ)/G."""
    path = vc.Travel([0.0, 1.0, 2.0], y=[0.0, 1e-3, 1e-3])
    ball, grid = vc.Paraboloid(0.01, 0.01), vc.Grid((30, 30), (3e-3, 9e-3))
    maxwell = vc.Material(vc.Maxwell(1e6, 5e4), 0.5)
    run = prepare_run(Problem(ball, maxwell, vc.step(0.1), grid, [0.0], motion=path))
    rises = entry_rise(run, np.array([0.5, 1.0, 2.0]))
    assert rises == close_to([np.sqrt(1 + 0.1 / 0.05) - 1] * 2 + [0.0])
    # A body that has been there for less time than it takes to pass a cell has crept for that.
    assert entry_rise(run, np.array([0.01])) == close_to([np.sqrt(1 + 0.01 / 0.05) - 1])
