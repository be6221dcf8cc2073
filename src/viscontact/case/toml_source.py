"""TOML parser with line numbers, where they can be found."""

from __future__ import annotations

import re
from collections import Counter
from typing import Any

from viscontact.case.errors import KeyPath, SourceError

__all__ = ["SourceError", "parse"]

_HEADER = re.compile(r"\s*\[(\[)?\s*([\w.-]+)\s*\]\]?")
_KEY = re.compile(r"\s*([\w.-]+)\s*=")

# The time of the parser grows with the square of a key's length.
_MOST_PARTS = 64
_ENDLESS_KEY = re.compile(
    rf"""(?<![\w-])(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){{{_MOST_PARTS}}}"""
)


def parse(text: str) -> tuple[dict[str, Any], dict[KeyPath, int]]:
    """Read TOML."""
    if endless := _ENDLESS_KEY.search(text):
        raise SourceError(
            f"a key of more than {_MOST_PARTS} parts does not occur in case files",
            text.count("\n", 0, endless.start()) + 1,
        )
    import tomllib  # few cases are written so

    try:
        data = tomllib.loads(text)
    except ValueError as error:  # TOMLDecodeError is one, and a whole number of 5000 digits another
        found = re.search(r"line (\d+)", str(error))
        line = int(found[1]) if found else None
        raise SourceError(f"not valid TOML: {error}", line) from error
    except RecursionError as error:
        raise SourceError("nested too deeply for a case file") from error
    return data, _lines(text)


def _lines(text: str) -> dict[KeyPath, int]:
    # tomllib has no line numbers; nearly all keys are in headers or at the beginning of a line.
    lines: dict[KeyPath, int] = {}
    table: KeyPath = ()
    entries: Counter[KeyPath] = Counter()
    for number, line in enumerate(text.splitlines(), start=1):
        if header := _HEADER.match(line):
            table = tuple(header[2].split("."))
            if header[1]:
                entries[table] += 1
                table = (*table, entries[table] - 1)
            lines.setdefault(table, number)
        elif key := _KEY.match(line):
            lines.setdefault((*table, *key[1].split(".")), number)
    return lines
