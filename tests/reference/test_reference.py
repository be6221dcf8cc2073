"""The exact solutions against independent evaluations of what defines them.

Displacements are integrated anew from the pressures with the point-load kernel 1/(pi E* r):
around circles by the complete elliptic integral (Johnson 1985, eq. 3.96), in an ellipse or
under a tilted punch along chords, where the square roots integrate in closed form.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import ellipkm1

from closeness import close_to
from viscontact import reference

MODULUS = 2e9
positive = st.floats(1e-3, 1e3)


def test_waves_in_full_contact_are_pressed_evenly_and_as_the_wave_besides():
    """p = p̄ + p* cos(2π x/λ), Johnson 1985, section 13.2, without tension from p̄ = p* on."""
    wave = reference.WavyContact(3.0, 2.0, wavelength=0.5, amplitude=1e-3)
    x = 0.5 * (np.arange(64) + 0.5) / 64
    assert wave.pressure(x).mean() == close_to(3.0, rel=1e-12)
    assert wave.pressure([0.0, 0.25]) == close_to([5.0, 1.0], rel=1e-12)
    assert wave.peak_pressure == 5.0


def axisymmetric_displacement(pressure, outer, rho):
    """Displacement at rho: ring loads weighted by 4 r K(k)/(pi E* (r + rho))."""

    def ring(angle):
        # r = a sin(angle) takes the square roots out of both rims, that of the punch and Hertz's.
        r = outer * math.sin(angle)
        kernel = ellipkm1(((r - rho) / (r + rho)) ** 2) * 4 * r / (r + rho)
        return float(pressure(r)) * kernel * outer * math.cos(angle)

    peak = math.asin(rho / outer)  # the kernel's logarithm
    parts = [quad(ring, *ends, epsabs=0, epsrel=1e-11) for ends in [(0, peak), (peak, math.pi / 2)]]
    return sum(part for part, _ in parts) / (math.pi * MODULUS)


def disc_integral(integrand, outer):
    """Integral of f(x, y) over a disc, for f with at most an inverse square root at the rim."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    angle = (nodes + 1) * math.pi / 4
    around = np.arange(64)[:, None] * math.pi / 32
    r = outer * np.sin(angle)
    values = integrand(r * np.cos(around), r * np.sin(around)).mean(axis=0) * 2 * math.pi
    return np.sum(weights * math.pi / 4 * outer * np.cos(angle) * r * values)


# Elastic contacts.


def test_pressures_integrate_to_the_force():
    sphere = reference.hertz_sphere(10.0, 0.01, MODULUS)
    punch = reference.flat_punch(10.0, 0.01, MODULUS, eccentricity=0.003)
    cone = reference.cone(10.0, 1.4, MODULUS)
    line = reference.hertz_line(1e5, 0.005, MODULUS)
    ellipse = reference.hertz_elliptical(10.0, 0.5, 0.01, MODULUS)
    a, b = ellipse.semi_axis_x, ellipse.semi_axis_y

    def hypot_pressure(contact):
        return lambda x, y: contact.pressure(np.hypot(x, y))

    assert disc_integral(hypot_pressure(sphere), sphere.contact_radius) == close_to(10, 1e-12)
    assert disc_integral(punch.pressure, punch.contact_radius) == close_to(10, rel=1e-12)
    # The logarithm on the cone's axis limits this quadrature.
    assert disc_integral(hypot_pressure(cone), cone.contact_radius) == close_to(10, rel=1e-6)
    assert a * b * disc_integral(lambda x, y: ellipse.pressure(a * x, b * y), 1.0) == close_to(
        10, rel=1e-12
    )
    width = line.half_width
    assert quad(line.pressure, -width, width)[0] == close_to(1e5, rel=1e-8)


def test_eccentric_punch_pressure_carries_the_moment():
    punch = reference.flat_punch(10.0, 0.01, MODULUS, eccentricity=0.003)
    moment = disc_integral(lambda x, y: punch.pressure(x, y) * x, 0.01)
    assert moment == close_to(10 * 0.003, rel=1e-12)


