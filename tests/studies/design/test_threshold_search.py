"""Search for the best value of a parameter that keeps the constraints, on functions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from tests.studies.design.analytic import notes, searched, trials_of

from closeness import close_to
from viscontact.studies.design.conclusions import why_infeasible
from viscontact.studies.design.goals import ScalarGoal, goals_of
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.trade_off import costs_of, not_dominated, searched_trade_off
from viscontact.studies.scalars import Value

LIMIT = "peak_pressure <= 1 Pa"
CHANGE = {"load.x": ("1", "5"), "load.y": ("0", "1")}


def peak(function: Callable[[float], float]) -> Callable[[Mapping[str, float]], dict[str, Value]]:
    return lambda v: {LIMIT: Value(function(v["load.x"]), 0.0)}


#: Peaks over the parameter from 1 to 10, with the least parameter whose peak is at most 1.
CURVES: dict[str, tuple[Callable[[float], float], float]] = {
    "straight": (lambda x: 2 - x / 4, 4.0),
    "power": (lambda x: (6.5 / x) ** 0.15, 6.5),
    "flat": (lambda x: 1 + 1e-3 * (3.3 - x), 3.3),
    "steep": (lambda x: math.exp(3 * (7.7 - x)), 7.7),
    "to the left of a peak": (lambda x: 1 + math.sin(x), math.pi),
    "with a step": (lambda x: 1.5 if x < 5.2 else 0.7, 5.2),
}


@pytest.mark.parametrize("is_coarse", [False, True])
@pytest.mark.parametrize(("function", "root"), CURVES.values(), ids=CURVES.keys())
def test_the_least_parameter_within_a_bound_is_the_root_of_the_excess(
    function: Callable[[float], float], root: float, is_coarse: bool
) -> None:
    change = {"load.x": ("1", "10")}
    design, best = searched(
        peak(function), change, parameter="load.x", constraints=[LIMIT], is_coarse=is_coarse
    )
    assert best is not None
    found = float(best.settings["load.x"])
    assert 0 <= found - root <= 1e-3 * root
    # What remains is the bracket, beyond which the bound is not kept.
    assert found - root <= design.remaining_gain + 1e-12 <= 2e-3 * root
    assert not design.is_cut_short
    # The root of a step can only be halved; the case itself is one more.
    assert design.trials.budget.runs <= (30 if function(5.1999) == 1.5 else 14)


def test_the_largest_parameter_is_found_from_the_upper_end_on() -> None:
    change = {"load.x": ("1 mm", "1 m", "log")}
    design, best = searched(
        peak(lambda x: x / 40),
        change,
        least=False,
        parameter="load.x",
        constraints=[LIMIT],
    )
    assert best is not None
    assert float(best.settings["load.x"].split()[0]) == close_to(40.0, rel=1e-3)
    assert design.trials.budget.runs <= 12


@pytest.mark.parametrize(
    ("ends", "root"),
    [(("10 mm", "10.2 mm"), 10.0733), (("10 mm", "10.1 mm"), 10.0711), (("-1 mm", "1 mm"), -0.2)],
)
def test_narrow_ranges_and_those_with_a_zero_are_searched_as_others(
    ends: tuple[str, str], root: float
) -> None:
    low, high = (float(end.split()[0]) for end in ends)
    design, best = searched(
        peak(lambda x: 1 + (root - x) / (high - low)),
        {"load.x": ends},
        parameter="load.x",
        constraints=[LIMIT],
    )
    assert best is not None
    found = float(best.settings["load.x"].split()[0])
    # Values have five digits.
    assert 0 <= found - root <= 1.1e-3 * (high - low) + 1e-4 * abs(root)
    assert not design.is_cut_short


def test_a_bound_that_is_kept_everywhere_takes_one_run_a_level() -> None:
    design, best = searched(
        peak(lambda x: 0.5),
        {"load.x": ("1", "10")},
        parameter="load.x",
        constraints=[LIMIT],
        is_coarse=True,
    )
    assert best is not None
    assert best.settings == {"load.x": "1"}
    assert design.trials.budget.runs == 3  # the case itself, and the lower bound on both cells
    assert design.remaining_gain == 0.0
    (note,) = notes(best, design)
    assert note == (
        "the optimum lies at the lower bound of load.x, 1, where all constraints are kept: a wider "
        "range has a better one"
    )


def test_a_window_between_the_first_points_is_found() -> None:
    # 1 at x = 6.2 and at 6.6, above it elsewhere.
    design, best = searched(
        peak(lambda x: 1 + (x - 6.2) * (x - 6.6)),
        {"load.x": ("1", "10")},
        parameter="load.x",
        constraints=[LIMIT],
    )
    assert best is not None
    assert 0 <= float(best.settings["load.x"]) - 6.2 <= 6.2e-3
    assert design.trials.budget.runs <= 30


def test_bounds_that_are_nowhere_kept_name_the_closest_trial() -> None:
    design, best = searched(
        peak(lambda x: 1.2 + (x - 4) ** 2),
        {"load.x": ("1", "10")},
        parameter="load.x",
        constraints=[LIMIT],
    )
    assert best is None
    assert why_infeasible(design.trials).startswith("no feasible design in ")
    assert design.trials.budget.runs <= 20


def test_coarse_cells_decide_only_where_the_search_goes_on() -> None:
    _design, best = searched(
        peak(lambda x: 5 / x),
        {"load.x": ("1", "10")},
        parameter="load.x",
        constraints=[LIMIT],
        is_coarse=True,
        on_coarse=peak(lambda x: 3 / x),
    )
    assert best is not None
    assert best.level == "case"
    assert 0 <= float(best.settings["load.x"]) - 5 <= 5e-3


@pytest.mark.parametrize("weight", [1.0, 0.03])
def test_of_two_parameters_the_other_one_helps(weight: float) -> None:
    # The excess 4 - x - 3 y (2 - y) is least at y = 1, where it is 1 - x: x = 1 in place of 4.
    def function(v: Mapping[str, float]) -> dict[str, Value]:
        x, y = v["load.x"], v["load.y"]
        return {LIMIT: Value(1 + weight * (4 - x - 3 * y * (2 - y)), 0.0)}

    change = {"load.x": ("0.5", "10"), "load.y": ("0", "2")}
    _design, best = searched(function, change, parameter="load.x", constraints=[LIMIT])
    assert best is not None
    assert 0 <= float(best.settings["load.x"]) - 1 <= 0.02


def test_choices_are_tried_from_the_better_end_on_up_to_the_first_feasible_one() -> None:
    change = {"load.x": ["5 mm", "1 cm", "2 mm", "20 mm"], "load.y": ["3", "4"]}

    def function(v: Mapping[str, float]) -> dict[str, Value]:
        return {LIMIT: Value(4.5 / v["load.x"], 0.0)}

    design, best = searched(function, change, parameter="load.x", constraints=[LIMIT])
    assert best is not None
    assert best.settings["load.x"] == "5 mm"
    # The case itself; 1 and 2 mm fail with both values of y, 5 mm is the first that does not.
    assert design.trials.budget.runs <= 1 + 2 * 2 + 2


@pytest.mark.parametrize("scale", [("4", "60"), ("4", "60", "log")], ids=["even", "log"])
def test_the_thinnest_cover_under_two_bounds_is_that_of_the_largest_roll(
    scale: tuple[str, ...],
) -> None:
    # A nip in numbers: the peak falls with thickness and diameter, and the width grows. The
    # thinnest cover has the largest diameter of 300, with 1.16 (1 + 1/t) = 1.4.
    def on(cells: float) -> Callable[[Mapping[str, float]], dict[str, Value]]:
        def nip(v: Mapping[str, float]) -> dict[str, Value]:
            pressure = cells * 1.16 * (1 + 1 / v["load.x"]) * (300 / v["load.y"]) ** 0.23
            width = Value(7.55e-3 / pressure, 1e-6)
            return {
                "peak_pressure <= 1.4 Pa": Value(pressure, 1e-3),
                "strip_width <= 5.5 mm": width,
            }

        return nip

    design, best = searched(
        on(1.0),
        {"load.x": scale, "load.y": ("60", "300")},
        parameter="load.x",
        constraints=["peak_pressure<=1.4 Pa", "strip_width<=5.5mm"],
        is_coarse=True,
        on_coarse=on(1.0004),
    )
    assert best is not None
    least = 1 / (1.4 / 1.16 - 1)
    gain = float(best.settings["load.x"]) - least
    assert 0 <= gain <= 3e-3 * least
    assert gain <= 2 * design.remaining_gain


def test_a_parameter_and_a_scalar_are_traded_along_their_curve() -> None:
    goals = (
        *goals_of("load.x", None, "worst", space_of(CHANGE), {}),
        ScalarGoal("force", True),
    )

    # The least force at x is 1/x, at y = 0.3, so that no trial along y = 0.3 is dominated.
    def forces(v: Mapping[str, float]) -> dict[str, Value]:
        return {"force": Value(1 / v["load.x"] + (v["load.y"] - 0.3) ** 2, 0.0)}

    trials = trials_of(forces, goals, CHANGE, budget=80)
    trials.of_case({})
    searched_trade_off(trials)
    done = [each for each in trials.in_order() if not each.failure]
    front = costs_of(done, goals)
    front = front[not_dominated(front)]
    assert np.median(front[:, 1] - 1 / front[:, 0]) < 0.01
    assert np.ptp(front[:, 0]) > 3
