"""Plan of a design: its arguments, checked before the first run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import Case
from viscontact.case.aliases import value_at
from viscontact.case.overrides import key_path
from viscontact.studies.case_values import case_path, case_with, refuse_repeated, texts
from viscontact.studies.design.goals import (
    Constraint,
    Goal,
    Names,
    constraints_of,
    goals_of,
    require_bounds,
    with_limits,
)
from viscontact.studies.design.parameters import space_of
from viscontact.studies.design.scenarios import Scenario, scenarios_of
from viscontact.studies.design.trade_off import compromises
from viscontact.studies.scalars import At, require_fluid, require_instant
from viscontact.studies.space import Space
from viscontact.units.numbers import whole

#: Most runs of a search, where none are given.
RUNS = 60


@dataclass(frozen=True)
class DesignPlan:
    """Arguments of a design that fit the case and each other."""

    path: Path
    fixed: Mapping[str, str]  # values of other keys, the same in all runs
    space: Space
    goals: tuple[Goal, ...]
    limits: tuple[Constraint, ...]
    scenarios: Sequence[Scenario]
    own: Case
    values: Mapping[str, str]  # of the parameters in the case, by key
    runs: int  # at most


def planned_design(  # noqa: PLR0913
    case: str | PathLike[str],
    change: Mapping[str, Any],
    *,
    minimise: Names = None,
    maximise: Names = None,
    at: At = "worst",
    over: Mapping[str, Sequence[Any]] | None = None,
    scatter: Mapping[str, tuple[Any, Any] | str] | None = None,
    constraints: Sequence[str] = (),
    settings: Mapping[str, Any] | None = None,
    runs: int | None = None,
) -> DesignPlan:
    """Check the arguments of `design`, without a run; ValueError begins with the argument."""
    path, fixed = case_path(case), texts(settings)
    space, allowable = space_of(change), case_with(path, fixed).allowable
    limits = constraints_of(with_limits(constraints, allowable))
    others = {"over": tuple(over or ()), "settings": tuple(fixed)}
    refuse_repeated(change=space.keys, **others)
    refuse_repeated(scatter=tuple(scatter or ()), **others)
    values = _own_values(case_with(path, fixed), (*space.keys, *(scatter or {})))
    goals = goals_of(minimise, maximise, at, space, values)
    require_bounds(goals, limits)
    most = whole("runs", _default_runs(len(goals)) if runs is None else runs, 1)
    scenarios = scenarios_of(over, scatter, space, values)
    own = _check_case(path, space, scenarios, fixed, at)
    require_fluid(own, [*(each.name for each in goals), *(each.scalar for each in limits)])
    return DesignPlan(path, fixed, space, goals, limits, scenarios, own, values, most)


def _default_runs(goals: int) -> int:
    """Most runs of each search; there is one for each goal and for each compromise."""
    if goals == 1:
        return RUNS
    return RUNS * (goals + len(compromises(goals)))


def _check_case(
    path: Path,
    space: Space,
    scenarios: Sequence[Scenario],
    fixed: Mapping[str, str],
    at: At,
) -> Case:
    """Check the case at its own values, at the bounds and in all scenarios, and return it."""

    def read(scenario: Scenario, trial: Mapping[str, str]) -> Case:
        return case_with(path, {**fixed, **scenario.settings(trial)})

    own = read(scenarios[0], {})
    require_instant(own, at)
    for corner in space.corners():
        for each in scenarios:
            if each is scenarios[0] or each.deviations:
                read(each, corner)
    for each in scenarios[1:]:
        read(each, {})
    return own


def _own_values(case: Case, keys: Sequence[str]) -> dict[str, str]:
    """Values of some keys in the case, where they are plain."""
    found = {}
    for key in keys:
        path = key_path(key)
        value = case.document.of_aliases.get(path, value_at(case.document.data, path))
        if isinstance(value, str | int | float):
            found[key] = str(value)
    return found
