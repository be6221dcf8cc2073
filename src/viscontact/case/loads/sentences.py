"""Sentences of a load: "ramp to 10 kN in 1 s; hold for 240 s; unload in 0.1 s"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, NamedTuple

from pydantic import BeforeValidator, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from viscontact.case.loads.grammar import EXAMPLES, FORMS, PhraseError, Reading, read_form
from viscontact.units.formatting import quoted

#: Ends of sentences; a new one also begins with "then" or "and".
_ENDS = re.compile(r";|\n|\.(?=\s|$)|,?\s*\b(?:and\s+)?then\b|,?\s+and\s+(?=[a-z])", re.IGNORECASE)

#: Largest number of sentences that an error message explains.
_MOST_EXPLAINED = 10

#: Longest quotation of a sentence in messages.
_LONGEST = 80

#: Largest number of sentences; more take seconds to parse.
_MOST_SENTENCES = 10_000

#: A short history.
EXAMPLE = "'ramp to 10 kN in 1 s; hold for 240 s; unload in 0.1 s'"


@dataclass(frozen=True)
class Sentence:
    """Parsed sentence, with its number and its list entry, both from 1."""

    number: int
    text: str
    entry: int
    reading: Reading

    def __str__(self) -> str:
        return f"sentence {self.number}, {quoted(self.text, _LONGEST)}"


def split_sentences(text: str) -> list[str]:
    """Split a text into its sentences."""
    # Single blanks: a pattern for "and" after blanks would try every sequence of them.
    text = re.sub(r"\s+", lambda run: "\n" if "\n" in run[0] else " ", text)
    return [part.strip(" \t\r,") for part in _ENDS.split(text) if part.strip(" \t\r,")]


class _Entry(NamedTuple):
    """An entry of a list of sentences: its place, its first sentence's number, its parts."""

    place: int
    first: int
    parts: list[str]


def _numbered_entries(texts: Sequence[Any]) -> list[_Entry]:
    entries: list[_Entry] = []
    number = 1
    for place, text in enumerate(texts, start=1):
        parts = split_sentences(text) if isinstance(text, str) else [repr(text)]
        entries.append(_Entry(place, number, parts))
        number += len(parts)
    return entries


def _sentences_of(entry: _Entry) -> tuple[Sentence, ...]:
    """Sentences of an entry; one message names all that are refused."""
    read: list[Sentence] = []
    refused: list[str] = []
    for number, text in enumerate(entry.parts, start=entry.first):
        try:
            read.append(Sentence(number, text, entry.place, read_form(text, FORMS)))
        except PhraseError as error:
            refused.append(f"sentence {number}, {quoted(text, _LONGEST)}: {error}")
    if not entry.parts:
        refused.append("it is empty")
    if refused:
        if len(refused) > _MOST_EXPLAINED:
            refused[_MOST_EXPLAINED:] = [f"and {len(refused) - _MOST_EXPLAINED} more"]
        forms = ", ".join(repr(form) for form in EXAMPLES)
        why = f"{'; '.join(refused)}. Possible sentences: {forms}"
        raise PydanticCustomError("quantity", "{why}", {"why": why})
    return tuple(read)


def _as_entries(given: Any) -> list[_Entry]:
    texts = [given] if isinstance(given, str) else given
    if not isinstance(texts, list) or not texts:
        got = quoted(str(given), _LONGEST)
        why = f"must be a text or a list of texts, got {got}; write e.g. {EXAMPLE}"
        raise PydanticCustomError("quantity", "{why}", {"why": why})
    entries = _numbered_entries(texts)
    count = sum(len(entry.parts) for entry in entries)
    if count > _MOST_SENTENCES:
        why = f"holds {count} sentences, and at most {_MOST_SENTENCES} are read; repeat some"
        raise PydanticCustomError("quantity", "{why}", {"why": why})
    return entries


_SCHEMA = {
    "description": "what happens in turn, such as " + ", ".join(EXAMPLES),
    "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
    "examples": [EXAMPLE.strip("'")],
}

#: Of a case file: a text or a list of texts, as tuples of `Sentence`.
Sentences = Annotated[
    list[Annotated[Any, PlainValidator(_sentences_of)]],
    BeforeValidator(_as_entries),
    WithJsonSchema(_SCHEMA),
]
