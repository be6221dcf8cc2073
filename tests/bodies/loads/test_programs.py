"""Load programs: what sentences mean, and what is refused."""

import pytest

import viscontact as vc


def test_sentences_are_segments():
    program = vc.LoadProgram(
        "move at 1 um/s until force reaches 10 nN; hold the height for 5 s; "
        "load at 2 N/min for 1 s;"
        "hold force for 10 s; retract at 2 um/s until contact is lost;"
        "stop when contact area exceeds 2 mm^2"
    )
    assert list(program.segments) == [
        vc.Segment(1e-6, "approach", until=vc.Condition("force", 1e-8)),
        vc.Segment(0.0, "approach", 5.0),
        vc.Segment(2 / 60, "force", 1.0),
        vc.Segment(0.0, "force", 10.0),
        vc.Segment(-2e-6, "approach", until=vc.Condition("contact")),
    ]
    assert list(program.stop) == [vc.Condition("contact_area", 2e-6)]


@pytest.mark.parametrize(
    "text",
    [
        "until the force is 10 nN",
        "until force reaches 10 nN",
        "until the force falls to 10 nN",
        "until force falls below 0.01 uN",
        "until the force rises above 10 nN",
        "until the force is below 10 nN",
    ],
)
def test_a_condition_has_several_words(text):
    (segment,) = vc.LoadProgram(f"move at 1 um/s {text}").segments
    assert segment.until == vc.Condition("force", 1e-8)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("wobble", "possible are"),
        ("move at 1 um/s until force reaches 10 nm", "as a force"),
        ("move at 1 Pa/s for 2 s", "no rate of a length or a force"),
        ("move at 1 um/s until luck reaches 1 N", "no scalar is called 'luck'"),
        ("hold height until tomorrow", "as a condition"),
        ("stop when contact is lost", "no segment"),
    ],
)
def test_what_cannot_be_read_is_refused(text, why):
    with pytest.raises(ValueError, match=why):
        vc.LoadProgram(text)


def test_a_segment_has_one_end():
    with pytest.raises(ValueError, match="either duration"):
        vc.Segment(1e-6)
    with pytest.raises(ValueError, match="either duration"):
        vc.Segment(1e-6, duration=1.0, until="contact is lost")


def test_a_mixed_history_gives_force_or_approach():
    load = vc.MixedHistory([0, 1, 3], ["approach", "force"], [0, 4.0], [1e-6, 2.0])
    assert [load.at(t).approach for t in (0.0, 0.5, 1.0, 2.0)] == [0.0, 5e-7, 1e-6, None]
    assert [load.at(t).force for t in (1.0, 2.0, 9.0)] == [None, 3.0, 2.0]
    assert load.level_at([0.5, 1.0, 2.0]).tolist() == [0.5, 1.0, 0.75]


def test_a_mixed_history_does_not_jump():
    with pytest.raises(ValueError, match="jumps"):
        vc.MixedHistory([0, 1, 2], ["approach", "approach"], [0, 2e-6], [1e-6, 3e-6])
    with pytest.raises(ValueError, match="jumps"):
        vc.MixedHistory([0, 1], ["force"], [1.0], [1.0])
