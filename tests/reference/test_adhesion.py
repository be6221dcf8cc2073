"""Adhering spheres: JKR and Maugis-Dugdale against their limits and published numbers."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.reference import jkr_sphere, maugis_dugdale, tabor_number

RADIUS, COMPLIANCE, WORK = 2e-6, 3e-7, 0.04
FORCE = np.pi * WORK * RADIUS
MODULUS = 4 / (3 * COMPLIANCE)
DEPTH = np.cbrt((np.pi * WORK / MODULUS) ** 2 * RADIUS)
RANGE_OF_1 = np.cbrt(RADIUS * (WORK * COMPLIANCE) ** 2)


def sphere(tabor):
    return maugis_dugdale(RADIUS, COMPLIANCE, WORK, RANGE_OF_1 / tabor)


def test_jkr_pull_off_is_three_halves_under_force_and_five_sixths_under_approach():
    # Johnson, Kendall & Roberts 1971, eq. 24; Maugis 1992, section 5.
    jkr = jkr_sphere(RADIUS, COMPLIANCE, WORK)
    assert jkr.pull_off.force == close_to(-1.5 * FORCE, rel=1e-7)
    assert jkr.last.force == close_to(-5 / 6 * FORCE, rel=1e-6)


def test_jkr_without_load_has_the_radius_of_zero_apparent_load():
    # a³ = 6 π w R²/K (Johnson, Kendall & Roberts 1971, eq. 23).
    radius = np.cbrt(6 * np.pi * WORK * RADIUS**2 / MODULUS)
    state = jkr_sphere(RADIUS, COMPLIANCE, WORK).at_radius(radius)
    assert abs(state.force) < 1e-12 * FORCE


def test_long_zones_are_dmt_and_short_ones_jkr():
    # Maugis 1992: 2 π w R as λ -> 0 and 3/2 π w R as λ -> inf.
    assert sphere(0.01).pull_off.force == close_to(-2 * FORCE, rel=5e-3)
    assert sphere(30.0).pull_off.force == close_to(-1.5 * FORCE, rel=2e-3)
    approach = 0.7 * DEPTH
    jkr = jkr_sphere(RADIUS, COMPLIANCE, WORK).at_approach(approach)
    assert sphere(30.0).at_approach(approach).force == close_to(jkr.force, rel=5e-3)


@pytest.mark.parametrize("tabor", [0.1, 1.0, 5.0])
def test_state_of_an_approach_is_that_of_its_radius(tabor):
    one = sphere(tabor)
    for radius in np.array([1.9, 2.2, 2.5]) * np.cbrt(np.pi * WORK * RADIUS**2 / MODULUS):
        state = one.at_radius(radius)
        back = one.at_approach(state.approach)
        assert back.contact_radius == close_to(radius, rel=1e-8)
        assert back.force == close_to(state.force, rel=1e-6)


def test_tabor_number_is_that_of_maugis_over_1_1273():
    # λ = 2 σ0 (R/(π w K²))^(1/3) (Maugis 1992, eq. 6.12).
    reach = 0.3 * RANGE_OF_1
    maugis = 2 * WORK / reach * np.cbrt(RADIUS / (np.pi * WORK * MODULUS**2))
    number = tabor_number(RADIUS, COMPLIANCE, WORK, reach)
    assert number == close_to(1 / 0.3, rel=1e-12)
    assert maugis == close_to(1.127252 * number, rel=1e-6)


def test_approach_beyond_the_last_state_is_refused():
    jkr = jkr_sphere(RADIUS, COMPLIANCE, WORK)
    with pytest.raises(ValueError, match="approach must be above"):
        jkr.at_approach(1.01 * jkr.last.approach)


@pytest.mark.parametrize("name", ["radius", "compliance", "work"])
def test_arguments_that_are_not_positive_are_refused(name):
    given = {"radius": RADIUS, "compliance": COMPLIANCE, "work": WORK} | {name: 0.0}
    with pytest.raises(ValueError, match=name):
        jkr_sphere(**given)
