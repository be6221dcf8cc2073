"""Conclusions of a search: notes on the best trial, or the reason why there is none."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from viscontact.results.formatting import format_with_error
from viscontact.results.variables import SCALARS
from viscontact.studies.design.evaluated_trials import Searched, Trials
from viscontact.studies.design.goals import Constraint
from viscontact.studies.design.trials import Trial
from viscontact.units.formatting import format_quantity

#: Part of a range from its end within which an optimum lies at the bound, and from a trial without
#: a limit within which it lies beside it.
AT_BOUND, BESIDE = 0.01, 0.02


def why_infeasible(trials: Trials) -> str:
    """Reason why no trial is feasible, with the closest one."""
    names = " or the ".join(goal.scalar for goal in trials.goals)
    limits, tried = trials.constraints, trials.tried()
    begin = f"no feasible design in {trials.budget.runs} runs"
    done = [trial for trial in tried if not trial.failure]
    if not done:
        reason = tried[0].failure if tried else "runs: are too few"
        return f"{begin}: every trial failed, the first one with: {reason}"
    closest = min(done, key=lambda trial: trial.violation(limits))
    where = ", ".join((f"{key}={value}" for key, value in closest.settings.items()))
    if closest.violation(limits) == 0.0:
        return (
            f"{begin}: the {names} has no limit, as at a sharp end, or the trials on coarse "
            f"cells were not confirmed on those of the case (closest: {where}); constrain the "
            "contact, choose another scalar, or allow more runs"
        )
    broken = max(limits, key=lambda each: each.violation(closest.extreme(each).value))
    value = format_quantity(closest.extreme(broken).value, broken.units)
    return f"{begin}: {broken} is not kept; the closest is {value} at {where}"


def notes_on(best: Trial, before: Trial, search: Searched) -> Iterator[str]:
    """Yield notes on the best trial, and on that of the case `before`."""
    trials, objective = search.trials, search.objective
    space, goals, point = trials.space, objective.goals, trials.points[best.key]
    for number in space.ranges if len(goals) == 1 else ():
        goal = goals[0]
        part, key = point[number], space.parameters[number].key
        if min(part, 1 - part) <= AT_BOUND:
            which, verb = "upper" if part > 0.5 else "lower", "falls" if goal.least else "grows"
            yield (
                f"the optimum lies at the {which} bound of {key}, {best.settings[key]}: the "
                f"{goal.scalar} {verb} up to there, and a wider range may give a better one; if it "
                f"{verb} for ever, there is no optimum"
            )
    yield from _beside_no_limit(best, search)
    for limit in trials.constraints:
        yield from _undecided(best, limit)
    if search.is_cut_short:
        yield f"{trials.budget.most} runs are too few to search until the gain is within the error"
    if before.is_feasible(trials.goals, trials.constraints):
        own, found = (objective.cost(each).value for each in (before, best))
        if own < found:
            yield "the values of the case itself are better than the best ones that were found"
    yield from best.warnings


def notes_on_trade_off(searches: Sequence[Searched], before: Trial) -> Iterator[str]:
    """Yield notes on the trials of a trade-off, each once."""
    yield (
        "the best trial is the compromise whose scalars are equally far from their best values; "
        "the table has all trials that are not dominated"
    )
    notes = (
        note
        for each in searches
        if each.best is not None
        for note in notes_on(each.best, before, each)
    )
    yield from dict.fromkeys(notes)


def _beside_no_limit(best: Trial, search: Searched) -> Iterator[str]:
    """Yield that a trial next to the best one has no limit, as at a sharp end."""
    points = search.trials.points

    def distance(trial: Trial) -> float:
        return math.dist(points[trial.key], points[best.key])

    for goal in search.objective.goals:
        tried = search.trials.tried(best.level)
        beside = [each for each in tried if each.worst(goal).depends_on_mesh]
        nearest = min(beside, key=distance, default=None)
        if nearest is not None and distance(nearest) <= BESIDE:
            where = ", ".join(f"{key}={value}" for key, value in nearest.settings.items())
            yield (
                f"the optimum lies beside values without a limit: at {where} the contact reaches "
                f"an edge of the body, where the {goal.scalar} grows as the cells get smaller"
            )


def _undecided(best: Trial, limit: Constraint) -> Iterator[str]:
    found = best.extreme(limit)
    excess = abs(found.value - limit.bound)
    if not excess > found.error and not math.isnan(found.error):
        value = format_with_error(found.value, found.error, SCALARS[limit.scalar].units)
        yield f"{limit} is kept within the error only: {value}"
