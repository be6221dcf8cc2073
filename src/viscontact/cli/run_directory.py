"""The directory of a run: what it may be, and what is put there."""

from __future__ import annotations

import shutil
from pathlib import Path

import netCDF4

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
    kept, result = directory / CASE_NAME, directory / RESULT_NAME
    if directory.exists() and not directory.is_dir():
        refuse(f"{directory}: is a file, not a directory; choose another one with -o DIR")
    # What a run has left that was stopped in its first step is nothing to lose.
    overwrite = overwrite or (result.exists() and not _holds_an_instant(result))
    if result.exists() and not overwrite:
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
        for file, name in case.file_names.items():
            if not _is_same(file, directory / name):
                shutil.copyfile(file, directory / name)
    except OSError as error:
        refuse(f"{directory}: cannot be written: {error}")
    return directory / RESULT_NAME


def _is_same(one: Path, other: Path) -> bool:
    return one.exists() and other.exists() and one.samefile(other)


def _holds_an_instant(result: Path) -> bool:
    """Whether a result has anything to lose; a file that cannot be read may have."""
    try:
        with netCDF4.Dataset(str(result)) as file:
            return "time" not in file.dimensions or len(file.dimensions["time"]) > 0
    except OSError:
        return True
