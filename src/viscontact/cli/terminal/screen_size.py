"""Sizes of the terminal that the environment states."""

from __future__ import annotations

import os

_STATING = ("COLUMNS", "LINES")
#: Digits of the largest number that counts.
_MOST_DIGITS = 9


def is_number(text: str) -> bool:
    """True if a size is a number that `int` reads; it refuses some digits, such as that of m²."""
    return text.isdecimal() and len(text) <= _MOST_DIGITS


def forget_unreadable_sizes() -> None:
    """Take sizes that are no numbers as not stated; Rich and Typer would fail at some of them."""
    for name in _STATING:
        if not is_number(os.environ.get(name, "")):
            os.environ.pop(name, None)
