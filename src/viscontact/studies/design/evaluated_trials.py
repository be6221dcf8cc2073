"""Trials of a design, whose runs an evaluation makes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from viscontact.studies.design.goals import Constraint, Goal
from viscontact.studies.design.search import Foreseen, Point
from viscontact.studies.design.trials import ScenarioResult, Trial
from viscontact.studies.evaluation import Budget, Entry, Evaluation, Level, StudyRun
from viscontact.studies.scalars import Value
from viscontact.studies.space import Space

#: Runs of a trial with some values, on cells of a level, one for each scenario.
RunsOf = Callable[[Mapping[str, str], Level], Sequence[StudyRun]]


@dataclass
class Trials:
    """Trials at points of a space, each made once, in their order."""

    space: Space
    runs_of: RunsOf
    goals: tuple[Goal, ...]
    constraints: tuple[Constraint, ...]
    evaluation: Evaluation
    made: dict[tuple[str, ...], Trial] = field(default_factory=dict)

    @property
    def budget(self) -> Budget:
        """Runs that are allowed and made."""
        return self.evaluation.budget

    def in_order(self) -> list[Trial]:
        """Trials, the case itself first."""
        return list(self.made.values())

    def __call__(
        self, points: Sequence[Point], level: Level, ahead: Foreseen | None = None
    ) -> list[Trial]:
        """Trials at some points; `ahead` gives points that are likely to follow."""

        def likely(count: int) -> Iterator[Sequence[StudyRun]]:
            for point in ahead(count) if ahead else ():
                yield self.runs_of(self.space.settings(point), level)

        return [self._trial(self.space.settings(point), level, likely) for point in points]

    def of_case(self) -> Trial:
        """Trial of the case with its own values."""
        return self._trial({}, "case", None)

    def _trial(
        self,
        settings: Mapping[str, str],
        level: Level,
        likely: Callable[[int], Iterator[Sequence[StudyRun]]] | None,
    ) -> Trial:
        known = self.made.get(Trial(settings, level, ()).key)
        if known is not None:
            return known
        outcomes = self.evaluation.outcomes(self.runs_of(settings, level), likely)
        trial = Trial(dict(settings), level, tuple(map(_result, outcomes)))
        self.made[trial.key] = trial
        return trial


def _result(outcome: Entry) -> ScenarioResult:
    if "failure" in outcome:
        return ScenarioResult({}, outcome["failure"])
    values = {name: Value(*each) for name, each in outcome["values"].items()}
    return ScenarioResult(values, "", outcome["warnings"])
