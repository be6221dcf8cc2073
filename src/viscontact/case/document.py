"""The text of a case file as plain data, and on which line each key stands."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from viscontact.case import toml_source, yaml_source
from viscontact.case.errors import CaseError, KeyPath, SourceError, dotted

# A case file is a page of text; histories of ten thousand points belong in a CSV. The parser
# reads a megabyte in ten seconds.
_LARGEST_FILE = 1_000_000


@dataclass(frozen=True)
class Document:
    """A case file before anything in it has been understood.

    Parameters
    ----------
    path : Path
        The file, as the user named it.
    text : str
        Its text, as YAML.
    data : dict
        Its content: mappings, lists, texts, numbers.
    lines : dict
        Line number of each key and list entry, by its path.
    overridden : frozenset
        Paths of the keys that were given on the command line.
    confined : bool
        Whether it may name no files but those that lie in its folder.
    """

    path: Path
    text: str
    data: dict[str, Any]
    lines: dict[KeyPath, int]
    overridden: frozenset[KeyPath] = field(default_factory=frozenset)
    confined: bool = False

    def place(self, key: KeyPath) -> str:
        """Say where a key stands: ``case.yaml:6:``, or ``--set`` if it came from there."""
        if any(key and _same_branch(key, path) for path in self.overridden):
            return "--set"
        for length in range(len(key), 0, -1):
            if key[:length] in self.lines:
                return f"{self.path}:{self.lines[key[:length]]}:"
        return f"{self.path}:"

    def problem(self, key: KeyPath, why: str) -> str:
        """Write one problem as one line: where, which key, and what is wrong with it."""
        return " ".join(filter(None, (self.place(key), f"{dotted(key)}:" if key else "", why)))


def _same_branch(one: KeyPath, other: KeyPath) -> bool:
    return all(a == b for a, b in zip(one, other, strict=False))


def read_document(path: Path) -> Document:
    """Read a case file, YAML or by its suffix TOML, without understanding it yet.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Document
        Its content and line numbers.

    Raises
    ------
    CaseError
        If there is no such file, or it is not text, empty, broken or not a mapping.
    """
    return document_of(_read_text(path), path)


def document_of(text: str, path: Path, *, confined: bool = False) -> Document:
    """Read the text of a case file, YAML or by the path's suffix TOML.

    Parameters
    ----------
    text : str
        The text.
    path : Path
        What messages call it; files that it names lie in the same folder.
    confined : bool
        Whether it may name no other files.

    Returns
    -------
    Document
        Its content and line numbers.

    Raises
    ------
    CaseError
        If it is too large, empty, broken or not a mapping.
    """
    try:
        if len(text.encode()) > _LARGEST_FILE:
            raise _too_large(path)
    except UnicodeEncodeError:
        raise CaseError(f"{path}: is not a text in UTF-8") from None
    if not text.strip():
        raise CaseError(f"{path}: the file is empty; `viscontact example` shows complete ones")
    is_toml = path.suffix.lower() == ".toml"
    source = toml_source if is_toml else yaml_source
    try:
        data, lines = source.parse(text)
    except SourceError as problem:
        place = f"{path}:{problem.line}" if problem.line else str(path)
        raise CaseError(f"{place}: {problem}") from problem
    if not isinstance(data, dict):
        raise CaseError(
            f"{path}: a case file is a mapping of keys such as indenter:, material:, load:, "
            f"got {_kind(data)}; `viscontact example` shows complete ones"
        )
    written = yaml_source.write(data) if is_toml else text
    return Document(path, written, data, lines, confined=confined)


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
