"""Events of load programs against exact solutions."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import viscontact as vc
from closeness import close_to

RADIUS, FORCE, RATE = 0.01, 0.05, 1e-4
BALL = vc.Paraboloid(RADIUS, RADIUS)
LAWS = {"zener": vc.Zener(1e6, 1e6, 1e6), "maxwell": vc.Maxwell(1e6, 5e5)}
PROGRAM = vc.LoadProgram(
    "move at 0.1 mm/s until force reaches 50 mN; retract at 0.2 mm/s until contact is lost"
)
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def exact_events(law):
    """Instants of the force under a rate (Lee and Radok 1960), and of lost contact (Ting 1966)."""

    def modulus(t):
        return 4 * float(law.relaxation(t))  # contact modulus, incompressible

    def force(t):
        """4/3 sqrt(R) ∫ M(t - t') d(v t')^(3/2), with t' = u²."""
        grown = quad(lambda u: modulus(t - u * u) * 3 * u * u, 0, np.sqrt(t))[0]
        return 4 / 3 * np.sqrt(RADIUS) * RATE**1.5 * grown

    reached = brentq(lambda t: force(t) - FORCE, 1e-3, 8)

    def remains(t):
        """∫ M(t - t') dw(t') over the whole past, 0 when contact is lost."""
        rise = quad(lambda s: modulus(t - s), 0, reached)[0]
        return rise - 2 * quad(lambda s: modulus(t - s), reached, t)[0]

    return reached, brentq(remains, reached, 3 * reached)


def run(law, cells, steps, program=PROGRAM, end=0.5):
    material, grid = vc.Material(law, 0.5), vc.Grid((cells, cells), (1.8e-3, 1.8e-3))
    times = vc.uniform_times(end, steps)
    return vc.simulate(BALL, material, program, grid, times, errors=False, fields="none")


@pytest.mark.parametrize("name", ["zener", pytest.param("maxwell", marks=pytest.mark.slow)])
def test_events_are_where_lee_radok_and_ting_have_them(name):
    ds = run(LAWS[name], 129, 80)
    events = ds.attrs["event_times"]
    assert np.allclose(events, exact_events(LAWS[name]), rtol=1e-4, atol=0)
    assert np.isin(events, ds.time).all()
    # Lost within the solver's tolerance: one cell may still bear a trifle.
    assert float(ds.force[-1]) == close_to(0, abs=1e-9 * FORCE)
    assert float(ds.force.sel(time=events[0])) == close_to(FORCE, rel=1e-6)
    assert "force reaches 50 mN" in ds.attrs["events"].splitlines()[0]


def test_a_condition_that_would_be_met_later_in_the_step_changes_nothing():
    alone = run(LAWS["zener"], 65, 8)
    reached, lost = alone.attrs["event_times"]
    after = RATE * (reached + 0.01)  # a step is 0.06 s
    program = replace(PROGRAM, stop=(vc.Condition("approach", after),))
    both = run(LAWS["zener"], 65, 8, program)
    assert both.attrs["event_times"] == close_to([reached, lost], rel=1e-9)
    assert both.force.values == close_to(alone.force.values, rel=1e-9)


@pytest.mark.parametrize("tolerance", [1e-2, pytest.param(1e-3, marks=pytest.mark.slow)])
def test_events_among_adaptive_steps_are_within_their_tolerance(tolerance):
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((65, 65), (1.8e-3, 1.8e-3))
    times = vc.adaptive_times(0.5, tolerance)
    ds = vc.simulate(BALL, material, PROGRAM, grid, times, errors=False, fields="none")
    found = ds.attrs["event_times"]
    assert np.allclose(found, exact_events(LAWS["zener"]), rtol=0.2 * tolerance, atol=0)
    assert float(ds.force.sel(time=found[0])) == close_to(FORCE, rel=1e-6)


