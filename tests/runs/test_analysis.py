"""Runs over time and over speed behave alike to those who ask their analysis."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.runs.analysis import Analysis
from viscontact.runs.directory.recorded import Recorded
from viscontact.runs.directory.recorder import Recorder
from viscontact.runs.over_speed import OverSpeed
from viscontact.runs.over_time import OverTime
from viscontact.runs.solving import solve
from viscontact.simulation.steady_motion.preparation import prepare
from viscontact.simulation.steady_motion.problem import steady_problem
from viscontact.simulation.transient.setup import prepare_run

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
BALL, LEVEL = vc.Sphere(0.01), vc.step(0.1, tilt_x=0.0, tilt_y=0.0)
GRID = vc.Grid((24, 24), (2.4e-3, 2.4e-3))


def over_time(**further: Any) -> OverTime:
    given = {"indenter": BALL, "material": RUBBER, "load": LEVEL, "grid": GRID, **further}
    return OverTime(prepare_run(contact_problem(**given)))


def standing() -> OverTime:
    return over_time(times=[0.0, 0.5, 1.0], fields=[0.5])


def travelling() -> OverTime:
    return over_time(times=np.linspace(0.0, 1.0, 5), motion=vc.Travel([0.0, 1.0], y=[0.0, 3e-4]))


def choosing() -> OverTime:
    return over_time(times=vc.adaptive_times(2.0, 0.05))


def steady() -> OverSpeed:
    motion = SteadyMotion((1e-2, 1e-3), "y")
    contact = contact_problem(
        indenter=BALL, material=RUBBER, load=LEVEL, grid=GRID, fields=[1e-2], motion=motion
    )
    return OverSpeed(prepare(steady_problem(contact, motion)))


@pytest.mark.parametrize("make", [standing, travelling, steady])
def test_result_of_a_run_is_the_recorded_one(
    make: Callable[[], Analysis[Any, Any]], tmp_path: Path
) -> None:
    run = make()
    expected = solve(run)
    record = Recorder(Recorded(tmp_path, run))
    for _ in record.steps():
        pass
    record.finish(record.estimate_errors())
    assert expected.attrs["case"] == run.attributes["case"]
    with vc.open_results(tmp_path) as stored:
        assert set(stored.variables) == set(expected.variables)
        assert stored[run.axis.name].values.tolist() == run.places.tolist()
        for name in expected.variables:
            np.testing.assert_allclose(stored[name], expected[name], rtol=1e-6, err_msg=name)


@pytest.mark.parametrize("make", [standing, travelling, steady])
def test_only_the_last_state_completes_a_run(make: Callable[[], Analysis[Any, Any]]) -> None:
    run = make()
    loop = run.states()
    states = [(run.part(loop, state), run.is_last(state)) for state in loop if state is not None]
    assert len(states) == run.total
    assert [part for part, _ in states] == [n / len(states) for n in range(1, len(states) + 1)]
    assert [last for _, last in states] == [False] * (len(states) - 1) + [True]


def test_finished_part_of_adaptive_steps_is_that_of_the_time() -> None:
    run = choosing()
    loop = run.states()
    found = [(state.time, run.part(loop, state)) for state in loop if state is not None]
    assert [part for _, part in found] == [time / 2.0 for time, _ in found]
    assert len(found) > 3
    assert run.total is None


def test_material_creeps_up_to_the_end_or_while_the_slowest_body_passes_the_grid() -> None:
    assert standing().longest_creep == 1.0
    assert steady().longest_creep == close_to(2.4e-3 / 1e-3)


def test_a_curve_that_ends_early_has_the_grid_of_its_first_speeds() -> None:
    run = steady()
    wider = replace(run.setup, grids=(GRID, GRID.widened((32, 32))))
    whole, first = OverSpeed(wider), next(iter(run.states()))
    assert first is not None
    assert whole.grid.shape == (32, 32)
    assert whole.after([first]).grid == GRID


def test_body_without_a_motion_has_none_of_its_scalars() -> None:
    assert "position_x" not in solve(standing())
    assert "motion" not in standing().case  # as runs from before are described, which are resumed
    assert "motion" in travelling().case
    assert {"position_x", "friction_coefficient", "heat"} <= set(solve(travelling()))


@pytest.mark.parametrize("call", ["simulate", "steady"])
def test_warnings_name_the_file_that_calls(call: str) -> None:
    coarse, further = vc.Grid((12, 12), (2.4e-3, 2.4e-3)), {"times": [0.0]}
    if call == "steady":
        further = {"speed": [1e-2]}
    with pytest.warns(vc.AccuracyWarning) as caught:
        getattr(vc, call)(BALL, RUBBER, LEVEL, grid=coarse, **further)
    assert {each.filename for each in caught} == {__file__}


def test_steady_motion_is_refused_over_time() -> None:
    with pytest.raises(ValueError, match="a steady motion is over speed, not over time"):
        over_time(times=[0.0, 1.0], motion=SteadyMotion((1e-2,), "y"))
