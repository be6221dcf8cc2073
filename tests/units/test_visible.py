"""Escapes of control characters, against the categories of the Unicode standard."""

from __future__ import annotations

import sys
import unicodedata

from viscontact.units.visible import visible

_END = sys.maxunicode + 1
#: Classes of UAX #9 that begin or end a change of direction.
DIRECTIONS = ("LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI")


def is_control(sign: str) -> bool:
    """Control characters, halves of characters, and changes of the direction of writing."""
    kind = unicodedata.category(sign)
    return kind in ("Cc", "Cs") or unicodedata.bidirectional(sign) in DIRECTIONS


def test_exactly_the_controls_of_unicode_are_escaped_except_tabs_and_new_lines() -> None:
    texts = ("".join(map(chr, range(first, first + 256))) for first in range(0, _END, 256))
    escaped = {
        sign for text in texts if visible(text) != text for sign in text if visible(sign) != sign
    }
    # Directions are a property of assigned characters alone: the rest has no class.
    expected = {sign for number in range(_END) if is_control(sign := chr(number))}
    assert escaped == expected - {"\t", "\n"}


def test_escapes_are_those_of_python_and_name_the_character() -> None:
    text = "a\x1b[31m\x07\x9b\u202e\r\ud800 µ\\x"
    assert visible(text) == "a\\x1b[31m\\x07\\x9b\\u202e\\r\\ud800 µ\\x"
    assert visible(visible(text)) == visible(text)
