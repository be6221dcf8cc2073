"""Numbers in Fortran format, as in material cards."""

from __future__ import annotations

import re

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")


def card_number(where: str, text: str) -> float:
    """Return the number in a field, whose exponent may begin with E or D, or raise ValueError."""
    if not _NUMBER.fullmatch(text):
        raise ValueError(f"{where}: {text[:40]!r} is not a number; write parameters out")
    value = float(re.sub("[dD]", "e", text))
    if value in (float("inf"), float("-inf")):
        raise ValueError(f"{where}: {text[:40]!r} is beyond all numbers")
    return value


def card_digits(value: float, widest: int = 20) -> str:
    """Write a number with all its digits, or as many as fit in `widest` characters."""
    text = repr(float(value))
    digits = 17
    while len(text) > widest:
        digits -= 1
        text = f"{value:.{digits}g}"
    return text
