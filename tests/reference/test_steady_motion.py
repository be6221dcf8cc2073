"""Hunter's cylinder against his equations in 60 digits, and limits of steady motion."""

import mpmath
import pytest

from closeness import close_to
from viscontact.reference import (
    fast_sphere_friction_coefficient,
    hertz_line,
    moving_cylinder,
    slow_friction_coefficient,
)


def in_many_digits(load, radius, instant, delayed, time, speed, near):
    """Half width and friction coefficient from the pressure's equations, with 60 digits.

    The pressure p, zero at both edges, has J(inf) p - l J0 dp/dx = P = (c0 + c1 T1 + c2 T2)(t) /
    sqrt(1 - t^2) over the strip x = m + a t. Load, slope and curvature of the cylinder give the
    coefficients; the unknown a and m follow from p = 0 at the trailing edge and from the slope at
    the leading one, whose memory is ahead. None of it is simplified.
    """
    with mpmath.workdps(60):
        load, radius, instant, delayed, time, speed = map(
            mpmath.mpf, (load, radius, instant, delayed, time, speed)
        )
        length, relaxed = speed * time, instant + delayed

        def offset_and_slope(a):
            kappa, zeta = a * relaxed / (length * instant), a / length
            c0, c2 = relaxed * load / (mpmath.pi * a), -a / (4 * radius)
            i0, i1, i2 = (mpmath.besseli(n, kappa) for n in range(3))
            k0, k1, k2 = (mpmath.besselk(n, zeta) for n in range(3))
            c1 = (c0 * i0 + c2 * i2) / i1
            m, decay = length - 2 * radius * c1, mpmath.exp(-zeta)
            ahead = c0 * k0 + c1 * (k1 - decay / zeta)
            ahead += c2 * (k2 - 2 * decay * (1 / zeta + 1 / zeta**2))
            return m, 2 * zeta * ahead / decay * radius / a - (m + a) / a

        around = [mpmath.mpf(near) * (1 + sign * mpmath.mpf(10) ** -9) for sign in (-1, 1)]
        a = mpmath.findroot(lambda a: offset_and_slope(a)[1], around, tol=1e-40)
        m = offset_and_slope(a)[0]
        # First moment of p over the strip, from the same equation times t.
        moment = mpmath.pi / 2 * (length - m) / (2 * radius) * a**2 - length * instant * load
        return a, m, (m * load + moment / relaxed) / (load * radius)


@pytest.mark.parametrize(
    ("ratio", "speed"),
    [
        pytest.param(ratio, speed, marks=[pytest.mark.slow] * ((ratio, speed) == (10, 1e-3)))
        for ratio in (2, 10, 1000)
        for speed in (1e-3, 0.1, 1.0, 1e3)
    ],
)
def test_the_cylinder_is_hunters(ratio, speed):
    """Speeds V tau/a from 1e-3 to 1e3, where Hunter's form loses up to 12 digits."""
    arguments = (10.0, 10.0, 1 / 2000, (ratio - 1) / 2000, float(ratio), speed)
    found = moving_cylinder(*arguments)
    a, m, mu = in_many_digits(*arguments, found.half_width)
    assert found.half_width == close_to(float(a), rel=1e-12)
    assert found.offset == close_to(float(m), rel=1e-10)
    assert found.friction_coefficient == close_to(float(mu), rel=1e-11)


def test_at_both_ends_of_speed_the_cylinder_is_that_of_hertz():
    for speed, compliance in ((1e-9, 10 / 2000), (1e9, 1 / 2000)):
        found = moving_cylinder(10.0, 10.0, 1 / 2000, 9 / 2000, 10.0, speed)
        elastic = hertz_line(10.0, 10.0, 1 / compliance)
        assert found.half_width == close_to(elastic.half_width, rel=1e-7)


def test_slow_friction_is_that_of_the_cylinder():
    slow = moving_cylinder(10.0, 10.0, 1 / 2000, 9 / 2000, 10.0, 1e-6).friction_coefficient
    # The next term is of the order V lambda/a, 1e-5 here.
    assert slow == close_to(slow_friction_coefficient(10.0, 9.0, 1e-6), rel=2e-5)


def test_fast_friction_falls_as_one_over_speed():
    at = [fast_sphere_friction_coefficient(10.0, 10.0, 5e-4, 4.5e-4, v) for v in (10.0, 40.0)]
    assert at[0] == close_to(4 * at[1])


def test_a_speed_of_zero_is_refused():
    with pytest.raises(ValueError, match="speed"):
        moving_cylinder(10.0, 10.0, 1 / 2000, 9 / 2000, 10.0, 0.0)
