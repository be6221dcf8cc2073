"""Layers under a load in steady motion: coefficients, waves and the preconditioner."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_influence import layered_influence_coefficient
from viscontact.mechanics.halfspace.moving_load import MovingCompliance, moving_influence_table
from viscontact.mechanics.halfspace.moving_surface import MovingSurface
from viscontact.mechanics.halfspace.preconditioner import MovingPreconditioner
from viscontact.mechanics.halfspace.spectral import MovingPeriodicConvolution
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SummedResponse

ZENER = MovingCompliance(1.0, np.array([9.0]), np.array([0.8]))
ELASTIC = MovingCompliance(0.5, np.empty(0), np.empty(0))


def bonded(thickness, nu=0.45):
    return ElasticStack((ElasticLayer(thickness, 1.0, nu),), None)


def coated(thickness):
    return ElasticStack((ElasticLayer(thickness, 20.0, 0.3),), ElasticBase(1.0, 0.4))


def at(x, y, cell, response):
    """Coefficient at an offset of some cells along y."""
    count = round(y / cell[1]) + 1
    return float(layered_influence_coefficient(np.array([x]), count, cell, response)[0, -1])


@pytest.mark.parametrize("response", [bonded(0.02), bonded(0.5), bonded(8.0), coated(0.3)])
@pytest.mark.parametrize("x", [0.25, 3.75, 19.75, 21.25])
def test_a_cell_between_those_of_a_grid_is_the_sum_of_its_halves(response, x):
    whole, halves = (1.0, 1.0), (0.5, 1.0)
    both = at(x - 0.25, 2.0, halves, response) + at(x + 0.25, 2.0, halves, response)
    largest = at(0.0, 0.0, whole, response)
    # Measured: 1e-10, where the formula changes at 20 cells.
    assert at(x, 2.0, whole, response) == close_to(both, abs=1e-9 * largest)


@pytest.mark.parametrize(
    ("response", "length", "places"),
    [
        (bonded(2.0), 30.0, [(0, 0), (1, 1)]),
        *(
            pytest.param(*each, [(-4, 0), (0, 0), (1, 1)], marks=pytest.mark.slow)
            for each in (
                *((bonded(2.0), 30.0), (bonded(0.05), 0.3)),
                *((bonded(0.05), 30.0), (coated(0.3), 0.3)),
            )
        ),
    ],
)
def test_coefficients_are_the_delayed_integral(response, length, places):
    """∫ exp(-z/l) K(x + z) dz/l by adaptive quadrature, split at the edges of the cell."""
    cell, mode = (1.0, 1.0), MovingCompliance(0.0, np.array([1.0]), np.array([length]))

    def coefficient(along, across, size):
        return layered_influence_coefficient(along[:, 0], across.size, size, response)

    table = moving_influence_table((5, 2), cell, mode, 0, coefficient)
    largest = at(0.0, 0.0, cell, response)

    def integrand(s, x, y):
        return np.exp(-s) * at(abs(x + length * s), y, cell, response)

    for x, y in places:
        ends = [edge + way for edge in (-0.5, 0.5) for way in (-0.1, -1e-3, 0.0, 1e-3, 0.1)]
        splits = [(each - x) / length for each in (*ends, 3.0, 10.0)] + [0.1, 1.0, 5.0]
        bounds = sorted({0.0, 45.0, *(each for each in splits if 0 < each < 45)})
        expected = sum(
            quad(integrand, *pair, args=(x, y), epsabs=1e-10, epsrel=1e-9, limit=50)[0]
            for pair in itertools.pairwise(bounds)
        )
        # Asked: 1e-8 of the coefficient of the loaded cell.
        assert table[x + 4, y] == close_to(expected, abs=1e-8 * largest)


def wave(cells, k):
    position = np.arange(cells)[:, None]
    return np.tile(np.exp(1j * k * position), (1, 6))


@pytest.mark.parametrize("axis", [0, 1])
def test_a_wave_over_a_period_has_the_compliances_of_all_terms(axis):
    cells, k = 24, 2 * np.pi * 3 / 24
    terms = [(bonded(2.0), ZENER), (bonded(2.0, 0.3), ELASTIC)]
    factors = [(response, each.at_wave_number) for response, each in terms]
    along = wave(cells, k)
    compliance = sum(
        complex(each.at_wave_number(np.array(k))) * float(response.ratio(np.array(k)))
        for response, each in terms
    )
    pressure, displacement = along.real + 3.0, (compliance * 2 / k * along).real
    # The mean pressure compresses the layers at rest.
    displacement += 3.0 * (10 * terms[0][0].mean_displacement + terms[1][0].mean_displacement / 2)
    if axis == 1:
        pressure, displacement = pressure.T, displacement.T
    operator = MovingPeriodicConvolution(pressure.shape, (1.0, 1.0), factors, axis)
    assert operator.apply(pressure) == close_to(displacement, rel=1e-12)


def test_the_preconditioner_inverts_a_wave_on_several_terms():
    # One of the terms displaces the wrong way, as part of a sum may.
    cells, k = 24, 2 * np.pi * 3 / 24
    soft = SummedResponse((bonded(2.0, 0.3),), (-0.2,))
    terms = [(bonded(2.0), ZENER), (soft, ELASTIC)]
    compliance = sum(
        complex(each.at_wave_number(np.array(k))) * float(response.ratio(np.array(k)))
        for response, each in terms
    )
    along = wave(cells, k)
    operator = MovingPreconditioner(along.shape, (1.0, 1.0), terms, 0)
    found = operator.apply((compliance * 2 / k * along).real)
    assert found == close_to(along.real, abs=1e-3)  # L is interpolated


def test_a_surface_of_waves_of_one_length_adds_its_terms():
    surface = MovingSurface(((bonded(2.0), ZENER), (HALF_SPACE, ELASTIC)))
    ratio = float(bonded(2.0).ratio(np.array(0.5)))
    found = surface.at_length(0.5)
    assert found.instant == close_to(ratio + 0.5)
    assert found.relaxed == close_to(10 * ratio + 0.5)
    assert not surface.is_supported
    rest = surface.relaxed_response(0.5)
    assert float(rest.ratio(np.array(0.5))) == close_to(1.0)
