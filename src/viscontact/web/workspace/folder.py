"""Folder of the calculator page: files that cases read, and runs."""

from __future__ import annotations

import json
import os
import secrets
import shutil
import sys
import time as clock
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, suppress
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from pydantic import TypeAdapter

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case.plain_names import is_plain_name
from viscontact.results.run_files import CASE_NAME, LOCK_NAME
from viscontact.runs.directory.atomic_files import put_in_place
from viscontact.web.workspace.privacy import make_private
from viscontact.web.workspace.problems import RequestError
from viscontact.web.workspace.uploads import Upload, Uploads

_FILES, _RUNS, _GIVEN, _RUN = "files", "runs", "given", "run"
_ENTRY_NAME, _SUMMARY_NAME = "request.json", "summary.json"
#: Other files of a server in its folder.
_BESIDE = (LOCK_NAME, "token", "open.html")


#: Suffixes of shipped files that examples read.
_SHIPPED = (".npz", ".csv")


@dataclass(frozen=True)
class StudyEntry:
    """Command of a study, which makes many runs."""

    command: Literal["run", "design"]
    options: tuple[str, ...]  # of the command line, with values as they were typed
    keys: tuple[str, ...]  # that differ between the runs
    workers: int  # runs at the same time


@dataclass(frozen=True)
class RunEntry:
    """Entry of a run or a study, stored in its directory: its request, its size and its state."""

    title: str
    quality: str
    created: str
    settings: tuple[str, ...]
    instants: int | None  # None for adaptive steps; of a study its runs, or the most of them
    end: float  # last instant [s] or largest speed [m/s]
    work: float  # cells times steps [-]
    memory: float  # needed [bytes]
    errors: bool  # True if errors are estimated after the last step
    state: str = "waiting"
    said: tuple[str, ...] = ()  # messages of its process
    label: str = ""
    over: Literal["time", "speed"] = "time"
    begin: float = 0.0
    resumable: bool = True  # after a failure; entries of earlier versions do not say
    study: StudyEntry | None = None


_ENTRY = TypeAdapter(RunEntry)


