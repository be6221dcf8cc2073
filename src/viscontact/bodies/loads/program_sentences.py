"""Sentences of a load program, read as plain numbers."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from viscontact.bodies.loads.history import Control
from viscontact.units.formatting import quoted
from viscontact.units.parsing import parse_any_quantity, parse_quantity, parse_unit

#: A condition: name of the scalar and its value in SI units.
ReadCondition = tuple[str, float]

#: Forms of sentences, as they are listed in messages.
FORMS = (
    "move at 1 um/s until force reaches 10 nN",
    "retract at 2 um/s until contact is lost",
    "load at 1 N/s for 2 s",
    "hold height for 5 s",
    "hold force for 10 s",
    "stop when contact_area exceeds 2 mm2",
)

_CONDITION = re.compile(
    r"(?:the\s+)?(?P<scalar>[a-z_ ]+?)\s+"
    r"(?:is(?:\s+above|\s+below)?|reaches|exceeds|falls\s+(?:to|below)|rises\s+(?:to|above))\s+(?P<value>.+)",
    re.IGNORECASE,
)
_LOST = re.compile(r"(?:the\s+)?contact\s+is\s+lost", re.IGNORECASE)
_SLIDES = re.compile(r"(?:the\s+)?(?:whole\s+contact\s+slips|body\s+slides)", re.IGNORECASE)
_STOP = re.compile(r"stop\s+(?:when|if|once)\s+(?P<what>.+)", re.IGNORECASE)
_HOLD = re.compile(
    r"hold\s+(?:the\s+)?(?P<what>height|approach|force)\s+(?P<end>.+)", re.IGNORECASE
)
_CHANGE = re.compile(
    r"(?P<verb>move|press|retract|withdraw|load|unload)\s+at\s+(?P<rate>.+?)\s+"
    r"(?P<end>(?:for|until)\s.+)",
    re.IGNORECASE,
)
_ENDS = re.compile(r"[;\n]|,?\s*\b(?:and\s+)?then\b", re.IGNORECASE)

#: Condition that the whole contact slips, or that friction carries the load no longer.
SLIDING = "full slip"

#: Scalars that a condition may be on, and their dimensions; None for plain numbers.
SCALARS: dict[str, str | None] = {
    "force": "force",
    "approach": "length",
    "contact_area": "area",
    "contact_length": "length",
    "contact_width": "length",
    "peak_pressure": "pressure",
    "mean_pressure": "pressure",
    "tilt_x": "angle",
    "tilt_y": "angle",
    **dict.fromkeys(("tangential_force_x", "tangential_force_y"), "force"),
    **dict.fromkeys(("tangential_displacement_x", "tangential_displacement_y"), "length"),
    "torque": "torque",
    "rotation": "angle",
    "stick_area": "area",
    "slip_fraction": None,
    "friction_heat": "energy",
}

#: Those of a contact under friction.
OF_FRICTION = frozenset(list(SCALARS)[9:])


class ProgramSentence(NamedTuple):
    """Meaning of a sentence; `stops` is a condition that ends the run."""

    rate: float = 0.0  # [m/s] or [N/s]
    control: Control = "approach"
    duration: float | None = None  # [s]
    until: ReadCondition | None = None
    stops: ReadCondition | None = None


def parsed_sentences(text: str) -> list[ProgramSentence]:
    """Read the sentences of a text, which end with semicolons, lines or "then"; else ValueError."""
    if not isinstance(text, str):
        raise ValueError(f"load program: wanted a sentence or a Segment, got {text!r}")
    parts = [part.strip(" ,.\t\r") for part in _ENDS.split(text)]
    return [_sentence(part) for part in parts if part]


def parsed_condition(text: str) -> ReadCondition:
    """Read a condition: name of the scalar, and value [SI unit]; ValueError for any other text."""
    words = text.strip() if isinstance(text, str) else ""
    if _LOST.fullmatch(words):
        return "contact", 0.0
    if _SLIDES.fullmatch(words):
        return SLIDING, 0.0
    match = _CONDITION.fullmatch(words)
    if match is None:
        raise ValueError(
            f"cannot read {quoted(str(text))} as a condition; write e.g. 'force reaches 10 nN', "
            "'contact_area exceeds 2 mm2' or 'contact is lost'"
        )
    scalar = re.sub(r"\s+", "_", match["scalar"].lower())
    if scalar not in SCALARS:
        raise ValueError(
            f"no scalar is called {scalar!r}; known are {', '.join(SCALARS)}, 'contact is lost' "
            "and 'the whole contact slips'"
        )
    dimension = SCALARS[scalar]
    if dimension is None:
        return scalar, _plain(scalar, match["value"])
    return scalar, parse_quantity(match["value"], dimension)


def _plain(scalar: str, text: str) -> float:
    """A plain number between 0 and 1."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 <= value <= 1:
        raise ValueError(f"{scalar} is a number from 0 to 1, as in 0.5, got {quoted(text)}")
    return value


def _sentence(text: str) -> ProgramSentence:
    try:
        if match := _STOP.fullmatch(text):
            return ProgramSentence(stops=parsed_condition(match["what"]))
        if match := _HOLD.fullmatch(text):
            control: Control = "force" if match["what"].lower() == "force" else "approach"
            return ProgramSentence(0.0, control, *_end(match["end"]))
        if match := _CHANGE.fullmatch(text):
            rate, control = _rate(match["rate"])
            back = match["verb"].lower() in ("retract", "withdraw", "unload")
            return ProgramSentence(-rate if back else rate, control, *_end(match["end"]))
    except ValueError as error:
        raise ValueError(f"load program: sentence {quoted(text)}: {error}") from None
    forms = ", ".join(repr(form) for form in FORMS)
    raise ValueError(f"load program: cannot read sentence {quoted(text)}; possible are {forms}")


def _end(text: str) -> tuple[float | None, ReadCondition | None]:
    """Duration [s] or condition that ends a segment."""
    word, _, rest = text.partition(" ")
    if word.lower() == "for":
        return parse_quantity(rest, "time"), None
    if word.lower() == "until":
        return None, parsed_condition(rest)
    raise ValueError("it ends with 'for 5 s' or 'until force reaches 10 nN'")


def _rate(text: str) -> tuple[float, Control]:
    """Rate and what it is of: N/s of a force, m/s of an approach."""
    change, slash, per = text.rpartition("/")
    if not slash:
        raise ValueError(f"{quoted(text)} is no rate; write e.g. '1 um/s' or '2 N/s'")
    value, unit = parse_any_quantity(change)
    if unit not in ("N", "m"):
        raise ValueError(f"{quoted(text)} is no rate of a length or a force")
    return value / parse_unit(per, "time"), "force" if unit == "N" else "approach"
