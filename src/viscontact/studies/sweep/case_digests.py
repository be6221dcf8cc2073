"""Digests of the cases of a sweep, by which a task notices that its case has been edited."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path

from viscontact.case import CaseError
from viscontact.runs.execution.case_digests import Digests, changed_parts, digests_of
from viscontact.studies.sweep.manifest import SweepRun


def with_digests(directory: Path, runs: Iterable[SweepRun]) -> list[SweepRun]:
    """Return the runs of a sweep with the digests of their cases; none for one without a case."""
    # A case that cannot be read, which its run will report, has no digests.
    of_case, pinned = cache(digests_of), []
    for run in runs:
        digests: Digests = {}
        if run.case:
            try:
                digests = of_case(case_path(directory, run))(run.settings)
            except (CaseError, OSError):
                digests = {}
        pinned.append(replace(run, digests=digests))
    return pinned


def changed_since(directory: Path, run: SweepRun) -> list[str]:
    """Return the sections and files of the case of a run that have changed since its digests."""
    return changed_parts(case_path(directory, run), run.settings, run.digests)


def case_path(directory: Path, run: SweepRun) -> Path:
    """Path of the case of a run, from the directory of the sweep, which may not exist yet."""
    return Path(os.path.normpath(directory.resolve() / run.case))
