"""Sizes of the terminal that the environment states."""

from __future__ import annotations

import os

#: Variables that Rich reads.
_STATING = ("COLUMNS", "LINES")
#: Digits of the largest number that counts.
_MOST_DIGITS = 9


def is_number(text: str) -> bool:
    """True if a size is a number; Rich takes digits that are none for one, such as those of m²."""
    return text.isdecimal() and len(text) <= _MOST_DIGITS


def readable_environment() -> dict[str, str]:
    """Environment without sizes at which Rich would fail: they count as not stated."""
    return {
        name: text
        for name, text in os.environ.items()
        if name not in _STATING or is_number(text) or not text.isdigit()
    }
