"""Points of a load history from its sentences."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple, NoReturn

from viscontact.bodies.loads.harmonic import STEPS_PER_CYCLE
from viscontact.bodies.loads.history import Control
from viscontact.case.loads.grammar import Rate, Reading
from viscontact.case.loads.levels import Level
from viscontact.case.loads.sentences import EXAMPLE, Sentence
from viscontact.units.formatting import format_quantity

#: Largest number of points; each is a step of the run.
MOST_POINTS = 100_000


class SentenceError(ValueError):
    """Sentence that cannot be carried out."""

    def __init__(self, sentence: Sentence, why: str) -> None:
        super().__init__(f"{sentence}: {why}")
        self.entry = sentence.entry


class LoadPoints(NamedTuple):
    """Load history by points: prescribed quantity, times [s] and levels [N or m]."""

    control: Control
    times: list[float]
    levels: list[float]


def course_of(sentences: Sequence[Sentence]) -> LoadPoints:
    """Return the history that sentences describe, from time 0 and level 0."""
    way = _Way(_control(sentences))
    for sentence, move in _moves(sentences):
        way.follow(sentence, move)
    return LoadPoints(way.control, [float(t) for t in way.times], [float(v) for v in way.levels])


def _control(sentences: Sequence[Sentence]) -> Control:
    """True if the sentences prescribe forces or lengths; both are refused."""
    found: Control | None = None
    for sentence in sentences:
        for given in sentence.reading.slots:
            slot = given.change if isinstance(given, Rate) else given
            if not isinstance(slot, Level):
                continue
            if found is not None and slot.control != found:
                words = {"force": "a force", "approach": "a length"}
                raise SentenceError(
                    sentence,
                    f"gives {words[slot.control]} where sentences before give {words[found]}; "
                    "either the force or the approach is prescribed, throughout",
                )
            found = slot.control
    if found is None:
        raise ValueError(f"no sentence says how much; write e.g. {EXAMPLE}")
    return found


def _moves(sentences: Sequence[Sentence]) -> Iterator[tuple[Sentence, Reading]]:
    """Sentences in order, with repetitions expanded."""
    done: list[list[Reading]] = []
    total = 0
    for sentence in sentences:
        kind, slots = sentence.reading.form.kind, sentence.reading.slots
        moves = [sentence.reading]
        if kind.startswith("repeat"):
            moves = _repeated_readings(sentence, done, slots)
            total += len(moves)
        if total > MOST_POINTS:
            raise SentenceError(sentence, f"repeats more than {MOST_POINTS} times in all")
        done.append(moves)
        yield from ((sentence, move) for move in moves)


def _repeated_readings(
    sentence: Sentence, done: Sequence[list[Reading]], slots: tuple[Any, ...]
) -> list[Reading]:
    kind = sentence.reading.form.kind
    *last, times = (int(slot) for slot in slots)
    count: int = last[0] if last else len(done) if kind == "repeat" else 1
    if not 1 <= count <= len(done):
        raise SentenceError(
            sentence, f"there are only {len(done)} sentences before it that could be repeated"
        )
    again = [move for moves in done[len(done) - count :] for move in moves]
    if len(again) * times > MOST_POINTS:
        raise SentenceError(sentence, f"that makes more than {MOST_POINTS} moves")
    return again * times


class _Way:
    """Points of a history as exact decimal numbers, so that ten times 0.1 s are 1 s."""

    def __init__(self, control: Control) -> None:
        self.control: Control = control
        self.times = [Fraction(0)]
        self.levels = [Fraction(0)]
        self._just_jumped = False

    def follow(self, sentence: Sentence, move: Reading) -> None:
        """Add the points of a sentence."""
        kind, slots = move.form.kind, move.slots
        if kind == "hold for":
            self._add_ramp(sentence, self.levels[-1], _exact(slots[0]))
        elif kind == "hold until":
            self._wait_until(sentence, _exact(slots[0]))
        elif kind == "swing":
            self._add_cycles(sentence, *slots)
        else:
            goal = self._goal(kind, slots)
            self._refuse_pull(sentence, goal)
            self._change(sentence, kind, slots, goal)

    def _goal(self, kind: str, slots: tuple[Any, ...]) -> Fraction:
        if kind.startswith("off"):
            return Fraction(0)
        given = _exact(slots[0].value)
        if kind.startswith("to"):
            return given
        return self.levels[-1] + (-given if kind.startswith("back") else given)

    def _change(
        self, sentence: Sentence, kind: str, slots: tuple[Any, ...], goal: Fraction
    ) -> None:
        if kind.endswith("in"):
            self._add_ramp(sentence, goal, _exact(slots[-1]))
        elif kind.endswith("at"):
            distance = abs(goal - self.levels[-1])
            if not distance:
                _refuse(sentence, "it is there already; write e.g. 'hold for 10 s'")
            change, per = slots[-1]
            self._add_ramp(sentence, goal, distance / _exact(change.value) * _exact(per))
        else:
            self._jump(sentence, goal)

    def _add_ramp(self, sentence: Sentence, level: Fraction, duration: Fraction) -> None:
        if len(self.times) >= MOST_POINTS:
            _refuse(sentence, f"by then the history has more than {MOST_POINTS} points")
        self.times.append(self.times[-1] + duration)
        self.levels.append(level)
        self._just_jumped = False

    def _jump(self, sentence: Sentence, level: Fraction) -> None:
        if self._just_jumped:
            _refuse(sentence, "there is a jump at this instant already; hold for a while first")
        if self.times == [0]:
            self.levels[0] = level
        elif level != self.levels[-1]:
            self.times.append(self.times[-1])
            self.levels.append(level)
        self._just_jumped = True

    def _wait_until(self, sentence: Sentence, instant: Fraction) -> None:
        if instant <= self.times[-1]:
            now = format_quantity(float(self.times[-1]), "s", 6)
            _refuse(sentence, f"by then it is {now} already; write e.g. 'hold for 10 s'")
        self._add_ramp(sentence, self.levels[-1], instant - self.times[-1])

    def _add_cycles(self, sentence: Sentence, amplitude: Level, period: float, cycles: int) -> None:
        middle, swing = self.levels[-1], _exact(amplitude.value)
        self._refuse_pull(sentence, middle - abs(swing))
        if cycles * STEPS_PER_CYCLE > MOST_POINTS:
            _refuse(sentence, f"that makes more than {MOST_POINTS} points; kind: harmonic has none")
        part = _exact(period) / STEPS_PER_CYCLE
        for _ in range(cycles):
            for sine in _SINES:
                self._add_ramp(sentence, middle + swing * sine, part)

    def _refuse_pull(self, sentence: Sentence, level: Fraction) -> None:
        if self.control == "force" and level < 0:
            lowest = format_quantity(float(level), "N")
            _refuse(
                sentence,
                f"the force would fall to {lowest}: a negative force pulls, and adhesion is not "
                "modelled",
            )


def _exact(number: float) -> Fraction:
    """Decimal number as written, so that 2 um minus 3 um is -1 um."""
    return Fraction(repr(number))


def _refuse(sentence: Sentence, why: str) -> NoReturn:
    raise SentenceError(sentence, why)


def _sine(k: int) -> Fraction:
    """Sine of a fraction of a turn, with exact zeros and ones."""
    quarters, rest = divmod(4 * k, STEPS_PER_CYCLE)
    if rest == 0:
        return Fraction((0, 1, 0, -1)[quarters % 4])
    return Fraction(math.sin(2 * math.pi * k / STEPS_PER_CYCLE))


_SINES = [_sine(k) for k in range(1, STEPS_PER_CYCLE + 1)]
