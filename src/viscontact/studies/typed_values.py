"""Values of keys as they are typed: lists with commas, and ranges with colons."""

from __future__ import annotations

_OPENING, _CLOSING, _QUOTES = "[{", "]}", "\"'"


def split_values(text: str) -> list[str]:
    """Split at commas outside brackets and quotes."""
    pieces, depth, quote = [""], 0, ""
    for letter in text:
        if quote:
            quote = "" if letter == quote else quote
        elif letter in _QUOTES and not pieces[-1].strip():
            quote = letter
        else:
            depth += (letter in _OPENING) - (letter in _CLOSING)
            if letter == "," and depth == 0:
                pieces.append("")
                continue
        pieces[-1] += letter
    return [piece.strip() for piece in pieces]


def bounds(text: str) -> tuple[str, ...]:
    """Parts of a range, as ``5 mm:50 mm:log``."""
    return tuple(part.strip() for part in text.split(":"))


def is_range(text: str) -> bool:
    """True for a range, which has colons outside brackets."""
    return ":" in text and text[0] not in _OPENING


def typed_parameter(text: str) -> tuple[str, ...] | list[str]:
    """Bounds of a range as a tuple, or a list of values."""
    return bounds(text) if is_range(text) else split_values(text)
