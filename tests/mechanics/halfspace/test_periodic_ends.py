"""Operators of contacts that repeat along free ends: limits, finite elements, symmetry, mirrors."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from mechanics.halfspace.plane_elements import PlaneSection
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.free_end import end_functions
from viscontact.mechanics.halfspace.plane_corner import added_by_end
from viscontact.mechanics.halfspace.plane_strip import MISSED, plane_strip
from viscontact.mechanics.halfspace.strip import strip_table, surface_panels

FREE, HELD = (True, True), (False, False)


def _operator(grid: Grid, response: EndedResponse) -> Floats:
    """Displacement of each cell under each, as a matrix."""
    domain = ContactDomain(grid, response=response)
    count = grid.shape[0] * grid.shape[1]
    found = [domain.convolution.apply(each.reshape(grid.shape)).ravel() for each in np.eye(count)]
    return np.array(found).T


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
def test_a_quarter_plane_is_the_limit_of_long_waves_beside_an_end(ratio: float) -> None:
    # The table of waves is solved on nodes of the faces, with Poisson's ratio; the limit is a
    # Fourier integral without it. What differs beside a displacement of all falls with k.
    functions, places = end_functions(ratio), np.array([0.2, 0.5, 1.0, 2.0, 5.0])
    plane = added_by_end(places[:, None], places, 1.0)
    found = []
    for wave in (1e-2, 1e-3, 1e-4):
        values = functions.at(wave * places)
        apart = values @ values.T - plane
        found.append(float(np.abs(apart - apart[2, 2]).max()))
    assert found[2] < 2e-3
    assert found[0] > 8 * found[1] > 60 * found[2]


def test_a_strip_is_the_limit_of_long_waves_between_two_ends() -> None:
    # Without Poisson's effect, the next term over k W is one of second order.
    places = surface_panels().places
    picked = np.searchsorted(places, [1e-3, 1e-2, 0.1, 0.3, 0.6, 0.95])
    nodes = np.ix_(picked, picked)
    plane, table, found = plane_strip(odd=False).added[nodes], strip_table(0.0, odd=False), []
    for wave in (0.32, 0.16, 0.08):
        added = np.tensordot(table.weights(np.array([wave]))[0], table.entries, axes=1)[nodes]
        apart = added - plane
        found.append(float(np.abs(apart - apart[-1, -1]).max()))
    assert found[-1] < 2e-3
    assert np.divide(found[:-1], found[1:]) == close_to([4.0, 4.0], rel=0.1)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
def test_waves_longer_than_those_of_the_table_of_a_strip_tend_to_plane_strain(ratio: float) -> None:
    # Longer ones are on a parabola through those of the table; the limit is solved without waves.
    places = surface_panels().places
    picked = np.searchsorted(places, [1e-3, 1e-2, 0.1, 0.3, 0.6, 0.95])
    nodes, table, wave = np.ix_(picked, picked), strip_table(ratio, odd=False), 1e-6
    added = np.tensordot(table.weights(np.array([wave]))[0], table.entries, axes=1) - (
        table.limit / wave
    )
    plane = plane_strip(odd=False).added[nodes]
    apart = added[nodes] - plane
    assert np.abs(apart - apart[-1, -1]).max() < 1e-3 * np.abs(plane).max()


@pytest.mark.parametrize("odd", [False, True])
def test_a_face_of_a_strip_is_near_to_it_that_of_a_quarter_plane(odd: bool) -> None:
    places = surface_panels().places
    picked = np.searchsorted(places, [1e-4, 3e-4, 1e-3])
    near = places[picked]
    apart = plane_strip(odd=odd).added[np.ix_(picked, picked)]
    apart = apart - added_by_end(near[:, None], near, 1.0)
    # The other face is seen as a displacement of all, and a slope.
    assert np.abs(apart - apart[0, 0]).max() < 10 * near[-1]
    assert plane_strip(odd=odd).error < MISSED + 2e-6


@pytest.mark.parametrize("odd", [False, True])
@pytest.mark.parametrize("ratio", [0.0, 0.3])
def test_a_strip_under_loads_at_its_end_is_that_of_finite_elements(odd: bool, ratio: float) -> None:
    rows, loads = 10, np.zeros(10)
    loads[2], loads[7] = 1.0, -0.4
    expected = PlaneSection(ratio, rows, odd=odd).displacements(loads)
    arm = 1 - (np.arange(rows) + 0.5) / rows
    rigid = arm if odd else np.ones(rows)
    found = []
    for cells in (1, 4, 16):
        half = np.repeat(loads, cells)
        pressure = np.concatenate([half, (-1 if odd else 1) * half[::-1]])
        grid = Grid((2 * rows * cells, 1), (2.0, 1.0), (False, True))
        domain = ContactDomain(grid, response=EndedResponse(ratio, (-1.0, 1.0), FREE))
        moved = domain.convolution.apply(pressure[:, None])[: rows * cells, 0]
        apart = moved.reshape(rows, cells).mean(axis=1) - expected
        apart -= rigid * (apart @ rigid) / (rigid @ rigid)
        found.append(float(np.abs(apart).max() / np.ptp(expected)))
    # Pressures that jump are sums of waves, up to those of two cells.
    assert found[-1] < 3e-3
    assert found[0] > 3 * found[1] > 9 * found[2]


def test_two_walls_are_a_grid_of_twice_the_length_with_two_periods() -> None:
    grid, inside = Grid((20, 12), (20.0, 9.0), (False, True)), slice(4, 16)
    pressure = np.zeros(grid.shape)
    pressure[inside] = np.random.default_rng(0).random((12, 12))
    response = EndedResponse(0.3, (-6.0, 6.0), HELD)
    found = ContactDomain(grid, response=response).convolution.apply(pressure)
    doubled = np.concatenate([pressure[inside], pressure[inside][::-1]])
    whole = ContactDomain(Grid((24, 12), (24.0, 9.0), (True, True)))
    assert found[inside] == close_to(whole.convolution.apply(doubled)[:12], rel=1e-12, abs=1e-12)
    assert not found[:4].any()


@pytest.mark.parametrize("planes", [(-6.0, None), (-6.0, 6.0)])
@pytest.mark.parametrize("columns", [1, 4, 5])
def test_force_and_displacement_change_places(
    planes: tuple[float, float | None], columns: int
) -> None:
    free = (True, planes[1] is not None)
    grid = Grid((18, columns), (18.0, 7.0), (False, True))
    found = _operator(grid, EndedResponse(0.3, planes, free))
    assert np.abs(found - found.T).max() < 1e-9 * np.abs(found).max()
    # Positive but for motions of the whole body, of which the work is zero.
    fixed = np.ones(18 * columns), np.repeat(grid.x, columns)
    for motion in map(np.asarray, fixed):
        found = found - np.outer(motion, motion @ found) / (motion @ motion)
        found = found - np.outer(found @ motion, motion) / (motion @ motion)
    assert np.linalg.eigvalsh(found).min() > -1e-6 * np.abs(found).max()


def test_a_period_is_the_limit_of_many_beside_each_other() -> None:
    # One operator sums waves of the period, the other places up to where the row of loads ends.
    planes, free, columns = (-6.0, None), (True, False), 8
    grid, inside = Grid((20, columns), (20.0, 6.0), (False, True)), slice(4, 16)
    x, y = grid.x[:, None], grid.y[None, :]
    wave = (1 + 0.5 * np.cos(2 * np.pi * y / 6)) * (np.cos(np.pi * (x - 1) / 12) + 1.2)
    pressure = np.where(np.abs(x) < 6, wave, 0.0)
    response, left = EndedResponse(0.3, planes, free), []
    own = ContactDomain(grid, response=response).convolution.apply(pressure)[inside]
    for periods in (11, 21, 41):
        long = Grid((20, columns * periods), (20.0, 6.0 * periods))
        row = np.tile(pressure, (1, periods))
        middle = slice(columns * (periods // 2), columns * (periods // 2 + 1))
        moved = ContactDomain(long, response=response).convolution.apply(row)[inside, middle]
        apart = moved - own
        apart -= apart.mean()
        # A row that ends turns the edge about y, in proportion to its curvature.
        arm = grid.x[inside] - grid.x[inside].mean()
        apart -= arm[:, None] * (apart.mean(axis=1) @ arm) / (arm @ arm)
        left.append(float(np.abs(apart).max() / np.ptp(own)))
    assert left[-1] < 5e-4
    assert left[0] > 3 * left[1] > 6 * left[2]


def test_half_of_an_even_pressure_and_a_patch_give_the_same() -> None:
    grid, response = (
        Grid((20, 6), (20.0, 6.0), (False, True)),
        EndedResponse(0.3, (-8.0, 8.0), FREE),
    )
    pressure = np.zeros(grid.shape)
    pressure[4:16] = np.random.default_rng(1).random((12, 6))
    even = pressure + pressure[::-1]
    whole = ContactDomain(grid, response=response)
    half = ContactDomain(grid, response=response, mirrored=(True, False))
    found = half.expand_by_symmetry(half.convolution.apply(half.reduce_by_symmetry(even)))
    assert found == close_to(whole.convolution.apply(even), rel=1e-8, abs=1e-8)
    patch = whole._patch(slice(4, 16), slice(0, 6))
    on_patch = patch.convolution.apply(pressure[4:16].astype(np.float32))
    expected = whole.convolution.apply(pressure)[4:16]
    assert on_patch == close_to(expected, rel=1e-5, abs=1e-5)


@pytest.mark.parametrize("columns", [1, 6])
def test_a_turned_body_is_the_same(columns: int) -> None:
    grid = Grid((20, columns), (20.0, 6.0), (False, True))
    pressure = np.random.default_rng(2).random(grid.shape)
    one, other = EndedResponse(0.3, (-6.0, None), FREE), EndedResponse(0.3, (None, 6.0), FREE)
    found = ContactDomain(grid, response=one).convolution.apply(pressure)
    turned = ContactDomain(grid, response=other).convolution.apply(pressure[::-1])[::-1]
    assert found == close_to(turned, rel=1e-9, abs=1e-12)
