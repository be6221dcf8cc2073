"""Journal of a study on the disk: its arguments, and a line of JSON for each run."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import field
from os import PathLike
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.line_digests import DIGEST, with_digest
from viscontact.runs.directory.atomic_files import replacing
from viscontact.runs.directory.lock import DirectoryInUse, locked
from viscontact.studies.json_lines import read_lines

#: Journal in the directory of a study.
JOURNAL_NAME = "trials.jsonl"

#: Remedy for a line that cannot be read.
_REMEDY = "remove the file"


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

    def __init__(
        self, path: Path, study: str, arguments: Mapping[str, Any], place: Path, kind: str
    ) -> None:
        self._path = path
        header = {"study": study, **json.loads(json.dumps(dict(arguments)))}
        self.recorded: dict[str, Entry] = {}
        if path.exists():
            lines = read_lines(path, _line, "a journal of runs", _REMEDY, appended=True)
            _require_same(next(lines, header), header, place, kind)
            self.recorded |= lines
        # A line that a killed process has begun is removed.
        with replacing(path) as file:
            file.write(_encoded(header))
            file.writelines(_encoded([key, each.as_json]) for key, each in self.recorded.items())

    def keep(self, key: str, outcome: Entry) -> None:
        """Append the outcome of a run, as JSON."""
        with self._path.open("ab") as file:
            file.write(_encoded([key, outcome.as_json]))
        self.recorded[key] = outcome


@contextmanager
def journal_of(
    study: str,
    arguments: Mapping[str, Any],
    *,
    directory: str | PathLike[str] | None = None,
    file: str | PathLike[str] | None = None,
    overwrite: bool = False,
) -> Iterator[Journal | None]:
    """Lock and open the journal of a study, in its directory or in a file; None without either.

    ValueError if it is in use, or of another study.
    """
    if directory is not None:
        place, kind = Path(directory), "directory"
        if place.exists() and not place.is_dir():
            raise ValueError(f"directory: {place} is a file; name a directory for the {study}")
        path, lock = place / JOURNAL_NAME, place
    elif file is not None:
        path = place = Path(file)
        # A lock is that of a directory; the folder of the file may be at work for something else.
        kind, lock = "file", path.with_name(f"{path.name}.lock")
    else:
        yield None
        return
    lock.mkdir(parents=True, exist_ok=True)
    try:
        with locked(lock):
            if overwrite:
                path.unlink(missing_ok=True)
            yield Journal(path, study, arguments, place, kind)
    except DirectoryInUse as error:
        busy = f"{place} is in use by another run; wait until it is over, or choose another file"
        raise ValueError(str(error) if file is None else busy) from None
    finally:
        if lock != place:
            with suppress(OSError):  # another run holds it
                lock.rmdir()


def _require_same(found: Any, wanted: Mapping[str, Any], place: Path, kind: str) -> None:
    """Raise ValueError unless the first line of a journal is that of the study."""
    if found == wanted:
        return
    if not isinstance(found, dict) or "study" not in found:
        raise ValueError(
            f"{place}: is not a journal of this version of viscontact; choose another {kind}"
        )
    changed = [name for name in wanted if found.get(name) != wanted[name]]
    raise ValueError(
        f"{place}: holds another {wanted['study']}, with a different "
        f"{', '.join(changed) or 'header'}; choose another {kind}"
    )


def _line(found: Any, number: int) -> Any:
    """First line as it is, and the key and the entry of each other one."""
    match found:
        case dict() if number == 1:
            return {key: value for key, value in found.items() if key != DIGEST}
        case _ if number == 1:
            return found
        case [str(key), dict(outcome)]:
            outcome.pop(DIGEST, None)
            return key, Entry.read(outcome)
    raise ValueError(f"is not a run of a study; {_REMEDY}")


def _encoded(line: Any) -> bytes:
    """Line of JSON as Python has it, with NaN and Infinity, in ASCII, and a digest."""
    return with_digest(json.dumps(line).encode()) + b"\n"
