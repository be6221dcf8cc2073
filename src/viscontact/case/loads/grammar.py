"""Grammar of sentences about a load or a temperature: a few forms of words and slots.

A form is a row of words. ``in|within`` is any of these words, ``[at]`` one that may be left
out, and a word in capitals a slot: LEVEL (a force or a length), RATE (one per time), TEMPERATURE,
DIFFERENCE (of temperatures), HEATING (one per time), TIME, COUNT, TIMES (3 times, twice). Articles
are passed over.
"""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case.loads.levels import Level, read_level
from viscontact.case.quantities import POSITIVE, WithUnit
from viscontact.units.formatting import quoted
from viscontact.units.parsing import parse_unit

_ARTICLES = frozenset({"a", "an", "the"})
_WITHIN = "in|within|over|during"
_TOKEN = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[^\s,]+")
_NUMBER = re.compile(r"[+-]?[\d.].*")
_COUNT_WORDS = {"once": 1, "twice": 2, "thrice": 3}


class PhraseError(ValueError):
    """Sentence that fits none of the forms."""


@dataclass(frozen=True)
class Token:
    """Number or word of a sentence, with the position of its end."""

    text: str
    end: int

    @property
    def word(self) -> str:
        """Text for comparison: the case of units matters, that of words does not."""
        return self.text.lower()

    @property
    def is_number(self) -> bool:
        """True if the token begins a quantity or a count."""
        return _NUMBER.fullmatch(self.text) is not None


class Degrees(NamedTuple):
    """A temperature, or a difference of temperatures [K]."""

    value: float


class Rate(NamedTuple):
    """Rate: a level or a difference of temperatures per time [s]."""

    change: Level | Degrees
    per: float


@dataclass(frozen=True)
class Form:
    """Form of a sentence: its meaning, and its words and slots in order."""

    kind: str
    words: str


@dataclass(frozen=True)
class Reading:
    """Match of a form with a sentence: slots, next word expected ("": none), error of a slot."""

    form: Form
    slots: tuple[Any, ...]
    reached: int
    expected: str = ""
    why: str = ""


def read_form(text: str, forms: Sequence[Form]) -> Reading:
    """Return the form that fits a sentence."""
    text = re.sub(r"\s*/\s*|\s+per\s+", "/", text.strip())
    tokens = [Token(found[0], found.end()) for found in _TOKEN.finditer(text)]
    tokens = [token for token in tokens if token.word not in _ARTICLES]
    readings = [_reading(form, tokens) for form in forms]
    whole = [reading for reading in readings if not reading.expected]
    if whole:
        return whole[0]
    raise PhraseError(_refusal(text, tokens, readings))


def _reading(form: Form, tokens: Sequence[Token]) -> Reading:
    slots: list[Any] = []
    at = 0
    for element in form.words.split():
        if element in _SLOTS:
            name, read = _SLOTS[element]
            try:
                value, used = read(tokens[at:])
            except ValueError as error:
                return Reading(form, tuple(slots), at, name, str(error))
            slots.append(value)
            at += used
            continue
        words = element.strip("[]").split("|")
        if at < len(tokens) and tokens[at].word in words:
            at += 1
        elif not element.startswith("["):
            return Reading(form, tuple(slots), at, repr(words[0]))
    expected = "the end" if at < len(tokens) else ""
    return Reading(form, tuple(slots), at, expected)


def _refusal(text: str, tokens: Sequence[Token], readings: Sequence[Reading]) -> str:
    """Message with the part of a sentence that the best forms match, and the part they do not."""
    reached = max(reading.reached for reading in readings)
    best = [reading for reading in readings if reading.reached == reached]
    if reached == 0:
        return f"nothing of it was understood{_nearest(tokens, readings)}"
    end = tokens[reached - 1].end
    understood, rest = text[:end].strip(), text[end:].strip(" ,")
    expected = " or ".join(dict.fromkeys(reading.expected for reading in best))
    got = f"got {quoted(rest)}" if rest else "but nothing follows"
    reasons = [reading.why for reading in best if reading.why]
    why = f" ({reasons[0]})" if reasons else ""
    return f"understood {quoted(understood)}, then expected {expected}, {got}{why}"


