"""Extrapolation is exact for what it is made for."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.mechanics.time_integration.extrapolation import (
    ElasticReference,
    lagrange_weights,
    predict,
)


def elastic_reference(time, force, at):
    """An elastic reference whose field and motion are linear in `at`."""
    field = np.array([1.0, -2.0]) + at * np.array([0.5, 3.0])
    return ElasticReference(time, force, field, np.array([at, -2 * at, 1.0]))


def test_without_a_past_there_is_no_guess():
    assert predict([], 1.0, 1.0) is None


@pytest.mark.parametrize("known", [1, 2, 3, 5])
def test_a_line_in_the_reference_force_is_continued_exactly_from_two_instants(known):
    forces = np.array([1.0, 1.5, 2.2, 3.0, 4.1])
    past = [elastic_reference(time, force, force) for time, force in enumerate(forces)][:known]
    guess = predict(past, 9.0, forces[known - 1] + 0.8)
    expected = elastic_reference(9.0, 0.0, forces[known - 1] + 0.8)
    assert guess.time == 9.0
    if known >= 2:
        assert guess.fields == close_to(expected.fields, rel=1e-12)
        assert guess.motion == close_to(expected.motion, rel=1e-12)
    if known == 1:
        assert (guess.fields == past[0].fields).all()


@pytest.mark.parametrize("forces", [[2.0, 2.0, 2.0], [1.0, 3.0, 2.0], [1.0, 1.0 + 1e-12, 2.0]])
def test_where_the_reference_force_stalls_or_turns_time_takes_its_place(forces):
    past = [elastic_reference(time, force, time) for time, force in enumerate(forces)]
    guess = predict(past, 3.5, 2.0)
    assert np.isfinite(guess.fields).all()
    assert guess.fields == close_to(elastic_reference(0, 0, 3.5).fields, rel=1e-12)


def test_the_past_is_left_alone():
    past = [elastic_reference(time, time, time) for time in (0.0, 1.0, 2.0)]
    kept = [each.fields.copy() for each in past]
    predict(past, 3.0, 3.0)
    assert all((each.fields == old).all() for each, old in zip(past, kept, strict=True))


@given(st.lists(st.integers(-50, 50), min_size=1, max_size=4, unique=True), st.integers(-80, 80))
def test_lagrange_weights_reproduce_every_polynomial_up_to_their_degree(nodes, at):
    weights = lagrange_weights([float(node) for node in nodes], float(at))
    for degree in range(len(nodes)):
        powers = [float(node) ** degree for node in nodes]
        size = np.abs(np.multiply(weights, powers)).sum() + 1.0
        assert np.dot(weights, powers) == close_to(float(at) ** degree, abs=1e-12 * size)
