"""Ting's closed forms against each other, elastic limits and quadrature of what defines them."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from closeness import close_to
from viscontact import reference

SPHERE, CONE = reference.SphereProfile(0.01), reference.ConeProfile(1.4)
both = pytest.mark.parametrize("profile", [SPHERE, CONE], ids=["sphere", "cone"])


def test_profiles_transform_the_gap():
    """g(s) = s integral of f'(r)/sqrt(s² - r²) over r < s (Sneddon 1965), r = s sin(angle)."""
    s = 3e-3
    slopes = [(SPHERE, lambda r: r / 0.01), (CONE, lambda r: 1 / math.tan(1.4))]
    for profile, slope in slopes:
        exact = s * quad(lambda x, f=slope: f(s * math.sin(x)), 0, math.pi / 2)[0]
        assert float(profile.depth(np.array(s))) == close_to(exact, rel=1e-12)
        assert float(profile.reach(np.array(exact))) == close_to(s, rel=1e-12)
        swept = quad(lambda x, p=profile: float(p.depth(np.array(x))), 0, s)[0]
        assert float(profile.depth_integral(np.array(s))) == close_to(swept, rel=1e-12)


@both
def test_profile_integrals_are_those_of_quadrature(profile):
    s, r = 3e-3, 2e-3
    h = 1e-9

    def rate(x):
        ends = profile.depth(np.array([x - h, x + h]))
        return (ends[1] - ends[0]) / (2 * h)

    outer = quad(lambda x: rate(math.hypot(r, x)) / math.hypot(r, x), 0, math.sqrt(s**2 - r**2))[0]
    assert float(profile.outer_integral(np.array(s), np.array(r))) == close_to(outer, rel=1e-6)
    inner = quad(lambda x: float(profile.depth(np.array(s * math.sin(x)))), 0, math.asin(r / s))[0]
    assert float(profile.inner_integral(np.array(r), np.array(s))) == close_to(inner, rel=1e-10)


@both
@pytest.mark.parametrize("t", [0.3, 1.0, 1.2, 1.45])
def test_triangle_force_is_the_integral_over_the_rods(profile, t):
    """F = 2 integral of chi ds, chi = integral of M(t - t') dw from touch to now (Ting 1966)."""
    contact = reference.ting_triangle(profile, 1e-5, 1.0, 3e8, [2e9, 1e9], [1.0, 0.1])

    def modulus(lag):
        return 3e8 + 2e9 * math.exp(-lag) + 1e9 * math.exp(-lag / 0.1)

    def chi(touched):
        way_in = quad(lambda x: modulus(t - x), touched, min(t, 1.0), epsabs=0, epsrel=1e-12)[0]
        return way_in - (quad(lambda x: modulus(t - x), 1.0, t, epsrel=1e-12)[0] if t > 1 else 0)

    last = min(t, 1.0) if t <= 1 else brentq(chi, 0.0, 1.0, xtol=1e-15)
    assert float(contact.earlier(t)) == close_to(last, rel=1e-9)
    edge = float(profile.reach(np.array(1e-5 * last)))
    force = 2e-5 * quad(lambda s: chi(float(profile.depth(np.array(s))) / 1e-5), 0, edge)[0]
    assert float(contact.force(t)) == close_to(force, rel=1e-8)


def test_maxwell_triangle_is_lost_at_the_logarithm():
    contact = reference.ting_triangle(SPHERE, 1e-5, 3.0, 0.0, [2e9], [2.0])
    assert contact.lost == close_to(2 * math.log(2 * math.exp(1.5) - 1), rel=1e-12)
    assert contact.force(contact.lost + 1e-6) == 0.0


@both
def test_elastic_triangle_has_no_hysteresis(profile):
    contact = reference.ting_triangle(profile, 1e-5, 1.0, 2e9)
    assert contact.lost == 2.0
    there, back = np.array([0.2, 0.7, 1.0]), np.array([1.8, 1.3, 1.0])
    np.testing.assert_allclose(contact.force(back), contact.force(there), rtol=1e-12)
    force = contact.force(1.0)
    elastic = (
        reference.hertz_sphere(force, 0.01, 2e9)
        if profile is SPHERE
        else reference.cone(force, 1.4, 2e9)
    )
    assert elastic.approach == close_to(1e-5, rel=1e-12)
    assert elastic.contact_radius == close_to(contact.contact_radius(1.0), rel=1e-12)


