"""Manifest of the runs of a command, in the directory of the sweep."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from viscontact.cli.many.request import PlannedRun
from viscontact.cli.terminal.messages import refuse
from viscontact.run_files import MANIFEST_NAME
from viscontact.runs.processes.request import RunRequest
from viscontact.runs.sweep.manifest import SweepRun, read_manifest, write_manifest
from viscontact.runs.sweep.varied_runs import case_name


@dataclass(frozen=True)
class RecordedSweep:
    """Runs of a command and those in the manifest of their directory.

    Without a directory, the runs lie next to their case files and have no manifest.
    """

    directory: Path | None
    runs: list[SweepRun]
    earlier: list[SweepRun]

    def refuse_another(self, *, resume: bool) -> None:
        """Refuse to replace the manifest of other runs; a resumed sweep may have more runs."""
        if self.directory is None or self._is_recorded:
            return
        if not any((self.directory / each.directory).exists() for each in self.earlier):
            return  # none of them has begun
        if not resume:
            refuse(
                f"{self.directory}: holds another sweep, the {len(self.earlier)} runs of its "
                f"{MANIFEST_NAME}; choose another directory with -o DIR, replace it with "
                "--overwrite, or add runs to it: with --resume, and all values of both"
            )
        now = {each.directory: each for each in self.runs}
        for each in self.earlier:
            if (change := _change(each, now.get(each.directory))) is not None:
                refuse(
                    f"{self.directory}: holds another sweep: its run {each.directory} {change}; "
                    "repeat the command that began it, choose another directory with -o DIR, or "
                    "replace it with --overwrite"
                )

    def write(self) -> None:
        """Write the manifest, unless it is there already."""
        if self.directory is None or self._is_recorded:
            return
        try:
            write_manifest(self.directory, self.runs)
        except OSError as error:
            refuse(f"{self.directory / MANIFEST_NAME}: cannot be written: {error}")

    @property
    def _is_recorded(self) -> bool:
        return [_key(each) for each in self.runs] == [_key(each) for each in self.earlier]


def recorded_runs(directory: Path | None) -> list[SweepRun]:
    """Runs in the manifest of a directory; none without a manifest."""
    if directory is None or not (path := directory / MANIFEST_NAME).exists():
        return []
    try:
        return list(read_manifest(path))
    except (ValueError, OSError) as error:
        refuse(str(error))


def sweep_runs(
    directory: Path | None, planned: Sequence[PlannedRun], requests: Sequence[RunRequest]
) -> list[SweepRun]:
    """Lines of the manifest of planned runs, with their requests."""
    if directory is None:
        return []
    place = directory.resolve()
    paths = {each.case: case_name(each.case, place) for each in requests}
    found = []
    for number, (plan, each) in enumerate(zip(planned, requests, strict=True)):
        own = directory.name if each.output is None else each.output.name
        name = (plan.design.name(plan.row) if len(paths) == 1 else "") or own
        pairs = (text.partition("=") for text in each.settings)
        settings = {key.strip(): value.strip() for key, _, value in pairs}
        keys, kind = plan.design.keys, plan.design.kind
        found.append(SweepRun(number, name, own, settings, keys, paths[each.case], kind))
    return found


def _change(earlier: SweepRun, now: SweepRun | None) -> str | None:
    """Difference of a run from the one of the same directory; None without any."""
    if now is None:
        return "is none of these runs"
    if now.case != earlier.case:
        return f"has the case {earlier.case}, not {now.case}"
    for key in {**earlier.settings, **now.settings}:
        before, after = earlier.settings.get(key), now.settings.get(key)
        if _plain(before) != _plain(after):
            return f"has {key}={before or 'that of the case'}, not {after or 'that of the case'}"
    return None


def _key(run: SweepRun) -> SweepRun:
    """Run whose values are compared without blanks."""
    return replace(run, settings={key: _plain(value) for key, value in run.settings.items()})


def _plain(value: str | None) -> str:
    return "".join((value or "").split())
