"""The directory of a run: what it may be, and what is put there."""

from __future__ import annotations

import shutil
from contextlib import suppress
from pathlib import Path

from viscontact.case import Case
from viscontact.cli.messages import refuse
from viscontact.results import RESULT_NAME

CASE_NAME = "case.yaml"


def chosen_directory(case: Path, output: Path | None) -> Path:
    """Return where a run goes: as asked, or CASE/ beside the case file.

    Parameters
    ----------
    case : Path
        The case file.
    output : Path or None
        What the user asked for.
    """
    if output is not None:
        return output
    if not case.suffix:
        refuse(f"{case}: without a suffix there is no name for the directory; give one with -o DIR")
    return case.with_suffix("")


def refuse_occupied(directory: Path, case: Case, *, overwrite: bool) -> None:
    """Refuse a directory in which something of the user's would be lost.

    Parameters
    ----------
    directory : Path
        Where the run is to go.
    case : Case
        The case that is run.
    overwrite : bool
        Whether an earlier result may be replaced.

    Raises
    ------
    typer.Exit
        With code 2.
    """
    try:
        directory.exists()
    except OSError as error:  # such as a name that is too long
        refuse(f"{directory}: cannot be a directory: {error}")
    kept = directory / CASE_NAME
    if directory.exists() and not directory.is_dir():
        refuse(f"{directory}: is a file, not a directory; choose another one with -o DIR")
    if (directory / RESULT_NAME).exists() and not overwrite:
        refuse(
            f"{directory}: holds a result already; replace it with --overwrite, choose another "
            "directory with -o DIR, or continue it with --resume (not built yet)"
        )
    if not kept.exists():
        return
    if _is_same(kept, case.document.path):
        refuse(f"{directory}: {kept} is the case file itself; choose another directory with -o DIR")
    if not overwrite:
        refuse(f"{kept}: is there already; choose another directory with -o DIR, or --overwrite")


def set_up(directory: Path, case: Case) -> Path:
    """Create the directory with the case as it is run.

    Parameters
    ----------
    directory : Path
        Where the run goes.
    case : Case
        The case.

    Returns
    -------
    Path
        Where its result belongs.

    Raises
    ------
    typer.Exit
        With code 2, if the directory cannot be made.
    """
    try:
        directory.mkdir(parents=True, exist_ok=True)
        (directory / CASE_NAME).write_text(case.text, encoding="utf-8")
        if case.load_file is not None and not _is_same(
            case.load_file, directory / case.load_file.name
        ):
            shutil.copyfile(case.load_file, directory / case.load_file.name)
    except OSError as error:
        refuse(f"{directory}: cannot be written: {error}")
    return directory / RESULT_NAME


def present(directory: Path, case: Case) -> frozenset[Path]:
    """Return what is there before a run begins and has to stay.

    Parameters
    ----------
    directory : Path
        Where the run is to go.
    case : Case
        The case.

    Returns
    -------
    frozenset of Path
        The directory, those above it and the load's file in it, as far as they exist.
    """
    paths = (directory, *directory.parents, *_load_copy(directory, case))
    return frozenset(path for path in paths if path.exists())


def clear(directory: Path, case: Case, before: frozenset[Path]) -> None:
    """Remove what a run without a single instant has put there, so that it may start again.

    Parameters
    ----------
    directory : Path
        Where the run went.
    case : Case
        The case.
    before : frozenset of Path
        From `present`; it stays.
    """
    # An earlier result went when this one was begun: both of these names are the run's.
    written = (directory / RESULT_NAME, directory / CASE_NAME, *_load_copy(directory, case))
    with suppress(OSError):  # there is something worse to report
        for file in (path for path in written if path not in before):
            file.unlink(missing_ok=True)
        for folder in (directory, *directory.parents):
            if folder not in before:
                folder.rmdir()


def _load_copy(directory: Path, case: Case) -> tuple[Path, ...]:
    return () if case.load_file is None else (directory / case.load_file.name,)


def _is_same(one: Path, other: Path) -> bool:
    return one.exists() and other.exists() and one.samefile(other)
