"""Values of keys as they are typed: lists with commas, and ranges with colons."""

from __future__ import annotations

from collections.abc import Iterator

_OPENING, _CLOSING, _QUOTES = "[{", "]}", "\"'"


def split_values(text: str) -> list[str]:
    """Split at commas outside brackets and quotes."""
    commas = [place for place in _outside(text) if text[place] == ","]
    ends = zip([-1, *commas], [*commas, len(text)], strict=True)
    return [text[comma + 1 : end].strip() for comma, end in ends]


def bounds(text: str) -> tuple[str, ...]:
    """Parts of a range, as ``5 mm:50 mm:log``."""
    return tuple(part.strip() for part in text.split(":"))


def is_range(text: str) -> bool:
    """True for a range, which has colons outside brackets and quotes."""
    return any(text[place] == ":" for place in _outside(text))


def typed_parameter(text: str) -> tuple[str, ...] | list[str]:
    """Bounds of a range as a tuple, or a list of values."""
    return bounds(text) if is_range(text) else split_values(text)


def _outside(text: str) -> Iterator[int]:
    """Places of the letters outside brackets and quotes; a quote begins a value."""
    depth, quote, is_begin = 0, "", True
    for place, letter in enumerate(text):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in _QUOTES and is_begin:
            quote, is_begin = letter, False
        else:
            depth += (letter in _OPENING) - (letter in _CLOSING)
            if depth == 0:
                yield place
            is_begin = (letter == "," and depth == 0) or (is_begin and letter.isspace())
