"""Manifest of the runs of a command, in the directory of the sweep."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.cli.sweep.request import PlannedRun
from viscontact.cli.terminal.messages import refuse
from viscontact.results.run_files import FAILURE_NAME, MANIFEST_NAME
from viscontact.runs.processes.request import RunRequest, command, no_option
from viscontact.studies.sweep import continuation
from viscontact.studies.sweep.common_cells import KEY
from viscontact.studies.sweep.continuation import (
    OtherSweepError,
    continued,
    has_begun,
    pinned,
    record,
)
from viscontact.studies.sweep.equal_values import comparable
from viscontact.studies.sweep.manifest import SweepRun
from viscontact.studies.sweep.varied_runs import case_name


@dataclass(frozen=True)
class RecordedSweep:
    """Runs of a command and those in the manifest of their directory.

    There are none for runs next to their case files, which have no manifest.
    """

    directory: Path
    runs: list[SweepRun]
    earlier: list[SweepRun]

    def continued(self, *, resume: bool) -> RecordedSweep:
        """Sweep with the directories and settings of equal earlier runs; refuse other ones."""
        if not self.earlier:
            return self
        try:
            sweep = replace(self, runs=continued(self.directory, self.runs, self.earlier))
        except OtherSweepError as error:
            if resume:
                refuse(
                    f"{self.directory}: holds another sweep: {error}; repeat the command that "
                    f"began it{self._same_sample}, choose another directory with -o DIR, or "
                    "replace it with --overwrite",
                    *replace(self, runs=self.earlier).change_of_failed(),
                )
            self._refuse_another(is_added=error.is_left_out)
        is_new = sweep.runs != self.earlier
        if is_new and not resume and any_begun(self.directory, self.earlier):
            self._refuse_another(is_added=True)
        return sweep

    def with_digests(self, *, mixed: bool) -> RecordedSweep:
        """Sweep with digests of its cases; refuse changed ones unless runs may be mixed."""
        try:
            return replace(self, runs=pinned(self.directory, self.runs, mixed=mixed))
        except ValueError as error:
            refuse(
                f"{self.directory}: {error}; choose another directory with -o DIR, or continue "
                "with the changed case by --resume"
            )

    def requests(self, planned: Sequence[RunRequest]) -> list[RunRequest]:
        """Return the requests with the directories and settings of the runs."""
        if not self.runs:
            return list(planned)
        return [
            replace(each, output=self.directory / run.directory, settings=run.assignments)
            for each, run in zip(planned, self.runs, strict=True)
        ]

    def write(self) -> None:
        """Write the manifest, unless it is there already."""
        try:
            record(self.directory, self.runs, self.earlier)
        except OSError as error:
            refuse(f"{self.directory / MANIFEST_NAME}: cannot be written: {error}")

    def _refuse_another(self, *, is_added: bool) -> NoReturn:
        """Refuse other runs; `is_added`: their difference does not prevent that they are added."""
        holds = (
            f"{self.directory}: holds another sweep, the {len(self.earlier)} runs of its "
            f"{MANIFEST_NAME}; choose another directory with -o DIR"
        )
        if is_added and self._is_alike:
            refuse(
                f"{holds}, replace it with --overwrite, or add runs to it: with --resume, and all "
                "values of both"
            )
        refuse(f"{holds}, or replace it with --overwrite")

    @property
    def _is_alike(self) -> bool:
        """True if the runs vary the same keys of the same cases as earlier ones."""
        return set(map(_kind, self.runs)) <= set(map(_kind, self.earlier))

    @property
    def _same_sample(self) -> str:
        kinds = {each.design for each in self.earlier}
        return " with its --range, --seed and --method" if "sample" in kinds else ""

    def change_of_failed(self) -> list[str]:
        """Line with the command that changes only the first run that has failed; else empty."""
        for each in self.runs:
            place = self.directory / each.directory
            if (place / FAILURE_NAME).exists():
                path = self.directory / MANIFEST_NAME
                words = ["--task", str(each.run), no_option(path), "--set", "KEY=VALUE"]
                again = ["--overwrite"] if has_begun(place) else []
                alone = f"to change only {each.directory}: {command(*words, *again)}"
                return [*_correction(each, place), alone]
        return []


def _kind(run: SweepRun) -> tuple[Hashable, ...]:
    """Case, design, varied keys, and settings that all runs of a sweep share."""
    own = {*run.varied, *run.changed, f"grid.{KEY}"}
    shared = {key: comparable(key, text) for key, text in run.settings.items() if key not in own}
    return run.case, run.design, run.varied, frozenset(shared.items())


def _correction(run: SweepRun, place: Path) -> list[str]:
    """Line that says how a varied value of a failed run is corrected; empty where it cannot be."""
    if not run.varied or run.design == "sample" or has_begun(place):
        return []
    keys = " or ".join(run.varied)
    again = "repeat the command with another value and --resume"
    return [f"to correct the {keys} of {run.directory}: {again}"]


def recorded_runs(directory: Path | None) -> list[SweepRun]:
    """Runs in the manifest of a directory; none without a manifest."""
    try:
        return [] if directory is None else continuation.recorded_runs(directory)
    except (ValueError, OSError) as error:
        refuse(str(error))


def any_begun(directory: Path, earlier: Sequence[SweepRun]) -> bool:
    """Test whether any run of a manifest has results."""
    return any(has_begun(directory / run.directory) for run in earlier)


def sweep_runs(
    directory: Path | None, planned: Sequence[PlannedRun], requests: Sequence[RunRequest]
) -> list[SweepRun]:
    """Lines of the manifest of planned runs, with their requests."""
    if directory is None:
        return []
    place = directory.resolve()
    paths = {each.case: case_name(each.case, place) for each in requests}
    runs = []
    for number, (plan, each) in enumerate(zip(planned, requests, strict=True)):
        own = directory.name if each.output is None else each.output.name
        name = (plan.design.name(plan.row) if len(paths) == 1 else "") or own
        pairs = (text.partition("=") for text in each.settings)
        settings = {key.strip(): value.strip() for key, _, value in pairs}
        keys, kind = plan.design.keys, plan.design.kind
        runs.append(SweepRun(number, name, own, settings, keys, paths[each.case], kind))
    return runs
