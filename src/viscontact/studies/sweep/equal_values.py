"""Equality of settings: quantities are equal however they are written."""

from __future__ import annotations

from collections.abc import Hashable
from functools import lru_cache
from typing import Any

from viscontact.case.yaml_source import SourceError, parse_value
from viscontact.units.parsing import parse_any_quantity


@lru_cache(maxsize=4096)
def comparable(key: str, text: str) -> Hashable:
    """Value of a setting in a form that is the same for equal values."""
    # Numbers are compared to 12 digits in SI units, and names of files letter by letter.
    try:
        value = parse_value(text)
    except SourceError:
        return text.strip()
    is_file = key.rpartition(".")[2] == "file" and isinstance(value, str)
    return value if is_file else _comparable(value)


def _comparable(value: Any) -> Hashable:
    if isinstance(value, list):
        return tuple(map(_comparable, value))
    if isinstance(value, dict):
        return tuple(sorted((str(key), repr(_comparable(each))) for key, each in value.items()))
    if value is None or isinstance(value, bool):
        return repr(value)
    text = str(value)
    try:
        number, unit = parse_any_quantity(text)
    except ValueError:
        return " ".join(text.split())
    return f"{number:.12g}", unit
