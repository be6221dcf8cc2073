"""Tables and mean errors of verification cases."""

from __future__ import annotations

from viscontact.verify.case import Result, history, single, with_mean_error
from viscontact.verify.table import as_markdown, row_of_words


def test_error_on_similar_meshes_is_their_mean() -> None:
    assert round(with_mean_error([single(2.0, 2.02), single(2.0, 2.06)]).error, 9) == 0.02


def test_row_has_a_readable_unit_and_the_verdict() -> None:
    result = Result("cone", "Love 1939", "approach", "m", 2e-5, 2.001e-5, 5e-4, 1e-3, 1.98, 0.1)
    assert row_of_words(result)[3:] == ("20.0000 µm", "20.0100", "5.0e-04", "1e-03", "2.0", "ok")


def test_case_and_reference_are_in_its_first_row_only() -> None:
    radius = Result("cone", "Love 1939", "radius", "m", 2e-4, 2e-4, 0.0, 1e-3, 1.4, 0.1)
    approach = Result("cone", "Love 1939", "approach", "m", 2e-5, 2e-5, 0.0, 1e-3, 1.4, 0.1)
    found = [line[:27] for line in as_markdown([radius, approach]).splitlines()[2:]]
    assert found == ["| cone | Love 1939 | radius", "|  |  | approach | 20.0000 "]


def test_error_of_two_numbers_is_relative_to_the_exact_one() -> None:
    assert round(single(2.0, 2.02).error, 9) == 0.01


def test_error_of_two_histories_is_relative_to_the_largest_value() -> None:
    assert history([1.0, 4.0], [1.2, 4.0]).error == 0.05
