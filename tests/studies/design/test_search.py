"""Search of a design on functions with known optima."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest
from tests.studies.design.analytic import (
    FunctionInPlaceOfARun,
    notes,
    random_function,
    searched,
)

from closeness import close_to
from viscontact.studies.design.conclusions import why_infeasible
from viscontact.studies.design.evaluated_trials import Searched, Trials
from viscontact.studies.design.evaluated_trials import searched as searched_among
from viscontact.studies.design.goals import ScalarGoal
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.scores import Foreseen, Point, Score
from viscontact.studies.design.search import search
from viscontact.studies.design.trials import REACH, Trial
from viscontact.studies.evaluation import Budget, Evaluation, Level
from viscontact.studies.scalars import Value

TWO = {"load.x": ("0", "1"), "load.y": ("0", "1")}


def exact(number: float) -> dict[str, Value]:
    return {"force": Value(number, 0.0)}


def reaching(length: float) -> dict[str, Value]:
    """Length of the contact, by which a search leaves values without a limit [m]."""
    return {REACH: Value(1 + length, 0.0)}


def value_of(design: Searched, trial: Trial) -> float:
    return trial.worst(design.trials.goals[0]).value


def test_a_parabola_is_minimised_in_less_than_forty_runs() -> None:
    design, best = searched(lambda v: exact(1 + (v["load.x"] - 0.37) ** 2), {"load.x": ("0", "1")})
    assert best is not None
    assert value_of(design, best) == close_to(1.0, abs=1e-3)
    assert design.trials.budget.runs <= 40


def test_the_search_needs_only_a_function_of_points() -> None:
    budget = Budget(40)

    def scores(points: Sequence[Point], level: Level, ahead: Foreseen | None) -> list[Score]:
        budget.require(len(points))
        budget.runs += len(points)
        error = 0.05 if level == "rough" else 0.0
        return [_score(each, level, 1 + (each[0] - 0.37) ** 2 + error) for each in points]

    found = search(scores, space_of({"load.x": ("0", "1")}), budget, ("rough", "fine"))
    best = found.best
    assert best is not None
    assert best.level == "fine"
    assert best.point[0] == close_to(0.37, abs=0.03)
    assert not found.is_cut_short


def test_points_within_their_errors_of_the_best_are_computed_on_the_finest_cells() -> None:
    rough, fine, asked = (1.0, 1.1, 2.0), (1.3, 1.05, 0.5), []

    def scores(points: Sequence[Point], level: Level, ahead: Foreseen | None) -> list[Score]:
        numbers = [int(3 * point[0]) for point in points]
        asked.extend((level, number) for number in numbers)
        values, error = (rough, 0.5) if level == "rough" else (fine, 0.0)
        return [
            replace(_score(point, level, values[number]), error=error)
            for point, number in zip(points, numbers, strict=True)
        ]

    space = space_of({"load.x": ["0", "1", "2"]})
    best = search(scores, space, Budget(60), ("rough", "fine")).best
    assert best is not None
    assert best.value == 1.05
    # The third one is worse by more than its error.
    assert [number for level, number in asked if level == "fine"] == [0, 1]


@pytest.mark.parametrize("edge", [0.13, 0.5, 0.9])
def test_values_without_a_limit_on_coarse_cells_are_tried_on_those_of_the_case(edge: float) -> None:
    def scores(points: Sequence[Point], level: Level, ahead: Foreseen | None) -> list[Score]:
        budget.require(1)
        budget.runs += 1
        (point,) = points
        # Coarse cells see the edge too early, and too low a value behind it.
        ends = edge / 4 if level == "coarse" else edge
        has_limit = point[0] <= ends
        value = 2 - point[0] if has_limit else 0.5
        found = _score(point, level, value)
        error = 0.0 if has_limit else math.inf
        cost = value if has_limit else 10 + point[0]
        return [replace(found, error=error, cost=cost, is_feasible=has_limit)]

    budget = Budget(20)
    found = search(scores, space_of({"load.x": ("0", "1")}), budget, ("coarse", "case"))
    assert found.best is not None
    assert edge - 0.01 < found.best.point[0] <= edge
    # The gain that is left is that up to the nearest point without a limit.
    assert found.best.value - (2 - edge) <= found.remaining_gain + 1e-9


def test_a_search_that_begins_at_a_bound_leaves_it() -> None:
    # Behind x = 0.1 there is no limit, and the least point of the coarse ones is x = 0.
    def beside(v: Mapping[str, float]) -> dict[str, Value]:
        x = v["load.x"]
        return reaching(x) | {"force": Value(3 - x, math.inf if x > 0.1 else 0.0)}

    design, best = searched(beside, {"load.x": ("0", "1")}, budget=14, is_coarse=True)
    assert best is not None
    assert 0.09 < float(best.settings["load.x"]) <= 0.1
    assert not any("bound" in each for each in notes(best, design))


def test_a_bound_beside_values_without_a_limit_is_not_called_a_trend() -> None:
    def spike(v: Mapping[str, float]) -> dict[str, Value]:
        x = v["load.x"]
        return reaching(x) | {"force": Value(3 - x, math.inf if x > 0.0 else 0.0)}

    design, best = searched(spike, {"load.x": ("0", "1")}, budget=30)
    assert best is not None
    (note,) = [each for each in notes(best, design) if "bound" in each]
    assert note.startswith(
        "the optimum lies at the lower bound of load.x, 0: the nearest trial, at "
    )
    assert note.endswith("has no limit")


def test_a_trend_up_to_a_bound_is_stated_with_the_next_trial() -> None:
    design, best = searched(lambda v: exact(3 - v["load.x"]), {"load.x": ("0", "1")})
    assert best is not None
    (note,) = [each for each in notes(best, design) if "bound" in each]
    tried = sorted(float(trial.settings["load.x"]) for trial in design.trials.tried())
    assert f"from {3 - tried[-2]:.4g} N at load.x={tried[-2]:.5g} to 2 N" in note


def test_a_scalar_without_a_limit_does_not_keep_an_upper_bound() -> None:
    limit = "peak_pressure <= 5 Pa"

    def singular(v: Mapping[str, float]) -> dict[str, Value]:
        peak = Value(2.0, math.inf if v["load.x"] > 0.4 else 0.01)
        return exact(2 - v["load.x"]) | {limit: peak}

    _, best = searched(singular, {"load.x": ("0", "1")}, constraints=["peak_pressure<=5 Pa"])
    assert best is not None
    assert 0.39 < float(best.settings["load.x"]) <= 0.4


def test_a_range_of_less_than_the_digits_of_its_values_is_searched_to_an_end() -> None:
    def slope(v: Mapping[str, float]) -> dict[str, Value]:
        return exact(3 - v["load.x"])

    design, best = searched(slope, {"load.x": ("1", "1.0001")})
    assert best is not None
    assert float(best.settings["load.x"]) == 1.0001
    assert design.trials.budget.runs < 10


@pytest.mark.parametrize("seed", range(8))
def test_the_optimum_of_a_random_function_is_found_within_the_stated_gain(seed: int) -> None:
    known = random_function(seed)
    design, best = searched(known.values, TWO, constraints=known.constraints, budget=40)
    assert best is not None
    gain = (value_of(design, best) - known.least) / known.least
    assert gain < 0.01
    # A surrogate sees too little of a kink.
    assert gain <= (3 if seed % 4 == 1 else 1) * design.remaining_gain / known.least


def _score(point: Point, level: Level, value: float) -> Score:
    return Score((level, point), point, level, value, 0.0, value, 0.0, True, False)


def test_a_logarithmic_range_is_searched_on_its_scale() -> None:
    change = {"load.x": ("1 mm", "10 m", "log")}
    _design, best = searched(lambda v: exact(1 + math.log10(v["load.x"] / 20) ** 2), change)
    assert best is not None
    # The unit is that of the lower bound; the width of the parabola allows 8 %.
    assert float(best.settings["load.x"].split()[0]) == close_to(20, rel=0.08)
    assert best.settings["load.x"].endswith("mm")


def test_the_largest_value_is_found_where_it_is_asked_for() -> None:
    design, best = searched(
        lambda v: exact(5 - (v["load.x"] - 0.7) ** 2), {"load.x": ("0", "1")}, least=False
    )
    assert best is not None
    assert value_of(design, best) == close_to(5.0, abs=5e-3)


def test_a_kinked_valley_of_two_parameters_is_followed_to_within_two_per_cent() -> None:
    def valley(v: Mapping[str, float]) -> dict[str, Value]:
        x, y = v["load.x"], v["load.y"]
        return exact(max(2 - x - 0.3 * y, 0.5 + 3 * x + y))

    # Both are equal at x = 0.375 - 0.325 y; along this line 1.625 + 0.025 y is least at y = 0.
    design, best = searched(valley, TWO)
    assert best is not None
    assert value_of(design, best) == close_to(1.625, rel=0.02)
    assert design.trials.budget.runs <= 60


def test_the_global_one_of_two_minima_is_found() -> None:
    def waves(v: Mapping[str, float]) -> dict[str, Value]:
        x = v["load.x"]
        return exact(3 + math.cos(4 * math.pi * x) + 0.8 * (x - 0.8) ** 2)

    _, best = searched(waves, {"load.x": ("0", "1")})
    assert best is not None
    assert float(best.settings["load.x"]) == close_to(0.75, abs=0.03)


@pytest.mark.parametrize("bound", [0.25, 0.5, 0.61])
def test_the_optimum_under_a_constraint_lies_on_it(bound: float) -> None:
    def falling(v: Mapping[str, float]) -> dict[str, Value]:
        x = v["load.x"]
        return exact(2 - x) | {f"contact_length <= {1000 * bound:g} mm": Value(x, 0.0)}

    limit = [f"contact_length<={bound} m"]
    _design, best = searched(falling, {"load.x": ("0", "1")}, constraints=limit)
    assert best is not None
    assert bound - 0.02 < float(best.settings["load.x"]) <= bound


def test_a_value_without_a_limit_is_never_the_best() -> None:
    def singular(v: Mapping[str, float]) -> dict[str, Value]:
        return {"force": Value(2 - v["load.x"], math.inf if v["load.x"] > 0.4 else 0.0)}

    design, best = searched(singular, {"load.x": ("0", "1")})
    assert best is not None
    assert 0.38 < float(best.settings["load.x"]) <= 0.4
    (note,) = [each for each in notes(best, design) if "without a limit" in each]
    beside = float(note.partition("load.x=")[2].split()[0])
    assert 0.4 < beside < float(best.settings["load.x"]) + 0.02


def test_trials_that_fail_do_not_end_the_search() -> None:
    def partly(v: Mapping[str, float]) -> dict[str, Value]:
        if v["load.x"] > 0.45:
            raise ValueError("no such body")
        return exact(1 + (v["load.x"] - 0.3) ** 2)

    _, best = searched(partly, {"load.x": ("0", "1")})
    assert best is not None
    assert float(best.settings["load.x"]) == close_to(0.3, abs=0.05)


def test_the_worst_scenario_decides() -> None:
    goals = (ScalarGoal("force", True),)

    def runs_of(settings: Mapping[str, str], level: Level) -> list[FunctionInPlaceOfARun]:
        # The larger one of 1 + x and 3 - x in two scenarios is least at x = 1.
        slopes = ((1, 1), (3, -1))
        return [
            FunctionInPlaceOfARun(
                f"{number} {settings}",
                lambda v, first=first, slope=slope: exact(first + slope * v["load.x"]),
                goals,
                settings,
            )
            for number, (first, slope) in enumerate(slopes)
        ]

    evaluation = Evaluation(Budget(60))
    trials = Trials(space_of({"load.x": ["0", "1", "2"]}), runs_of, goals, (), evaluation)
    best = searched_among(trials, Objective(goals)).best
    assert best is not None
    assert best.settings == {"load.x": "1"}
    assert evaluation.budget.runs == 2 * 3


def test_choices_are_tried_in_all_combinations() -> None:
    change = {"load.x": ["1", "2", "5"], "load.y": ["3", "4"]}
    design, best = searched(lambda v: exact(abs(v["load.x"] - 2.1) + v["load.y"]), change)
    assert best is not None
    assert best.settings == {"load.x": "2", "load.y": "3"}
    assert design.trials.budget.runs == 1 + 6  # with the case itself


def test_a_choice_and_a_range_are_searched_together() -> None:
    change = {"load.x": ("0", "1"), "load.y": ["3", "4"]}
    design, best = searched(lambda v: exact((v["load.x"] - 0.6) ** 2 + 5 - v["load.y"]), change)
    assert best is not None
    assert best.settings["load.y"] == "4"
    assert value_of(design, best) == close_to(1.0, abs=0.01)


@pytest.mark.parametrize("budget", [1, 5, 17])
def test_no_more_runs_are_made_than_allowed(budget: int) -> None:
    design, _ = searched(lambda v: exact(v["load.x"] * v["load.y"]), TWO, budget=budget)
    assert design.trials.budget.runs <= budget


def test_the_best_of_the_coarse_cells_is_computed_on_those_of_the_case() -> None:
    design, best = searched(
        lambda v: exact(1 + (v["load.x"] - 0.37) ** 2), {"load.x": ("0", "1")}, is_coarse=True
    )
    assert best is not None
    assert best.level == "case"
    assert {each.level for each in design.trials.in_order()} == {"coarse", "case"}


@pytest.mark.parametrize("slope", [1.0, -1.0])
def test_an_optimum_at_a_bound_is_reported_with_its_bound(slope: float) -> None:
    design, best = searched(lambda v: exact(3 + slope * v["load.x"]), {"load.x": ("0", "1")})
    assert best is not None
    assert float(best.settings["load.x"]) == (0.0 if slope > 0 else 1.0)
    (note,) = [each for each in notes(best, design) if "bound" in each]
    bound = "lower bound of load.x, 0:" if slope > 0 else "upper bound of load.x, 1:"
    assert bound in note


def test_an_infeasible_design_names_the_constraint_and_the_closest_trial() -> None:
    def far(v: Mapping[str, float]) -> dict[str, Value]:
        return exact(1.0) | {"contact_length <= 1 m": Value(1.5 + v["load.x"], 0.0)}

    design, best = searched(far, {"load.x": ("0", "1")}, constraints=["contact_length<=1m"])
    assert best is None
    why = why_infeasible(design.trials)
    assert why.startswith("no feasible design in ")
    assert "contact_length <= 1 m is not kept; the closest is 1.5" in why


@pytest.mark.parametrize("bound", [0.41, 0.6])
def test_a_feasible_corner_is_found_in_a_third_of_the_runs(bound: float) -> None:
    def long(v: Mapping[str, float]) -> dict[str, Value]:
        x, y = v["load.x"], v["load.y"]
        length = Value(0.4 + 0.8 * x + y, 0.0)
        return exact(3 - x - y) | {f"contact_length <= {1000 * bound:g} mm": length}

    # Feasible is a triangle at x = y = 0: of 0.006 % of the plane in the first case, where the
    # middle of the plane exceeds the bound by more than 100 %, and of 2.5 % in the second.
    limits = [f"contact_length<={bound} m"]
    design, best = searched(long, TWO, constraints=limits, budget=20, is_coarse=True)
    assert best is not None
    assert best.level == "case"
    assert design.trials.budget.runs <= 20
    # The optimum is that of a straight line: all of the length goes to x.
    assert value_of(design, best) == close_to(3 - (bound - 0.4) / 0.8, rel=0.03)


@pytest.mark.parametrize("budget", [6, 9, 12])
def test_few_runs_still_give_a_certified_trial_and_a_note(budget: int) -> None:
    design, best = searched(
        lambda v: exact(2 + (v["load.x"] - 0.2) ** 2 + (v["load.y"] - 0.9) ** 2),
        TWO,
        budget=budget,
        is_coarse=True,
    )
    assert best is not None
    assert best.level == "case"
    assert design.trials.budget.runs <= budget
    assert any(f"{budget} runs are too few" in note for note in notes(best, design))


@pytest.mark.parametrize("workers", [2, 3, 4])
def test_workers_compute_trials_ahead_and_do_not_change_the_search(workers: int) -> None:
    def bowl(v: Mapping[str, float]) -> dict[str, Value]:
        return exact(2 + (v["load.x"] - 0.27) ** 2 + 3 * (v["load.y"] - 0.61) ** 2)

    one, best = searched(bowl, TWO, is_coarse=True)
    several, same = searched(bowl, TWO, is_coarse=True, workers=workers)
    assert several.trials.in_order() == one.trials.in_order()
    assert best == same
    trials = len(one.trials.in_order())
    rounds = several.trials.evaluation.workers.executor.rounds  # type: ignore[attr-defined]
    # Without a wrong guess there would be 1 / workers as many rounds as trials.
    assert rounds < 1.7 * trials / workers
    assert rounds >= trials / workers
