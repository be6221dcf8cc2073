"""TOML as plain data with line numbers, as far as they can be found."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from viscontact.case.problems import KeyPath, SourceError

__all__ = ["SourceError", "parse"]

_HEADER = re.compile(r"\s*\[(\[)?\s*([\w.-]+)\s*\]\]?")
_KEY = re.compile(r"\s*([\w.-]+)\s*=")


def parse(text: str) -> tuple[dict[str, Any], dict[KeyPath, int]]:
    r"""Read TOML.

    Parameters
    ----------
    text : str
        The text of the file.

    Returns
    -------
    data : dict
        Its content.
    lines : dict
        Line number, from 1, of each key that begins a line, by its path.

    Raises
    ------
    SourceError
        If it is not TOML.

    Examples
    --------
    >>> parse('[load]\nforce = "10 kN"')
    ({'load': {'force': '10 kN'}}, {('load',): 1, ('load', 'force'): 2})
    """
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"line (\d+)", str(error))
        line = int(found[1]) if found else None
        raise SourceError(f"not valid TOML: {error}", line) from error
    except RecursionError as error:
        raise SourceError("nested too deeply for a case file") from error
    return data, _lines(text)


def _lines(text: str) -> dict[KeyPath, int]:
    # tomllib keeps no line numbers; the headers and keys at the beginning of lines are nearly all.
    lines: dict[KeyPath, int] = {}
    table: KeyPath = ()
    for number, line in enumerate(text.splitlines(), start=1):
        if header := _HEADER.match(line):
            table = tuple(header[2].split("."))
            if header[1]:
                table = (*table, _next_index(table, lines))
            lines.setdefault(table, number)
        elif key := _KEY.match(line):
            lines.setdefault((*table, *key[1].split(".")), number)
    return lines


def _next_index(table: KeyPath, lines: dict[KeyPath, int]) -> int:
    index = 0
    while (*table, index) in lines:
        index += 1
    return index
