"""Sentences about a load: what they mean, point by point, and how others are refused."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

import viscontact as vc
from closeness import close_to
from random_examples import given_few_or_many
from viscontact.case.loads.course import MOST_POINTS, SentenceError
from viscontact.case.loads.grammar import EXAMPLES
from viscontact.case.loads.sentence_history import LoadPoints, course_of
from viscontact.case.loads.sentences import Sentence, Sentences, split_sentences

READER = TypeAdapter(Sentences)


def read_sentences(texts: Sequence[str]) -> list[Sentence]:
    return [each for entry in READER.validate_python(list(texts)) for each in entry]


def said_of(error: ValidationError) -> str:
    """Message of the only entry that is refused."""
    [refused] = error.errors()
    return refused["msg"]


def course(*texts: str) -> LoadPoints:
    return course_of(read_sentences(texts), may_pull=False)


def points(*texts: str) -> list[tuple[float, float]]:
    _, times, levels = course(*texts)
    return list(zip(times, levels, strict=True))


def test_bodies_may_approach() -> None:
    assert course("approach to 1 um in 0.5 s") == course("ramp to 1 um in 0.5 s")
    assert course("approach to 1 um in 0.5 s").control == "approach"


# --- possible sentences ------------------------------------------------------------------------


def test_the_promised_sentences_are_the_history_by_hand() -> None:
    history = course("ramp to 10 kN in 1 s; hold for 240 s; unload in 0.1 s")
    by_hand = vc.ForceHistory([0, 1, 241, 241.1], [0, 10e3, 10e3, 0])
    assert vc.ForceHistory(history.times, history.levels) == by_hand
    assert history.control == "force"


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("step to 5 kN", [(0, 5e3)]),
        ("jump to 5 kN at once", [(0, 5e3)]),
        ("wait for 1 s; step to 5 kN", [(0, 0), (1, 0), (1, 5e3)]),
        ("ramp to 10 N at 2 N/s", [(0, 0), (5, 10)]),
        ("ramp to 6 N at 2 N / min", [(0, 0), (180, 6)]),
        ("ramp to 6 N at 2 N per min", [(0, 0), (180, 6)]),
        ("ramp to 3 N in 1 s; ramp by -1 N in 1 s", [(0, 0), (1, 3), (2, 2)]),
        ("ramp up to 3 N in 1 minute; step down to 2 N", [(0, 0), (60, 3), (60, 2)]),
        ("step to 3 N; hold until 300 s; unload", [(0, 3), (300, 3), (300, 0)]),
        ("step to 3 N; unload to 1 N in 2 s", [(0, 3), (2, 1)]),
        ("step to 3 N; unload by 1 N in 2 s", [(0, 3), (2, 2)]),
        ("step to 3 N; unload at 1 N/s", [(0, 3), (3, 0)]),
        (
            "ramp to 1 N in 1 s; unload in 1 s; repeat once",
            [(0, 0), (1, 1), (2, 0), (3, 1), (4, 0)],
        ),
        (
            "step by 1 N; hold for 1 s; repeat twice",
            [(0, 1), (1, 1), (1, 2), (2, 2), (2, 3), (3, 3)],
        ),
        (
            "ramp to 2 N in 1 s; unload to 1 N in 1 s; ramp to 2 N in 1 s; repeat last 2 2 times",
            [(0, 0), (1, 2), (2, 1), (3, 2), (4, 1), (5, 2), (6, 1), (7, 2)],
        ),
        (
            "ramp by 1 N in 1 s; repeat the last sentence 2 more times",
            [(0, 0), (1, 1), (2, 2), (3, 3)],
        ),
    ],
)
def test_force_by_sentences(said: str, expected: list[tuple[float, float]]) -> None:
    assert points(said) == expected
    assert course(said).control == "force"


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("ramp to 0.1 mm in 2 s; withdraw to -0.1 mm in 1 s", [(0, 0), (2, 1e-4), (3, -1e-4)]),
        ("press to 2 um in 1 s; retract in 1 s", [(0, 0), (1, 2e-6), (2, 0)]),
        ("press to 2 um in 1 s; retract by 3 um in 1 s", [(0, 0), (1, 2e-6), (2, -1e-6)]),
        ("move to 10 um at 5 um/s", [(0, 0), (2, 1e-5)]),
        ("ramp to 1 in in 1 s; withdraw to -1 in over 2 s", [(0, 0), (1, 0.0254), (3, -0.0254)]),
        ("step to 1 in", [(0, 0.0254)]),
    ],
)
def test_lengths_make_it_an_approach(said: str, expected: list[tuple[float, float]]) -> None:
    assert course(said).control == "approach"
    np.testing.assert_allclose(points(said), expected, rtol=1e-15)


def test_swing_is_a_sine_of_128_lines_a_cycle_about_where_it_was() -> None:
    control, times, levels = course(
        "step to 3 N; hold for 1 s; oscillate by 2 N with a period of 4 s for 2 cycles"
    )
    assert (control, len(times)) == ("force", 2 + 256)
    t = np.array(times[2:])
    np.testing.assert_allclose(levels[2:], 3 + 2 * np.sin(2 * np.pi * (t - 1) / 4), atol=1e-14)
    # at quarters and ends exactly, so that it neither drifts nor overshoots
    assert (levels[1 + 32], levels[1 + 96], levels[1 + 128], levels[-1]) == (5.0, 1.0, 3.0, 3.0)
    assert times[-1] == 9.0
    # which is the harmonic load, to what a line misses of a sine: A (pi/128)^2/2 = 3e-4 A
    history, swing = vc.ForceHistory(times, levels), vc.harmonic(3.0, 2.0, 4.0, 2)
    fine = np.linspace(0, 8, 5000)
    missed = np.abs(history.level_at(fine + 1) - swing.level_at(fine)).max()
    assert 0.9 * math.pi**2 / 128**2 < missed < math.pi**2 / 128**2


@pytest.mark.parametrize(
    "said",
    [
        "RAMP to 10 kN WITHIN 1 s. Hold for 2 s. Unload in 3 s.",
        "ramp to 10 kN, in 1 s, then hold 2 s, and then unload over 3 s",
        "load to 10kN during 1s;hold for 2 s;;unload within 3 s;",
        "Ramp to 10 kN in 1 s\nwait for the 2 s\nunload in 3000 ms\n",
        "ramp to a 10 kN in 1 s and hold constant for 2 s and unload in 3 s",
    ],
)
def test_case_commas_dots_and_little_words_do_not_matter(said: str) -> None:
    assert points(said) == [(0, 0), (1, 1e4), (3, 1e4), (6, 0)]
    parts = split_sentences(said)
    assert len(parts) == 3
    assert points(*parts) == points(said)


def test_times_and_levels_do_not_gather_rounding() -> None:
    _, times, levels = course("step by 0.1 N; hold for 0.1 s; repeat 9 times")
    assert (times[-1], levels[-1]) == (1.0, 1.0)  # ten times 0.1 is 0.9999999999999999 by adding


def test_all_that_can_be_said_is_understood() -> None:
    said = [form.split(" (")[0] for form in EXAMPLES]
    assert len(read_sentences(said)) == len(EXAMPLES)
    # all but the repetitions are one history, too: 300 s, an unloading, ten cycles of 2 s
    history = course("ramp to 3 kN in 1 s", *said[2:5], "step to 2 kN", said[5])
    assert history.times[-1] == close_to(300 + 0.1 + 20)


# --- what cannot ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("said", "why"),
    [
        (
            "dance",
            "sentence 1, 'dance': nothing of it was understood. Possible sentences: 'ramp to",
        ),
        ("unlode in 3 s", "did you mean 'unload'?"),
        ("ramp to 10 kN", "understood 'ramp to 10 kN', then expected 'in' or 'at', but nothing"),
        ("ramp to 1 N in 1 s; hold it", "sentence 2, 'hold it': understood 'hold'"),
        ("ramp to 10 in 1 s", "10 has no unit; a force or a length is expected"),
        ("ramp to 10 MPa in 1 s", "cannot read '10 MPa' as a force or a length (got a pressure)"),
        ("ramp to 10 N in 0 s", "must be more than zero, got '0 s'"),
        ("ramp to 10 N in -1 s", "must be more than zero"),
        ("ramp to 10 N in 1 N", "as a time (got a force)"),
        ("ramp to 10 N in 1", "1 has no unit; a time is expected"),
        ("ramp to 10 N at 2 N", "'2 N' is not per time; write e.g. '2 kN/s'"),
        ("ramp to 10 N at -2 N/s", "a rate must be more than zero"),
        ("ramp to 10 N at 2 N/m", "as a time (got a length)"),
        ("ramp to 10 N in 1 s quickly", "then expected the end, got 'quickly'"),
        ("step to 1 N; repeat", "understood 'repeat', then expected 'last' or how many"),
        ("step to 1 N; repeat 0 times", "how many times, got '0 times'"),
        ("step to 1 N; repeat the last 3 times", "expected how many times"),
        ("step to nan N", "understood 'step to', then expected a force or a length, got 'nan N'"),
        ("step to 1e300 N", "beyond what can be computed with"),
        ("", "it is empty"),
    ],
)
def test_sentence_that_is_not_understood_says_how_far_it_was(said: str, why: str) -> None:
    with pytest.raises(ValidationError) as refusal:
        read_sentences([said])
    assert why in said_of(refusal.value)
    assert "Possible sentences: " in said_of(refusal.value)
    assert "\n" not in said_of(refusal.value)


def test_all_sentences_that_are_not_understood_are_named_at_once() -> None:
    with pytest.raises(ValidationError) as refusal:
        read_sentences(["jump; ramp to 1 N in 1 s; fly"])
    assert "sentence 1, 'jump'" in said_of(refusal.value)
    assert "sentence 3, 'fly'" in said_of(refusal.value)


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ("step to 1 N; withdraw to 1 mm in 1 s", "sentence 2, .* gives a length where .* a force"),
        ("step to 1 mm; ramp to 1 mm at 1 N/s", "sentence 2, .* gives a force where .* a length"),
        ("step to 1 N; ramp by -2 N in 1 s", "sentence 2, .* the force would fall to -1 N"),
        ("ramp to -1 N in 1 s", "would fall to -1 N: a negative force pulls"),
        ("step to 1 N; swing by 2 N with a period of 1 s for 1 cycle", "would fall to -1 N"),
        ("step to 1 N; step to 2 N", "sentence 2, .* a jump at this instant already"),
        ("step to 1 N; hold for 5 s; hold until 5 s", "sentence 3, .* by then it is 5 s already"),
        ("repeat twice; step to 1 N", "sentence 1, .* only 0 sentences before it"),
        ("step to 1 N; repeat the last 2 2 times", "only 1 sentences before it"),
        ("ramp to 1 N in 1 s; ramp to 1 N at 1 N/s", "it is there already"),
        ("hold for 5 s; unload in 1 s", "no sentence says how much"),
        ("step to 1 N; hold for 1 s; unload; repeat 2 times", "there is a jump at this instant"),
        ("ramp by 1 N in 1 s; repeat 900000 times", "more than 100000 moves"),
        ("ramp by 1 N in 1 s; repeat 999 times; repeat 999 times", "more than 100000 moves"),
        pytest.param(
            "ramp by 1 N in 1 s; repeat 60000 times; repeat the last sentence once",
            "repeats more than 100000 times",
            marks=pytest.mark.slow,
        ),
        ("step to 1 N; swing by 1 N with period 1 s for 9999 cycles", "more than 100000 points"),
        (
            "step to 9 N; swing by 1 N with period 1 s for 999 cycles; repeat the last 1 2 times",
            "more than 100000 points",
        ),
    ],
)
def test_sentence_that_cannot_be_done_is_named(said: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        course(said)


# --- anything at all --------------------------------------------------------------------------

_WORDS = st.sampled_from(
    [
        *[
            "ramp",
            "step",
            "jump",
            "hold",
            "unload",
            "withdraw",
            "repeat",
            "oscillate",
            "to",
            "by",
            "in",
            "at",
            "for",
            "until",
            "the",
            "last",
        ],
        *("with", "period", "of", "cycles", "times", "once", "10 kN", "1 s", "-3 um", "2 N/s", "3"),
        *(";", ",", ".", "1e999 N", "-", "/", "0 s", "\n", "½", "sentences"),
    ]
)


#: By chance alone none of a hundred texts is a history.
_SENTENCES = st.sampled_from(
    [
        *("step to 10 N", "ramp by 2 N in 1 s", "hold for 1 s", "unload in 1 s"),
        *("ramp to 3 N at 2 N/s", "oscillate by 1 N with a period of 2 s for 3 cycles"),
        *("repeat the last 2 sentences 3 times", "repeat 2 times"),
    ]
)


@given_few_or_many(
    50,
    400,
    st.one_of(
        st.text(max_size=60),
        st.lists(_WORDS, max_size=14).map(" ".join),
        st.lists(_SENTENCES, max_size=5).map(lambda more: "; ".join(["ramp to 9 N in 1 s", *more])),
    ),
)
@example("step to 1 / N")
@example("step to 1 N; hold for 1 s; repeat 3 times")
@example("repeat 999999999 times; repeat 9 times")
def test_any_text_is_a_history_or_refused_in_one_line(text: str) -> None:
    try:
        control, times, levels = course(text)
    except ValidationError as error:
        said = said_of(error)
    except (SentenceError, ValueError) as error:
        said = str(error)
    else:
        build = vc.ForceHistory if control == "force" else vc.ApproachHistory
        build(times, levels)
        assert len(times) <= MOST_POINTS
        return
    assert said
    assert "\n" not in said
    assert len(said) < 8000


_STEPS = st.lists(
    st.tuples(st.integers(0, 999), st.integers(1, 500), st.booleans()), min_size=1, max_size=8
)


@given(_STEPS)
def test_ramps_and_holds_are_the_points_that_they_name(steps: list[tuple[int, int, bool]]) -> None:
    said, expected = ["ramp to 1 N in 1 s"], [(0.0, 0.0), (1.0, 1.0)]
    for level, duration, held in steps:
        time, now = expected[-1]
        said.append(f"hold for {duration} s" if held else f"ramp to {level} N in {duration} s")
        expected.append((time + duration, now if held else float(level)))
    assert points("; ".join(said)) == points(*said) == expected
