"""Numbers in the cards of programs that are written in Fortran."""

from __future__ import annotations

import re

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")


def card_number(where: str, text: str) -> float:
    """Return the number in a field, or raise ValueError.

    Parameters
    ----------
    where : str
        For the message.
    text : str
        The field; a D may stand for the E of the exponent.

    Examples
    --------
    >>> card_number("card:1", "1.5D-3")
    0.0015
    """
    if not _NUMBER.fullmatch(text):
        raise ValueError(f"{where}: {text[:40]!r} is not a number; write parameters out")
    value = float(re.sub("[dD]", "e", text))
    if value in (float("inf"), float("-inf")):
        raise ValueError(f"{where}: {text[:40]!r} is beyond all numbers")
    return value


def card_digits(value: float, widest: int = 20) -> str:
    """Write a number with as many digits as a field takes, at most those that it has.

    Parameters
    ----------
    value : float
        The number.
    widest : int
        Most characters of a field.

    Examples
    --------
    >>> card_digits(0.1), card_digits(1.2345678901234567e-05)
    ('0.1', '1.23456789012346e-05')
    """
    text = repr(float(value))
    digits = 17
    while len(text) > widest:
        digits -= 1
        text = f"{value:.{digits}g}"
    return text
