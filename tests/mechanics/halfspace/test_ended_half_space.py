"""Convolution of bodies that end, against mirrored grids, sums over cells, and symmetries."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.halfspace.end_correction import end_basis
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.ended_rows import ended_rows
from viscontact.mechanics.halfspace.free_end import end_functions
from viscontact.mechanics.halfspace.layered_influence import periodic_layered_table
from viscontact.mechanics.halfspace.periodic_influence import smooth_periodic_table
from viscontact.mechanics.halfspace.strip_basis import StripRows, strip_basis
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE

GRID = Grid((20, 12), (20.0, 9.0))
INSIDE = slice(4, 16)


def _pressure(seed: int = 0) -> Floats:
    pressure = np.zeros(GRID.shape)
    pressure[INSIDE] = np.random.default_rng(seed).random((12, 12))
    return pressure


def _displacement(response: EndedResponse, pressure: Floats) -> Floats:
    return ContactDomain(GRID, response=response).convolution.apply(pressure)


def test_two_walls_are_a_period_of_twice_the_length() -> None:
    pressure = _pressure()
    found = _displacement(EndedResponse(0.3, (-6.0, 6.0), (False, False)), pressure)
    inside = pressure[INSIDE]
    doubled = Grid((24, 12), (24.0, 9.0), (True, False))
    expected = ContactDomain(doubled).convolution.apply(np.concatenate([inside, inside[::-1]]))
    assert found[INSIDE] == close_to(expected[:12], rel=1e-9)
    assert not found[:4].any()


@pytest.mark.parametrize("side", [0, 1])
def test_a_wall_is_a_mirror(side: int) -> None:
    planes = (-6.0, None) if side == 0 else (None, 6.0)
    pressure = _pressure()
    found = _displacement(EndedResponse(0.3, planes, (False, False)), pressure)
    inside = pressure[INSIDE]
    images = [inside[::-1], inside] if side == 0 else [inside, inside[::-1]]
    doubled = ContactDomain(Grid((24, 12), (24.0, 9.0))).convolution
    expected = doubled.apply(np.concatenate(images))
    assert found[INSIDE] == close_to(expected[12:] if side == 0 else expected[:12], rel=1e-9)


def test_a_free_end_adds_the_sum_over_all_pairs_of_cells() -> None:
    pressure = _pressure()
    planes = (-6.0, None)
    held, free = (
        _displacement(EndedResponse(0.3, planes, (kind, False)), pressure)[INSIDE]
        for kind in (False, True)
    )
    basis = end_basis(0.3, range(16), GRID.cell_size)  # all rows of the grid on the body
    table = basis.basis @ basis.coefficients(12, GRID.cell_size[1]) @ basis.basis.T
    offsets = np.abs(np.subtract.outer(np.arange(12), np.arange(12)))
    expected = np.einsum("jkab,bk->aj", table[offsets][..., :12, :12], pressure[INSIDE])
    assert free - held == close_to(expected, rel=1e-9)


@pytest.mark.parametrize("offset", [0, 3])
def test_what_cells_add_near_a_free_end_is_a_mean_over_waves(offset: int) -> None:
    # Against a fine sum over wave numbers of the mean over both cells along x and one along y.
    functions, waves = end_functions(0.3), np.geomspace(1e-9, 40.0, 8000)
    nodes, weights = np.polynomial.legendre.leggauss(8)
    places = np.multiply.outer(0.5 + nodes / 2, waves)
    means = [
        np.tensordot(weights / 2, functions.at(places + row * waves), axes=1) for row in (3, 10)
    ]
    across = np.cos(waves * offset) * np.sinc(waves / (2 * np.pi))
    values = (means[0] * means[1]).sum(axis=1) * across * waves
    expected = np.trapezoid(values, np.log(waves)) / np.pi
    basis = end_basis(0.3, range(12), (1.0, 1.0))
    found = basis.basis[3] @ basis.coefficients(4, 1.0)[offset] @ basis.basis[10]
    assert found == close_to(expected, rel=1e-5)


@pytest.mark.parametrize("planes", [(-6.0, None), (-30.0, None)])
def test_a_turned_body_is_the_same(planes: tuple[float | None, float | None]) -> None:
    pressure = _pressure()
    found = _displacement(EndedResponse(0.3, planes, (True, False)), pressure)
    turned = tuple(None if plane is None else -plane for plane in planes[::-1])
    other = EndedResponse(0.3, (turned[0], turned[1]), (False, True))
    expected = _displacement(other, pressure[::-1])[::-1]
    assert found[INSIDE] == close_to(expected[INSIDE], rel=1e-12)


def test_half_of_an_even_pressure_and_a_patch_give_the_same() -> None:
    response = EndedResponse(0.3, (-6.0, None), (True, False))
    whole = ContactDomain(GRID, response=response)
    half = ContactDomain(GRID, response=response, mirrored=(False, True))
    pressure = _pressure()
    even = pressure + pressure[:, ::-1]
    found = half.expand_by_symmetry(half.convolution.apply(half.reduce_by_symmetry(even)))
    assert found[INSIDE] == close_to(whole.convolution.apply(even)[INSIDE], rel=1e-12)
    part = np.zeros(GRID.shape)
    part[6:16, 2:9] = pressure[6:16, 2:9]
    patch = whole._patch(slice(6, 18), slice(2, 9))
    on_patch = patch.convolution.apply(part[6:18, 2:9].astype(np.float32))
    expected = whole.convolution.apply(part)[6:18, 2:9]
    assert on_patch == close_to(expected, rel=1e-6)


def test_a_free_end_keeps_reciprocity() -> None:
    convolution = ContactDomain(
        GRID, response=EndedResponse(0.45, (None, 6.0), (False, True))
    ).convolution
    one, other = _pressure(1), _pressure(2)
    there = np.sum(other * convolution.apply(one))
    assert there == close_to(np.sum(one * convolution.apply(other)), rel=1e-12)


FREE = EndedResponse(0.3, (-6.0, 6.0), (True, True))


def test_two_free_ends_add_the_sum_over_all_pairs_of_cells() -> None:
    pressure = _pressure()
    held = _displacement(EndedResponse(0.3, (-6.0, 6.0), (False, False)), pressure)[INSIDE]
    added = _displacement(FREE, pressure)[INSIDE] - held
    strip, offsets = StripRows(12, (True, True)), np.abs(np.subtract.outer(*[np.arange(12)] * 2))
    expected = np.zeros((12, 12))
    for odd in (False, True):
        basis = strip_basis(0.3, strip, range(12), GRID.cell_size, 9.0, odd=odd)
        table = basis.basis @ basis.coefficients(12, GRID.cell_size[1]) @ basis.basis.T
        expected += np.einsum("jkab,bk->aj", table[offsets], pressure[INSIDE])
    assert added == close_to(expected, rel=1e-9)


def test_between_two_free_ends_the_mirrored_pressure_displaces_the_mirror_image() -> None:
    pressure = _pressure()
    found = _displacement(FREE, pressure)
    assert found == close_to(_displacement(FREE, pressure[::-1])[::-1], rel=1e-12)
    # With an odd number of cells, the row in the middle is even.
    odd = Grid((15, 12), (15.0, 9.0))
    domain = ContactDomain(odd, response=EndedResponse(0.3, (-5.5, 5.5), (True, True)))
    some = np.zeros((15, 12))
    some[2:13] = np.random.default_rng(1).random((11, 12))
    turned = domain.convolution.apply(some[::-1])[::-1]
    assert domain.convolution.apply(some) == close_to(turned, rel=1e-12)


@pytest.mark.parametrize("periodic", [False, True])
def test_even_pressures_on_an_odd_number_of_rows_need_no_odd_part_of_the_operator(
    periodic: bool,
) -> None:
    grid = Grid((15, 12), (15.0, 9.0), periodic=(False, periodic))
    response = EndedResponse(0.3, (-5.5, 5.5), (True, True))
    pressure = np.zeros(grid.shape)
    pressure[2:13] = np.random.default_rng(1).random((11, 12))
    even = pressure + pressure[::-1]
    whole = ContactDomain(grid, response=response).convolution
    part = ContactDomain(grid, response=response, even_rows=True).convolution
    assert part.apply(even) == close_to(whole.apply(even), rel=1e-12)
    odd = pressure - pressure[::-1]
    assert np.abs(part.apply(odd) - whole.apply(odd)).max() > 1e-3 * np.abs(whole.apply(odd)).max()


def test_half_of_an_even_pressure_between_two_free_ends_is_one_beside_a_wall() -> None:
    pressure = _pressure()
    even = pressure + pressure[::-1]
    half = ContactDomain(GRID, response=FREE, mirrored=(True, False))
    found = half.expand_by_symmetry(half.convolution.apply(half.reduce_by_symmetry(even)))
    assert found[INSIDE] == close_to(_displacement(FREE, even)[INSIDE], rel=1e-6)
    wall = EndedResponse(0.3, (0.0, 6.0), (False, True))
    assert _displacement(wall, even)[10:16] == close_to(found[10:16], rel=1e-12)
    turned = EndedResponse(0.3, (-6.0, 0.0), (True, False))
    assert _displacement(turned, even)[4:10] == close_to(found[4:10], rel=1e-12)


def test_a_part_of_a_body_between_two_free_ends_is_displaced_as_in_the_whole() -> None:
    pressure = _pressure()
    pressure[:7] = 0.0
    cut = Grid((14, 12), (14.0, 9.0), centre=(3.0, 0.0))  # one face lies outside
    found = ContactDomain(cut, response=FREE).convolution.apply(pressure[6:])
    assert found[1:10] == close_to(_displacement(FREE, pressure)[7:16], rel=1e-6)
    whole = ContactDomain(GRID, response=FREE)
    patch = whole._patch(slice(6, 18), slice(2, 9))
    part = np.where(np.arange(12) < 9, pressure, 0.0)
    part[:, :2] = 0.0
    on_patch = patch.convolution.apply(part[6:18, 2:9].astype(np.float32))
    assert on_patch == close_to(whole.convolution.apply(part)[6:18, 2:9], rel=1e-5)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
def test_two_free_ends_keep_reciprocity_and_give_way(ratio: float) -> None:
    response = EndedResponse(ratio, (-6.0, 6.0), (True, True))
    one, other = _pressure(1), _pressure(2)
    found = _displacement(response, one)
    there = np.sum(other * found)
    assert there == close_to(np.sum(one * _displacement(response, other)), rel=1e-12)
    held = _displacement(EndedResponse(ratio, (-6.0, 6.0), (False, False)), one)
    assert np.sum(one * (found - held)) > 0


def test_a_far_free_end_is_felt_as_that_of_a_body_that_goes_on() -> None:
    pressure = _pressure()
    lone = _displacement(EndedResponse(0.3, (-6.0, None), (True, False)), pressure)[INSIDE]
    spread = []
    for length in (40.0, 80.0, 160.0):
        both = EndedResponse(0.3, (-6.0, length - 6.0), (True, True))
        missed = _displacement(both, pressure)[INSIDE] - lone
        # Without a datum: up to a displacement and a tilt of the whole.
        x = np.stack([np.ones(12), np.arange(12.0)]).repeat(12, axis=1)
        rest = missed.ravel() - x.T @ np.linalg.lstsq(x.T, missed.ravel(), rcond=None)[0]
        spread.append(np.abs(rest).max() / lone.max())
    assert spread[2] < 0.4 * spread[1] < 0.16 * spread[0] < 1e-3


@pytest.mark.parametrize("shape", [(240, 32), (20, 12), (10, 200), (64, 300)])
def test_interpolated_images_are_those_of_the_periodic_table(shape: tuple[int, int]) -> None:
    cell = (0.3, 0.2)
    width = shape[1] * cell[1]
    exact = periodic_layered_table(shape, cell, HALF_SPACE, width)
    assert smooth_periodic_table(shape, cell, width) == close_to(
        exact, abs=1e-13 * float(np.abs(exact).max())
    )


def test_coefficients_of_a_block_are_those_of_fewer_cells() -> None:
    basis = end_basis(0.3, range(12), (1.0, 1.0))
    for cells in (5, 3, 9, 9):
        assert basis.table(cells, 0.5) == close_to(basis.coefficients(cells, 0.5), rel=1e-12)


def test_rows_of_small_grids_are_kept() -> None:
    asked = (EndedResponse(0.3, (-6.0, 6.0), (True, True)), (16, 12), (1.0, 1.0), (2, 14))
    assert ended_rows(*asked) is ended_rows(*asked)
    large = (asked[0], (16, 4000), *asked[2:])
    assert ended_rows(*large) is not ended_rows(*large)
