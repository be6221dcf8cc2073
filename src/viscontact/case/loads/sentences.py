"""Sentences of a load: "ramp to 10 kN in 1 s; hold for 240 s", or of a temperature."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

from pydantic import BeforeValidator, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case.loads.grammar import (
    EXAMPLES,
    FORMS,
    TEMPERATURE_EXAMPLES,
    TEMPERATURE_FORMS,
    Form,
    PhraseError,
    Reading,
    read_form,
)
from viscontact.units.formatting import quoted

#: Ends of sentences; a new one also begins with "then" or "and".
_ENDS = re.compile(r";|\n|\.(?=\s|$)|,?\s*\b(?:and\s+)?then\b|,?\s+and\s+(?=[a-z])", re.IGNORECASE)

#: Largest number of sentences that an error message explains.
_MOST_EXPLAINED = 10

#: Longest quotation of a sentence in messages.
_LONGEST = 80

#: Largest number of sentences; more take seconds to parse.
_MOST_SENTENCES = 10_000

#: Short histories of a load and of a temperature.
EXAMPLE = "'ramp to 10 kN in 1 s; hold for 240 s; unload in 0.1 s'"
TEMPERATURE_EXAMPLE = "'start at 23 degC; heat to 60 degC in 2 h; hold for 8 h'"


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


@dataclass(frozen=True)
class Language:
    """Sentences about one thing: their forms, examples of each, and a short history."""

    forms: tuple[Form, ...]
    examples: tuple[str, ...]
    example: str

    def sentences_of(self, entry: _Entry) -> tuple[Sentence, ...]:
        """Sentences of an entry; one message names all that are refused."""
        read: list[Sentence] = []
        refused: list[str] = []
        for number, text in enumerate(entry.parts, start=entry.first):
            try:
                read.append(Sentence(number, text, entry.place, read_form(text, self.forms)))
            except PhraseError as error:
                refused.append(f"sentence {number}, {quoted(text, _LONGEST)}: {error}")
        if not entry.parts:
            refused.append("it is empty")
        if refused:
            if len(refused) > _MOST_EXPLAINED:
                refused[_MOST_EXPLAINED:] = [f"and {len(refused) - _MOST_EXPLAINED} more"]
            forms = ", ".join(repr(form) for form in self.examples)
            why = f"{'; '.join(refused)}. Possible sentences: {forms}"
            raise PydanticCustomError("quantity", "{why}", {"why": why})
        return tuple(read)

    def as_entries(self, given: Any) -> list[_Entry]:
        """Entries of a text or of a list of texts."""
        texts = [given] if isinstance(given, str) else given
        if not isinstance(texts, list) or not texts:
            got = quoted(str(given), _LONGEST)
            why = f"must be a text or a list of texts, got {got}; write e.g. {self.example}"
            raise PydanticCustomError("quantity", "{why}", {"why": why})
        entries = _numbered_entries(texts)
        count = sum(len(entry.parts) for entry in entries)
        if count > _MOST_SENTENCES:
            why = f"holds {count} sentences, and at most {_MOST_SENTENCES} are read; repeat some"
            raise PydanticCustomError("quantity", "{why}", {"why": why})
        return entries

    @property
    def schema(self) -> dict[str, Any]:
        """JSON schema: a text, or a list of texts."""
        return {
            "description": "what happens in turn, such as " + ", ".join(self.examples),
            "anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}],
            "examples": [self.example.strip("'")],
        }


LOADS = Language(FORMS, EXAMPLES, EXAMPLE)
TEMPERATURES = Language(TEMPERATURE_FORMS, TEMPERATURE_EXAMPLES, TEMPERATURE_EXAMPLE)

#: Of a case file: a text or a list of texts, as tuples of `Sentence`.
Sentences = Annotated[
    list[Annotated[Any, PlainValidator(LOADS.sentences_of)]],
    BeforeValidator(LOADS.as_entries),
    WithJsonSchema(LOADS.schema),
]
TemperatureSentences = Annotated[
    list[Annotated[Any, PlainValidator(TEMPERATURES.sentences_of)]],
    BeforeValidator(TEMPERATURES.as_entries),
    WithJsonSchema(TEMPERATURES.schema),
]
