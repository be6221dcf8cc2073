"""Adhering cylinders, waves and punches, and the edge of a creeping body, against their limits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from viscontact.reference import (
    adhesive_line,
    adhesive_punch,
    adhesive_wave_pressure,
    edge_energy,
    maugis_dugdale,
)

RADIUS, COMPLIANCE, WORK = 1e-3, 1e-6, 0.05
SCALE = np.cbrt(RADIUS**2 * WORK * COMPLIANCE)


def zener(time):
    return 1 - 0.9 * np.exp(-time)


def test_cylinder_of_a_short_range_has_the_line_load_of_jkr():
    # Barquins 1988, Chaudhury et al. 1996: π a²/(4 R J) - sqrt(2 π a w/J).
    line = adhesive_line(RADIUS, COMPLIANCE, WORK, 1e-10)
    for half_width in np.array([0.5, 1.0, 3.0]) * SCALE:
        hertz = math.pi * half_width**2 / (4 * RADIUS * COMPLIANCE)
        pull = math.sqrt(2 * math.pi * half_width * WORK / COMPLIANCE)
        assert line.at_half_width(half_width).line_load == close_to(hertz - pull, rel=1e-5)
    least = -0.75 * np.cbrt(4 * math.pi * WORK**2 * RADIUS / COMPLIANCE)
    assert line.pull_off.line_load == close_to(least, rel=1e-6)


def test_gap_of_a_cylinder_at_the_end_of_its_zone_is_the_range():
    # Displacements of a line load, by quadrature of the pressure 1/2 E*/R sqrt(a² - x²) -
    # (2 σ0/π) arctan sqrt((c² - a²)/(a² - x²)), and -σ0 over the zone (Baney & Hui 1997).
    reach = float(np.cbrt(RADIUS * (WORK * COMPLIANCE) ** 2))
    state = adhesive_line(RADIUS, COMPLIANCE, WORK, reach).at_half_width(1.3 * SCALE)
    a, c, strength = state.half_width, state.zone_half_width, WORK / reach

    def pressure(angle):  # at x = a sin(angle)
        root = a * math.cos(angle)
        pulled = 2 * strength / math.pi * math.atan2(math.sqrt(c**2 - a**2), root)
        return root / (2 * RADIUS * COMPLIANCE) - pulled

    def inside(angle, at):
        x = a * math.sin(angle)
        return pressure(angle) * a * math.cos(angle) * math.log(abs(at**2 - x**2))

    def zone(at):
        def piece(x):
            return x * math.log(abs(x)) - x if x else 0.0

        both = piece(c - at) - piece(a - at) + piece(c + at) - piece(a + at)
        return -strength * both

    def gap(at):
        within = quad(inside, 0.0, math.pi / 2, args=(at,), limit=200)[0]
        sunk = -2 * COMPLIANCE / math.pi * (within + zone(at))
        return at**2 / (2 * RADIUS) + sunk

    assert gap(c) - gap(a * (1 + 1e-9)) == close_to(reach, rel=1e-4)
    load = 2 * quad(lambda t: pressure(t) * a * math.cos(t), 0.0, math.pi / 2)[0]
    assert load - 2 * strength * (c - a) == close_to(state.line_load, rel=1e-6)


def test_long_waves_adhere_like_cylinders():
    # A crest of the waves Δ (1 - cos(2π x/λ)) has the curvature 4 π² Δ/λ².
    wavelength = 3e-2
    height = wavelength**2 / (4 * math.pi**2 * RADIUS)
    mean = adhesive_wave_pressure(SCALE, height, wavelength, COMPLIANCE, WORK)
    alone = adhesive_line(RADIUS, COMPLIANCE, WORK, 1e-10).at_half_width(SCALE).line_load
    assert mean * wavelength == close_to(alone, rel=1e-3)


def test_wave_without_work_is_that_of_westergaard():
    flat = math.pi * 1e-6 / (COMPLIANCE * 1e-3)
    mean = adhesive_wave_pressure(2.5e-4, 1e-6, 1e-3, COMPLIANCE, 1e-12)
    assert mean == close_to(flat / 2, rel=1e-3)


def test_punch_has_the_limits_of_kendall_and_of_its_strength():
    kendall = adhesive_punch(RADIUS, COMPLIANCE, WORK)
    assert kendall == close_to(math.sqrt(8 * math.pi * RADIUS**3 * WORK / COMPLIANCE), rel=1e-12)
    assert adhesive_punch(RADIUS, COMPLIANCE, WORK, 1e-8) == close_to(kendall, rel=1e-4)
    longest = adhesive_punch(RADIUS, COMPLIANCE, WORK, 1e-4)
    assert longest == close_to(math.pi * RADIUS**2 * WORK / 1e-4, rel=1e-12)


def test_punch_is_the_sphere_of_maugis_without_curvature():
    reach = math.sqrt(WORK * COMPLIANCE * RADIUS) / 2
    pull = adhesive_punch(RADIUS, COMPLIANCE, WORK, reach)
    flat = maugis_dugdale(1e6 * RADIUS, COMPLIANCE, WORK, reach)
    # The contact whose cohesive zone ends at the punch's edge, by bisection.
    inner, outer = 0.1 * RADIUS, RADIUS
    for _ in range(60):
        middle = (inner + outer) / 2
        beyond = flat._ratio(middle / flat._length) * middle > RADIUS
        inner, outer = (inner, middle) if beyond else (middle, outer)
    assert -flat.at_radius(inner).force == close_to(pull, rel=1e-4)


def test_edge_releases_the_work_when_slow_and_its_stiffening_more_when_fast():
    assert edge_energy(1e6, zener) == close_to(1.0, rel=1e-4)
    assert edge_energy(1e-7, zener) == close_to(10.0, rel=1e-4)
    energies = [edge_energy(passage, zener) for passage in np.geomspace(1e-4, 1e4, 9)]
    assert energies == sorted(energies, reverse=True)


def test_edge_on_a_power_law_follows_a_power_of_the_speed():
    # j = (t/τ)^n: x^(1 + n) is proportional to T^-n (Persson & Brener 2005).
    fast, slow = (edge_energy(passage, lambda time: time**0.5) for passage in (1e-3, 1e-1))
    assert fast / slow == close_to(100 ** (0.5 / 1.5), rel=1e-6)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: adhesive_line(-1.0, 1.0, 1.0, 1.0), "radius"),
        (lambda: adhesive_punch(1.0, 1.0, 0.0), "work"),
        (lambda: adhesive_wave_pressure(0.6, 1.0, 1.0, 1.0, 1.0), "half_width must be below half"),
        (lambda: edge_energy(0.0, zener), "passage"),
    ],
)
def test_arguments_that_mean_nothing_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