@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_sphere_pressure_displaces_the_surface_to_the_paraboloid(fraction):
    contact = reference.hertz_sphere(10.0, 0.01, MODULUS)
    rho = fraction * contact.contact_radius
    displacement = axisymmetric_displacement(contact.pressure, contact.contact_radius, rho)
    assert displacement == close_to(contact.approach - rho**2 / 0.02, rel=1e-9)


@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_cone_pressure_displaces_the_surface_to_the_cone(fraction):
    contact = reference.cone(10.0, 1.4, MODULUS)
    rho = fraction * contact.contact_radius
    displacement = axisymmetric_displacement(contact.pressure, contact.contact_radius, rho)
    assert displacement == close_to(contact.approach - rho / math.tan(1.4), rel=1e-9)


@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_central_punch_pressure_displaces_the_surface_evenly(fraction):
    contact = reference.flat_punch(10.0, 0.01, MODULUS)
    displacement = axisymmetric_displacement(contact.pressure, 0.01, fraction * 0.01)
    assert displacement == close_to(contact.approach, rel=1e-9)


def test_eccentric_punch_pressure_displaces_the_surface_to_the_tilted_plane():
    """Along any chord a linear function over sqrt(a² - r²) gives pi times its mid-chord value."""
    contact = reference.flat_punch(10.0, 0.01, MODULUS, eccentricity=0.003)
    x, y = 0.004, -0.007

    def chord(angle):
        along = x * math.cos(angle) + y * math.sin(angle)
        middle_x = x - along * math.cos(angle)
        middle_y = y - along * math.sin(angle)
        edge = math.sqrt(0.01**2 - middle_x**2 - middle_y**2)
        return math.pi * edge * float(contact.pressure(middle_x, middle_y))

    displacement = quad(chord, 0, math.pi, epsrel=1e-12)[0] / (math.pi * MODULUS)
    assert displacement == close_to(contact.approach + contact.tilt_x * x, rel=1e-10)


def elliptical_displacement(contact, x, y):
    """Integrate the half-ellipsoid of pressure along chords through (x, y), scaled to a circle."""
    a, b = contact.semi_axis_x, contact.semi_axis_y

    def chord(angle):
        sine, cosine = math.sin(angle), math.cos(angle)
        return (1 - (x / a * sine - y / b * cosine) ** 2) / math.hypot(a * cosine, b * sine)

    # Slender ellipses: the chords along the long axis make a narrow peak.
    halves = [(0.0, math.pi / 2), (math.pi / 2, math.pi)]
    parts = [quad(chord, *ends, epsrel=1e-12, limit=200)[0] for ends in halves]
    return contact.peak_pressure * a * b / (2 * MODULUS) * sum(parts)


@pytest.mark.parametrize("radius_ratio", [1.0, 1.0001, 10.0, 31623.0, 1e-3])
@pytest.mark.parametrize("place", [(0.0, 0.0), (0.7, 0.2), (-0.1, 0.9)])
def test_elliptical_pressure_displaces_the_surface_to_the_paraboloid(radius_ratio, place):
    """31623 gives axes nearly 1000 times apart."""
    contact = reference.hertz_elliptical(10.0, 0.01 * radius_ratio, 0.01, MODULUS)
    x, y = place[0] * contact.semi_axis_x, place[1] * contact.semi_axis_y
    gap = x**2 / (0.02 * radius_ratio) + y**2 / 0.02
    displacement = elliptical_displacement(contact, x, y)
    assert displacement == close_to(contact.approach - gap, abs=1e-10 * contact.approach)


@pytest.mark.parametrize("difference", [0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-5])
def test_elliptical_contact_tends_to_the_sphere_without_losing_digits(difference):
    sphere = reference.hertz_sphere(10.0, 0.01, MODULUS)
    ellipse = reference.hertz_elliptical(10.0, 0.01 * (1 + difference), 0.01, MODULUS)
    tolerance = abs(difference) + 1e-14
    assert ellipse.semi_axis_x == close_to(sphere.contact_radius, rel=tolerance)
    assert ellipse.semi_axis_y == close_to(sphere.contact_radius, rel=tolerance)
    assert ellipse.approach == close_to(sphere.approach, rel=tolerance)
    assert ellipse.peak_pressure == close_to(sphere.peak_pressure, rel=tolerance)