def _nearest(tokens: Sequence[Token], readings: Sequence[Reading]) -> str:
    verbs = {word for reading in readings for word in reading.form.words.split()[0].split("|")}
    first = tokens[0].word if tokens else ""
    near = difflib.get_close_matches(first, verbs, n=1)
    return f"; did you mean {near[0]!r}?" if near else ""


def _quantity(tokens: Sequence[Token]) -> tuple[str, int]:
    """Text of a number and its unit, and their number of tokens."""
    if not tokens or not tokens[0].is_number:
        raise PhraseError("")
    if len(tokens) == 1 or tokens[1].is_number or _is_no_unit(tokens[1:]):
        return tokens[0].text, 1
    return f"{tokens[0].text} {tokens[1].text}", 2


def _is_no_unit(tokens: Sequence[Token]) -> bool:
    """True if a word continues the sentence: in "0.1 in in 1 s" the second "in" does."""
    words = [token.word for token in itertools.islice(tokens, 2)]
    prepositions = {*_WITHIN.split("|"), "at", "for", "with", "until"}
    if words[0] == "in" and (len(words) == 1 or words[1] in prepositions):
        return False  # inches
    return words[0] in prepositions


def _level(tokens: Sequence[Token]) -> tuple[Level, int]:
    text, used = _quantity(tokens)
    return read_level(text), used


def _time(tokens: Sequence[Token]) -> tuple[float, int]:
    text, used = _quantity(tokens)
    return WithUnit("time", POSITIVE).read(text), used


def _rate(tokens: Sequence[Token]) -> tuple[Rate, int]:
    text, used = _quantity(tokens)
    level, _, unit = text.rpartition("/")
    if not level:
        raise PhraseError(f"{text!r} is not per time; write e.g. '2 kN/s'")
    change = read_level(level)
    if change.value <= 0:
        raise PhraseError(f"a rate must be more than zero, got {text!r}; the goal says which way")
    return Rate(change, parse_unit(unit, "time")), used


def _temperature(tokens: Sequence[Token]) -> tuple[Degrees, int]:
    text, used = _quantity(tokens)
    return Degrees(WithUnit("temperature", POSITIVE).read(text)), used


def _difference(tokens: Sequence[Token]) -> tuple[Degrees, int]:
    text, used = _quantity(tokens)
    return Degrees(WithUnit("temperature difference", POSITIVE).read(text)), used


def _heating(tokens: Sequence[Token]) -> tuple[Rate, int]:
    text, used = _quantity(tokens)
    change, _, unit = text.rpartition("/")
    if not change:
        raise PhraseError(f"{text!r} is not per time; write e.g. '2 K/min'")
    degrees = Degrees(WithUnit("temperature difference", POSITIVE).read(change))
    return Rate(degrees, parse_unit(unit, "time")), used


def _count(tokens: Sequence[Token]) -> tuple[int, int]:
    if not tokens or not re.fullmatch(r"\d{1,9}", tokens[0].text) or int(tokens[0].text) < 1:
        raise PhraseError("")
    return int(tokens[0].text), 1


def _times(tokens: Sequence[Token]) -> tuple[int, int]:
    if tokens and tokens[0].word in _COUNT_WORDS:
        return _COUNT_WORDS[tokens[0].word], 1
    count, used = _count(tokens)
    behind = [token.word for token in itertools.islice(tokens, 1, 3)]
    used += behind[:1] == ["more"]
    if behind[used - 1 : used] not in (["times"], ["time"]):
        raise PhraseError("")
    return count, used + 1


_Slot = Callable[[Sequence[Token]], tuple[Any, int]]
_SLOTS: dict[str, tuple[str, _Slot]] = {
    "LEVEL": ("a force or a length", _level),
    "RATE": ("a force or a length per time", _rate),
    "TEMPERATURE": ("a temperature", _temperature),
    "DIFFERENCE": ("a difference of temperatures", _difference),
    "HEATING": ("a difference of temperatures per time", _heating),
    "TIME": ("a time", _time),
    "COUNT": ("a whole number", _count),
    "TIMES": ("how many times", _times),
}


