"""Trade-offs between several goals, against known fronts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.studies.design.analytic import trials_of
from tests.studies.design.test_arguments import BALL

import viscontact as vc
from closeness import close_to
from viscontact.studies.design.goals import ScalarGoal
from viscontact.studies.design.trade_off import costs_of, not_dominated, searched_trade_off
from viscontact.studies.scalars import Value

TWO = {"load.x": ("0", "1"), "load.y": ("-1", "1")}
GOALS = (ScalarGoal("force", True), ScalarGoal("approach", True))


def parabolas(v: Mapping[str, float]) -> dict[str, Value]:
    """Distances from two points, squared (Schaffer 1985): sqrt f1 + sqrt f2 = 1 on the front."""
    x, y = v["load.x"], v["load.y"]
    return {
        "force": Value(x**2 + y**2, 0.0),
        "approach": Value((x - 1) ** 2 + y**2, 0.0),
    }


def bells(v: Mapping[str, float]) -> dict[str, Value]:
    """Fonseca and Fleming (1995), in steps of the x axis: the front, at y = 0, is not convex."""
    x, y = 2 * v["load.x"] - 1, v["load.y"]
    low, high = ((x + sign / math.sqrt(2)) ** 2 * 2 + 2 * y**2 for sign in (-1, 1))
    return {
        "force": Value(1 - math.exp(-low), 0.0),
        "approach": Value(1 - math.exp(-high), 0.0),
    }


def front_of(function: object, budget: int = 300) -> tuple[NDArray[np.float64], int]:
    """Costs on the front of a function, sorted by the first one, and the number of runs."""
    trials = trials_of(function, GOALS, TWO, budget=budget)  # type: ignore[arg-type]
    trials.of_case({})
    searched_trade_off(trials)
    done = [each for each in trials.in_order() if not each.failure]
    costs = costs_of(done, GOALS)
    found = costs[not_dominated(costs)]
    return found[found[:, 0].argsort()], trials.budget.runs


def exact_front(function: object) -> NDArray[np.float64]:
    """Front at y = 0, for x from 0 to 1."""
    sizes = [function({"load.x": x, "load.y": 0.0}) for x in np.linspace(0, 1, 2001)]  # type: ignore[operator]
    costs = np.array([[each["force"].value, each["approach"].value] for each in sizes])
    return costs[not_dominated(costs)]


@pytest.mark.parametrize("function", [parabolas, bells])
def test_the_front_of_two_goals_is_found_in_all_its_parts(function: object) -> None:
    found, runs = front_of(function)
    exact = exact_front(function)
    assert runs <= 300
    apart = np.linalg.norm(found[:, None] - exact[None], axis=2)
    # Each trial lies near the front, whose scalars are from 0 to 1, and each part of the front
    # has a trial near it.
    assert np.sqrt(np.mean(apart.min(axis=1) ** 2)) < 0.03
    assert apart.min(axis=0).max() < 0.15
    assert len(found) >= 10


@pytest.mark.slow
def test_a_larger_value_of_one_goal_and_a_smaller_one_of_the_other_are_traded(
    tmp_path: Path,
) -> None:
    path = tmp_path / "ball.yaml"
    path.write_text(BALL)
    found = vc.design(
        path,
        {"indenter.radius": ("4 mm", "10 mm")},
        minimise=["peak_pressure", "contact_area"],
        runs=40,
        workers=1,
    )
    front = found.front
    # p0 a^2 = 3 F / (2 pi) for every radius (Hertz), so that no trial is dominated.
    product = front.peak_pressure * front.contact_area / np.pi
    np.testing.assert_allclose(product, 3 * 0.1 / (2 * np.pi), rtol=0.02)
    radii = front["indenter.radius"].values * 1e3
    assert radii.min() == close_to(4.0, abs=0.15)
    assert radii.max() == close_to(10.0, abs=0.15)
    assert (np.diff(front.contact_area) <= 0).all()  # the case has a radius of the search
    assert 4.5 < float(found.best["indenter.radius"]) * 1e3 < 8
    assert bool(found.best.on_front)
    assert str(found).startswith("least peak_pressure and least contact_area: ")
    page = tmp_path / "report.html"
    found.report(page)
    text = page.read_text(encoding="utf-8")
    assert "<h2>Trade-off</h2>" in text
    assert text.count("data:image/svg+xml") == 5  # pressure, line load, trade-off, trials of both
