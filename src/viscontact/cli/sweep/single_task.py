"""One run of a manifest, for job arrays and workflow systems."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from viscontact.cli.run.execution import execute
from viscontact.cli.sweep.plan_options import key_of, share_a_branch
from viscontact.cli.sweep.request import ManyRequest
from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.cli.terminal.messages import (
    INTERRUPTED,
    REFUSED,
    STOPPED,
    CommandError,
    refuse,
    stop,
)
from viscontact.results.run_files import MANIFEST_NAME, RESULT_NAME, STOP_NAME
from viscontact.runs.directory.failure import write_failure
from viscontact.runs.directory.lock import DirectoryInUse, is_locked, locked
from viscontact.runs.execution.checked_run import checked_run
from viscontact.runs.processes.request import RunRequest, command, no_option
from viscontact.studies.sweep.case_digests import case_path, changed_since, with_digests
from viscontact.studies.sweep.common_cells import KEY
from viscontact.studies.sweep.continuation import has_begun
from viscontact.studies.sweep.equal_values import comparable
from viscontact.studies.sweep.manifest import SweepRun, read_manifest, write_manifest

#: Keys of a grid that is not automatic, and the key of the common cells of automatic ones.
_OWN_GRID, _CELLS = {"grid", "grid.shape", "grid.size"}, f"grid.{KEY}"


def execute_task(request: ManyRequest, number: int) -> None:
    """Compute the run with a number in a manifest, or the rest of it, with other settings."""
    common = request.common
    is_plain = request == ManyRequest(request.cases, request.common, task=number)
    if len(request.cases) > 1 or not is_plain or common.output is not None:
        refuse(
            f"--task {number}: takes the manifest of a sweep, which names the case, the settings "
            f"and the directory of the run: viscontact run --task {number} DIR/{MANIFEST_NAME}"
        )
    (manifest,) = request.cases
    path = manifest / MANIFEST_NAME if manifest.is_dir() else manifest
    if path.is_file() and path.suffix != Path(MANIFEST_NAME).suffix:
        refuse(
            f"--task {number}: {path} is not the manifest of a sweep; give DIR/{MANIFEST_NAME}, "
            "which `viscontact run CASE --vary ... -o DIR --array FILE.sbatch` writes"
        )
    run = _run_by_number(path, number)
    directory = path.parent / run.directory
    if not (common.resume or common.overwrite):
        with _recorded_failure(directory):
            _refuse_changed_case(path, run)
    if common.settings:
        run = _change_settings(path, run, common)
    with _recorded_failure(directory):
        _execute(_request(path, run, common), path.parent / STOP_NAME, _command(path, run, common))


@contextmanager
def _recorded_failure(directory: Path) -> Iterator[None]:
    """Write a failure within the block to the directory of the run, unless it has a result."""
    try:
        yield
    except CommandError as end:
        is_new = end.code == REFUSED and not (directory / RESULT_NAME).exists()
        if (is_new or end.code == STOPPED) and not is_locked(directory):
            write_failure(directory, "refused" if is_new else "stopped", STOPPED, end.lines)
        raise


def _execute(request: RunRequest, file: Path, again: str) -> None:
    """Compute a run, which a file may stop; messages name the command of the task, `again`."""
    if file.exists():
        stop(f"{file} asks the runs of this sweep to stop; remove it first", code=INTERRUPTED)
    with watched_interruption() as interruption:
        interruption.file = file
        try:
            execute(request)
        except CommandError as end:
            lines = tuple(line.replace(request.resuming, again) for line in end.lines)
            raise CommandError(end.code, lines) from end


def _command(path: Path, run: SweepRun, common: RunRequest) -> str:
    """Command that continues a task; it keeps settings that were given before."""
    words = ["--task", str(run.run), no_option(path)]
    if common.threads != 1:
        words += ["--threads", str(common.threads)]
    return command(*words, *(["--quiet"] * common.quiet), *(["--resume"] * common.resume))


def _refuse_changed_case(path: Path, run: SweepRun) -> None:
    if parts := changed_since(path.parent, run):
        case = os.path.relpath(case_path(path.parent, run))
        refuse(
            f"{case}: has changed since {path} was written: {', '.join(parts)}; "
            "compute the changed case in a new directory, or, if runs of both cases are meant to "
            "be in this one, with --resume"
        )


def _change_settings(path: Path, run: SweepRun, common: RunRequest) -> SweepRun:
    """Run with other settings, which are checked and written to its manifest."""
    directory = path.parent / run.directory
    changed = changed_run(run, common.settings, directory, overwrite=common.overwrite)
    if changed != run:
        checked_run(_request(path, changed, common))
        write_changed(path, changed)
    return changed


def _request(path: Path, run: SweepRun, common: RunRequest) -> RunRequest:
    return RunRequest(
        case_path(path.parent, run),
        path.parent / run.directory,
        common.overwrite,
        not common.overwrite,
        run.assignments,
        common.threads,
        common.quiet,
    )


def _run_by_number(path: Path, number: int) -> SweepRun:
    """Run of a manifest with a number."""
    found, last = None, -1
    try:
        for run in read_manifest(path):
            last = run.run
            if last == number:
                found = run
                break
    except FileNotFoundError:
        refuse(f"{path}: no such file; --task needs the manifest of a sweep, DIR/{MANIFEST_NAME}")
    except (ValueError, OSError) as error:
        refuse(str(error))
    if found is None:
        refuse(f"--task {number}: {path} has the runs 0 to {last}")
    return found


def changed_run(
    run: SweepRun, settings: Sequence[str], directory: Path, *, overwrite: bool
) -> SweepRun:
    """Run with other settings, each KEY=VALUE; one with results in its directory is refused."""
    given = {key_of(text): text.partition("=")[2].strip() for text in settings}
    for key in given:
        if any(share_a_branch(key, varied) for varied in run.varied):
            refuse(
                f"--set {key}: differs between the runs of this sweep; correct the value where "
                "the runs are given, and repeat that command with --resume"
            )
    before = {key: comparable(key, text) for key, text in run.settings.items() if key in given}
    if before == {key: comparable(key, text) for key, text in given.items()}:
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