def test_automatic_grid_of_a_program_keeps_its_tolerance():
    material = vc.Material(LAWS["zener"], 0.5)
    grid, times = vc.AutomaticGrid(0.01), vc.uniform_times(0.5, 40)
    ds = vc.simulate(BALL, material, PROGRAM, grid, times, errors=False, fields="none")
    reached, lost = exact_events(LAWS["zener"])
    assert np.allclose(ds.attrs["event_times"], [reached, lost], rtol=2e-3, atol=0)
    at_event = ds.sel(time=ds.attrs["event_times"][0])
    # Ting (1966): under a rising approach w = v t the contact is that of the body, a² = R w.
    assert float(at_event.contact_area) == close_to(np.pi * RADIUS * RATE * reached, rel=0.01)
    assert float(at_event.approach) == close_to(RATE * reached, rel=0.01)


def test_error_bars_compare_at_equal_times_after_the_events():
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((45, 45), (1.8e-3, 1.8e-3))
    program = vc.LoadProgram(
        "move at 0.1 mm/s until force reaches 50 mN; hold height for 0.1 s; "
        "retract at 0.2 mm/s until contact is lost"
    )
    times = vc.uniform_times(0.6, 60)
    ds = vc.simulate(BALL, material, program, grid, times, fields="none")
    reached = exact_events(LAWS["zener"])[0]
    event, bars = ds.attrs["event_times"][0], ds.attrs["event_time_errors"]
    assert abs(event - reached) <= bars[0] < 2e-3 * reached
    held = ds.isel(time=(ds.time > event + 1e-6) & (ds.time < event + 0.1))
    # Force under a held height, by Lee and Radok's integral, at equal times after the event.
    law, error = LAWS["zener"], held.force_error.values
    exact = []
    for after in held.time.values - event:
        grown = quad(
            lambda u, t: 4 * float(law.relaxation(t - u * u)) * 3 * u * u,
            *(0, np.sqrt(reached)),
            args=(reached + after,),
        )[0]
        exact.append(4 / 3 * np.sqrt(RADIUS) * RATE**1.5 * grown)
    apart = np.abs(held.force.values - exact)
    assert (apart <= error).mean() >= 0.9
    assert (error < 3e-3 * FORCE).all()
    # The set point is the force at its event, whenever this is; without contact there is no area.
    assert float(ds.force_error.sel(time=event)) <= 1e-5 * FORCE
    assert ds.contact_area_error[-1] == 0


@pytest.mark.slow
def test_bars_where_contact_is_lost_hold_and_are_not_wide():
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((39, 39), (1.8e-3, 1.8e-3))
    ds = vc.simulate(BALL, material, PROGRAM, grid, vc.uniform_times(0.5, 48), fields="none")
    reached, lost = exact_events(LAWS["zener"])
    # The approach rises at the rate, and falls twice as fast.
    exact = RATE * (reached - 2 * (lost - reached))
    bar, late = float(ds.approach_error[-1]), float(ds.attrs["event_time_errors"][-1])
    assert abs(float(ds.approach[-1]) - exact) <= bar <= 2 * RATE * late
    assert abs(ds.attrs["event_times"][-1] - lost) <= late < 3e-3 * lost
    # Work is that of Lee and Radok's force while the body comes, and of Ting's while it goes; a run
    # on four times as many cells has it to a tenth of a per cent.
    fine = run(LAWS["zener"], 67, 144)
    assert abs(float(ds.work[-1] - fine.work[-1])) <= float(ds.work_error[-1])
    assert float(ds.work_error[-1]) < 0.02 * float(fine.work.max())


def test_free_tilt_takes_the_resultant_to_the_axis():
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((33, 33), (1.8e-3, 1.8e-3))
    sentences = "move at 0.1 mm/s until force reaches 50 mN; hold force for 0.1 s"
    given, free = (
        vc.simulate(
            *(BALL.shifted(x=-1e-4), material),
            vc.LoadProgram(sentences, tilt_x=tilt),
            *(grid, vc.uniform_times(0.5, 20)),
            errors=False,
        )
        for tilt in (0.0, None)
    )
    # The free body turns until the resultant is on the axis: its moment is zero.
    assert np.abs(given.eccentricity_x[1:]).max() > 5e-5
    assert np.nanmax(np.abs(free.eccentricity_x)) < 1e-6 * 1.8e-3
    assert (np.abs(free.tilt_x[2:]) > 1e-3).all()


