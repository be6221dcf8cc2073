"""Run directory: checks before it is used, its lock, and the files of the case."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from viscontact.case import Case, CaseError
from viscontact.case.data_file import is_same_file
from viscontact.case.document import read_document
from viscontact.case.reader import digest
from viscontact.case.yaml_source import parse
from viscontact.results.run_files import CASE_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.runs.command_error import refuse
from viscontact.runs.directory.atomic_files import replacing
from viscontact.runs.directory.checkpoint import is_checkpoint
from viscontact.runs.directory.earlier_result import stored_run
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.runs.directory.lock_check import LockCheck
from viscontact.runs.directory.progress_log import is_course

#: Files that a run overwrites, and functions that recognize those written by a run.
_WRITTEN = {STATE_NAME: is_checkpoint, PROGRESS_NAME: is_course}

_NAMES = (CASE_NAME, RESULT_NAME, STATE_NAME, PROGRESS_NAME)


def chosen_directory(case: Path, output: Path | None) -> Path:
    """Return the directory of a run: the given one, or CASE/ at the case file."""
    if output is not None:
        return output
    if not case.suffix:
        refuse(f"{case}: without a suffix there is no name for the directory; give one with -o DIR")
    return case.with_suffix("")


def refuse_no_directory(directory: Path) -> None:
    """Refuse a path that cannot be a run directory."""
    try:
        directory.exists()
    except OSError as error:  # such as a name that is too long
        refuse(f"{directory}: cannot be a directory: {error}")
    if directory.exists() and not directory.is_dir():
        refuse(f"{directory}: is a file, not a directory; choose another one with -o DIR")
    for path in (directory / name for name in _NAMES):
        if path.is_dir():
            refuse(f"{path}: is a directory, where a run has a file; choose another -o DIR")
        if path.exists() and not path.is_file():  # reading a pipe would never end
            refuse(f"{path}: is not a regular file; choose another -o DIR")


def refuse_occupied(directory: Path, case: Case, *, overwrite: bool) -> None:
    """Refuse a directory in which files of the user would be lost."""
    kept, is_runs = directory / CASE_NAME, is_of_a_run(directory)
    # A run that stopped in its first step has no results to lose.
    if not overwrite and _holds_an_instant(directory / RESULT_NAME):
        refuse(
            f"{directory}: holds a result already; continue it with --resume, replace it with "
            "--overwrite, or choose another directory with -o DIR"
        )
    if is_same_file(kept, case.document.path):
        if not (is_runs and _says_the_same(kept, case)):
            refuse(
                f"{directory}: {kept} is the case file itself; choose another directory with -o DIR"
            )
    elif kept.exists() and not (is_runs or overwrite):
        refuse(f"{kept}: is there already; choose another directory with -o DIR, or --overwrite")
    if not is_runs:
        _refuse_other_programs(directory)
    _refuse_other_data(directory, case, kept if is_runs else None)


def write_case(directory: Path, case: Case) -> None:
    """Write the case as run and the files it names, each atomically."""
    for file in case.file_names:
        if digest(file) != case.digests[file]:
            raise OSError(f"{file} was changed while the run was being prepared")
    if not is_same_file(directory / CASE_NAME, case.document.path):
        _write(directory / CASE_NAME, case.text.encode())
    for file, name in case.file_names.items():
        if not is_same_file(file, directory / name):
            _write(directory / name, file.read_bytes())


@contextmanager
def reserved(directory: Path) -> Iterator[LockCheck]:
    """Make the directory, and lock it during the block; yield the check of the lock."""
    is_new = not directory.exists()
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        refuse(f"{directory}: cannot be made: {error}")
    try:
        with ExitStack() as held:
            try:
                check = held.enter_context(locked(directory))
            except (DirectoryInUse, OSError) as error:
                refuse(str(error))
            yield check
    finally:
        if is_new:
            # Removed only if it is empty.
            with suppress(OSError):
                directory.rmdir()


def is_of_a_run(directory: Path) -> bool:
    """True if the directory contains a file that a run has written."""
    if any(is_ours(directory / name) for name, is_ours in _WRITTEN.items()):
        return True
    try:
        return stored_run(directory / RESULT_NAME).case is not None
    except ValueError:
        return False


def _write(path: Path, content: bytes) -> None:
    """Replace a file; a link is replaced as well, so that its target is not changed."""
    if not path.is_symlink() and path.is_file() and path.read_bytes() == content:
        return
    with replacing(path) as file:
        file.write(content)


def _refuse_other_programs(directory: Path) -> None:
    """Refuse to replace files that no run has written; links are replaced, their targets kept."""
    for path in (directory / name for name in _WRITTEN):
        if path.is_file() and not path.is_symlink() and path.stat().st_size:
            refuse(
                f"{path}: exists already, and viscontact has not written it; choose another "
                "directory with -o DIR"
            )


def _holds_an_instant(result: Path) -> bool:
    """True if a result has completed instants; an unreadable file may have."""
    if not result.exists():
        return result.is_symlink()
    try:
        return stored_run(result).rows > 0
    except ValueError:
        return True


def _says_the_same(kept: Path, case: Case) -> bool:
    return bool(parse(kept.read_text(encoding="utf-8"))[0] == parse(case.text)[0])


def _texts(earlier: Path) -> set[str]:
    """All texts in the case of an earlier run, the names of its tables included."""
    try:
        found: list[Any] = [read_document(earlier).data]
    except (CaseError, OSError):
        return set()  # a changed case may name other files
    texts = set()
    while found:
        value = found.pop()
        if isinstance(value, str):
            texts.add(value)
        else:
            found += value.values() if isinstance(value, dict) else ()
            found += value if isinstance(value, list) else ()
    return texts


def _refuse_other_data(directory: Path, case: Case, earlier: Path | None) -> None:
    """Refuse to replace a file by a table of the same name, unless an earlier run wrote it."""
    replaceable = _texts(earlier) if earlier and earlier.exists() else set()
    for file, name in case.file_names.items():
        there = directory / name
        if is_same_file(file, there) or not (there.exists() or there.is_symlink()):
            continue
        if there.is_file() and (name in replaceable or there.read_bytes() == file.read_bytes()):
            continue
        refuse(f"{there}: is there already, and is not {file}; choose another directory, -o DIR")