def test_slender_ellipse_tends_to_the_line_contact():
    """At its middle a long ellipse carries p0 pi b/2 a length.

    What remains falls as ln(kappa)/kappa², the first term of the integrals for small b/a; the
    factor is then the same at every kappa, but for 1/ln(kappa).
    """
    factors = []
    for radius_ratio in [1e3, 1e4, 1e5]:
        ellipse = reference.hertz_elliptical(10.0, 0.01 * radius_ratio, 0.01, MODULUS)
        kappa = ellipse.semi_axis_x / ellipse.semi_axis_y
        force_per_length = math.pi / 2 * ellipse.peak_pressure * ellipse.semi_axis_y
        line = reference.hertz_line(force_per_length, 0.01, MODULUS)
        difference = line.half_width / ellipse.semi_axis_y - 1
        factors.append(difference * kappa**2 / math.log(kappa))
    np.testing.assert_allclose(factors, factors[-1], rtol=0.02)


@given(force=positive, radius_x=positive, radius_y=positive, modulus=positive)
def test_elliptical_contact_turns_with_its_radii(force, radius_x, radius_y, modulus):
    one = reference.hertz_elliptical(force, radius_x, radius_y, modulus)
    other = reference.hertz_elliptical(force, radius_y, radius_x, modulus)
    assert other.semi_axis_x == close_to(one.semi_axis_y, rel=1e-12)
    assert other.approach == close_to(one.approach, rel=1e-12)


@given(scale=positive)
def test_elastic_contact_depends_on_force_over_modulus(scale):
    """E* -> c E* with F -> c F leaves the geometry and multiplies the pressure by c."""
    pairs = [
        (
            reference.hertz_sphere(3.0, 0.01, 2e9),
            reference.hertz_sphere(3 * scale, 0.01, 2e9 * scale),
        ),
        (reference.cone(3.0, 1.0, 2e9), reference.cone(3 * scale, 1.0, 2e9 * scale)),
        (
            reference.flat_punch(3.0, 0.01, 2e9, 0.003),
            reference.flat_punch(3 * scale, 0.01, 2e9 * scale, 0.003),
        ),
    ]
    for one, other in pairs:
        r = one.contact_radius / 3
        assert other.contact_radius == close_to(one.contact_radius, rel=1e-12)
        assert other.approach == close_to(one.approach, rel=1e-12)
        assert other.pressure(r) == close_to(scale * one.pressure(r), rel=1e-12)


def test_pressure_is_zero_outside_and_a_scalar_for_a_scalar():
    ellipse = reference.hertz_elliptical(10.0, 0.05, 0.01, MODULUS)
    for contact in [
        reference.hertz_sphere(10.0, 0.01, MODULUS),
        reference.cone(10.0, 1.0, MODULUS),
        reference.flat_punch(10.0, 0.01, MODULUS),
    ]:
        outside = contact.pressure(1.5 * contact.contact_radius)
        assert np.isscalar(outside)
        assert outside == 0.0
        assert contact.pressure(np.full((2, 3), 1e-6)).shape == (2, 3)
    assert ellipse.pressure(np.zeros((4, 1)), np.ones(5)).shape == (4, 5)
    assert ellipse.pressure(np.zeros((4, 1)), np.ones(5)).max() == 0.0


def test_punch_pressure_at_the_edge_is_infinite_but_where_the_edge_is_about_to_lift():
    punch = reference.flat_punch(10.0, 0.01, MODULUS, eccentricity=0.01 / 3)
    assert punch.pressure(0.01) == math.inf
    assert punch.pressure(-0.01) == 0.0


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: reference.hertz_sphere(-1.0, 0.01, 1e9), "force"),
        (lambda: reference.hertz_sphere(1.0, math.nan, 1e9), "radius"),
        (lambda: reference.hertz_elliptical(1.0, math.inf, 0.01, 1e9), "radius_x"),
        (lambda: reference.hertz_line(1.0, 0.01, 0.0), "contact_modulus"),
        (lambda: reference.cone(1.0, 1.6, 1e9), "half_angle"),
        (lambda: reference.flat_punch(1.0, 0.01, 1e9, 0.0034), "eccentricity.*lifts off"),
        (lambda: reference.flat_punch(1.0, 0.01, 1e9, math.nan), "eccentricity"),
    ],
)
def test_bad_arguments_are_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}"):
        call()