def test_eccentric_force_ends_on_a_condition():
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((33, 33), (2.4e-3, 2.4e-3))
    ball = vc.FlatPunch(half_length=5e-4, half_width=5e-4)
    program = vc.LoadProgram(
        "load at 1 N/s until tilt_x reaches 1 mrad; hold force for 0.1 s",
        eccentricity_x=1e-4,
        tilt_x=None,
    )
    ds = vc.simulate(ball, material, program, grid, vc.uniform_times(5.0, 20), errors=False)
    event = ds.sel(time=ds.attrs["event_times"][0])
    assert float(event.tilt_x) == close_to(1e-3, rel=1e-6)
    assert float(event.eccentricity_x) == close_to(1e-4, rel=1e-4)


def test_events_are_of_second_order_in_the_steps():
    # The cells' error is the same; that of the steps falls to a quarter each time.
    coarse, middle, fine = (
        np.array(run(LAWS["zener"], 33, n).attrs["event_times"]) for n in (20, 40, 80)
    )
    orders = np.log2((coarse - middle) / (middle - fine))
    assert (orders > 1.6).all()


def test_height_then_force_are_held():
    program = vc.LoadProgram(
        "move at 0.1 mm/s until force reaches 50 mN; hold height for 0.1 s; hold force for 0.1 s"
    )
    ds = run(LAWS["zener"], 33, 50, program)
    begin = float(ds.time[-1]) - 0.2
    height = ds.sel(time=slice(begin - 1e-9, begin + 0.1 + 1e-9))
    force = ds.sel(time=slice(begin + 0.1 - 1e-9, None))
    assert np.ptp(height.approach.values) <= 1e-12 * height.approach[0]
    assert height.force[-1] < 0.97 * height.force[0]
    assert np.allclose(force.force, force.force[0], rtol=1e-5, atol=0)
    assert force.approach[-1] > 1.001 * force.approach[0]
    # The force at the end of the hold is that of the relaxed body, and stays there.
    assert force.force[0] == close_to(float(height.force[-1]), rel=1e-5)


def test_a_condition_that_is_met_at_the_end_of_a_step_is_met_there():
    """In powers of 2 the approach has its value exactly after four steps of a sixteenth second."""
    rising = vc.Segment(2.0**-13, until=vc.Condition("approach", 2.0**-15))
    ds = run(LAWS["zener"], 17, 8, vc.LoadProgram([rising]))
    assert ds.attrs["event_times"] == [0.25]
    assert ds.time.values.tolist() == [0.0, 0.0625, 0.125, 0.1875, 0.25]


@pytest.mark.parametrize("apart", [-1e-12, 0.0, 1e-12])
def test_a_requested_time_beside_an_event_is_the_event(apart):
    """20 µm are reached after 0.2 s."""
    program = vc.LoadProgram("move at 0.1 mm/s until approach reaches 20 um; hold height for 0.1 s")
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((17, 17), (1.8e-3, 1.8e-3))
    times = [0.0, 0.1, 0.2 * (1 + apart), 0.25, 0.3 * (1 + apart), 0.5]
    ds = vc.simulate(BALL, material, program, grid, times, errors=False, fields=[times[2]])
    assert ds.time.values == close_to([0.0, 0.1, 0.2, 0.25, 0.3], rel=1e-8)
    assert ds.field_time.values == ds.time.values[2] == ds.attrs["event_times"][0]


