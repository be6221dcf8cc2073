"""Error bars of load programs, against runs on finer cells and in shorter steps."""

import numpy as np
import pytest

import viscontact as vc
from campaigns import tried
from viscontact.mechanics.problem.kept_fields import NO_FIELDS
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.accuracy.coarser_results import CoarserResult
from viscontact.simulation.accuracy.event_bars import event_errors, segment_end_errors
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.setup import prepare_run

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

SCALARS = ("force", "approach", "contact_area", "peak_pressure", "work")


def drawn(rng):
    """Indenter, material and program at random; force and area differ by decades."""
    radius = 10 ** rng.uniform(-3, -2)
    reach = 0.25 * radius
    laws = (
        vc.Zener(1e6, 10 ** rng.uniform(5.5, 6.5), 10 ** rng.uniform(5.0, 6.5)),
        vc.Maxwell(1e6, 10 ** rng.uniform(5.5, 6.5)),
        vc.CreepSeries(5e-7, [2e-7, 4e-7], [0.05, 0.5]),
    )
    law = laws[rng.integers(3)]
    ball = vc.Paraboloid(radius, radius * rng.uniform(1.0, 1.6))
    depth = reach**2 / radius / 2
    rate = depth / rng.uniform(0.2, 0.6)
    # Elastic contact under the half of the depth, as a scale of force [N].
    force = rng.uniform(0.2, 0.6) * 16 / 3 * 1e6 * radius**0.5 * (depth / 2) ** 1.5
    held = rng.choice(["height", "force"])
    program = vc.LoadProgram(
        [
            vc.Segment(rate, until=vc.Condition("force", force)),
            f"hold {held} for 0.2 s",
            vc.Segment(-rate * rng.uniform(0.5, 2.0), until="contact is lost"),
        ]
    )
    return ball, vc.Material(law, 0.5), program, 4 * reach


def ran(case, cells, steps, *, errors):
    ball, material, program, size = case
    grid, times = vc.Grid((cells, cells), (size, size)), vc.uniform_times(3.0, steps)
    return vc.simulate(ball, material, program, grid, times, errors=errors, fields="none")


def at_equal_times_after_events(name, ds, fine):
    """Scalar of the finer run at the times of the other one, between the same events."""
    own, theirs = (np.array([0.0, *each.attrs["event_times"]]) for each in (ds, fine))
    times = ds.time.values
    number = np.clip(np.searchsorted(own, times, side="left") - 1, 0, len(own) - 2)
    then = theirs[number] + (times - own[number])
    then[np.isin(times, own)] = theirs[np.isin(own, times)]
    return np.interp(then, fine.time, fine[name]), then <= theirs[number + 1] * (1 + 1e-12)


@pytest.mark.slow
def test_bars_of_programs_cover_95_of_100_errors():
    rng = np.random.default_rng(20)
    inside, events = {name: [] for name in SCALARS}, []
    for _ in range(tried(6, 12)):
        case = drawn(rng)
        ds, fine = ran(case, 33, 300, errors=True), ran(case, 81, 1200, errors=False)
        own, theirs = ds.attrs["event_times"], fine.attrs["event_times"]
        assert len(own) == len(theirs) == 2
        apart = np.abs(np.subtract(own, theirs))
        events.append(apart <= ds.attrs["event_time_errors"])
        for name in SCALARS:
            exact, known = at_equal_times_after_events(name, ds, fine)
            bar = ds[f"{name}_error"].values
            touching = known & (ds.contact_area.values > 0)
            inside[name].append((np.abs(ds[name].values - exact) <= bar)[touching])
    covered = {name: float(np.concatenate(each).mean()) for name, each in inside.items()}
    covered["event_time"] = float(np.concatenate(events).mean())
    # Of work a little less: in 20 to 60 steps its bars are short, from the first segment on.
    assert min(covered.values()) >= 0.85
    assert np.mean(list(covered.values())) >= 0.95


# --- errors of instants that are known by construction ------------------------------------------


def programmed(law):
    """Run of a program that ends two segments by conditions, at some 0.2 s and 0.35 s."""
    program = vc.LoadProgram(
        "move at 0.1 mm/s until force reaches 50 mN; retract at 0.2 mm/s until contact is lost"
    )
    ball, grid = vc.Paraboloid(0.01, 0.01), vc.Grid((16, 16), (1.8e-3, 1.8e-3))
    material, times = vc.Material(law, 0.5), vc.uniform_times(0.5, 10)
    problem = Problem(ball, material, program, grid, times, tolerance=1e-7, kept=NO_FIELDS)
    return prepare_run(carried_out(problem))


@pytest.fixture(scope="module")
def zener_run():
    return programmed(vc.Zener(1e6, 1e6, 1e6))


def coarser(spacing, ends, *, divides_steps=False):
    """Coarser run of which only the ends of the segments are known [s]."""
    none = np.zeros(0)
    flags = none.astype(bool)
    kinds = (none, flags, none, none, none, none, none, np.zeros((0, 2), bool))
    return CoarserResult(spacing, divides_steps, {}, *kinds, is_sharp=False, segment_ends=ends)


def bars(run, results):
    return np.array(event_errors(run, segment_end_errors(run, results))["event_time_errors"])


ERRORS = np.array([2e-3, -5e-3])  # [s], far above those of the solver


def test_bars_of_instants_hold_an_error_of_second_order_in_the_cells(zener_run):
    """t(h) = t + c h², h in cells of the run: its own error is c."""
    exact = np.array(zener_run.problem.load.times[1:]) - ERRORS
    found = bars(zener_run, [coarser(h, exact + ERRORS * h**2) for h in (2.0, 3.0)])
    assert (found > 0.99 * np.abs(ERRORS)).all()
    assert (found < 5 * np.abs(ERRORS)).all()


def test_bars_of_instants_hold_an_error_of_the_steps(zener_run):
    """Trapezoids are of second order: a step divided at its quarter and middle has 5/32 of it."""
    own = np.array(zener_run.problem.load.times[1:])
    divided = coarser(2.0, own - ERRORS * 27 / 32, divides_steps=True)
    found = bars(zener_run, [coarser(2.0, own), coarser(3.0, own), divided])
    assert (found > 0.99 * np.abs(ERRORS)).all()
    assert (found < 5 * np.abs(ERRORS)).all()


def test_bars_of_instants_hold_the_errors_of_solver_and_law(zener_run):
    """Where all runs agree: of the tolerance, and of a measured modulus that is inverted."""
    times = np.geomspace(1e-2, 100.0, 13)
    measured = programmed(vc.TabulatedRelaxation(times, 1e6 * (1 + times) ** -0.3))
    inverted = measured.problem.compliance.inversion_error
    solved = zener_run.problem.solver_error
    assert inverted > 2 * solved
    for run, error in ((zener_run, solved), (measured, inverted)):
        own = np.array(run.problem.load.times[1:])
        found = bars(run, [coarser(2.0, own), coarser(3.0, own)])
        assert (found >= error * own).all()
        assert (found < 1.5 * error * own).all()
