"""Constraints, scenarios and compromises of a design."""

from __future__ import annotations

import math

import numpy as np

from viscontact.studies.design.goals import Constraint, ScalarGoal, constraints_of
from viscontact.studies.design.scenarios import Deviation, Scenario
from viscontact.studies.design.trade_off import compromises, not_dominated
from viscontact.studies.design.trials import ScenarioResult, Trial
from viscontact.studies.scalars import Value


def test_violation_is_the_excess_relative_to_the_bound() -> None:
    assert Constraint("force", True, 10.0).violation(12.0) == 0.2


def test_constraint_is_read_with_its_unit() -> None:
    assert str(constraints_of(["contact_length<=18mm"])[0]) == "contact_length <= 18 mm"


def test_deviation_is_added_to_a_value_with_its_unit() -> None:
    assert Deviation("-0.5 mm", "").added_to("12 mm") == "0.0115 m"


def test_scenario_adds_its_deviation_to_the_trial() -> None:
    wide = Scenario("wide", {"load.force": "1 N"}, {"load.x": Deviation("2 mm", "5 mm")})
    assert wide.settings({"load.x": "3 mm"}) == {"load.force": "1 N", "load.x": "0.005 m"}


def test_a_trial_that_is_equal_in_one_goal_and_worse_in_another_is_dominated() -> None:
    costs = [[0.0, 1.0], [0.0, 2.0], [1.0, 0.0], [2.0, 0.5], [math.nan, 0.0], [0.0, 1.0]]
    assert not_dominated(np.array(costs)).tolist() == [True, False, True, False, False, True]


def test_a_value_without_a_limit_is_the_worst_of_the_scenarios() -> None:
    goal, limitless = ScalarGoal("peak_pressure", least=True), Value(1.0, math.inf)
    values = [Value(2.0, 0.1), limitless, Value(3.0, 0.1)]
    results = tuple(ScenarioResult({goal.entries[0]: each}) for each in values)
    assert Trial({}, "case", results).worst(goal) == limitless
    assert Trial({}, "case", results[::2]).worst(goal) == values[2]
    assert Trial({}, "case", (*results, ScenarioResult({}, "failed"))).failure == "failed"


def test_compromises_have_positive_weights_and_end_with_equal_ones() -> None:
    assert compromises(2) == [(0.25, 0.75), (0.75, 0.25), (0.5, 0.5)]
