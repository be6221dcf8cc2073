"""Bodies that end under a load that moves along y, against delayed elastic displacements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from closeness import close_to
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.moving_domain import MovingDomain
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.halfspace.moving_load import MovingCompliance
from viscontact.mechanics.halfspace.moving_surface import MovingSurface

GRID = Grid((12, 16), (2.0, 1.0), centre=(1.0, 0.0))
MOVING = MovingCompliance(0.7, np.array([1.1, 0.5]), np.array([0.075, 0.425]))

BODIES = {
    "one end": EndedResponse(0.4, (0.0, None), (True, False)),
    "end ahead of +x": EndedResponse(0.4, (None, 2.0), (False, True)),
    "two free ends": EndedResponse(0.4, (0.0, 2.0), (True, True)),
    "end and wall": EndedResponse(0.4, (0.0, 2.0), (True, False)),
}


def _elastic(response: EndedResponse, pressure: Floats) -> tuple[CubicSpline, Floats]:
    """Elastic displacement over y, and the places of the cells' middles."""
    fine, longer = 5, 40  # cells of the elastic surface in one, and its length
    grid = Grid((12, 16 * longer * fine), (2.0, float(longer)), centre=(1.0, 0.0))
    loaded = np.zeros(grid.shape)
    first = 16 * fine * longer // 2
    cells = slice(first, first + 16 * fine)
    loaded[:, cells] = np.repeat(pressure, fine, axis=1)
    elastic = ContactDomain(grid, response=response).convolution.apply(loaded)
    return CubicSpline(grid.y, elastic, axis=1), grid.y[cells][fine // 2 :: fine]


def _delayed(response: EndedResponse, pressure: Floats) -> Floats:
    """J0 q + Σ Ji ∫ exp(-z/li) q(y + z) dz/li by quadrature, of the elastic displacement q."""
    spline, middles = _elastic(response, pressure)
    total = np.asarray(MOVING.instant * spline(middles))
    nodes, weights = np.polynomial.legendre.leggauss(6)
    for amplitude, length in zip(MOVING.amplitudes, MOVING.lengths, strict=True):
        edges = np.linspace(0.0, 30 * length, 1500)
        half = np.diff(edges)[:, None] / 2
        ahead = ((edges[1:] + edges[:-1])[:, None] / 2 + half * nodes).ravel()
        part = (half * weights).ravel() * np.exp(-ahead / length) / length
        for column, place in enumerate(middles):
            total[:, column] += amplitude * (spline(place + ahead) @ part)
    return total


def _without_datum(response: EndedResponse, difference: Floats) -> Floats:
    """Difference less an approach between two ends, and between two free ones a tilt."""
    if None in response.planes:
        return difference
    level = np.column_stack([np.ones(difference.size), np.repeat(GRID.x, 16)])
    rigid = np.linalg.lstsq(level, difference.ravel(), rcond=None)[0]
    return np.asarray(difference - (level @ rigid).reshape(difference.shape))


@pytest.mark.parametrize("name", BODIES)
def test_material_that_returns_still_lags_behind_earlier_turns(name: str) -> None:
    response, period = BODIES[name], 3.0
    returning = replace(MOVING, lengths=np.array([0.3, 20.0]), periods=np.full(2, period))
    pressure = np.zeros(GRID.shape)
    pressure[:, 8] = np.random.default_rng(5).random(12)
    domain = MovingDomain(GRID, MovingSurface(((response, returning),)), 1)
    found = domain.compliance * domain.convolution.apply(pressure)
    # The material at y comes by the load once in each period, and no more than half of one away.
    spline, middles = _elastic(response, pressure)
    expected = np.asarray(returning.instant * spline(middles))
    nodes, weights = np.polynomial.legendre.leggauss(6)
    for amplitude, length in zip(returning.amplitudes, returning.lengths, strict=True):
        for column, place in enumerate(middles):
            wrap = (middles[8] + period / 2 - place) % period
            edges = np.unique(np.append(np.linspace(0.0, period, 900), wrap))
            half = np.diff(edges)[:, None] / 2
            ahead = ((edges[1:] + edges[:-1])[:, None] / 2 + half * nodes).ravel()
            part = (half * weights).ravel() * np.exp(-ahead / length) / length
            part /= -np.expm1(-period / length)
            beside = (place + ahead - middles[8] + period / 2) % period - period / 2
            expected[:, column] += amplitude * (spline(middles[8] + beside) @ part)
    difference = _without_datum(response, found - expected)
    assert np.abs(difference).max() < 2e-5 * np.ptp(found)


@pytest.mark.parametrize("name", BODIES)
def test_displacement_lags_behind_a_moving_load_by_the_creep(name: str) -> None:
    response = BODIES[name]
    pressure = np.random.default_rng(1).random(GRID.shape)
    domain = MovingDomain(GRID, MovingSurface(((response, MOVING),)), 1)
    found = domain.compliance * domain.convolution.apply(pressure)
    difference = _without_datum(response, found - _delayed(response, pressure))
    # The spline of the quadrature does not follow the kinks at the borders of cells.
    assert np.abs(difference).max() < 2e-5 * np.ptp(found)


@pytest.mark.parametrize("name", BODIES)
def test_a_body_that_does_not_creep_is_displaced_as_at_rest(name: str) -> None:
    response = BODIES[name]
    elastic = MovingCompliance(2.0, np.empty(0), np.empty(0))
    pressure = np.random.default_rng(2).random(GRID.shape)
    domain = MovingDomain(GRID, MovingSurface(((response, elastic),)), 1)
    at_rest = ContactDomain(GRID, response=response).convolution.apply(pressure)
    found = domain.elastic.apply(pressure)
    assert found - found.mean() == close_to(at_rest - at_rest.mean(), abs=1e-9)
    assert not domain.loss.apply(pressure).any()


def test_a_grid_that_is_mirrored_about_the_middle_is_the_whole_one() -> None:
    grid = Grid((16, 12), (2.0, 1.0))
    response = EndedResponse(0.4, (-0.75, 0.75), (True, True))
    surface = MovingSurface(((response, MOVING),))
    half = np.random.default_rng(3).random((8, 12))
    half[6:] = 0.0
    whole = MovingDomain(grid, surface, 1)
    even = MovingDomain(grid, surface, 1, mirrored=True)
    expected = whole.convolution.apply(np.concatenate([half[::-1], half]))[2:-2]
    found = even.expand_by_symmetry(even.convolution.apply(half))[2:-2]
    assert found - found.mean() == close_to(expected - expected.mean(), abs=1e-6)
