"""Syntax of LS-DYNA keyword files: keywords, cards of fixed or comma-separated fields, parameters.

LS-DYNA Keyword User's Manual, volume I, section "General card format": eight fields of 10
characters in a line, or of 20 in the long format (``*KEYWORD LONG=Y``, or a ``+`` behind a
keyword); a line with a comma has its fields between the commas; a dollar sign begins a comment;
``&name`` is the value that ``*PARAMETER`` gives.
"""

from __future__ import annotations

import re
from dataclasses import field
from itertools import pairwise

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.cards.numbers import card_number

_STANDARD, _LONG = 10, 20
_LONG_FILE = re.compile(r"\blong\s*=\s*y", re.I)
_PARAMETER = re.compile(r"(?P<kind>[RIC])?\s*(?P<name>\w+)", re.I)


@dataclass(frozen=True)
class CardLine:
    """One line of data: its place, for messages, and its fields with parameters substituted."""

    where: str
    fields: tuple[str, ...]

    def text(self, place: int) -> str:
        """Return a field, counted from 0; empty if it is missing."""
        return self.fields[place] if place < len(self.fields) else ""

    def number(self, place: int) -> float:
        """Return a field as a number, 0 if it is blank; else ValueError."""
        text = self.text(place)
        if text.startswith("&"):
            raise ValueError(
                f"{self.where}: the parameter {text[:40]!r} has no number in this file; write it "
                "out (expressions are not computed)"
            )
        if re.search(r"\s", text):
            raise ValueError(
                f"{self.where}: {text[:40]!r} is not a number; fields are as wide as the format "
                "says (10 characters, 20 in the long one), or have commas between them"
            )
        return card_number(self.where, text) if text else 0.0


@dataclass
class KeywordBlock:
    """One keyword in capitals without its star; `where` is file and line."""

    where: str
    keyword: str
    width: int
    raw: list[tuple[str, str]] = field(default_factory=list)  # place and text of each line

    def title(self) -> str:
        """Remove the first line, that of a title, and return it."""
        return self.raw.pop(0)[1].strip() if self.raw else ""

    def lines(self, parameters: dict[str, str]) -> list[CardLine]:
        """Return the lines of data; blank ones count, except at the end."""
        raw = list(self.raw)
        while raw and not raw[-1][1].strip():
            raw.pop()
        return [
            CardLine(where, _substituted(_fields(where, text, self.width), parameters))
            for where, text in raw
        ]


def read_keywords(source: str, text: str) -> list[KeywordBlock]:
    """Split the text of a keyword file; `source` is its name, for messages."""
    blocks: list[KeywordBlock] = []
    width = _STANDARD
    for number, line in enumerate(text.splitlines(), start=1):
        where = f"{source}:{number}"
        if line.startswith("$"):
            continue
        if not line.startswith("*"):
            if blocks:
                blocks[-1].raw.append((where, line))
            continue
        words = line[1:].upper().split()
        keyword = words[0] if words else ""
        if keyword == "KEYWORD" and _LONG_FILE.search(line):
            width = _LONG
        own = _LONG if keyword.endswith("+") or words[1:2] == ["+"] else width
        own = _STANDARD if keyword.endswith("-") or words[1:2] == ["-"] else own
        blocks.append(KeywordBlock(where, keyword.rstrip("+-"), own))
    return blocks


def read_parameters(blocks: list[KeywordBlock]) -> dict[str, str]:
    """Return the numbers that *PARAMETER gives, by names in capitals; no expressions."""
    found: dict[str, str] = {}
    for block in blocks:
        options = block.keyword.split("_")
        if options[0] != "PARAMETER" or "EXPRESSION" in options:
            continue
        for line in block.lines({}):
            for name, value in zip(line.fields[::2], line.fields[1::2], strict=False):
                match = _PARAMETER.fullmatch(name)
                if match:
                    found.setdefault(match["name"].upper(), value)
    return found


def _fields(where: str, text: str, width: int) -> tuple[str, ...]:
    if "," in text:
        return tuple(part.strip() for part in text.split(","))
    if "\t" in text:
        raise ValueError(
            f"{where}: has tabs; put its fields into columns of {width} characters by blanks, or "
            "commas between them"
        )
    parts = [text[start : start + width] for start in range(0, len(text.rstrip()), width)]
    for part, following in pairwise(parts):
        meet = not part[-1].isspace() and not following[0].isspace()
        if meet and len(following.strip()) < width:
            raise ValueError(
                f"{where}: {part.split()[-1] + following.split()[0]!r} lies across the edge of two "
                f"fields of {width} characters; move it, or put commas between the fields"
            )
    return tuple(part.strip() for part in parts)


def _substituted(fields: tuple[str, ...], parameters: dict[str, str]) -> tuple[str, ...]:
    return tuple(_value(text, parameters) for text in fields)


def _value(text: str, parameters: dict[str, str]) -> str:
    sign, name = ("-", text[2:]) if text.startswith("-&") else ("", text[1:])
    if not text.startswith(("&", "-&")) or name.upper() not in parameters:
        return text
    value = parameters[name.upper()]
    return value[1:] if sign and value.startswith("-") else sign + value
