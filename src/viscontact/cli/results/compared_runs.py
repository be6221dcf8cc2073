"""Runs of a comparison, of which a sweep's directory names all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from viscontact.cli.terminal.messages import refuse, say
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.studies.sweep.manifest import read_manifest
from viscontact.studies.sweep.states import State, run_state

#: Most runs in a figure, of which each has a colour and dashes of its own.
MOST = 24


def compared_runs(paths: Sequence[Path]) -> list[Path]:
    """Return the directories of runs, at most `MOST`; of a sweep in the order of its manifest."""
    found = [run for path in paths for run in _runs(path)]
    if len(found) > MOST:
        sweep = next((str(path) for path in paths if (path / MANIFEST_NAME).is_file()), "SWEEP")
        refuse(
            f"{len(found)} runs are too many for a figure, which shows {MOST} at most; name fewer, "
            f"or draw all of a sweep with: viscontact plot {sweep} response"
        )
    return found


def _runs(path: Path) -> Iterator[Path]:
    if path.name == MANIFEST_NAME:
        return  # the shell names it in DIR/*, together with the runs
    if not (path / MANIFEST_NAME).is_file():
        yield path
        return
    yield from _finished_runs(path)


def _finished_runs(sweep: Path) -> list[Path]:
    """Directories of the finished runs of a sweep; the others are left out with a note."""
    try:
        runs = list(read_manifest(sweep / MANIFEST_NAME))
    except (ValueError, OSError) as error:
        refuse(str(error))
    places = [sweep / run.directory for run in runs]
    note_changed(sweep, sum(bool(run.changed) for run in runs))
    found = [place for place in places if run_state(place).state is State.DONE]
    note_missing(sweep, len(places) - len(found), len(places))
    return found


def note_missing(sweep: Path, missing: int, total: int) -> None:
    """Print how many runs a figure leaves out, and the command that lists them."""
    if missing:
        say(
            f"{sweep}: {missing} of {total} runs {'is' if missing == 1 else 'are'} not done and "
            f"left out; `viscontact status {sweep}` shows their states"
        )


def note_changed(sweep: Path, changed: int) -> None:
    """Print how many runs have settings of their own, and the command that lists them."""
    if changed:
        which = "run has settings of its" if changed == 1 else "runs have settings of their"
        say(f"{sweep}: {changed} {which} own; `viscontact status {sweep}` shows them")
