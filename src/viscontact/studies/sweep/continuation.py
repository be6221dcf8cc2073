"""Continuation of a sweep: the runs of its manifest among those of the next command or call."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Hashable, Sequence
from dataclasses import replace
from pathlib import Path

from viscontact.results.run_files import MANIFEST_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.directory.earlier_result import stored_run
from viscontact.runs.directory.lock import is_locked
from viscontact.studies.sweep.case_digests import changed_since, with_digests
from viscontact.studies.sweep.equal_values import comparable
from viscontact.studies.sweep.manifest import SweepRun, read_manifest, write_manifest

#: Designs whose directories are named after the values of their runs, not after their numbers.
_NAMED_BY_VALUES = ("grid", "zip")


class OtherSweepError(ValueError):
    """Run in the directory of a sweep that has results, with other settings or left out."""

    def __init__(self, message: str, *, is_left_out: bool = False) -> None:
        super().__init__(message)
        self.is_left_out = is_left_out


def recorded_runs(directory: Path) -> list[SweepRun]:
    """Runs in the manifest of a directory, if any; ValueError names the line that is damaged."""
    path = directory / MANIFEST_NAME
    return list(read_manifest(path)) if path.exists() else []


def has_begun(directory: Path) -> bool:
    """Test whether a run directory holds results, or a run is at work there."""
    try:
        names = {each.name for each in os.scandir(directory)}
    except OSError:
        return False
    if STATE_NAME in names or is_locked(directory):
        return True
    try:
        return RESULT_NAME in names and stored_run(directory / RESULT_NAME).rows > 0
    except ValueError:  # damaged
        return True


def continued(
    directory: Path, runs: Sequence[SweepRun], earlier: Sequence[SweepRun]
) -> list[SweepRun]:
    """Return the runs with the directories and settings that equal ones have in the manifest.

    OtherSweepError names a run with results that is left out, or has other settings.
    """
    # There may be more runs than before. Settings that were set for a run alone are kept.
    by_place = {each.directory: each for each in earlier}
    # Values are compared only where a directory is not in the manifest.
    has_new = any(each.directory not in by_place for each in runs)
    by_values = {_values(each): each for each in earlier} if has_new else {}
    found, kept = [], set()
    for run in runs:
        before = by_place.get(run.directory) or by_values.get(_values(run))
        if before is None:
            found.append(run)
            continue
        kept.add(before.directory)
        change = _change(before, run)
        if change and has_begun(directory / before.directory):
            raise OtherSweepError(f"its run {before.directory} has results {change}")
        found.append(_keep_settings(before, run) if change else _renumber(before, run))
    for each in earlier:
        if each.directory not in kept and has_begun(directory / each.directory):
            raise OtherSweepError(
                f"its run {each.directory} has results, and is none of these", is_left_out=True
            )
    return found


def refuse_shared_directories(places: Sequence[Path]) -> None:
    """Raise ValueError if several runs of a command or call would go to one directory."""
    # On a file system that ignores the case of letters, MPa and mPa are the same name.
    parents = {place.parent: str(place.parent.resolve()) for place in places}
    names = [f"{parents[place.parent]}/{place.name}".casefold() for place in places]
    name, count = Counter(names).most_common(1)[0]
    if count > 1:
        raise ValueError(
            f"{places[names.index(name)]}: {count} of the runs would go there; give each case "
            "file a name of its own, and each value once"
        )


def pinned(directory: Path, runs: Sequence[SweepRun], *, mixed: bool = False) -> list[SweepRun]:
    """Return the runs with the digests of their cases now.

    ValueError for a run with results of another case, unless results may be `mixed`.
    """
    current = with_digests(directory, runs)
    for before, now in zip(runs, current, strict=True):
        is_same = mixed or not before.digests or before.digests == now.digests
        if is_same or not has_begun(directory / before.directory):
            continue
        if parts := changed_since(directory, before):
            raise ValueError(
                f"holds runs of the case {Path(before.case).name} before it changed: "
                f"{', '.join(parts)}"
            )
    return current


def record(directory: Path, runs: Sequence[SweepRun], earlier: Sequence[SweepRun]) -> None:
    """Write the manifest of runs, unless it is there already, with the same digests."""
    digests = [[each.digests for each in some] for some in (runs, earlier)]
    if list(runs) != list(earlier) or digests[0] != digests[1]:
        write_manifest(directory, runs)


def _values(run: SweepRun) -> Hashable:
    """Case and varied values of a run, equal for equal quantities."""
    if run.design not in _NAMED_BY_VALUES:
        return run.directory
    return run.case, frozenset((key, comparable(key, run.settings[key])) for key in run.varied)


def _renumber(before: SweepRun, run: SweepRun) -> SweepRun:
    """Run of the manifest in its place among the runs of now."""
    return replace(before, run=run.run, varied=run.varied, design=run.design)


def _keep_settings(before: SweepRun, run: SweepRun) -> SweepRun:
    """Run with its new settings, and those that were set for it alone."""
    changed = tuple(key for key in before.changed if key not in run.varied)
    others = {key: value for key, value in run.settings.items() if key not in changed}
    own = {key: value for key, value in before.settings.items() if key in changed}
    return replace(run, settings={**others, **own}, changed=changed)


def _change(before: SweepRun, run: SweepRun) -> str:
    """Difference of the settings of a run from those in the manifest; empty without any."""
    if run.case != before.case:
        return f"of the case {before.case}, not of {run.case}"
    for key in {**before.settings, **run.settings}:
        if key in before.changed and key not in run.varied:
            continue
        was, now = before.settings.get(key), run.settings.get(key)
        if was == now:
            continue
        if was is None:
            return f"with the {key} of its case, not {now}"
        if now is None:
            return f"with {key}={was}, not that of the case"
        if comparable(key, was) != comparable(key, now):
            return f"with {key}={was}, not {now}"
    return ""
