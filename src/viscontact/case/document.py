"""Text of a case file as plain data, with the line of each key."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import field, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import toml_source, yaml_source
from viscontact.case.aliases import CanonicalData, resolved, value_at
from viscontact.case.errors import CaseError, KeyPath, SourceError, dotted
from viscontact.case.tolerances import nominal

# Largest case file [bytes]; long histories belong in a CSV file. The parser needs ten seconds for
# a megabyte.
_LARGEST_FILE = 1_000_000


@dataclass(frozen=True)
class Document:
    """Content of a case file before it is validated; numbers are nominal, keys canonical."""

    path: Path
    source: str  # without the values given by ``--set``
    data: dict[str, Any]
    lines: dict[KeyPath, int]
    overrides: Mapping[KeyPath, Any] = field(default_factory=dict)
    confined: bool = False  # names files in its folder only
    # Keys typed in place of canonical ones.
    aliases: Mapping[KeyPath, KeyPath] = field(default_factory=dict)
    of_aliases: Mapping[KeyPath, Any] = field(default_factory=dict)  # values, as typed
    misused: tuple[tuple[KeyPath, str], ...] = ()  # typed keys that cannot be resolved
    tolerances: Mapping[KeyPath, str] = field(default_factory=dict)  # texts, under keys as typed

    @cached_property
    def text(self) -> str:
        """YAML text with the values given by ``--set``, written when it is needed."""
        if not self.overrides:
            return self.source
        return yaml_source.with_overrides(self.source, dict(self.overrides))

    @property
    def data_as_typed(self) -> dict[str, Any]:
        """The data with the aliases that were typed, and their values."""
        data = deepcopy(self.data)
        for canonical, typed in self.aliases.items():
            del value_at(data, canonical[:-1])[canonical[-1]]
            value_at(data, typed[:-1])[typed[-1]] = self.of_aliases[typed]
        return data

    @property
    def data_with_tolerances(self) -> dict[str, Any]:
        """The data as they were typed, with the tolerances."""
        data = self.data_as_typed
        for path, text in self.tolerances.items():
            value_at(data, path[:-1])[path[-1]] = text
        return data

    def place(self, key: KeyPath) -> str:
        """Return the place of a key: ``case.yaml:6:``, or ``--set`` if it was given there."""
        if any(key and _same_branch(key, path) for path in self.overrides):
            return "--set"
        for length in range(len(key), 0, -1):
            if key[:length] in self.lines:
                return f"{self.path}:{self.lines[key[:length]]}:"
        return f"{self.path}:"

    def problem(self, key: KeyPath, why: str) -> str:
        """Return a problem as one line: place, key as it was typed, and reason."""
        name = f"{dotted(self._as_typed(key))}:" if key else ""
        return " ".join(filter(None, (self.place(key), name, why)))

    def _as_typed(self, key: KeyPath) -> KeyPath:
        for length in range(len(key), 0, -1):
            if typed := self.aliases.get(key[:length]):
                return (*typed, *key[length:])
        return key


def as_written(data: Any, path: KeyPath) -> KeyPath:
    """Path of a value in the data of a file, without the steps that the file leaves out."""
    found: list[str | int] = []
    for place, step in enumerate(path):
        if isinstance(data, dict) and step in data:
            # A name of the library, beside which the keys of its section are written.
            if isinstance(data[str(step)], str) and any(key in data for key in path[place + 1 :]):
                continue
            data = data[str(step)]
        elif isinstance(data, list) and isinstance(step, int) and step < len(data):
            data = data[step]
        else:
            continue
        found.append(step)
    return tuple(found)


def _same_branch(one: KeyPath, other: KeyPath) -> bool:
    return all(a == b for a, b in zip(one, other, strict=False))


def read_document(path: Path) -> Document:
    """Read a case file, YAML or by its suffix TOML, without validating it."""
    return document_of(_read_text(path), path)


def with_section(document: Document) -> Document:
    """Put keys of a material at the top level under `material`."""
    if "law" not in document.data or "material" in document.data:
        return document
    lines = {("material", *key): line for key, line in document.lines.items()}
    return Document(document.path, document.source, {"material": document.data}, lines)


def document_of(text: str, path: Path, *, confined: bool = False) -> Document:
    """Read the text of a case file, YAML or by the path's suffix TOML."""
    try:
        if len(text.encode()) > _LARGEST_FILE:
            raise _too_large(path)
    except UnicodeEncodeError:
        raise CaseError(f"{path}: is not a text in UTF-8") from None
    if not text.strip():
        raise CaseError(f"{path}: the file is empty; `viscontact example` shows complete ones")
    is_toml = path.suffix.lower() == ".toml"
    try:
        data, lines = deepcopy(_parse(text, is_toml))
    except SourceError as problem:
        place = f"{path}:{problem.line}" if problem.line else str(path)
        raise CaseError(f"{place}: {problem}") from problem
    if not isinstance(data, dict):
        raise CaseError(
            f"{path}: a case file is a mapping of keys such as indenter:, material:, load:, "
            f"got {_kind(data)}; `viscontact example` shows complete ones"
        )
    written = yaml_source.write(data) if is_toml else text
    plain = nominal(data)
    document = Document(
        path,
        written,
        plain.data,
        lines,
        confined=confined,
        misused=plain.problems,
        tolerances=plain.tolerances,
    )
    return _with_canonical_keys(document, resolved(plain.data))


