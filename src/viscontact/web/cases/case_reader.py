"""Reading and checking of cases, and the entry of a new run."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import field, replace
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import Case, CaseError, Parts, read_case_text, read_parts
from viscontact.case.document import document_of
from viscontact.case.loads.temperature import spelled_temperature
from viscontact.case.materials.layers import spelled_out
from viscontact.runs.check_report import expectations, needs, verdict, warnings_of
from viscontact.runs.forecast import Forecast
from viscontact.runs.machine.memory import available_memory
from viscontact.runs.preparation import PreparedRun, predicted, prepared
from viscontact.web.cases.quick_settings import coarse_settings, without_cells
from viscontact.web.workspace.folder import Folder, RunEntry
from viscontact.web.workspace.naming import label_of, suggested_title
from viscontact.web.workspace.problems import RequestError, case_problems, without_folder


@dataclass(frozen=True)
class CaseReader:
    """Reader of cases that may name the files of a folder."""

    folder: Folder
    _last: dict[str, tuple[PreparedRun, Forecast]] = field(default_factory=dict, repr=False)

    def forecast(self, text: str) -> tuple[PreparedRun, Forecast]:
        """Read and check a case, and predict its run."""
        # A check, a drawing and a run of one case follow each other, and an automatic grid is then
        # computed once.
        if text in self._last:
            whole, expected = self._last[text]
            return whole, replace(expected, available=available_memory())
        try:
            whole = prepared(read_case_text(text, self.folder.case), roughly=True)
            found = whole, predicted(whole)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error
        self._last.clear()
        if not whole.case.files:  # files may be replaced in the meantime
            self._last[text] = found
        return found

    def values(self, text: str) -> Any:
        """Return the values in the text of a case, its materials in their longest spelling."""
        try:
            return form_values(text, self.folder.case)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def case(self, text: str) -> Case:
        """Read a case."""
        try:
            return read_case_text(text, self.folder.case)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def parts(self, text: str) -> Parts:
        """Read the valid parts of an incomplete case."""
        try:
            return read_parts(text, self.folder.case)
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def prepared(self, text: str, quality: str) -> tuple[PreparedRun, tuple[str, ...]]:
        """Read and check a case, with coarser settings unless the quality is "full"."""
        whole, expected = self.forecast(text)
        if quality == "full":
            return whole, ()
        settings = coarse_settings(whole, expected)
        try:
            try:
                return self._coarse(text, settings), settings
            except CaseError:  # such as waves that need their cells
                settings = without_cells(settings)
                return self._coarse(text, settings), settings
        except CaseError as error:
            raise case_problems(error, self.folder.case) from error

    def _coarse(self, text: str, settings: tuple[str, ...]) -> PreparedRun:
        """Read and check a case with coarser settings."""
        return prepared(read_case_text(text, self.folder.case, settings), roughly=True)

    def check(self, text: str, quality: str) -> dict[str, Any]:
        """Check a case, and return its size, its computing time and the results to expect."""
        if quality == "full":
            run, expected = self.forecast(text)
        else:
            run, _ = self.prepared(text, quality)
            try:
                expected = predicted(run)
            except CaseError as error:
                raise case_problems(error, self.folder.case) from error
        first = without_folder(verdict(run, expected), self.folder.case.parent)
        warned, rows = warnings_of(run, expected), needs(run, expected)
        title, found = expectations(run, expected)
        lines = [
            *(first, *(f"warning: {line}" for line in warned)),
            *(f"note: {line}" for line in run.case.notes),
            *(f"{name}: {value}" for name, value in rows),
            *((title, *(f"{name}: {value}" for name, value in found)) if found else ()),
        ]
        return {
            **{"lines": lines, "warnings": warned, "notes": list(run.case.notes)},
            **{"needs": rows, "expectations_title": title, "expectations": found},
            **{"seconds": expected.seconds, "memory": expected.memory},
            **{"cells": list(run.run.grid.shape), **_course(run)},
        }

    def new_run(
        self, text: str, quality: str, others: Sequence[tuple[str, RunEntry]] = ()
    ) -> tuple[str, RunEntry]:
        """Check a case, and keep it with its files as a new run; return its name and entry."""
        found, settings = self.prepared(text, quality)
        case = found.case
        title = case.title or suggested_title(case.document.data) or "Untitled case"
        entry = RunEntry(
            title=title,
            label=self._label(title, text, quality, others),
            quality=quality,
            created=clock.strftime("%Y-%m-%dT%H:%M:%SZ", clock.gmtime()),
            settings=settings,
            **_extent(found),
        )
        try:
            name = self.folder.new_run(text, entry, {path: path.name for path in _data(case)})
        except OSError as error:
            why = f"the run cannot be stored: {error.strerror or error}"
            raise RequestError(507, why) from error
        return name, entry

    def _label(
        self, title: str, text: str, quality: str, others: Sequence[tuple[str, RunEntry]]
    ) -> str:
        """Label of a run, unique among the runs of the same quality."""
        alike = [(name, entry) for name, entry in others if entry.title == title]
        first = None
        with suppress(OSError, ValueError, RequestError):  # removed or damaged files
            if alike:
                first = self.values(self.folder.given(alike[0][0]).read_text(encoding="utf-8"))
        taken = {entry.label or entry.title for _, entry in alike if entry.quality == quality}
        return label_of(title, self.values(text), first, taken)


def form_values(text: str, path: Path) -> dict[str, Any]:
    """Values in the text of a case as the form has them: materials in their longest spelling."""
    values = document_of(text, path).data
    spelled = {**dict.fromkeys(("material", "indenter_material"), spelled_out)}
    spelled["temperature"] = spelled_temperature
    return values | {key: spell(values[key]) for key, spell in spelled.items() if key in values}


def filled(value: Any) -> Any:
    """Return values without empty ones."""
    if isinstance(value, dict):
        parts = {str(name): filled(part) for name, part in value.items()}
        return {name: part for name, part in parts.items() if part not in (None, "", {})}
    return [filled(part) for part in value] if isinstance(value, list) else value


def _course(found: PreparedRun) -> dict[str, int | None]:
    """Number of the steps, None where they are adaptive; or of the speeds."""
    total = found.run.total
    if not found.run.axis.is_history:
        return {"speeds": total}
    return {"steps": None if total is None else total - 1}


def _extent(found: PreparedRun) -> dict[str, Any]:
    """Entries of a run about its states and its size."""
    run = found.run
    is_history = run.axis.is_history
    return {
        **{"over": run.axis.name, "begin": 0.0 if is_history else float(run.places.min())},
        **{"end": float(run.places.max()), "instants": run.total},
        **{"work": run.work, "memory": run.memory},
        "errors": run.errors and is_history,  # those over speed are found with each speed
    }


def _data(case: Case) -> set[Path]:
    return set(case.files.values())
