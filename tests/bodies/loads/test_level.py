"""Arguments of loads, and sentences of programs."""

from __future__ import annotations

from viscontact.bodies.loads.history_points import instants
from viscontact.bodies.loads.level import prescribed_level
from viscontact.bodies.loads.program import Segment
from viscontact.bodies.loads.program_sentences import parsed_condition, parsed_sentences


def test_a_repeated_instant_is_a_jump():
    assert instants([0, 1, 1]).tolist() == [0.0, 1.0, 1.0]


def test_force_or_approach_is_prescribed():
    assert prescribed_level("ramp", None, 1e-6) == ("approach", 1e-6)


def test_segments_are_written_as_sentences():
    assert str(Segment(rate=-2e-6, until="contact is lost")) == (
        "retract at 2 µm/s until contact is lost"
    )
    assert str(Segment(duration=5.0)) == "hold height for 5 s"


def test_sentences_are_read_in_si_units():
    assert parsed_sentences("retract at 2 um/s until contact is lost")[0][:2] == (-2e-6, "approach")
    assert parsed_condition("force reaches 10 nN") == ("force", 1e-8)
    assert parsed_condition("contact is lost") == ("contact", 0.0)