def _with_canonical_keys(document: Document, found: CanonicalData) -> Document:
    """Return a document with the resolved data, and with the same keys in its text."""
    if found.data is document.data:
        return document
    lines = dict(document.lines)
    for canonical, typed in found.typed.items():
        if typed in lines:
            lines[canonical] = lines[typed]
    text = yaml_source.renamed(document.source, found.typed, found.data)
    return replace(
        document,
        source=text,
        data=found.data,
        lines=lines,
        aliases=found.typed,
        of_aliases=found.values,
        misused=(*document.misused, *found.problems),
    )


@lru_cache(maxsize=8)
def _parse(text: str, is_toml: bool) -> tuple[Any, dict[KeyPath, int]]:
    """Data and lines of a text, kept as the runs of a sweep read the same case."""
    return toml_source.parse(text) if is_toml else yaml_source.parse(text)


def _too_large(path: Path) -> CaseError:
    return CaseError(
        f"{path}: larger than {_LARGEST_FILE // 1_000_000} MB, which no case file is; a "
        "long history belongs in a CSV file"
    )


def _read_text(path: Path) -> str:
    try:
        if path.is_dir():
            raise CaseError(f"{path}: is a directory; name the case file in it")
        if path.exists() and not path.is_file():  # a device or a pipe may have no end
            raise CaseError(f"{path}: is no file")
        with path.open("rb") as file:
            data = file.read(_LARGEST_FILE + 1)
        if len(data) > _LARGEST_FILE:
            raise _too_large(path)
        return data.decode("utf-8-sig")
    except FileNotFoundError:
        raise CaseError(f"{path}: no such file{_nearest_file(path)}") from None
    except UnicodeDecodeError:
        raise CaseError(f"{path}: is not a text file in UTF-8") from None
    except (OSError, ValueError) as error:
        if isinstance(error, CaseError):
            raise
        raise CaseError(f"{path}: cannot be read: {error}") from error


def _nearest_file(path: Path) -> str:
    folder = path.parent
    try:
        names = [entry.name for entry in folder.iterdir()]
    except (OSError, ValueError):  # no such folder, or none that may be read
        return ""
    near = difflib.get_close_matches(path.name, names, n=1)
    return f"; did you mean '{folder / near[0]}'?" if near else ""


def _kind(data: object) -> str:
    if data is None:
        return "only comments"
    return "a list" if isinstance(data, list) else f"only {str(data)[:40]!r}"
