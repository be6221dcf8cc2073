"""The contact's area below the cell size, where counting cells would be off by a per cent.

The exact area of a creeping ball follows from eq. 16 of Spinu & Cerlinca (2018), a³ = 3 R W J(t)/4,
on circles whose centre lies anywhere between the cells. A held soft solid is the hard case: its
surface has crept far beyond what the pressure of now would cause, so an estimate that takes the gap
for elastic with the instantaneous modulus misses the rim. The orders of other contacts are in
`test_order_of_the_rim`.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest

import viscontact as vc
from verification.pressing import BALL, ELASTIC, FORCE, RADIUS, Shifted, grid_around, order

RELAXATION_TIME = 1.0


@dataclass(frozen=True)
class AreaErrors:
    """Relative errors of the area on several meshes."""

    traced: np.ndarray
    counted: np.ndarray


def area_errors(material, times, cells, offsets, *, seed=0):
    """Errors at the last instant under a step load, for so many random places of the centre."""
    rng = np.random.default_rng(seed)
    compliance = float(material.contact_compliance()(times[-1]))
    radius = math.cbrt(0.75 * RADIUS * FORCE * compliance)
    areas = np.array([_areas(material, times, cells, radius, rng) for _ in range(offsets)])
    return AreaErrors(*(areas.T / (math.pi * radius**2) - 1))


def _areas(material, times, cells, radius, rng):
    cells = cells * rng.uniform(0.97, 1.03)
    grid = grid_around((radius, radius), (cells, cells))
    shifted = Shifted(BALL, *(rng.uniform(-0.5, 0.5, 2) * radius / cells))
    load = vc.step(FORCE, tilt_x=0.0, tilt_y=0.0)
    state = list(vc.march(shifted, material, load, grid, times))[-1]
    return state.contact_area, np.count_nonzero(state.pressure) * grid.cell_area


def soft_solid(ratio):
    """A Zener solid that relaxes from M(0) to M(0)/ratio in RELAXATION_TIME; nu = 1/2."""
    stiff = 1e9
    delayed = stiff / (ratio - 1)
    viscosity = RELAXATION_TIME * (stiff + delayed)  # relaxation time eta/(G_1 + G_2)
    return vc.Material(vc.Zener(stiff, delayed, viscosity), poisson_ratio=0.5)


def held(ratio, steps):
    """Instants even in log time, to 100 creep times: a creep time is `ratio` relaxation times."""
    return vc.log_times(0.01, 100 * RELAXATION_TIME * ratio, steps)


def test_traced_area_is_far_better_than_counted_cells():
    """Measured at 15 cells a radius over 40 places: traced 2.5e-4, counted 2.1e-2."""
    errors = area_errors(ELASTIC, [0.0], 15, offsets=12)
    assert abs(errors.traced).max() < 5e-4
    assert abs(errors.counted).max() > 20 * abs(errors.traced).max()


@pytest.mark.parametrize(
    ("cells", "bias", "scatter", "worst"),
    [
        (15, 2e-4, 1.5e-4, 5e-4),  # measured over 40 places: 8.2e-5, 9.3e-5, 2.5e-4
        # Measured: 1.4e-5, 3.3e-5, 9.2e-5.
        pytest.param(28, 5e-5, 5e-5, 1.5e-4, marks=pytest.mark.slow),
    ],
)
def test_area_of_an_elastic_contact(cells, bias, scatter, worst):
    errors = area_errors(ELASTIC, [0.0], cells, offsets=24).traced
    assert abs(errors.mean()) < bias
    assert errors.std() < scatter
    assert abs(errors).max() < worst


@pytest.mark.parametrize(
    ("ratio", "offsets"),
    [(100, 2), *(pytest.param(ratio, 4, marks=pytest.mark.slow) for ratio in (10, 100))],
)
@pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning")  # of pressure
def test_area_of_a_held_soft_solid(ratio, offsets):
    """M(0)/M(inf) = 10 and 100, held until all creep is over: as accurate as an elastic contact."""
    errors = area_errors(soft_solid(ratio), held(ratio, 40), 15, offsets).traced
    assert abs(errors).max() < 5e-4


@pytest.mark.parametrize(
    ("ratio", "offsets"),
    [(10, 2), *(pytest.param(ratio, 4, marks=pytest.mark.slow) for ratio in (10, 100))],
)
@pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning")  # of pressure
@pytest.mark.filterwarnings("ignore:only:viscontact.AccuracyWarning")  # few cells, on purpose
def test_area_of_a_held_soft_solid_is_of_second_order(ratio, offsets):
    """Mean errors measured, for both ratios: 4.7e-4, 1.3e-4, 9.3e-6."""
    cells = np.array([8, 14, 24])
    errors = [
        abs(area_errors(soft_solid(ratio), held(ratio, 40), n, offsets).traced).mean()
        for n in cells
    ]
    assert order(1 / cells, errors) > 1.8
    assert errors[-1] < 8e-5


@pytest.mark.parametrize(
    ("ratio", "offsets"),
    [(10, 1), *(pytest.param(ratio, 2, marks=pytest.mark.slow) for ratio in (10, 100))],
)
def test_area_of_a_soft_solid_held_for_100_relaxation_times(ratio, offsets):
    """The other reading of a long hold: with M(0)/M(inf) = 100 the contact then still grows.

    Steps of half a relaxation time: fine enough for the pressure at the rim, which newly touched
    surface enters at the instantaneous stiffness. Measured: 1.8e-4 at most for both.
    """
    times = vc.uniform_times(100 * RELAXATION_TIME, 200)
    errors = area_errors(soft_solid(ratio), times, 15, offsets).traced
    assert abs(errors).max() < 5e-4


@pytest.mark.slow
@pytest.mark.parametrize("cells", [15, 28])
@pytest.mark.parametrize("ratio", [10, 100])
@pytest.mark.filterwarnings("ignore:a time step:viscontact.AccuracyWarning")  # of pressure
def test_bias_and_scatter_of_a_held_soft_solid(ratio, cells):
    """As above over 12 places: bias and scatter."""
    errors = area_errors(soft_solid(ratio), held(ratio, 40), cells, offsets=12).traced
    assert abs(errors.mean()) < 2e-4
    assert errors.std() < 1.5e-4
    assert abs(errors).max() < 5e-4


def test_area_does_not_suffer_from_steps_long_against_the_relaxation():
    """M(0)/M(inf) = 100, 100 relaxation times in 40 steps even in log time.

    A pressure linear over such steps rings at the rim and opens holes: 3 % of area.
    """
    times = vc.log_times(0.01, 100 * RELAXATION_TIME, 40)
    errors = area_errors(soft_solid(100), times, 15, offsets=2).traced
    assert abs(errors).max() < 5e-4
