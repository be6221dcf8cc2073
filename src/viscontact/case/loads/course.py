"""Course of a quantity over time that sentences describe, by points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NoReturn

from viscontact.case.loads.grammar import Reading
from viscontact.case.loads.sentences import Sentence
from viscontact.units.formatting import format_quantity

#: Largest number of points; each is a step of the run.
MOST_POINTS = 100_000


class SentenceError(ValueError):
    """Sentence that cannot be carried out."""

    def __init__(self, sentence: Sentence, why: str) -> None:
        super().__init__(f"{sentence}: {why}")
        self.entry = sentence.entry


def moves(sentences: Sequence[Sentence]) -> Iterator[tuple[Sentence, Reading]]:
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


class Way:
    """Points of a history as exact decimal numbers, so that ten times 0.1 s are 1 s."""

    def __init__(self, start: Fraction = Fraction(0)) -> None:
        self.times = [Fraction(0)]
        self.levels = [start]
        self._just_jumped = False

    @property
    def points(self) -> tuple[list[float], list[float]]:
        """Times [s] and levels of the points."""
        return [float(each) for each in self.times], [float(each) for each in self.levels]

    def refuse_goal(self, sentence: Sentence, move: Reading, goal: Fraction) -> None:
        """Raise SentenceError for a level that cannot be reached by a sentence."""

    def follow(self, sentence: Sentence, move: Reading) -> None:
        """Add the points of a sentence."""
        kind, slots = move.form.kind, move.slots
        if kind == "hold for":
            self.add_ramp(sentence, self.levels[-1], exact(slots[0]))
        elif kind == "hold until":
            self._wait_until(sentence, exact(slots[0]))
        else:
            goal = self._goal(kind, slots)
            self.refuse_goal(sentence, move, goal)
            self._change(sentence, kind, slots, goal)

    def _goal(self, kind: str, slots: tuple[Any, ...]) -> Fraction:
        if kind.startswith("off"):
            return Fraction(0)
        given = exact(slots[0].value)
        if kind.startswith("to"):
            return given
        return self.levels[-1] + (-given if kind.startswith("back") else given)

    def _change(
        self, sentence: Sentence, kind: str, slots: tuple[Any, ...], goal: Fraction
    ) -> None:
        if kind.endswith("in"):
            self.add_ramp(sentence, goal, exact(slots[-1]))
        elif kind.endswith("at"):
            distance = abs(goal - self.levels[-1])
            if not distance:
                refuse(sentence, "it is there already; write e.g. 'hold for 10 s'")
            change, per = slots[-1]
            self.add_ramp(sentence, goal, distance / exact(change.value) * exact(per))
        else:
            self._jump(sentence, goal)

    def add_ramp(self, sentence: Sentence, level: Fraction, duration: Fraction) -> None:
        """Add a point after a duration."""
        if len(self.times) >= MOST_POINTS:
            refuse(sentence, f"by then the history has more than {MOST_POINTS} points")
        self.times.append(self.times[-1] + duration)
        self.levels.append(level)
        self._just_jumped = False

    def _jump(self, sentence: Sentence, level: Fraction) -> None:
        if self._just_jumped:
            refuse(sentence, "there is a jump at this instant already; hold for a while first")
        if self.times == [0]:
            self.levels[0] = level
        elif level != self.levels[-1]:
            self.times.append(self.times[-1])
            self.levels.append(level)
        self._just_jumped = True

    def _wait_until(self, sentence: Sentence, instant: Fraction) -> None:
        if instant <= self.times[-1]:
            now = format_quantity(float(self.times[-1]), "s", 6)
            refuse(sentence, f"by then it is {now} already; write e.g. 'hold for 10 s'")
        self.add_ramp(sentence, self.levels[-1], instant - self.times[-1])


def exact(number: float) -> Fraction:
    """Decimal number as written, so that 2 um minus 3 um is -1 um."""
    return Fraction(repr(number))


def refuse(sentence: Sentence, why: str) -> NoReturn:
    """Raise SentenceError for a sentence, with the reason."""
    raise SentenceError(sentence, why)
