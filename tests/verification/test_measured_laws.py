"""Tables sampled from a series: what the series gives, exactly where there are rows.

While the contact grows under a sudden force, approach and area depend on J(t) alone, in closed form
(Lee & Radok 1960, J. Appl. Mech. 27, 438, for a sphere; by correspondence for any shape). So what a
table has between its rows, and how the past is remembered, must not show at the rows.
"""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from verification.creeping_bodies import creep_series, relaxation_series
from verification.indenting import deviation
from verification.pressing import BALL, FORCE, RADIUS, grid_around, order, over_time
from viscontact import reference

TOLERANCE = 1e-9


def marched(material, load, radius, times, cells=14.3):
    grid = grid_around((radius, radius), (cells, cells), margin=1.2, odd=True)
    return list(vc.march(BALL, material, load, grid, times, tolerance=TOLERANCE))


def rows(each_decade, first=0.01, decades=6):
    return np.append(0.0, first * np.logspace(0, decades, each_decade * decades + 1))


def table_of(body, times):
    return vc.Material(vc.TabulatedCreep(times, body.creep(times) / 0.62), 0.38)


def largest(body, end):
    return np.cbrt(0.75 * RADIUS * FORCE * body.creep(np.array([end]))[0])


@pytest.mark.parametrize("indenter", ["ball", "roller"])
def test_at_the_rows_of_a_creep_table_the_series_answers(indenter):
    """Four rows a decade, far too few for the curve between. Measured: 2e-9, the solver's."""
    body, times = creep_series(), rows(4)
    if indenter == "ball":
        shape, load = BALL, vc.step(FORCE)
        grid = grid_around((largest(body, times[-1]),) * 2, (12.3, 12.3), margin=1.2)
    else:
        shape, load = vc.Roller(5e-3, 9.565e-3, 75e-3), vc.step(3e3, eccentricity_x=4e-3)
        grid = vc.Grid((48, 32), (44e-3, 3.2e-3))
    series, table = (
        list(vc.march(shape, material, load, grid, times[:-1], tolerance=TOLERANCE))
        for material in (body.material, table_of(body, times))
    )
    for name in ("approach", "tilt_x", "contact_area", "contact_length"):
        found, exact = over_time(table, name), over_time(series, name)
        np.testing.assert_allclose(found, exact, rtol=1e-7, atol=1e-11)
    # The pressure remembers what was between: it does show the table.
    pressures = [over_time(states, "peak_pressure") for states in (table, series)]
    assert 1e-5 < deviation(*pressures) < 5e-2


@pytest.mark.parametrize(
    ("densities", "instants"),
    [([4, 8], 24), pytest.param([4, 8, 16], 48, marks=pytest.mark.slow)],
)
def test_between_the_rows_the_answer_is_as_good_as_the_interpolation(densities, instants):
    """Approach goes with J^(2/3); pressure with the error of J, twice at most.

    Measured at 4, 8, 16 rows a decade: J within 7e-3, 1.1e-3, 2e-4.
    """
    body, errors = creep_series(), []
    times = np.append(0.0, np.geomspace(0.03, 3e3, instants))
    radius = largest(body, times[-1])
    series = marched(body.material, vc.step(FORCE), radius, times)
    between = np.geomspace(0.01, 3e3, 1000)
    for density in densities:
        material = table_of(body, rows(density))
        curve = material.contact_compliance()
        in_law = np.abs(curve(between) / body.creep(between) - 1).max()
        states = marched(material, vc.step(FORCE), radius, times)
        ratio = over_time(states, "approach") / over_time(series, "approach")
        expected = (curve(times) / body.creep(times)) ** (2 / 3)
        np.testing.assert_allclose(ratio, expected, rtol=1e-2 * in_law)  # a mesh's own
        middle = states[0].pressure.shape[0] // 2
        pressures = [
            np.array([state.pressure[middle, middle] for state in run]) for run in (states, series)
        ]
        assert np.abs(pressures[0] / pressures[1] - 1).max() < 2 * in_law
        errors.append(in_law)
    assert order(1 / np.array(densities), errors) > 2


def test_relaxation_table_answers_for_a_stage_that_is_held():
    """F(t) = (4/3) sqrt(R) w^(3/2) M(t) on a sphere pushed in at once (Lee & Radok 1960).

    In 81 steps, at the rows, 8 a decade, against the series in the same steps: within the error
    that the law itself claims for its interconversion, and the time steps' on both sides.
    """
    body, times = relaxation_series(), rows(8, first=0.01, decades=5)
    law = vc.TabulatedRelaxation(times, body.relaxation(times) * 0.62 / 2)
    depth, instants = 1e-5, np.append(0.0, np.geomspace(0.05, 500.0, 80))
    radius = np.sqrt(RADIUS * depth)
    load = vc.step(approach=depth)
    series, table = (
        over_time(marched(material, load, radius, instants), "force")
        for material in (body.material, vc.Material(law, 0.38))
    )
    exact = 4 / 3 * np.sqrt(RADIUS) * depth**1.5 * body.relaxation(instants)
    assert deviation(series, exact) < 3e-3
    between = np.abs(law.relaxation(instants) / body.material.law.relaxation(instants) - 1).max()
    assert deviation(table, series) < 2 * (between + law.inversion_error)


@pytest.mark.parametrize(
    "steps", [[20, 30, 40], pytest.param([20, 40, 80], marks=pytest.mark.slow)]
)
def test_measured_relaxation_is_what_a_sphere_relaxes_by(steps):
    """At the table's own instants and in fine steps: only mesh and steps are left. Order 2."""
    body, errors = relaxation_series(), []
    end, depth = 300.0, 1e-5
    for n in steps:
        times = end * np.linspace(0, 1, n + 1) ** 2
        law = vc.TabulatedRelaxation(times, body.relaxation(times) * 0.62 / 2)
        states = marched(vc.Material(law, 0.38), vc.step(approach=depth), 3.2e-4, times)
        force = over_time(states, "force")
        errors.append(
            deviation(force / force[0], body.relaxation(times) / body.relaxation(times)[0])
        )
    assert errors[-1] < 1e-3
    assert order(1 / np.array(steps), errors) == close_to(2.0, abs=0.4)


@pytest.mark.slow
def test_ting_on_a_table():
    """Ting (1966) for the series; the table, 12 rows a decade, is a memory of sums of all steps."""
    body, rise, peak = relaxation_series(), 60.0, 1e-5
    exact = reference.ting_hump(
        reference.SphereProfile(RADIUS),
        lambda t: peak * np.minimum(t, 2 * rise - t) / rise,
        rise,
        2 * rise,
        body.relaxation,
    )
    times = vc.uniform_times(2 * rise, 120)
    load = vc.triangle(approach=peak, rise=rise)
    states = marched(table_of(body, rows(12)), load, np.sqrt(RADIUS * peak), times, cells=24.3)
    assert deviation(over_time(states, "force"), exact.force(times)) < 1e-3
