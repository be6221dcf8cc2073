"""Settings of a single run of a sweep, changed in its manifest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from viscontact.cli.sweep.plan_options import key_of, share_a_branch
from viscontact.cli.terminal.messages import refuse
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.studies.sweep.case_digests import with_digests
from viscontact.studies.sweep.common_cells import KEY
from viscontact.studies.sweep.continuation import has_begun
from viscontact.studies.sweep.equal_values import comparable
from viscontact.studies.sweep.manifest import SweepRun, read_manifest, write_manifest

#: Keys of a grid that is not automatic, and the key of the common cells of automatic ones.
_OWN_GRID, _CELLS = {"grid", "grid.shape", "grid.size"}, f"grid.{KEY}"


def changed_run(
    run: SweepRun, settings: Sequence[str], directory: Path, *, overwrite: bool
) -> SweepRun:
    """Return a run with other settings, each KEY=VALUE; one with results is refused.

    `directory` is that of the run, whose results may be overwritten. The run itself is returned if
    nothing differs.
    """
    given = {key_of(text): text.partition("=")[2].strip() for text in settings}
    for key in given:
        if any(share_a_branch(key, varied) for varied in run.varied):
            refuse(
                f"--set {key}: differs between the runs of this sweep; correct the value where "
                "the runs are given, and repeat that command with --resume"
            )
    before = {key: run.settings.get(key) for key in given}
    if all(value is not None and _same(key, value, given[key]) for key, value in before.items()):
        return run
    if not overwrite and has_begun(directory):
        refuse(
            f"{directory}: has results with other settings; replace them with --overwrite, or "
            "leave --set out"
        )
    # A grid of its own has no common cells.
    dropped = {_CELLS} & run.settings.keys() if _OWN_GRID & given.keys() else set()
    kept = {key: value for key, value in run.settings.items() if key not in dropped}
    changed = tuple(dict.fromkeys((*run.changed, *dropped, *given)))
    return replace(run, settings={**kept, **given}, changed=changed)


def write_changed(manifest: Path, run: SweepRun) -> None:
    """Replace a run in its manifest."""
    try:
        with locked(manifest.parent):
            runs = list(read_manifest(manifest))
            [runs[run.run]] = with_digests(manifest.parent, [run])
            write_manifest(manifest.parent, runs)
    except (DirectoryInUse, OSError, ValueError) as error:
        refuse(f"{manifest}: cannot be changed: {error}")


def _same(key: str, one: str, other: str) -> bool:
    return comparable(key, one) == comparable(key, other)