def _forms(rows: Iterable[tuple[str, str]]) -> tuple[Form, ...]:
    return tuple(Form(kind, words) for kind, words in rows)


_GO, _BACK = "ramp|load|press|move|go|approach", "unload|withdraw|retract"
_HEAT, _COOL = "heat|warm", "cool|chill"
_STILL = "hold|wait|rest|dwell|pause"

_REPEATS = [
    ("repeat last", "repeat last COUNT [sentences|sentence|steps|step] TIMES"),
    ("repeat the last", "repeat last sentence|step TIMES"),
    ("repeat", "repeat [all|everything] TIMES"),
]
_HOLDS = [
    ("hold for", f"{_STILL} [constant] [for] TIME"),
    ("hold until", f"{_STILL} [constant] until TIME"),
]

#: Forms of sentences about a load.
FORMS = _forms(
    [
        ("to, in", f"{_GO}|{_BACK} [linearly] [up|down] to LEVEL {_WITHIN} TIME"),
        ("to, at", f"{_GO}|{_BACK} [linearly] [up|down] to LEVEL at RATE"),
        ("by, in", f"{_GO} by LEVEL {_WITHIN} TIME"),
        ("back, in", f"{_BACK} by LEVEL {_WITHIN} TIME"),
        ("off, in", f"{_BACK} {_WITHIN} TIME"),
        ("off, at", f"{_BACK} at RATE"),
        ("off", f"{_BACK} [at] [once]"),
        ("to", "step|jump [up|down] to LEVEL [at] [once]"),
        ("by", "step|jump by LEVEL [at] [once]"),
        *_HOLDS,
        ("swing", "oscillate|swing by LEVEL [with] period [of] TIME for COUNT cycles|cycle"),
        *_REPEATS,
    ]
)

#: Kind of the sentence that gives the first temperature.
START = "start"

#: Forms of sentences about a temperature.
TEMPERATURE_FORMS = _forms(
    [
        (START, "start|begin [at] TEMPERATURE"),
        ("to, up, in", f"{_HEAT} [linearly] [up] to TEMPERATURE {_WITHIN} TIME"),
        ("to, up, at", f"{_HEAT} [linearly] [up] to TEMPERATURE at HEATING"),
        ("to, down, in", f"{_COOL} [linearly] [down] to TEMPERATURE {_WITHIN} TIME"),
        ("to, down, at", f"{_COOL} [linearly] [down] to TEMPERATURE at HEATING"),
        ("to, in", f"go [linearly] [up|down] to TEMPERATURE {_WITHIN} TIME"),
        ("to, at", "go [linearly] [up|down] to TEMPERATURE at HEATING"),
        ("by, in", f"{_HEAT} by DIFFERENCE {_WITHIN} TIME"),
        ("back, in", f"{_COOL} by DIFFERENCE {_WITHIN} TIME"),
        ("to", "step|jump [up|down] to TEMPERATURE [at] [once]"),
        *_HOLDS,
        *_REPEATS,
    ]
)

#: Examples for error messages, of loads and of temperatures.
EXAMPLES = (
    "ramp to 10 kN in 1 s (or: at 2 kN/s)",
    "step to 5 kN (or: by 1 kN)",
    "hold for 240 s",
    "hold until 300 s",
    "unload in 0.1 s",
    "oscillate by 1 kN with a period of 2 s for 10 cycles",
    "repeat 9 times (that is, 9 times more)",
    "repeat the last 2 sentences 9 times",
)
TEMPERATURE_EXAMPLES = (
    "start at 23 degC",
    "heat to 60 degC in 2 h (or: at 2 K/min)",
    "cool by 20 K in 1 h",
    "hold for 8 h",
    "hold until 24 h",
    "step to 60 degC",
    "repeat 9 times (that is, 9 times more)",
    "repeat the last 4 sentences 9 times",
)
