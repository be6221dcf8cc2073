"""Manifest of a sweep: the runs of one command, a line of JSON each."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.line_digests import DIGEST, with_digest
from viscontact.results.run_files import MANIFEST_NAME
from viscontact.runs.directory.atomic_files import replacing
from viscontact.studies.json_lines import read_lines

#: Kinds of designs: combinations, pairs, rows of a table, random samples, or several case files.
DESIGNS = ("grid", "zip", "table", "sample", "cases")

#: Key of the last line.
_LAST = "last"
#: Remedy for a line that cannot be read.
_REMEDY = "remove the file, and repeat the command that began the sweep with --resume"


@dataclass(frozen=True)
class SweepRun:
    """One run of a sweep: number, settings, and directory relative to that of the sweep."""

    run: int  # number, from 0, in the order of the manifest
    name: str
    directory: str
    settings: Mapping[str, str]  # all values in place of those of the case, by dotted key
    varied: tuple[str, ...]  # keys of the settings that differ between the runs of a case
    case: str  # path of the case file
    design: str  # one of `DESIGNS`
    changed: tuple[str, ...] = ()  # keys that were set, or left out, for this run alone
    #: Digests of the case's sections and files when the manifest was written; empty if unknown.
    digests: Mapping[str, str] = field(default_factory=dict, compare=False)

    @property
    def assignments(self) -> tuple[str, ...]:
        """Settings as ``--set`` takes them."""
        return tuple(f"{key}={value}" for key, value in self.settings.items())

    @property
    def own_settings(self) -> str:
        """Settings that were given, or left out, for this run alone; empty without any."""
        return ", ".join(
            f"{key}={self.settings[key]}" if key in self.settings else f"without {key}"
            for key in self.changed
        )


def write_manifest(directory: Path, runs: Iterable[SweepRun]) -> Path:
    """Write the manifest of a sweep atomically, and return its path; the directory is made."""
    directory.mkdir(parents=True, exist_ok=True)
    path = directory / MANIFEST_NAME
    with replacing(path) as file:
        for each, is_last in _with_last(runs):
            found = {**vars(each), "settings": dict(each.settings), "digests": dict(each.digests)}
            optional = ("changed", "digests")
            line = {name: value for name, value in found.items() if value or name not in optional}
            text = json.dumps(line | ({_LAST: True} if is_last else {}), ensure_ascii=False)
            # A name that is not UTF-8 is escaped as JSON does it.
            file.write(with_digest(text.encode("utf-8", "backslashreplace")) + b"\n")
    return path


def _with_last(runs: Iterable[SweepRun]) -> Iterator[tuple[SweepRun, bool]]:
    """Yield each run, and whether it is the last one."""
    before: SweepRun | None = None
    for run in runs:
        if before is not None:
            yield before, False
        before = run
    if before is not None:
        yield before, True


def read_manifest(path: Path) -> Iterator[SweepRun]:
    """Yield the runs of a manifest, in constant memory; ValueError names the damaged line."""
    read = None
    for read in read_lines(path, _read_line, "a manifest", _REMEDY):
        yield read[0]
    if read is not None and not read[1]:
        raise ValueError(f"{path}: is damaged: its last runs are missing; {_REMEDY}")
    if read is None:
        raise ValueError(f"{path}: holds no runs; remove it, and repeat the command of the sweep")


def _read_line(found: Any, number: int) -> tuple[SweepRun, bool]:
    """Run of a line, and whether it may be the last one; any may in those of earlier versions."""
    run = _read_run(found, number)
    return run, found.get(_LAST) is True or DIGEST not in found


def _read_run(found: Any, number: int) -> SweepRun:
    if not isinstance(found, dict):
        raise ValueError(f"must be an object of JSON, as {{...}}, got {found!r:.40}")
    run = SweepRun(
        _entry(found, "run", int),
        _entry(found, "name", str),
        _entry(found, "directory", str),
        _texts(found, "settings"),
        _varied_keys(found),
        _entry(found, "case", str),
        _entry(found, "design", str),
        _names(found, "changed") if "changed" in found else (),
        _texts(found, "digests") if "digests" in found else {},
    )
    if run.run != number - 1 or isinstance(found["run"], bool):
        raise ValueError(f"run: must be {number - 1}, the number of its line, got {found['run']}")
    if run.design not in DESIGNS:
        raise ValueError(f"design: must be {', '.join(DESIGNS)}, got {run.design!r}")
    _require_inside(run.directory)
    return run


def _entry(found: dict[str, Any], name: str, kind: type) -> Any:
    value = found.get(name)
    if not isinstance(value, kind):
        what = {int: "a whole number", str: "text", dict: "an object", list: "a list"}[kind]
        got = repr(value)[:40] if name in found else "nothing"
        raise ValueError(f"{name}: must be {what}, got {got}")
    return value


def _texts(found: dict[str, Any], entry: str) -> dict[str, str]:
    texts: dict[str, str] = _entry(found, entry, dict)
    for key, value in texts.items():
        if not isinstance(value, str):
            what = "text with its unit" if entry == "settings" else "text"
            raise ValueError(f"{entry}: {key} must be {what}, got {value!r}")
    return texts


def _varied_keys(found: dict[str, Any]) -> tuple[str, ...]:
    names = _names(found, "varied")
    for name in names:
        if name not in found["settings"]:
            raise ValueError(f"varied: {name!r} is none of the keys of the settings")
    return names


def _names(found: dict[str, Any], entry: str) -> tuple[str, ...]:
    names = _entry(found, entry, list)
    for name in names:
        if not isinstance(name, str):
            raise ValueError(f"{entry}: must be a list of keys, got {name!r}")
    return tuple(names)


def _require_inside(directory: str) -> None:
    # Not by pathlib, which keeps the names of all directories.
    first, *others = re.split(r"[/\\]", directory)
    if not first or re.match("[A-Za-z]:", first) or ".." in (first, *others):
        raise ValueError(
            f"directory: must be the name of a directory in that of the sweep, got {directory!r}"
        )
