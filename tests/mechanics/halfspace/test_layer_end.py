"""Layers that end, wave by wave, against finite elements of another program and short waves."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from closeness import close_to
from mechanics.halfspace.section_elements import LayerSection
from viscontact.backend.arrays import Floats
from viscontact.mechanics.halfspace import layer_end
from viscontact.mechanics.halfspace.elastic_stack import ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.free_end import end_functions

HALF_LENGTH, ROW = 3.0, 0.125
BORDERS = ROW * np.arange(25) / HALF_LENGTH


def _stack(ratio: float) -> ElasticStack:
    return ElasticStack((ElasticLayer(1.0, 1.0, ratio),), None)


def _added(ratio: float, wave: float, *, odd: bool) -> Floats:
    """What the face adds to the mean displacement of rows, per pressure on rows and modulus."""
    table = layer_end.layer_table(_stack(ratio), HALF_LENGTH, odd=odd)
    weights = table.weights(np.array([wave * HALF_LENGTH]))[0]
    nodes = np.tensordot(weights, table.entries, axes=1) * (1 - ratio) / 2
    means = np.diff(table.panels.weights_until(BORDERS), axis=0) * HALF_LENGTH / ROW
    return np.asarray(means @ nodes @ means.T * ROW)


def _mirrored(ratio: float, wave: float, *, odd: bool) -> Floats:
    """The same of endless layers under the load and its images, by waves across."""
    across = np.pi / HALF_LENGTH * (np.arange(3000) + (0.5 if odd else 0.0))
    rate = np.hypot(across, wave)
    weights = np.where(across == 0, 1.0, 2.0) / HALF_LENGTH * ROW
    moved = (1 - ratio) * _stack(ratio).ratio(rate) / rate * np.sinc(across * ROW / 2 / np.pi) ** 2
    middles = ROW * (np.arange(24) + 0.5)
    cosines = np.cos(np.multiply.outer(across, middles))
    return np.asarray(cosines.T @ ((weights * moved)[:, None] * cosines))


@pytest.mark.parametrize("odd", [False, True])
@pytest.mark.parametrize(("ratio", "rel"), [(0.3, 1e-3), (0.45, 2e-3)])
def test_surface_of_a_layer_that_ends_is_that_of_finite_elements(
    ratio: float, rel: float, odd: bool
) -> None:
    rows = [0, 1, 2, 4]
    for wave in (0.5, 3.0):
        found = _mirrored(ratio, wave, odd=odd) + _added(ratio, wave, odd=odd)
        section = LayerSection(ratio, HALF_LENGTH, ROW, odd=odd)
        for loaded in (0, 3):
            expected = section.displacements(wave, loaded, rows)
            scale = float(np.abs(expected).max())
            assert found[rows, loaded] == close_to(expected, abs=rel * scale)
            # The end is a quarter of it and more.
            endless = _mirrored(ratio, wave, odd=odd)[rows, loaded]
            assert np.abs(endless - expected).max() > 0.05 * scale


def test_elements_half_as_long_change_little_and_less_each_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stack = _stack(0.49)

    def at_edge(factor: float) -> Any:
        monkeypatch.setattr(layer_end, "FIRST", 0.02 * factor)
        monkeypatch.setattr(layer_end, "GROWTH", 1 + 0.5 * factor)
        monkeypatch.setattr(layer_end, "LARGEST", 0.25 * factor)
        return layer_end.added_at(stack, HALF_LENGTH, 0.5, odd=False)[0, 0]

    coarse, usual, fine = (at_edge(factor) for factor in (2.0, 1.0, 0.5))
    assert abs(fine - usual) < 0.5 * abs(usual - coarse)
    assert usual == close_to(fine, rel=2e-3)


def test_short_waves_feel_the_end_of_a_half_space() -> None:
    wave = 14.0  # times the thickness
    table = layer_end.layer_table(_stack(0.3), HALF_LENGTH, odd=False)
    weights = table.weights(np.array([wave * HALF_LENGTH]))[0]
    found = np.tensordot(weights, table.entries, axes=1)
    functions = end_functions(0.3).at(wave * HALF_LENGTH * table.panels.places)
    expected = functions @ functions.T
    # Nearer than this the places lie within the first elements.
    near = table.panels.places > 0.02
    difference = (found - expected)[near][:, near]
    assert np.abs(difference).max() < 5e-3 * np.abs(expected[near][:, near]).max()


def test_waves_between_those_of_the_table_are_met() -> None:
    table = layer_end.layer_table(_stack(0.45), HALF_LENGTH, odd=True)
    assert table.error < 2e-5
    for wave in (0.1, 1.0, 7.0):
        weights = table.weights(np.array([wave * HALF_LENGTH]))[0]
        found = np.tensordot(weights, table.entries, axes=1)
        own = layer_end.added_at(_stack(0.45), HALF_LENGTH, wave, odd=True)
        assert np.abs(found - own).max() < 2e-5 * np.abs(own).max()
