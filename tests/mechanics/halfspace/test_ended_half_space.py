"""Convolution of bodies that end, against mirrored grids, sums over cells, and symmetries."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.halfspace.end_correction import end_basis
from viscontact.mechanics.halfspace.ended_half_space import EndedResponse
from viscontact.mechanics.halfspace.free_end import end_functions

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
