"""Syntax of Abaqus input files: keyword lines, data lines, comments."""

from __future__ import annotations

import re

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.cards.abaqus_keywords import whole_keyword
from viscontact.bodies.materials.cards.numbers import card_number


@dataclass(frozen=True)
class DataLine:
    """One data line: its place, for messages, and its fields."""

    where: str
    fields: tuple[str, ...]

    def numbers(self, least: int, most: int) -> list[float]:
        """Return `least` to `most` fields as numbers, padded with 0; else ValueError."""
        if not least <= len(self.fields) <= most:
            wanted = f"{least} to {most}" if least < most else f"{most}"
            raise ValueError(f"{self.where}: must have {wanted} numbers, got {len(self.fields)}")
        found = [card_number(self.where, field) if field else 0.0 for field in self.fields]
        return found + [0.0] * (most - len(found))


@dataclass(frozen=True)
class Block:
    """One keyword in capitals with parameters and data lines; `where` is file and line."""

    where: str
    keyword: str
    parameters: dict[str, str]
    data: tuple[DataLine, ...]

    def given(self, name: str, least: int = 3) -> str | None:
        """Return the value of a parameter, whose name may be abbreviated; None if not given."""
        for written, value in self.parameters.items():
            short = _word(written)
            if short == _word(name) or (len(short) >= least and _word(name).startswith(short)):
                return value
        return None

    def choice(self, name: str, options: tuple[str, ...], default: str) -> str:
        """Return the word, maybe abbreviated, that a parameter has; ValueError for another."""
        given = self.given(name)
        if given is None:
            return default
        plain = _word(given)
        found = [option for option in options if plain and _word(option).startswith(plain)]
        if len(found) != 1:
            raise ValueError(
                f"{self.where}: *{self.keyword}, {name}={given}: must be one of "
                f"{', '.join(options)}"
            )
        return found[0]


def read_blocks(source: str, text: str) -> list[Block]:
    """Split the text of an input file into keyword blocks; `source` is its name, for messages.

    Abaqus 2016 Analysis User's Guide, section 1.2.1, "Input syntax rules": a keyword line begins
    with one star and continues on the next line if it ends with a comma; two stars begin a
    comment; case and blanks are ignored, except in quotation marks. Abbreviated keywords are
    returned whole.
    """
    blocks: list[Block] = []
    data: list[DataLine] = []
    heading, place = "", ""
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.strip()
        if not content or content.startswith("**"):
            continue
        if heading.endswith(","):  # the keyword line continues
            heading += content
        elif content.startswith("*"):
            _close(blocks, place, heading, data)
            heading, place, data = content, f"{source}:{number}", []
        elif heading:
            fields = tuple(field.strip() for field in content.removesuffix(",").split(","))
            data.append(DataLine(f"{source}:{number}", fields))
    _close(blocks, place, heading, data)
    return blocks


def _close(blocks: list[Block], where: str, heading: str, data: list[DataLine]) -> None:
    if not heading:
        return
    keyword, *parameters = _split_outside_quotes(heading.removesuffix(","))
    found = {}
    for parameter in parameters:
        name, _, value = parameter.partition("=")
        found[_with_spaces(name)] = value.strip().strip('"')
    blocks.append(Block(where, whole_keyword(keyword.removeprefix("*")), found, tuple(data)))


def _split_outside_quotes(heading: str) -> list[str]:
    """Split at commas that an even number of quotation marks follows."""
    pieces = heading.split('"')
    last = len(pieces) - 1
    # Text files contain no NUL, so it can mark where to split.
    marked = [p if (last - k) % 2 else p.replace(",", "\0") for k, p in enumerate(pieces)]
    return '"'.join(marked).split("\0")


def _with_spaces(text: str) -> str:
    return " ".join(text.split()).upper()


def _word(text: str) -> str:
    return re.sub(r"\s+", "", text).upper()
