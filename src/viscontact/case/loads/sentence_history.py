"""Points of a load history, or of a temperature, from its sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from viscontact.bodies.loads.harmonic_history import STEPS_PER_CYCLE
from viscontact.case.loads.course import (
    MOST_POINTS,
    SentenceError,
    Way,
    exact,
    moves,
    refuse,
)
from viscontact.case.loads.grammar import START, Rate, Reading
from viscontact.case.loads.levels import IN_WORDS, Level, Prescribed
from viscontact.case.loads.sentences import EXAMPLE, TEMPERATURE_EXAMPLE, Sentence
from viscontact.units.formatting import format_quantity
from viscontact.units.temperatures import in_celsius


class LoadPoints(NamedTuple):
    """Load history by points: prescribed quantity, times [s] and levels [N, m or N/m]."""

    control: Prescribed
    times: list[float]
    levels: list[float]


def course_of(sentences: Sequence[Sentence], *, may_pull: bool = True) -> LoadPoints:
    """Return the history that sentences describe, from time 0 and level 0.

    SentenceError for a force that pulls, if it may not.
    """
    way = _LoadWay(_control(sentences), may_pull=may_pull)
    for sentence, move in moves(sentences):
        way.follow(sentence, move)
    return LoadPoints(way.control, *way.points)


def temperatures_of(
    sentences: Sequence[Sentence], start: float | None
) -> tuple[list[float], list[float]]:
    """Times [s] and temperatures [K] that sentences describe, from a first temperature [K]."""
    first, *others = sentences
    begins = first.reading.form.kind == START
    if begins and start is not None:
        raise SentenceError(first, "the key start gives the first temperature, too; give it once")
    if not begins and start is None:
        raise ValueError(
            "the first temperature is missing; begin with a sentence, e.g. "
            f"{TEMPERATURE_EXAMPLE}, or give the key start, e.g. 'start: 23 degC'"
        )
    way = _TemperatureWay(exact(first.reading.slots[0].value if start is None else start))
    for sentence, move in moves(others if begins else sentences):
        way.follow(sentence, move)
    return way.points


def _control(sentences: Sequence[Sentence]) -> Prescribed:
    """Return what the sentences prescribe, throughout."""
    found: Prescribed | None = None
    for sentence in sentences:
        for given in sentence.reading.slots:
            slot = given.change if isinstance(given, Rate) else given
            if not isinstance(slot, Level):
                continue
            if found is not None and slot.control != found:
                raise SentenceError(
                    sentence,
                    f"gives {IN_WORDS[slot.control]} where sentences before give "
                    f"{IN_WORDS[found]}; "
                    "either the force or the approach is prescribed, throughout",
                )
            found = slot.control
    if found is None:
        raise ValueError(f"no sentence says how much; write e.g. {EXAMPLE}")
    return found


class _LoadWay(Way):
    """Points of a force, of an approach or of a line load."""

    def __init__(self, control: Prescribed, *, may_pull: bool) -> None:
        super().__init__()
        self.control: Prescribed = control
        self._may_pull = may_pull

    def follow(self, sentence: Sentence, move: Reading) -> None:
        """Add the points of a sentence."""
        if move.form.kind == "swing":
            self._add_cycles(sentence, *move.slots)
        else:
            super().follow(sentence, move)

    def refuse_goal(self, sentence: Sentence, move: Reading, goal: Fraction) -> None:
        """Raise SentenceError for a force that pulls."""
        self._refuse_pull(sentence, goal)

    def _add_cycles(self, sentence: Sentence, amplitude: Level, period: float, cycles: int) -> None:
        middle, swing = self.levels[-1], exact(amplitude.value)
        if cycles * STEPS_PER_CYCLE > MOST_POINTS:
            refuse(sentence, f"that makes more than {MOST_POINTS} points; kind: harmonic has none")
        self._refuse_pull(sentence, middle - abs(swing))
        part = exact(period) / STEPS_PER_CYCLE
        for _ in range(cycles):
            for sine in _SINES:
                self.add_ramp(sentence, middle + swing * sine, part)

    def _refuse_pull(self, sentence: Sentence, level: Fraction) -> None:
        if self.control != "approach" and level < 0 and not self._may_pull:
            lowest = format_quantity(float(level), "N" if self.control == "force" else "N/m")
            refuse(
                sentence,
                f"the force would fall to {lowest}: a negative force pulls, which needs adhesion; "
                "give e.g. 'adhesion: {work: 50 mJ/m2, range: 2 nm}'",
            )


class _TemperatureWay(Way):
    """Points of a temperature."""

    def follow(self, sentence: Sentence, move: Reading) -> None:
        """Add the points of a sentence."""
        if move.form.kind == START:
            refuse(sentence, "only the first sentence starts; write e.g. 'step to 60 degC'")
        super().follow(sentence, move)

    def refuse_goal(self, sentence: Sentence, move: Reading, goal: Fraction) -> None:
        """Raise SentenceError for a way that its verb contradicts, or one to 0 K."""
        now, kind = self.levels[-1], move.form.kind
        there = f"it is {in_celsius(float(now)):.6g} °C by then; write"
        if "up" in kind and goal < now:
            refuse(sentence, f"{there} 'cool' in place of 'heat'")
        if "down" in kind and goal > now:
            refuse(sentence, f"{there} 'heat' in place of 'cool'")
        if goal <= 0:
            refuse(sentence, "the temperature would fall to absolute zero")


def _sine(k: int) -> Fraction:
    """Sine of a fraction of a turn, with exact zeros and ones."""
    quarters, rest = divmod(4 * k, STEPS_PER_CYCLE)
    if rest == 0:
        return Fraction((0, 1, 0, -1)[quarters % 4])
    return Fraction(math.sin(2 * math.pi * k / STEPS_PER_CYCLE))


_SINES = [_sine(k) for k in range(1, STEPS_PER_CYCLE + 1)]