def test_the_begin_of_a_run_remains_beside_an_event():
    first, then = (
        vc.Segment(1e-4, until=vc.Condition("approach", 1e-15)),
        "move at 0.1 mm/s for 0.2 s",
    )
    ds = run(LAWS["zener"], 17, 5, vc.LoadProgram([first, then]))
    assert ds.time.values[0] == 0
    assert 0 < ds.attrs["event_times"][0] < 1e-9


def test_a_stop_ends_the_run():
    area = 3e-7
    program = vc.LoadProgram("move at 0.1 mm/s for 5 s; stop when contact_area exceeds 0.3 mm^2")
    ds = run(LAWS["zener"], 33, 50, program)
    assert ds.contact_area[-1] == close_to(area, rel=1e-6)
    assert (ds.contact_area[:-1] < area).all()
    assert "stop when" in ds.attrs["events"]


@pytest.mark.parametrize(
    ("sentences", "why"),
    [
        ("move at 0.1 mm/s until force reaches 5 kN", "segment 1, .*comes closest at 100 ms with"),
        ("hold height until contact is lost", "segment begins without contact"),
        # It begins with that value, which is not reached again.
        ("move at 0.1 mm/s until approach reaches 0 mm", "segment 1, .*closest at 0 s with 0 m"),
        ("move at 0.1 mm/s for 50 ms; hold height until force reaches 1 N", "segment 2, .*50 ms"),
    ],
)
def test_what_never_happens_is_said(sentences, why):
    with pytest.raises(ValueError, match=why):
        run(LAWS["zener"], 33, 10, vc.LoadProgram(sentences), end=0.1)


def test_what_has_no_program_is_refused():
    material, grid = vc.Material(LAWS["zener"], 0.5), vc.Grid((33, 33), (1.8e-3, 1.8e-3))
    times = vc.uniform_times(0.5, 10)
    with pytest.raises(ValueError, match="times: a load program needs given instants"):
        vc.simulate(BALL, material, PROGRAM, grid)
    with pytest.raises(ValueError, match="leave motion out"):
        vc.simulate(BALL, material, PROGRAM, grid, times, motion=vc.Travel([0, 1], y=[0, 1e-4]))
    repeated = vc.Grid((33, 33), (1.8e-3, 1.8e-3), periodic=True)
    with pytest.raises(ValueError, match="leave periodic out"):
        vc.simulate(BALL, material, PROGRAM, repeated, times)
    with pytest.raises(ValueError, match="load: a steady motion has a constant load"):
        vc.steady(BALL, material, PROGRAM, 1.0, rolling=False)


def test_an_eccentric_force_is_unloaded_at_its_rate_until_contact_is_lost():
    # Slender contact on an automatic grid, a free tilt, and the force throughout.
    program = vc.LoadProgram(
        "load at 10 N/s until contact_width reaches 0.3 mm; unload at 20 N/s until contact is lost",
        eccentricity_x=2e-4,
        tilt_x=None,
    )
    body, material = vc.Paraboloid(75e-3, 5e-3), vc.Material(vc.Zener(1e8, 1e8, 1e8), 0.4)
    grid, times = vc.AutomaticGrid(0.05), vc.uniform_times(5.0, 50)
    ds = vc.simulate(body, material, program, grid, times, errors=False, fields="none")
    reached, lost = ds.attrs["event_times"]
    event = ds.sel(time=reached)
    assert float(event.contact_width) == close_to(3e-4, rel=1e-6)
    assert float(event.eccentricity_x) == close_to(2e-4, rel=1e-4)
    assert float(event.force) == close_to(10 * reached, rel=1e-6)
    # The force falls at twice the rate of its rise.
    assert lost == close_to(1.5 * reached, rel=1e-6)
    assert ds.force[-1] == 0


def test_a_force_is_not_reduced_below_zero():
    program = vc.LoadProgram("load at 1 N/s for 50 ms; unload at 1 N/s for 60 ms")
    with pytest.raises(ValueError, match="the force is zero after 50 ms of it"):
        run(LAWS["zener"], 33, 10, program)
