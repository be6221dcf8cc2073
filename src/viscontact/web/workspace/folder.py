"""The folder in which the page keeps what it was given and what it has computed."""

from __future__ import annotations

import json
import os
import secrets
import shutil
import sys
import time as clock
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, suppress
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from viscontact.case.data_file import is_plain_name
from viscontact.run_files import CASE_NAME
from viscontact.runs.directory.atomic_files import replace
from viscontact.web.workspace.problems import RequestError
from viscontact.web.workspace.request import Asked

_FILES, _RUNS, _GIVEN, _RUN = "files", "runs", "given", "run"
_ASKED, _FOUND = "asked.json", "found.json"


#: Endings of shipped files that examples read.
_SHIPPED = (".npz", ".csv")


_ASKED_FORM = TypeAdapter(Asked)


class Folder:
    """Where files that cases may name, and runs, are kept."""

    def __init__(self, path: Path) -> None:
        self.path = path.absolute()
        for part in (_FILES, _RUNS):
            (self.path / part).mkdir(parents=True, exist_ok=True)
        self._put_shipped_files()

    @property
    def case(self) -> Path:
        """What a case is called that is only looked at: beside the files that it may name."""
        return self.path / _FILES / CASE_NAME

    def files(self) -> list[dict[str, Any]]:
        """Return what files there are: name and size [bytes]."""
        found = sorted((self.path / _FILES).iterdir())
        return [
            {"name": path.name, "size": path.stat().st_size}
            for path in found
            if path.is_file() and is_plain_name(path.name)
        ]

    def put_file(self, name: str, content: bytes) -> None:
        """Keep a file under a name; one of that name is replaced."""
        path = self._file(name)
        try:
            _write(path, content)
        except OSError as error:
            why = f"{name} cannot be kept: {error.strerror or error}"
            raise RequestError(507, why) from error

    def remove_file(self, name: str) -> None:
        """Remove a file."""
        path = self._file(name)
        if not path.is_file():
            raise RequestError(404, f"there is no file {name!r}")
        path.unlink()

    def new_run(self, text: str, asked: Asked, data: Mapping[Path, str]) -> str:
        """Keep a case that is to be run, and what it reads."""
        name = f"{clock.strftime('%Y%m%d-%H%M%S', clock.gmtime())}-{secrets.token_hex(3)}"
        given = self.path / _RUNS / name / _GIVEN
        with ExitStack() as undoing:
            given.mkdir(parents=True)
            undoing.callback(self.remove_run, name)  # unless all of it is kept
            (given / CASE_NAME).write_text(text, encoding="utf-8")
            for path, called in data.items():
                shutil.copyfile(path, given / called)
            self.keep(name, asked)  # last: without it there is no run
            undoing.pop_all()
        return name

    def keep(self, name: str, asked: Asked) -> None:
        """Keep how a run stands."""
        told = json.dumps(asdict(asked), ensure_ascii=False, indent=1)
        _write(self.path / _RUNS / name / _ASKED, told.encode())

    def runs(self) -> Iterator[tuple[str, Asked]]:
        """Yield the runs that are kept, oldest first; what cannot be read is left alone."""
        for path in sorted((self.path / _RUNS).glob(f"*/{_ASKED}")):
            with suppress(OSError, ValueError):
                yield path.parent.name, _ASKED_FORM.validate_json(path.read_bytes())

    def keep_found(self, name: str, key: str, found: dict[str, Any]) -> None:
        """Keep what the result of a run says, so that it need not be read again."""
        told = json.dumps({"key": key, "found": found}, allow_nan=False)
        _write(self.path / _RUNS / name / _FOUND, told.encode())

    def found(self, name: str, key: str) -> dict[str, Any] | None:
        """Return what the result of a run was found to say; None if that is not kept."""
        try:
            kept = json.loads((self.path / _RUNS / name / _FOUND).read_text(encoding="utf-8"))
            return dict(kept["found"]) if kept["key"] == key else None
        except (OSError, ValueError, TypeError, LookupError):
            return None

    def remove_run(self, name: str) -> None:
        """Remove a run and all that is kept of it; of one that lies elsewhere, the link to it."""
        place = self.path / _RUNS / name
        if place.is_symlink():  # somebody keeps it elsewhere, where nothing is ours to remove
            place.unlink()
            return
        # First what makes a run of it: whatever cannot be removed comes back no more.
        with suppress(FileNotFoundError):
            (place / _ASKED).unlink()
        shutil.rmtree(place, ignore_errors=True)

    def given(self, name: str) -> Path:
        """Return the case of a run, as it was given."""
        return self.path / _RUNS / name / _GIVEN / CASE_NAME

    def directory(self, name: str) -> Path:
        """Return the run directory of a run."""
        return self.path / _RUNS / name / _RUN

    def report(self, name: str) -> Path:
        """Return where the report of a run is kept."""
        return self.path / _RUNS / name / "report.html"

    def keep_report(self, name: str, page: bytes, made_from: int) -> None:
        """Keep the report of a run, with the time at which the result it tells of was written."""
        _write(self.report(name), page)
        os.utime(self.report(name), ns=(made_from, made_from))

    def _file(self, name: str) -> Path:
        if not is_plain_name(name) or name.lower() == CASE_NAME or len(name.encode()) > 200:
            raise RequestError(
                400, f"{name!r} cannot be the name of a file here; call it e.g. 'pmma.csv'"
            )
        return self.path / _FILES / name

    def _put_shipped_files(self) -> None:
        """Put what shipped examples read beside what users give."""
        for entry in files("viscontact.examples").iterdir():
            path = self.path / _FILES / entry.name
            if path.suffix in _SHIPPED and not path.exists():
                _write(path, entry.read_bytes())


def usual_folder() -> Path:
    """Return where data of programs belong on this system, below the user's own folder."""
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Application Support"
    else:
        base = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")
    return base / "viscontact"


def _write(path: Path, content: bytes) -> None:
    """Write a file so that it is there whole or not at all."""
    fresh = path.with_name(f".{secrets.token_hex(6)}.new")  # two may come at once
    try:
        fresh.write_bytes(content)
        replace(fresh, path)
    finally:
        with suppress(OSError):  # only if it could not be written or put there
            fresh.unlink()
