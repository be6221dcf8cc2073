"""Each guard against a silently wrong number has a run that meets it and one that does not."""

from __future__ import annotations

import numpy as np
import pytest

import viscontact as vc
from simulation.checks.body_guards import BODY_GUARDS
from simulation.checks.guarded_runs import BALL, RUBBER, Guard, Job, Shifted, hertz_force
from simulation.checks.resolution_guards import RESOLUTION_GUARDS

GUARDS = {**RESOLUTION_GUARDS, **BODY_GUARDS}
#: Those whose words another guard has too, met in another way.
LIKE_ANOTHER = {
    "a turned map finer than the grid",
    "an approach that is taken back in one step",
    "a run beyond the data of one of two materials",
    "a later jump sooner than the first row",
}
each_guard = pytest.mark.parametrize(
    "guard",
    [
        pytest.param(each, id=name, marks=[pytest.mark.slow] if name in LIKE_ANOTHER else [])
        for name, each in GUARDS.items()
    ],
)


@each_guard
def test_guard_is_met(guard: Guard) -> None:
    if not issubclass(guard.outcome, Warning):
        with pytest.raises(guard.outcome) as refusal:
            guard.met.run()
        assert guard.words in str(refusal.value)
        return
    said = guard.met.run()
    assert sum(guard.words in text for text in said) == 1, said


@each_guard
def test_guard_is_missed(guard: Guard) -> None:
    said = guard.missed.run()
    assert [text for text in said if not any(words in text for words in guard.besides)] == []
    assert not any(guard.words in text for text in said)


@pytest.mark.parametrize("shift", [(0.05, 0.0), (-0.05, 0.0), (0.0, 0.05), (0.0, -0.05)])
def test_rim_is_guarded_on_every_side(shift: tuple[float, float]) -> None:
    # Free tilts would bring the contact under the force.
    load, grid = vc.step(hertz_force(0.1), tilt_x=0.0, tilt_y=0.0), vc.Grid((50, 50), (0.25, 0.25))
    assert Job(Shifted(0.0, 0.0), load, grid).run() == []
    with pytest.raises(vc.DomainError, match="edge of the grid"):
        Job(Shifted(*shift), load, grid).run()


def test_rim_met_within_a_run_keeps_the_steps_before() -> None:
    load = vc.ForceHistory([0.0, 1.0, 1.0], [0.0, hertz_force(0.1), hertz_force(0.15)])
    grid = vc.Grid((60, 60), (0.28, 0.28))
    with pytest.raises(vc.DomainError, match="at t = 1 s") as stopped:
        vc.simulate(BALL, RUBBER, load, grid, [0.5, 0.75, 1.0])
    assert stopped.value.partial is not None
    assert stopped.value.partial.time.values.tolist() == [0.5, 0.75]


def test_mesh_is_judged_at_the_largest_contact_though_it_is_lost_at_the_end() -> None:
    load = vc.ForceHistory([0.0, 1.0, 1.0], [hertz_force(0.1), hertz_force(0.1), 0.0])
    grid = vc.Grid((13, 13), (0.28, 0.28))
    (said,) = Job(load=load, grid=grid, times=[0.0, 1.0]).run()
    assert "only 9 cells lie across the largest contact" in said
    with pytest.raises(vc.DomainError, match="3 cells lie across"):
        Job(load=load, grid=vc.Grid((15, 15), (1.0, 1.0)), times=[0.0, 1.0]).run()


def test_small_contacts_on_the_way_are_no_matter() -> None:
    load = vc.ForceHistory([0.0, 1.0, 2.0], [0.0, hertz_force(0.1), 0.0])
    assert Job(load=load, times=np.linspace(0, 2, 41)).run() == []
