"""Events of bodies that adhere, and errors of their instants from those of load programs."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.grid import Grid
from viscontact.indenters import Paraboloid
from viscontact.loads import ApproachHistory
from viscontact.mechanics.state import ContactEvent, Outcome, as_event
from viscontact.simulation.accuracy.coarser_results import CoarserResult
from viscontact.simulation.accuracy.event_bars import pull_off_errors
from viscontact.simulation.transient.contact_events import BEYOND, NEAR, ContactEvents
from viscontact.simulation.transient.provenance import contact_event_attributes


def withdrawn(times, pulls, *, restarted=False):
    """Event that ends a contact which pulls so [N], over time [s]."""
    events = ContactEvents()
    for time, pull in zip([*times, times[-1] + 0.01], [*pulls, 0.0], strict=True):
        touches = Outcome.CONVERGED if time <= times[-1] else Outcome.NO_CONTACT
        events.after(SimpleNamespace(time=time, force=-pull, approach=0.0, outcome=touches))
        if restarted:
            kept = json.loads(json.dumps(events.restart_data()))
            events = ContactEvents()
            events.restore(kept)
    return events.reported()[-1]


@pytest.mark.parametrize("restarted", [False, True])
def test_bend_of_the_largest_pull_is_that_of_its_parabola(restarted):
    times = np.linspace(0.0, 1.5, 31)
    event = withdrawn(times, 3.0 - 2.0 * np.square(times - 0.83), restarted=restarted)
    assert (event.pull, event.pull_time) == (close_to(3.0), close_to(0.83))
    assert event.pull_bend == close_to(2.0, rel=1e-9)
    assert as_event(json.loads(json.dumps(event))) == event


def test_a_pull_that_ends_at_its_largest_has_no_flat_part():
    assert withdrawn([0.0, 0.5, 1.0], [1.0, 2.0, 3.0]).pull_bend == math.inf


def test_a_constant_pull_falls_beyond_its_states():
    event = withdrawn([0.0, 1.0, 2.0, 3.0, 4.0], [2.9999999, 3.0, 3.0, 3.0, 3.0])
    width = BEYOND * (4.0 - event.pull_time)
    assert event.pull_bend == close_to(NEAR * event.pull / width**2)


def described(jump_errors, end_error=0.3):
    """Attributes of a program: a pull at 1 s, contact lost at 4 s, and the errors of its jumps."""
    ends = {"event_times": [1.0, 4.0005], "event_time_errors": [0.02, end_error]}
    return ends | {"events": "a\nb", "jump_time_errors": jump_errors, "pull_off_time_error": 0.01}


def events(*kinds_and_times):
    pair = (0.0, 0.0)
    return [
        ContactEvent(kind, time, pair, pair, 2.0 if kind == "pull_off" else math.nan, time - 0.5)
        for kind, time in kinds_and_times
    ]


@pytest.mark.parametrize(
    ("at", "own", "stated"),
    [
        (4.0, 0.1, 0.3),  # ends the segment
        (4.0, 0.5, 0.5),
        (3.0, 0.01, 0.02),  # within the segment, which begins at an instant that is so uncertain
        (0.5, 0.01, 0.01),
    ],
)
def test_a_jump_has_at_least_the_error_of_the_segment_that_it_ends_or_lies_in(at, own, stated):
    found = contact_event_attributes(events(("pull_off", at)), described({"pull_off": [own]}))
    errors = dict(zip(found["event_kind"].split(), found["event_time_errors"], strict=False))
    assert errors["pull_off"] == stated
    assert found["pull_off_time_error"] == (0.02 if at > 1.5 else 0.01)


def test_a_pull_off_that_coarser_runs_lack_has_the_error_of_the_segment_that_it_ends():
    jumps = events(("jump_in", 0.5), ("pull_off", 4.0))
    found = contact_event_attributes(jumps, described({"jump_in": [0.001]}))
    np.testing.assert_array_equal(found["event_time_errors"], [0.001, 0.02, 0.3, 0.3])
    lacking = contact_event_attributes(jumps, described({"jump_in": []}, math.nan))
    np.testing.assert_array_equal(
        lacking["event_time_errors"], [math.nan, 0.02, math.nan, math.nan]
    )


def test_time_of_a_flat_largest_pull_is_as_uncertain_as_its_force_makes_it():
    def coarser(spacing, pull, time):
        event = ("pull_off", time + 0.2)
        return CoarserResult(
            *(spacing, False, {}, *[np.zeros(0)] * 9, False),
            pull_off=(pull, time),
            pull_bend=4.0,
            contact_events=(event,),
        )

    load = ApproachHistory([0.0, 1.0, 4.0], [0.0, 1e-6, -1e-6])
    problem = SimpleNamespace(end=10.0, contact_load=load, indenter=Paraboloid(1e-3, 1e-3))
    run = SimpleNamespace(law="exponential", problem=problem, grid=Grid((4, 4), (4e-6, 4e-6)))
    found = pull_off_errors(run, [coarser(2.4, 1.02, 3.0), coarser(1.5, 1.01, 3.0)])
    error = found["pull_off_force_error"]
    assert 0.01 < error < 0.03
    # The pull is within its error of the largest one while 4 N/s² (t - 3 s)² is.
    assert found["pull_off_time_error"] == close_to(math.sqrt(error / 4.0))
    assert list(found["jump_time_errors"]) == ["jump_in", "pull_off"]
    assert found["jump_time_errors"]["jump_in"] == []
    # The coarser runs agree that it is after 3.2 s, within a shortest step of their stretch, and
    # what passes until the cells nearest to the apex, at a gap of d²/(4 R), are lost.
    of_cells = 1e-12 / 4e-3 / (2e-6 / 3.0)
    assert found["jump_time_errors"]["pull_off"] == close_to([3e-5 + of_cells], rel=1e-6)
    lacking = [coarser(2.4, 1.02, 3.0), coarser(1.5, math.nan, math.nan)]
    assert math.isnan(pull_off_errors(run, lacking)["pull_off_time_error"])
