"""Residuals of a calibration: fitted less measured values of the runs of all records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.studies.calibration.response import Experiment, Mounting, RecordRun
from viscontact.studies.calibration.search import NoResidualsError
from viscontact.studies.calibration.unknowns import (
    CONTACT_POINT,
    MACHINE_STIFFNESS,
    Unknown,
    is_of_machine,
    values_at,
)
from viscontact.studies.evaluation import Evaluation, Level
from viscontact.studies.journal import Entry
from viscontact.units.parsing import parse_any_quantity

#: Part of the largest force below which the approach may be that of a body without contact.
TOUCH = 0.05


@dataclass(frozen=True)
class Residuals:
    """Residuals of all records at points of the ranges of the unknowns."""

    experiments: Sequence[Experiment]
    unknowns: tuple[Unknown, ...]
    evaluation: Evaluation

    def __call__(self, points: Sequence[Floats], level: Level) -> list[Floats | str]:
        """Fitted less measured values over the largest of each record, or why a run fails."""
        # Those on the cells of the case are computed beyond the budget.
        fitted = self.fitted(points, level)
        return [each if isinstance(each, str) else self._over_largest(each) for each in fitted]

    def fitted(
        self, points: Sequence[Floats], level: Level
    ) -> list[list[tuple[Floats, Bools]] | str]:
        """Fitted values of each record [N or m] at some points, and masks of rows that count."""
        values = [values_at(self.unknowns, point) for point in points]
        responses = [self._responses(each, level) for each in values]
        runs = [run for each in responses for run in each]
        outcomes = iter(self.evaluation.outcomes(runs, is_limited=level == "coarse"))
        return [
            self._compare(each, [next(outcomes) for _ in each], at)
            for each, at in zip(responses, values, strict=True)
        ]

    def _over_largest(self, fitted: Sequence[tuple[Floats, Bools]]) -> Floats:
        measured = [each.measured for each in self.experiments]
        parts = [
            (values - real)[counted] / np.abs(real).max()
            for (values, counted), real in zip(fitted, measured, strict=True)
        ]
        return np.concatenate(parts)

    def _compare(
        self, responses: Sequence[RecordRun], outcomes: Sequence[Entry], values: Mapping[str, str]
    ) -> list[tuple[Floats, Bools]] | str:
        try:
            return [
                self._compare_record(run, outcome, values)
                for run, outcome in zip(responses, outcomes, strict=True)
            ]
        except NoResidualsError as error:
            return str(error)

    def _responses(self, values: Mapping[str, str], level: Level) -> list[RecordRun]:
        of_case = {k: v for k, v in values.items() if not is_of_machine(k)}
        return [
            RecordRun(each, of_case, self._mounting(each, values, each.drive), level)
            for each in self.experiments
        ]

    def _mounting(
        self, test: Experiment, values: Mapping[str, str], drive: str = "approach"
    ) -> Mounting:
        """Mounting of a record; that of a run which does not depend on it is none."""
        if drive != "approach":
            return Mounting()
        several = f"{CONTACT_POINT}[{test.number + 1}]"
        name = CONTACT_POINT if CONTACT_POINT in values else several
        point = parse_any_quantity(values[name])[0] if name in values else 0.0
        if MACHINE_STIFFNESS not in values:
            return Mounting(point)
        return Mounting(point, 1.0 / parse_any_quantity(values[MACHINE_STIFFNESS])[0])

    def _compare_record(
        self, run: RecordRun, outcome: Entry, values: Mapping[str, str]
    ) -> tuple[Floats, Bools]:
        """Fitted values of a record, and the mask of the rows that count."""
        if outcome.failure:
            raise NoResidualsError(outcome.failure)
        force, approach = (np.array(outcome.values[name]) for name in ("force", "approach"))
        test = run.experiment
        jumps = np.append(np.diff(test.record.times) == 0, False)  # the row before each
        if test.compared == "force":
            return _seen_in_time(test, force, outcome), ~jumps
        mounting = self._mounting(test, values)
        fitted = approach + mounting.contact_point + mounting.compliance * force
        # Without force the approach is the position of the stage, not of the surface. The
        # prescribed force does not depend on the values.
        counted = ~jumps & (force > TOUCH * np.nanmax(force))
        if not np.isfinite(fitted[counted]).all():
            raise NoResidualsError("the approach is not defined where the record has a force")
        return fitted, counted


def _seen_in_time(test: Experiment, force: Floats, outcome: Entry) -> Floats:
    """Forces of a run in which bodies jump in or off, as near to the record as its rows tell.

    The record shows a jump between two rows, or within a mean over some. Beside the jump of the run
    a row may have the force before or after it, or one between: less and less of this as the jump
    comes near the row's other side, so that residuals depend continuously on the values.
    """
    times, measured, seen = test.record.times, test.measured, force.copy()
    given = (outcome.values.get(name, ()) for name in ("jump_times", "jump_forces"))
    jumps = zip(*given, strict=True)
    for time, change in jumps:
        after = int(np.searchsorted(times, time))
        if not 0 < after < times.size:
            continue
        part = (time - times[after - 1]) / (times[after] - times[after - 1])
        for row, other in ((after - 1, (1 - part) * change), (after, -part * change)):
            ends = sorted((force[row], force[row] + other))
            seen[row] = np.clip(measured[row], *ends)
    return seen