@both
def test_hump_by_quadrature_meets_the_triangle_in_closed_form(profile):
    exact = reference.ting_triangle(profile, 1e-5, 1.0, 3e8, [2e9, 1e9], [1.0, 0.1])
    hump = reference.ting_hump(
        profile,
        exact.approach,
        1.0,
        2.0,
        lambda t: 3e8 + 2e9 * np.exp(-t) + 1e9 * np.exp(-10 * t),
    )
    t = np.linspace(0, 1.9, 39)
    np.testing.assert_allclose(hump.force(t), exact.force(t), atol=1e-11 * exact.force(1.0))
    np.testing.assert_allclose(hump.contact_radius(t), exact.contact_radius(t), atol=1e-12)
    assert hump.lost == close_to(exact.lost, rel=1e-12)


@pytest.mark.parametrize("rise", [0.5, 3.0], ids=["fast", "slow"])
def test_force_triangle_fulfils_tings_two_equations(rise):
    """F = integral of M d(4a³/(3R)) up to t_1, and 0 = integral of M dw from t_1 to t."""
    contact = reference.ting_force_triangle(10.0, rise, 0.01, 2e9, 1.0)
    t = contact.widest + 0.6 * (2 * rise - contact.widest)
    earlier = float(contact.earlier(t))
    assert contact.contact_radius(t) == close_to(contact.contact_radius(earlier), rel=1e-12)

    def load(quantity, begin, end):
        """Integrate exp(t') dq(t') by parts, with the cube of a variable against the root at 0."""
        rest = quad(
            lambda x: 3 * x**2 * math.exp(x**3) * float(quantity(x**3)),
            begin ** (1 / 3),
            end ** (1 / 3),
            points=[rise ** (1 / 3)] if begin < rise < end else None,
            epsabs=0,
            epsrel=1e-11,
        )[0]
        return math.exp(end) * quantity(end) - math.exp(begin) * quantity(begin) - rest

    force = 2e9 * 4 / 0.03 * load(lambda x: contact.contact_radius(x) ** 3, 0.0, earlier)
    assert force * math.exp(-t) == close_to(contact.force(t), rel=1e-9)
    there = load(contact.approach, earlier, contact.widest)
    back = load(contact.approach, contact.widest, t)
    assert there == close_to(-back, rel=1e-7)


def test_first_of_the_cycles_is_the_triangle():
    cycles = reference.ting_cycles(SPHERE, 1e-5, 1.0, 2e9, 0.7)
    triangle = reference.ting_triangle(SPHERE, 1e-5, 1.0, 0.0, [2e9], [0.7])
    t = np.linspace(0.01, 1.9, 30)
    np.testing.assert_allclose(cycles.force(t), triangle.force(t), atol=1e-12)
    np.testing.assert_allclose(cycles.contact_radius(t), triangle.contact_radius(t), atol=1e-15)
    assert cycles.lost(0) == close_to(triangle.lost, rel=1e-14)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: reference.SphereProfile(0.0), "radius"),
        (lambda: reference.ConeProfile(1.6), "half_angle"),
        (lambda: reference.PunchProfile(-1.0), "radius"),
        (lambda: reference.ting_triangle(SPHERE, 1e-5, 1.0, 0.0, [2e9], []), "moduli"),
        (lambda: reference.ting_triangle(SPHERE, 1e-5, 1.0, 0.0), "moduli"),
        (lambda: reference.ting_hump(SPHERE, np.cos, 1.0, 2.0, np.exp), "approach"),
        (lambda: reference.ting_hump(SPHERE, np.sin, 2.0, 1.0, np.exp), "end"),
        (lambda: reference.ting_force_triangle(1.0, 1.0, 1.0, 0.0, 1.0), "modulus"),
        (lambda: reference.ting_cycles(SPHERE, 1.0, 1.0, 1.0, math.inf), "relaxation_time"),
    ],
)
def test_bad_arguments_are_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}"):
        call()
