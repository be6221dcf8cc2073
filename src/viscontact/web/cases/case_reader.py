"""What is told of a case before it is run: values, checks, drawings, and the run that it makes."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from viscontact.case import Case, CaseError, Parts, read_case_text, read_parts
from viscontact.case.document import document_of
from viscontact.runs.check_report import expectations, needs, predicted, verdict, warnings_of
from viscontact.runs.forecast import Forecast
from viscontact.runs.free_memory import available_memory
from viscontact.runs.preparation import PreparedRun, prepared
from viscontact.runs.resources import run_memory, step_count
from viscontact.web.cases.coarse import coarse_settings, without_cells
from viscontact.web.workspace.folder import Folder
from viscontact.web.workspace.naming import label_of, suggested_title
from viscontact.web.workspace.problems import RequestError, case_problems, without_folder
from viscontact.web.workspace.request import Asked


@dataclass(frozen=True)
class Desk:
    """Where cases are read."""

    folder: Folder
    _predicted: dict[str, tuple[PreparedRun, Forecast]] = field(default_factory=dict, repr=False)

    def predicted(self, text: str) -> tuple[PreparedRun, Forecast]:
        """Read a case, check it, and foresee its run.

        What was asked for last is kept: a check, a drawing and a run of one case come after each
        other, and an automatic grid is found once for all of them.
        """
        if text in self._predicted:
            whole, expected = self._predicted[text]
            return whole, replace(expected, available=available_memory())
        try:
            whole = prepared(read_case_text(text, self.folder.case))
            found = whole, predicted(whole)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error
        self._predicted.clear()
        if not whole.case.files:  # these may be replaced meanwhile
            self._predicted[text] = found
        return found

    def values(self, text: str) -> Any:
        """Return the values of a case, as its text has them."""
        try:
            return document_of(text, self.folder.case).data
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def case(self, text: str) -> Case:
        """Read a case."""
        try:
            return read_case_text(text, self.folder.case)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def parts(self, text: str) -> Parts:
        """Read what can be read of a case that is still being written."""
        try:
            return read_parts(text, self.folder.case)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def prepared(self, text: str, quality: str) -> tuple[PreparedRun, tuple[str, ...]]:
        """Read and check a case."""
        whole, expected = self.predicted(text)
        if quality == "full":
            return whole, ()
        settings = coarse_settings(whole, expected)
        try:
            try:
                return prepared(read_case_text(text, self.folder.case, settings)), settings
            except CaseError:  # such as waves that need their cells
                settings = without_cells(settings)
                return prepared(read_case_text(text, self.folder.case, settings)), settings
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def check(self, text: str, quality: str) -> dict[str, Any]:
        """Check a case, and say how large it is, how long it takes and what to expect."""
        if quality == "full":
            run, expected = self.predicted(text)
        else:
            run, _ = self.prepared(text, quality)
            try:
                expected = predicted(run)
            except CaseError as error:
                raise case_problems(error, self.folder.case) from error
        first = without_folder(verdict(run, expected), self.folder.case.parent)
        warnings, rows = warnings_of(run, expected), needs(run, expected)
        title, found = expectations(run, expected)
        lines = [
            *(first, *(f"warning: {line}" for line in warnings)),
            *(f"note: {line}" for line in run.case.notes),
            *(f"{name}: {value}" for name, value in rows),
            *((title, *(f"{name}: {value}" for name, value in found)) if found else ()),
        ]
        return {
            **{"lines": lines, "warnings": warnings, "notes": list(run.case.notes)},
            **{"needs": rows, "expectations_title": title, "expectations": found},
            **{"seconds": expected.seconds, "memory": expected.memory},
            **{"cells": list(run.run.grid.shape), "steps": _steps(run)},
        }

    def new_run(
        self, text: str, quality: str, others: Sequence[tuple[str, Asked]] = ()
    ) -> tuple[str, Asked]:
        """Check a case, and keep it and all that it reads, to be run."""
        found, settings = self.prepared(text, quality)
        run, case = found.run, found.case
        title = case.title or suggested_title(case.document.data) or "Untitled case"
        asked = Asked(
            title=title,
            label=self._label(title, text, quality, others),
            quality=quality,
            created=clock.strftime("%Y-%m-%dT%H:%M:%SZ", clock.gmtime()),
            settings=settings,
            instants=len(run.times) if run.adaptive is None else None,
            end=float(run.times[-1]),
            work=run.grid.shape[0] * run.grid.shape[1] * (1.0 + step_count(run)),
            memory=run_memory(run),
            errors=case.errors,
        )
        try:
            name = self.folder.new_run(text, asked, {path: path.name for path in _data(case)})
        except OSError as error:
            raise RequestError(507, f"the run cannot be kept: {error.strerror or error}") from error
        return name, asked

    def _label(
        self, title: str, text: str, quality: str, others: Sequence[tuple[str, Asked]]
    ) -> str:
        """What a run is called; a coarse one and a full one of one case are told apart by that."""
        alike = [(name, asked) for name, asked in others if asked.title == title]
        first = None
        with suppress(OSError, ValueError, RequestError):  # somebody has removed or damaged it
            if alike:
                first = self.values(self.folder.given(alike[0][0]).read_text(encoding="utf-8"))
        taken = {asked.label or asked.title for _, asked in alike if asked.quality == quality}
        return label_of(title, self.values(text), first, taken)


def filled(value: Any) -> Any:
    """Return values without those that are empty.

    Examples
    --------
    >>> filled({"title": "", "load": {"force": "1 N", "tilt_x": None}, "grid": {}})
    {'load': {'force': '1 N'}}
    """
    if isinstance(value, dict):
        parts = {str(name): filled(part) for name, part in value.items()}
        return {name: part for name, part in parts.items() if part not in (None, "", {})}
    return [filled(part) for part in value] if isinstance(value, list) else value


def _steps(found: PreparedRun) -> int | None:
    return None if found.run.adaptive is not None else len(found.run.times) - 1


def _data(case: Case) -> set[Path]:
    return set(case.files.values())