class Folder:
    """Folder with the files that cases may name, and with the runs."""

    def __init__(self, path: Path) -> None:
        self.path = path.absolute()
        for part in (_FILES, _RUNS):
            (self.path / part).mkdir(parents=True, exist_ok=True)
        self._make_private()
        for earlier, name in (("asked.json", _ENTRY_NAME), ("found.json", _SUMMARY_NAME)):
            for file in (self.path / _RUNS).glob(f"*/{earlier}"):
                with suppress(OSError):  # a linked run that cannot be written to
                    file.replace(file.with_name(name))
        self._put_shipped_files()
        self._uploads = Uploads(self.path / _FILES)

    def _make_private(self) -> None:
        """Take the folder from other users; of one with other content, only its parts."""
        for part in (_FILES, _RUNS):
            make_private(self.path / part)
        if {each.name for each in self.path.iterdir()} <= {_FILES, _RUNS, *_BESIDE}:
            make_private(self.path)

    @property
    def case(self) -> Path:
        """Path of a case that is not run, next to the files that it may name."""
        return self.path / _FILES / CASE_NAME

    def files(self) -> list[dict[str, Any]]:
        """Return name and size [bytes] of each file."""
        found = sorted((self.path / _FILES).iterdir())
        return [
            {"name": path.name, "size": path.stat().st_size}
            for path in found
            if path.is_file() and is_plain_name(path.name)
        ]

    def receiving(self, name: str) -> AbstractContextManager[Upload]:
        """Receive a file, in place of one of the same name."""
        return self._uploads.receiving(self._file(name))

    def stored_file(self, name: str) -> Path:
        """Return the path of a file; RequestError if there is none."""
        path = self._file(name)
        if not path.is_file():
            raise RequestError(404, f"there is no file {name!r}")
        return path

    def remove_file(self, name: str) -> None:
        """Remove a file."""
        self.stored_file(name).unlink()

    def new_run(self, text: str, entry: RunEntry, data: Mapping[Path, str]) -> str:
        """Store a case to be run and its files; return the name of the run."""
        name = f"{clock.strftime('%Y%m%d-%H%M%S', clock.gmtime())}-{secrets.token_hex(3)}"
        given = self.path / _RUNS / name / _GIVEN
        with ExitStack() as undoing:
            given.mkdir(parents=True)
            undoing.callback(self.remove_run, name)  # unless everything is stored
            (given / CASE_NAME).write_text(text, encoding="utf-8")
            for path, called in data.items():
                shutil.copyfile(path, given / called)
            self.keep(name, entry)  # last: without it there is no run
            undoing.pop_all()
        return name

    def keep(self, name: str, entry: RunEntry) -> None:
        """Store the entry of a run."""
        text = json.dumps(asdict(entry), ensure_ascii=False, indent=1)
        _write(self.path / _RUNS / name / _ENTRY_NAME, text.encode())

    def runs(self) -> Iterator[tuple[str, RunEntry]]:
        """Yield the names and entries of runs, oldest first, without unreadable ones."""
        for path in sorted((self.path / _RUNS).glob(f"*/{_ENTRY_NAME}")):
            with suppress(OSError, ValueError):
                yield path.parent.name, _ENTRY.validate_json(path.read_bytes())

    def keep_summary(self, name: str, key: str, found: dict[str, Any]) -> None:
        """Store the summary of a result, so that the result need not be read again."""
        text = json.dumps({"key": key, "found": found}, allow_nan=False)
        _write(self.path / _RUNS / name / _SUMMARY_NAME, text.encode())

    def summary(self, name: str, key: str) -> dict[str, Any] | None:
        """Return the stored summary of a result; None without one for this key."""
        try:
            kept = json.loads(
                (self.path / _RUNS / name / _SUMMARY_NAME).read_text(encoding="utf-8")
            )
            return dict(kept["found"]) if kept["key"] == key else None
        except (OSError, ValueError, TypeError, LookupError):
            return None

    def remove_run(self, name: str) -> None:
        """Remove a run and its files; of a linked run, the link only."""
        place = self.path / _RUNS / name
        if place.is_symlink():  # its files are kept elsewhere
            place.unlink()
            return
        # The entry first: without it the remaining files no longer count as a run.
        with suppress(FileNotFoundError):
            (place / _ENTRY_NAME).unlink()
        shutil.rmtree(place, ignore_errors=True)

    def given(self, name: str) -> Path:
        """Return the path of the case of a run, as submitted."""
        return self.path / _RUNS / name / _GIVEN / CASE_NAME

    def directory(self, name: str) -> Path:
        """Return the run directory of a run."""
        return self.path / _RUNS / name / _RUN

    def report(self, name: str) -> Path:
        """Return the path of the stored report of a run."""
        return self.path / _RUNS / name / "report.html"

    def keep_report(self, name: str, page: bytes, made_from: int) -> None:
        """Store the report of a run, with the modification time of its result [ns]."""
        _write(self.report(name), page)
        os.utime(self.report(name), ns=(made_from, made_from))

    def _file(self, name: str) -> Path:
        if not is_plain_name(name) or name.lower() == CASE_NAME or len(name.encode()) > 200:
            raise RequestError(
                400, f"{name!r} cannot be the name of a file here; call it e.g. 'pmma.csv'"
            )
        return self.path / _FILES / name

    def _put_shipped_files(self) -> None:
        """Copy the files that shipped examples read into the folder."""
        for entry in files("viscontact.case.examples").iterdir():
            path = self.path / _FILES / entry.name
            if path.suffix in _SHIPPED and not path.exists():
                _write(path, entry.read_bytes())


def usual_folder() -> Path:
    """Return the folder for application data on this system."""
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Application Support"
    else:
        base = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")
    return base / "viscontact"


def _write(path: Path, content: bytes) -> None:
    """Write a file atomically."""
    fresh = path.with_name(f".{secrets.token_hex(6)}.new")  # requests may write at the same time
    try:
        fresh.write_bytes(content)
        put_in_place(fresh, path)
    finally:
        with suppress(OSError):  # exists only after a failure
            fresh.unlink()
