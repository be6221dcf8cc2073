"""Digests of the content of a case, by which a later run notices that it has been edited.

The digests are those of the parsed sections, so that comments and blanks may change, and of the
files that a case names. Values that the settings of a run replace are left out.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from viscontact.case import CaseError
from viscontact.case.document import read_document
from viscontact.case.overrides import override
from viscontact.case.reader import digest

#: Length of a digest [characters].
_LENGTH = 16
#: Sections without influence on the numbers, and key of the name of a file.
_FILED, _FILE = ("title", "report", "allowable"), "file"

#: Digests of sections and files, by their names.
Digests = Mapping[str, str]


def changed_parts(case: Path, settings: Mapping[str, str], before: Digests) -> list[str]:
    """Return changed sections and files of a case; None without digests, or if it is unreadable."""
    try:
        now = digests_of(case)(settings) if before else {}
    except (CaseError, OSError):
        return []
    return [name for name in {**before, **now} if before.get(name) != now.get(name)]


def digests_of(case: Path) -> Callable[[Mapping[str, str]], Digests]:
    """Return the function that gives the digests of a case with settings; CaseError if it fails."""
    document = read_document(case)
    of_file = cache(lambda name: digest(case.parent / name).hex()[:_LENGTH])

    @cache
    def sections(keys: tuple[str, ...]) -> dict[str, str]:
        data = override(document, (f"{key}=null" for key in keys)).data
        return {name: _digest(value) for name, value in data.items() if name not in _FILED}

    @cache
    def files(settings: tuple[str, ...]) -> dict[str, str]:
        return {name: of_file(name) for name in _files(override(document, settings).data)}

    def digests(settings: Mapping[str, str]) -> Digests:
        named = (f"{key}={value}" for key, value in settings.items())
        of_files = tuple(text for text in named if _FILE in text)
        return {**sections(tuple(settings)), **files(of_files)}

    return digests


def _files(data: Any) -> Iterator[str]:
    """Yield the names of files in the data of a case."""
    entries: Sequence[Any] = data if isinstance(data, list) else ()
    if isinstance(data, dict):
        entries = [value for key, value in data.items() if key != _FILE]
        if isinstance(name := data.get(_FILE), str):
            yield name
    for entry in entries:
        yield from _files(entry)


def _digest(value: Any) -> str:
    text = json.dumps(_normal_value(value), sort_keys=True, default=str)
    return hashlib.sha256(text.encode("utf-8", "backslashreplace")).hexdigest()[:_LENGTH]


def _normal_value(value: Any) -> Any:
    """Value of a case with texts without blanks, and with floats for all numbers."""
    if isinstance(value, dict):
        return {str(key): _normal_value(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_normal_value(each) for each in value]
    if isinstance(value, str):
        return "".join(value.split())
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value
