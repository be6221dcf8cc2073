"""Trade-off between several goals: the trials that are not dominated by any other one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.studies.design.evaluated_trials import Searched, Trials, searched
from viscontact.studies.design.goals import Goal
from viscontact.studies.design.objectives import Objective
from viscontact.studies.design.trials import Trial

#: Weights of the compromises are multiples of its inverse.
_PARTS = 4


def compromises(count: int) -> list[tuple[float, ...]]:
    """Weights of the goals in the compromises, all above zero; equal ones are the last."""
    equal = (1 / count,) * count
    lattice = (row for row in product(range(1, _PARTS), repeat=count) if sum(row) == _PARTS)
    found = [tuple(each / _PARTS for each in row) for row in lattice]
    return [*(row for row in found if not np.allclose(row, equal, atol=0)), equal]


def searched_trade_off(trials: Trials) -> list[Searched]:
    """Search for the best trial of each goal, then for compromises; the equal one is the last."""
    # If a goal has no feasible trial, its search is the last.
    goals, budget, weights = trials.goals, trials.budget, compromises(len(trials.goals))
    found: list[Searched] = []

    def search(objective: Objective) -> None:
        later = len(goals) + len(weights) - len(found) - 1
        held = (budget.most - budget.runs) * later // (later + 1)
        found.append(searched(trials, objective, held=held))

    for goal in goals:
        search(Objective((goal,)))
    ends = [each.best for each in found if each.best is not None]
    if len(ends) < len(goals):
        return found
    costs = costs_of(ends, goals)
    least = costs.min(axis=0)
    spans = np.maximum(costs.max(axis=0) - least, 1e-6 * abs(least) + 1e-300)
    for each in weights:
        search(Objective(tuple(goals), each, tuple(least), tuple(spans)))
    return found


def costs_of(trials: Sequence[Trial], goals: Sequence[Goal]) -> Floats:
    """Costs of all goals in some trials, of shape (trials, goals)."""
    return np.array([[goal.cost(each.worst(goal).value) for goal in goals] for each in trials])


def not_dominated(costs: Floats) -> Bools:
    """Rows of which no other one is as good in every cost and better in one."""
    no_worse = np.all(costs[None] <= costs[:, None], axis=2)
    better = np.any(costs[None] < costs[:, None], axis=2)
    is_dominated = np.any(no_worse & better, axis=1)
    return np.asarray(~is_dominated & ~np.isnan(costs).any(axis=1))
