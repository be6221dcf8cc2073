"""Evaluation of a calibration: the runs of all records at some values, each made once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.errors import ConvergenceError, DomainError
from viscontact.studies.calibration.response import Experiment, Mounting, Response
from viscontact.studies.calibration.trial_log import Outcome, TrialLog
from viscontact.studies.calibration.unknowns import (
    CONTACT_POINT,
    MACHINE_STIFFNESS,
    Unknown,
    is_of_machine,
    values_at,
)
from viscontact.units.parsing import parse_any_quantity

#: Part of the largest force below which the approach may be that of a body without contact.
TOUCH = 0.05


class BudgetSpentError(Exception):
    """The next runs would be more than are allowed."""


class FailedRunError(ValueError):
    """A run has no result at some values."""


@dataclass
class Evaluation:
    """Runs of the records of a calibration."""

    experiments: Sequence[Experiment]
    unknowns: tuple[Unknown, ...]
    budget: int  # most runs
    executor: Executor | None
    log: TrialLog | None
    progress: Callable[[int, int], None]  # called with the numbers of runs, done and allowed
    known: dict[str, Outcome] = field(default_factory=dict)
    runs: int = 0

    def residuals(self, point: Floats, *, on_own_cells: bool = False) -> Floats:
        """Fitted less measured values over the largest of each record, of the rows that count.

        FailedRunError if a run fails.
        """
        return self.many([point], on_own_cells=on_own_cells)[0]

    def many(self, points: Sequence[Floats], *, on_own_cells: bool = False) -> list[Floats]:
        """Residuals at several points; runs that are not known yet are made at the same time."""
        values = [values_at(self.unknowns, point) for point in points]
        self._make([r for each in values for r in self._responses(each, on_own_cells)])
        return [np.concatenate(self._of_experiments(each, on_own_cells)) for each in values]

    def fitted(self, point: Floats, *, on_own_cells: bool) -> list[tuple[Floats, Bools]]:
        """Fitted values of each record [N or m], and the mask of the rows that count."""
        values = values_at(self.unknowns, point)
        responses = self._responses(values, on_own_cells)
        self._make(responses)
        return [
            self._compared(number, response, values) for number, response in enumerate(responses)
        ]

    def _of_experiments(self, values: Mapping[str, str], on_own_cells: bool) -> list[Floats]:
        found = []
        for number, response in enumerate(self._responses(values, on_own_cells)):
            fitted, counted = self._compared(number, response, values)
            measured = response.experiment.measured
            found.append((fitted - measured)[counted] / np.abs(measured).max())
        return found

    def _responses(self, values: Mapping[str, str], on_own_cells: bool) -> list[Response]:
        of_case = {k: v for k, v in values.items() if not is_of_machine(k)}
        return [
            Response(test, of_case, self._mounting(n, values, test.drive), on_own_cells)
            for n, test in enumerate(self.experiments)
        ]

    def _mounting(
        self, number: int, values: Mapping[str, str], drive: str = "approach"
    ) -> Mounting:
        """Mounting of a record; that of a run which does not depend on it is none."""
        if drive != "approach":
            return Mounting()
        name = CONTACT_POINT if CONTACT_POINT in values else f"{CONTACT_POINT}[{number + 1}]"
        point = parse_any_quantity(values[name])[0] if name in values else 0.0
        if MACHINE_STIFFNESS not in values:
            return Mounting(point)
        return Mounting(point, 1.0 / parse_any_quantity(values[MACHINE_STIFFNESS])[0])

    def _compared(
        self, number: int, response: Response, values: Mapping[str, str]
    ) -> tuple[Floats, Bools]:
        outcome, test = self.known[self._key(response)], response.experiment
        if isinstance(outcome, str):
            raise FailedRunError(outcome)
        force, approach = outcome
        jumps = np.append(np.diff(test.record.times) == 0, False)  # the row before each
        if test.compared == "force":
            return force, ~jumps
        mounting = self._mounting(number, values)
        fitted = approach + mounting.contact_point + mounting.compliance * force
        # Without force the approach is the position of the stage, not of the surface. The
        # prescribed force does not depend on the values.
        counted = ~jumps & (force > TOUCH * np.nanmax(force))
        if not np.isfinite(fitted[counted]).all():
            raise FailedRunError("the approach is not defined where the record has a force")
        return fitted, counted

    def _make(self, responses: Sequence[Response]) -> None:
        """Make the runs that are not known."""
        wanted = {self._key(each): each for each in responses}
        wanted = {key: each for key, each in wanted.items() if key not in self.known}
        if self.runs + len(wanted) > self.budget:
            raise BudgetSpentError
        logged = self.log.outcomes if self.log else {}
        made = {key: each for key, each in wanted.items() if key not in logged}
        futures = self.executor and {
            key: self.executor.submit(_attempt, each) for key, each in made.items()
        }
        for key, each in wanted.items():
            if key in logged:
                self.known[key] = logged[key]
            else:
                self.known[key] = futures[key].result() if futures else _attempt(each)
                if self.log:
                    self.log.keep(key, self.known[key])
            self.runs += 1
            self.progress(self.runs, self.budget)

    def _key(self, response: Response) -> str:
        number = self.experiments.index(response.experiment)
        values = ", ".join(f"{key}={value}" for key, value in response.values.items())
        place = "case" if response.on_own_cells else "coarse"
        mounting = response.mounting
        return f"{place} {number} {mounting.contact_point!r} {mounting.compliance!r} {values}"


def _attempt(response: Response) -> Outcome:
    try:
        return response()
    except (ValueError, ConvergenceError, DomainError) as error:
        return str(error).splitlines()[0]
