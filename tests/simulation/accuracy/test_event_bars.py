"""Error bars of load programs, against runs on finer cells and in shorter steps."""

import numpy as np
import pytest

import viscontact as vc

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
    for _ in range(12):
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
