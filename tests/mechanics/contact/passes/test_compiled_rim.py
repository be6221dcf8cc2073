"""The compiled rim of a contact, and trends of cells, against those in NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from viscontact.backend import compiled
from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.team import Team
from viscontact.mechanics.contact.body_edge import Outline
from viscontact.mechanics.contact.recession import ContactTrend
from viscontact.mechanics.contact.rim import trace_rim
from viscontact.mechanics.contact.rim_crossings import Recession

pytestmark = pytest.mark.skipif(compiled.core is None, reason="no compiled core")

cells = st.tuples(st.integers(4, 14), st.integers(4, 14))
seeds = st.integers(0, 2**32 - 1)


def spots(random: np.random.Generator, shape: tuple[int, int]) -> tuple[Bools, Floats, Floats]:
    """Contact, gap and pressure of waves with some cells changed at random, and a body's end."""
    x, y = np.meshgrid(*(np.arange(count) for count in shape), indexing="ij")
    wave = np.cos(x * random.uniform(0.1, 1.5)) * np.cos(y * random.uniform(0.1, 1.5))
    height = wave - random.uniform(-0.5, 0.9) + 0.1 * random.standard_normal(shape)
    contact = height > 0
    gap = np.where(contact, 1e-9 * random.standard_normal(shape), np.abs(height) ** 1.5)
    if random.random() < 0.5:
        gap[~contact & (x > random.integers(1, shape[0]))] = np.inf
    return contact, gap, np.where(contact, np.sqrt(np.maximum(height, 0)), 0.0)


@settings(max_examples=300)
@given(seeds, cells, st.booleans(), st.booleans(), st.tuples(st.booleans(), st.booleans()))
def test_crossings_area_and_extents(
    seed: int, shape: tuple[int, int], recedes: bool, ends: bool, periodic: tuple[bool, bool]
) -> None:
    random = np.random.default_rng(seed)
    contact, gap, pressure = spots(random, shape)
    grid = vc.Grid(shape, (1e-3 * shape[0], 1.3e-3 * shape[1]), periodic=periodic)
    recession = outline = None
    if recedes:
        recession = Recession(pressure, *(random.random(shape) < 0.5 for _ in range(3)))
    if ends:
        nx, ny = shape
        lines: list[Any] = [random.random((nx - 1, ny)), random.random((nx, ny - 1))]
        for each in lines:
            each[each < 0.2] = np.nan
        outline = Outline(lines[0], np.asfortranarray(lines[1]))
    expected, found = (
        trace_rim(grid, contact, gap, outline, recession, team)
        for team in (Team(), Team(core=compiled.core))
    )
    least = 1e-12 * grid.cell_area
    assert found.area == close_to(expected.area, 1e-9, abs=least)
    assert found.length == close_to(expected.length, 1e-9, abs=least)
    assert found.width == close_to(expected.width, 1e-9, abs=least)
    assert found.cells_across == expected.cells_across
    assert found.extent.segment == close_to(expected.extent.segment, 1e-14)


@given(seeds, cells, st.tuples(st.booleans(), st.booleans()), st.booleans())
def test_one_half_of_an_even_contact_tells_the_other(
    seed: int, part: tuple[int, int], even: tuple[bool, bool], recedes: bool
) -> None:
    random, team = np.random.default_rng(seed), Team(core=compiled.core)
    flags = [random.random(part) < 0.5 for _ in range(3)]
    contact, gap, pressure, *flags = (
        Team().unfold(each, even) for each in (*spots(random, part), *flags)
    )
    grid = vc.Grid(contact.shape, (1e-3 * contact.shape[0], 1.3e-3 * contact.shape[1]))
    recession = Recession(pressure, *flags) if recedes else None
    whole, half = (
        trace_rim(grid, contact, gap, None, recession, team, mirrored)
        for mirrored in ((False, False), even)
    )
    assert half.extent == whole.extent


def test_rims_of_large_and_small_blocks_in_turn() -> None:
    # Memory is kept between small ones only, and has to be as before after each.
    for cells in (40, 1100, 24, 40, 1100):
        grid = vc.Grid((cells, cells), (1.0, 1.0))
        r = np.hypot(grid.x[:, None], 1.1 * grid.y[None, :])
        gap, contact = np.maximum(r - 0.43, 0.0) ** 1.5, r < 0.43
        expected, found = (
            trace_rim(grid, contact, gap, team=team) for team in (Team(), Team(core=compiled.core))
        )
        assert found.area == close_to(expected.area, 1e-12)
        assert found.length == close_to(expected.length, 1e-12)


@given(seeds, cells, st.sampled_from([0.0, 0.05]))
def test_trends_over_steps(seed: int, shape: tuple[int, int], error: float) -> None:
    random = np.random.default_rng(seed)
    grid = vc.Grid(shape, (1.0, 1.0))
    trends = [ContactTrend.at_first(grid)] * 2
    for _ in range(5):
        contact, gap, pressure = spots(random, shape)
        trends = [
            trend.after(gap, pressure, contact, error, team)
            for trend, team in zip(trends, (Team(), Team(core=compiled.core)), strict=True)
        ]
        for one, other in zip(trends[0].fields, trends[1].fields, strict=True):
            np.testing.assert_array_equal(one, other)
