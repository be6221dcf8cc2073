"""Journal of a study on the disk: its arguments, and a line of JSON for each run."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

from viscontact.runs.directory.atomic_files import replacing
from viscontact.runs.directory.lock import DirectoryInUse, locked

#: Journal in the directory of a study.
JOURNAL_NAME = "trials.jsonl"


@dataclass(frozen=True)
class Entry:
    """Outcome of a run: its values as JSON has them, or the reason why there are none."""

    values: Mapping[str, Any] = field(default_factory=dict)
    failure: str = ""
    warnings: str = ""  # a line each

    @classmethod
    def read(cls, found: Mapping[str, Any]) -> Entry:
        """Entry of an object of JSON, in which earlier versions had values beside the texts."""
        texts = {name: found[name] for name in ("failure", "warnings") if name in found}
        own = {name: value for name, value in found.items() if name not in texts}
        return cls(own.get("values", own), **texts)

    @property
    def as_json(self) -> dict[str, Any]:
        """The fields that are not empty."""
        return {name: value for name, value in vars(self).items() if value}


class Journal:
    """Outcomes of runs by their values, kept in a file; ValueError if it is of another study."""

    def __init__(self, path: Path, study: str, arguments: Mapping[str, Any], place: str) -> None:
        self._path = path
        lines = _whole_lines(path)
        header = {"study": study, **json.loads(json.dumps(dict(arguments)))}
        if lines:
            _require_same(_read_line(path, 1, lines[0]), header, place)
        self.recorded: dict[str, Entry] = dict(
            _entry(path, n, line) for n, line in enumerate(lines[1:], 2)
        )
        # A line that a killed process has begun is removed.
        with replacing(path) as file:
            file.writelines(f"{line}\n".encode() for line in lines or [json.dumps(header)])

    def keep(self, key: str, outcome: Entry) -> None:
        """Append the outcome of a run, as JSON."""
        with self._path.open("a", encoding="utf-8") as file:
            # JSON of Python has NaN and Infinity, which it also reads.
            file.write(json.dumps([key, outcome.as_json]) + "\n")
        self.recorded[key] = outcome


@contextmanager
def journal_in(
    directory: str | PathLike[str] | None,
    study: str,
    arguments: Mapping[str, Any],
    *,
    overwrite: bool = False,
) -> Iterator[Journal | None]:
    """Lock a study's directory and open its journal; None without, ValueError if in use."""
    if directory is None:
        yield None
        return
    place = Path(directory)
    if place.exists() and not place.is_dir():
        raise ValueError(f"directory: {place} is a file; name a directory for the {study}")
    place.mkdir(parents=True, exist_ok=True)
    try:
        with locked(place):
            if overwrite:
                (place / JOURNAL_NAME).unlink(missing_ok=True)
            where = f"{place}: holds another {study}|choose another directory"
            yield Journal(place / JOURNAL_NAME, study, arguments, where)
    except DirectoryInUse as error:
        raise ValueError(str(error)) from None


@contextmanager
def journal_at(
    path: str | PathLike[str] | None,
    study: str,
    arguments: Mapping[str, Any],
    *,
    overwrite: bool = False,
) -> Iterator[Journal | None]:
    """Lock a file and open the journal of a study in it; None without a file."""
    if path is None:
        yield None
        return
    file = Path(path)
    # A lock is that of a directory; the folder of the file may be at work for something else.
    place = file.with_name(f"{file.name}.lock")
    place.mkdir(parents=True, exist_ok=True)
    try:
        with locked(place):
            if overwrite:
                file.unlink(missing_ok=True)
            where = f"{file}: holds the runs of another {study}|choose another file"
            yield Journal(file, study, arguments, where)
    except DirectoryInUse:
        raise ValueError(
            f"{file} is in use by another run; wait until it is over, or choose another file"
        ) from None
    finally:
        with suppress(OSError):  # another run holds it
            place.rmdir()


def _require_same(found: Any, wanted: Mapping[str, Any], place: str) -> None:
    """Raise ValueError unless the first line of a journal is that of the study."""
    if found == wanted:
        return
    which, remedy = place.split("|")
    if not isinstance(found, dict) or "study" not in found:
        which = which.partition(":")[0]
        raise ValueError(f"{which}: is not a journal of this version of viscontact; {remedy}")
    changed = [name for name in wanted if found.get(name) != wanted[name]]
    raise ValueError(f"{which}, with a different {', '.join(changed) or 'header'}; {remedy}")


def _whole_lines(path: Path) -> list[str]:
    """Complete lines of a file; none without it."""
    try:
        return path.read_text(encoding="utf-8").split("\n")[:-1]
    except FileNotFoundError:
        return []
    except UnicodeDecodeError:
        raise ValueError(f"{path}: is not UTF-8 text, as a journal of runs is") from None


def _read_line(path: Path, number: int, line: str) -> Any:
    try:
        return json.loads(line)
    except ValueError:
        raise ValueError(f"{path}:{number}: is not a line of JSON; remove the file") from None


def _entry(path: Path, number: int, line: str) -> tuple[str, Entry]:
    match _read_line(path, number, line):
        case [str(key), dict(outcome)]:
            return key, Entry.read(outcome)
    raise ValueError(f"{path}:{number}: is not a run of a study; remove the file")
