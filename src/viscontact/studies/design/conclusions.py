"""Conclusions of a search: notes on the best trial, or the reason why there is none."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from viscontact.results.formatting import format_with_error
from viscontact.results.variables import SCALARS
from viscontact.studies.design.evaluated_trials import Searched, Trials
from viscontact.studies.design.goals import Constraint, ParameterGoal
from viscontact.studies.design.trials import Trial
from viscontact.units.formatting import format_quantity

#: Part of a range from its end within which an optimum lies at the bound, and from a trial without
#: a limit within which it lies beside it.
AT_BOUND, BESIDE = 0.01, 0.02
#: Relative excess of a scalar that is next to its bound, and number of its errors by which it
#: differs at least in the trial that gives its slope.
NEXT_TO_BOUND, APART_ERRORS = 0.01, 3


def why_infeasible(trials: Trials) -> str:
    """Reason why no trial is feasible, with the closest one."""
    names = " or the ".join(goal.name for goal in trials.goals)
    limits, tried = trials.constraints, trials.tried()
    begin = f"no feasible design in {trials.budget.runs} runs"
    done = [trial for trial in tried if not trial.failure]
    if not done:
        reason = tried[0].failure if tried else "runs: are too few"
        return f"{begin}: every trial failed, the first one with: {reason}"
    closest = min(done, key=lambda trial: trial.violation(limits))
    where = _where(closest)
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
    if len(objective.goals) == 1:
        yield from _at_bounds(best, search)
    yield from _beside_no_limit(best, search)
    yield from _at_sharp_end(best, search)
    for limit in trials.constraints:
        yield from _undecided(best, limit)
        if search.objective.is_known:
            yield from _error_of_parameter(best, limit, search)
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


def _at_bounds(best: Trial, search: Searched) -> Iterator[str]:
    """Yield that the optimum lies at a bound, and what the trial next to it has."""
    points, trials = search.trials.points, search.trials
    own = points[best.key]
    others = [each for each in trials.tried(best.level) if each is not best]
    for number in trials.space.ranges:
        part, key = own[number], trials.space.parameters[number].key
        which = "upper" if part > 0.5 else "lower"
        begin = f"the optimum lies at the {which} bound of {key}, {best.settings[key]}"
        goal = search.objective.goals[0]
        if isinstance(goal, ParameterGoal) and goal.name == key:
            if part in (0.0, 1.0):
                yield f"{begin}, where all constraints are kept: a wider range has a better one"
            continue
        inside = [each for each in others if points[each.key][number] != part]
        if min(part, 1 - part) > AT_BOUND or not inside:
            continue
        nearest = min(inside, key=lambda each: math.dist(points[each.key], own))
        yield f"{begin}: {_next_to_bound(nearest, best, search)}"


def _next_to_bound(nearest: Trial, best: Trial, search: Searched) -> str:
    trials, (goal,), where = search.trials, search.objective.goals, _where(nearest)
    if nearest.failure:
        return f"the nearest trial, at {where}, failed"
    if not nearest.has_limits(trials.goals, trials.constraints):
        return f"the nearest trial, at {where}, has no limit"
    if not nearest.is_feasible(trials.goals, trials.constraints):
        return f"the nearest trial, at {where}, does not keep the constraints"
    units, verb = goal.units, "falls" if goal.least else "grows"
    value, own = (format_quantity(each.worst(goal).value, units) for each in (nearest, best))
    return (
        f"the {goal.name} {verb} up to there, from {value} at {where} to {own}, and a wider "
        f"range may give a better one; if it {verb} for ever, there is no optimum"
    )


def _where(trial: Trial) -> str:
    return ", ".join(f"{key}={value}" for key, value in trial.settings.items())


def _beside_no_limit(best: Trial, search: Searched) -> Iterator[str]:
    """Yield that a trial next to the best one has no limit, as at a sharp end."""
    points = search.trials.points

    def distance(trial: Trial) -> float:
        return math.dist(points[trial.key], points[best.key])

    for goal in search.objective.goals:
        tried = search.trials.tried(best.level)
        beside = [each for each in tried if not each.has_limits((goal,), ())]
        nearest = min(beside, key=distance, default=None)
        if nearest is not None and distance(nearest) <= BESIDE:
            yield (
                f"the optimum lies beside values without a limit: at {_where(nearest)} the "
                f"contact reaches an edge of the body, where the {goal.name} grows as the cells "
                "get smaller"
            )


def _at_sharp_end(best: Trial, search: Searched) -> Iterator[str]:
    """Yield the best trial whose contact is clear of the ends, if that of the best one is not."""
    trials, cost = search.trials, search.objective.cost
    if not best.is_at_sharp_end or len(search.objective.goals) > 1:
        return
    found = [
        each
        for each in trials.tried(best.level)
        if not each.is_at_sharp_end and each.is_feasible(trials.goals, trials.constraints)
    ]
    clear = min(found, key=lambda each: cost(each).value, default=None)
    if clear is not None:
        (goal,) = search.objective.goals
        value = format_quantity(clear.worst(goal).value, goal.units)
        yield (
            f"the contact of the best trial reaches a sharp end; of the trials whose contact does "
            f"not, the best has {value}, at {_where(clear)}; clear_of_ends "
            "(--clear-of-ends) searches among these"
        )


def _undecided(best: Trial, limit: Constraint) -> Iterator[str]:
    found = best.extreme(limit)
    excess = abs(found.value - limit.bound)
    if not excess > found.error and not math.isnan(found.error):
        value = format_with_error(found.value, found.error, SCALARS[limit.scalar].units)
        yield f"{limit} is kept within the error only: {value}"


def _error_of_parameter(best: Trial, limit: Constraint, search: Searched) -> Iterator[str]:
    """Yield what the error of a scalar next to its bound is in terms of the only parameter."""
    (goal,), found, trials = search.objective.goals, best.extreme(limit), search.trials
    error, is_next = found.error, abs(limit.violation(found.value)) <= NEXT_TO_BOUND
    if len(trials.space.keys) > 1 or not (math.isfinite(error) and error > 0 and is_next):
        return
    own, slopes = best.worst(goal).value, []
    for each in trials.tried():
        apart, change = each.worst(goal).value - own, each.extreme(limit).value - found.value
        if abs(change) >= APART_ERRORS * error:
            slopes.append((abs(apart), abs(apart / change)))
    if slopes:
        text = format_quantity(min(slopes)[1] * error, goal.units, 2)
        bar = format_quantity(error, limit.units, 2)
        yield f"the error of {limit.scalar}, ±{bar}, is one of about ±{text} of {goal.name}"
