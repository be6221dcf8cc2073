"""Lee and Radok's sphere against closed forms, force balance and the classical integral."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import beta, gamma, hyp1f1

from closeness import close_to
from inverse_pairs import MODULUS, maxwell, power_law, series
from viscontact import reference

FORCE, RADIUS = 10.0, 0.01


ZENER = series(1 / 2e9, [1 / 1e9], [1.5])
# Twelve decades between the relaxation times, a hundred between the moduli.
STIFF = series(1 / 2e9, [1 / 1e9, 1 / 2e7], [2e-6, 3e6])


def integrated_force(contact, t):
    """Integrate the pressure over the contact, between radii reached at many instants.

    They lie decade by decade after each corner of the load, where rings of weak singularity
    sit, and before t, where the rim was just reached. In between, a cubic substitution removes
    square roots at both ends.
    """
    decades = np.append(0.0, np.geomspace(1e-8, 1.0, 6))
    corners = [corner for corner in contact.load.corners if corner <= t]
    instants = [corner + (t - corner) * decades for corner in corners]
    instants += [t - (t - corner) * decades for corner in corners]
    edges = np.unique(np.append(0.0, contact.contact_radius(np.concatenate(instants))))
    nodes, weights = np.polynomial.legendre.leggauss(40)
    u = (nodes + 1) / 2
    low, high = edges[:-1, None], edges[1:, None]
    r = low + (high - low) * u**2 * (3 - 2 * u)
    p = contact.pressure(r, t)
    return np.sum(weights * 3 * u * (1 - u) * (high - low) * 2 * math.pi * r * p)


@pytest.mark.parametrize(
    ("law", "times"),
    [
        (maxwell(3.0), [0.0, 0.1, 3.0, 30.0]),
        (ZENER, [0.0, 1e-6, 1.0, 1e3]),
        (STIFF, [0.0, 1e-6, 1e-2, 1e4, 1e7, 1e9]),
    ],
    ids=["maxwell", "zener", "stiff"],
)
def test_pressure_under_a_step_balances_the_force(law, times):
    """The strictest check of the two callables, the radius and the integral at once."""
    contact = reference.lee_radok_step(FORCE, RADIUS, *law)
    for t in times:
        assert integrated_force(contact, t) == close_to(FORCE, rel=1e-8)


LAWS = {"maxwell": maxwell(3.0), "zener": ZENER, "stiff": STIFF, "power-law": power_law(0.5)}
#: Most laws and instants once; the stiff law is above, under a step.
BY_DEFAULT = {("maxwell", 2.0), ("zener", 2.0001), ("power-law", 2e4)}


@pytest.mark.parametrize(
    ("law", "t"),
    [
        pytest.param(*pair, marks=() if pair in BY_DEFAULT else pytest.mark.slow)
        for pair in itertools.product(LAWS, [2.0, 2.0001, 4.5, 2e4])
    ],
)
def test_pressure_under_a_ramp_balances_the_force(law, t):
    """At the ramp's end, just after it, a while after and ten thousand ramps after."""
    contact = reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *LAWS[law])
    assert contact.force(t) == FORCE
    assert integrated_force(contact, t) == close_to(FORCE, rel=1e-8)


def test_pressure_within_a_ramp_balances_the_force():
    contact = reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *ZENER)
    assert integrated_force(contact, 0.5) == close_to(FORCE / 4, rel=1e-8)


def test_maxwell_central_pressure_follows_its_closed_form():
    """p(0, t) by Kummer's function.

    p = 2 M(0) a0/(pi R) [y^(1/3) - e^-y (c(y) - c(1))], y = 1 + t/tau, where
    c(y), the integral of e^v v^(1/3) from 0, is (3/4) y^(4/3) 1F1(4/3; 7/3; y) (DLMF 13.4.1).
    """
    tau = 3.0
    contact = reference.lee_radok_step(FORCE, RADIUS, *maxwell(tau))
    t = np.array([0.0, 1e-6, 0.1, 1.0, 6.0, 30.0, 90.0])
    y = 1 + t / tau

    def c(v):
        return 0.75 * v ** (4 / 3) * hyp1f1(4 / 3, 7 / 3, v)

    a0 = (0.75 * RADIUS * FORCE / MODULUS) ** (1 / 3)
    exact = 2 * MODULUS * a0 / (math.pi * RADIUS) * (y ** (1 / 3) - np.exp(-y) * (c(y) - c(1.0)))
    np.testing.assert_allclose(contact.pressure(0.0, t), exact, rtol=1e-10)
    np.testing.assert_allclose(contact.contact_radius(t), a0 * y ** (1 / 3), rtol=1e-14)


def test_zener_pressure_follows_the_table_of_the_founding_paper():
    """Table 1, Zener with G_1 and (G_2, eta), nu = 1/2, generalised to G_1 != G_2.

    p = 8 G_1/(pi R) [s(t) - integral (G_1/eta) exp(-(t-t')(G_1+G_2)/eta) s(t') dt'], here by
    SciPy's adaptive quadrature in sqrt(t' - instant of arrival).
    """
    G1, G2, eta = 2e9, 1e9, 3e9
    rate = (G1 + G2) / eta

    def creep(t):
        return 0.25 * (1 / G1 - np.expm1(-t * G2 / eta) / G2)

    def relaxation(t):
        return 4 * G1 * (G2 + G1 * np.exp(-rate * t)) / (G1 + G2)

    contact = reference.lee_radok_step(FORCE, RADIUS, creep, relaxation)
    a0 = float(contact.contact_radius(0.0))

    def by_table(r, t):
        def s(instant):
            square = np.cbrt(0.75 * RADIUS * FORCE * creep(instant)) ** 2 - r**2
            return math.sqrt(max(square, 0.0))

        needed = 16 * r**3 / (3 * RADIUS * FORCE) - 1 / G1
        arrival = -eta / G2 * math.log1p(-G2 * needed) if r > a0 else 0.0

        def integrand(q):
            return 2 * q * math.exp(-(t - arrival - q * q) * rate) * s(arrival + q * q)

        past = quad(integrand, 0, math.sqrt(t - arrival), epsabs=1e-17, epsrel=1e-11)[0]
        return 8 * G1 / (math.pi * RADIUS) * (s(t) - G1 / eta * past)

    for t in [0.01, 1.0, 10.0, 100.0]:
        r = np.append(a0 * np.array([0.0, 0.5, 0.999, 1.0]), contact.contact_radius(t * 0.6))
        exact = [by_table(distance, t) for distance in r]
        np.testing.assert_allclose(contact.pressure(r, t), exact, rtol=0, atol=1e-11 * exact[0])


@pytest.mark.parametrize(("exponent", "tolerance"), [(0.2, 1e-11), (0.5, 1e-9), (0.8, 1e-6)])
def test_power_law_under_a_ramp_is_self_similar(exponent, tolerance):
    """a = A t^b with b = (1 + n)/3, so p(0, t) is Euler's beta integral; M(0) is infinite."""
    contact = reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *power_law(exponent))
    t = np.array([1e-6, 0.1, 1.0, 2.0])
    b = (1 + exponent) / 3
    A = (0.75 * RADIUS * FORCE / 2 / MODULUS / (1 + exponent)) ** (1 / 3)
    modulus = MODULUS / (gamma(1 + exponent) * gamma(1 - exponent))
    exact = 2 * modulus * A * b * beta(b, 1 - exponent) / (math.pi * RADIUS) * t ** (b - exponent)
    np.testing.assert_allclose(contact.contact_radius(t), A * t**b, rtol=1e-12)
    np.testing.assert_allclose(contact.pressure(0.0, t), exact, rtol=tolerance)


@pytest.mark.parametrize("t", [0.5, 2.0, 3.0, 2e6])
def test_maxwell_radius_under_a_ramp_follows_its_closed_form(t):
    """a³ = (3RF/4TE) [t + t²/(2 tau)] while loading, (3RF/4E) [1 + (t - T/2)/tau] held."""
    contact = reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *maxwell(3.0))
    factor = (t + t**2 / 6) / 2 if t < 2 else 1 + (t - 1) / 3
    cubed = 0.75 * RADIUS * FORCE / MODULUS * factor
    assert contact.contact_radius(t) ** 3 == close_to(cubed, rel=1e-13)
    assert contact.approach(t) == close_to(cubed ** (2 / 3) / RADIUS, rel=1e-13)


def test_under_a_maxwell_body_the_peak_leaves_the_axis_at_1_54_relaxation_times():
    """From there on it lies at 0.87 of the radius: the integral taken by quadrature elsewhere."""
    contact = reference.lee_radok_step(FORCE, RADIUS, *maxwell(3.0))
    for t, place in ((1.53, 0.0), (1.55, 0.866)):
        radius = contact.contact_radius(3.0 * t)
        r = radius * np.linspace(0.0, 1.0, 501)
        assert r[contact.pressure(r, 3.0 * t).argmax()] / radius == close_to(place, abs=0.01)


def test_elastic_law_gives_hertz():
    sphere = reference.hertz_sphere(FORCE, RADIUS, MODULUS)
    law = (lambda t: 1 / MODULUS), (lambda t: MODULUS)
    r = sphere.contact_radius * np.array([0.0, 0.3, 0.8, 0.999, 1.001, 1.2])
    for contact, t in [
        (reference.lee_radok_step(FORCE, RADIUS, *law), 0.0),
        (reference.lee_radok_step(FORCE, RADIUS, *law), 7.0),
        (reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *law), 7.0),
    ]:
        assert contact.contact_radius(t) == close_to(sphere.contact_radius, rel=1e-14)
        assert contact.approach(t) == close_to(sphere.approach, rel=1e-14)
        close = 1e-12 * sphere.peak_pressure
        np.testing.assert_allclose(contact.pressure(r, t), sphere.pressure(r), rtol=0, atol=close)


@pytest.mark.parametrize("load", ["step", "ramp"])
def test_a_solid_held_for_ever_is_hertz_with_its_final_compliance(load):
    contact = (
        reference.lee_radok_step(FORCE, RADIUS, *ZENER)
        if load == "step"
        else reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *ZENER)
    )
    sphere = reference.hertz_sphere(FORCE, RADIUS, 1 / (1 / 2e9 + 1 / 1e9))
    r = sphere.contact_radius * np.linspace(0, 0.99, 12)
    assert contact.contact_radius(1e6) == close_to(sphere.contact_radius, rel=1e-13)
    np.testing.assert_allclose(contact.pressure(r, 1e6), sphere.pressure(r), rtol=1e-11)


def test_a_short_ramp_tends_to_the_step_in_proportion_to_its_duration():
    step = reference.lee_radok_step(FORCE, RADIUS, *ZENER)
    errors = [
        abs(
            reference.lee_radok_ramp(FORCE, duration, RADIUS, *ZENER).pressure(1e-4, 1.0)
            / step.pressure(1e-4, 1.0)
            - 1
        )
        for duration in [1e-2, 1e-3, 1e-4]
    ]
    orders = np.log10(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 1.0, atol=0.02)


def test_maxwell_pressure_leaves_the_axis_before_twice_its_relaxation_time():
    """Old pressure relaxes at the centre while the growing rim is freshly loaded."""
    contact = reference.lee_radok_step(FORCE, RADIUS, *maxwell(1.0))
    r = contact.contact_radius(0.0) * np.linspace(0, 1.4, 141)
    assert np.argmax(contact.pressure(r, 1.0)) == 0
    assert r[np.argmax(contact.pressure(r, 2.0))] > contact.contact_radius(0.0)


@settings(max_examples=10, deadline=None)
@given(softer=st.floats(1e-3, 1e3), slower=st.floats(1e-6, 1e6), t=st.floats(1e-6, 100.0))
def test_softer_and_slower_laws_scale(softer, slower, t):
    """J(t) -> c J(t/d) with F -> F/c: same contact at time d t, pressure divided by c."""
    creep, relaxation = ZENER
    contact = reference.lee_radok_ramp(FORCE, 2.0, RADIUS, creep, relaxation)
    scaled = reference.lee_radok_ramp(
        FORCE / softer,
        2.0 * slower,
        RADIUS,
        lambda t: softer * creep(t / slower),
        lambda t: relaxation(t / slower) / softer,
    )
    a = contact.contact_radius(t)
    r = a * np.array([0.0, 0.4, 0.8])
    assert scaled.contact_radius(t * slower) == close_to(a, rel=1e-12)
    p = contact.pressure(r, t)
    np.testing.assert_allclose(scaled.pressure(r, t * slower) * softer, p, rtol=1e-10)


def test_scalars_give_scalars_and_arrays_broadcast():
    contact = reference.lee_radok_step(FORCE, RADIUS, *ZENER)
    values = [contact.force(1.0), contact.contact_radius(1.0), contact.pressure(0.0, 1.0)]
    assert all(np.isscalar(value) for value in values)
    assert np.isscalar(contact.approach(1.0))
    table = contact.pressure(np.linspace(0, 1e-4, 30)[:, None], np.array([0.0, 1.0, 2.0]))
    assert table.shape == (30, 3)
    assert table[7, 2] == contact.pressure(np.linspace(0, 1e-4, 30)[7], 2.0)
    assert contact.pressure(1e-2, 1.0) == 0.0


def test_contact_of_a_ramp_starts_from_nothing():
    contact = reference.lee_radok_ramp(FORCE, 2.0, RADIUS, *power_law(0.5))
    assert contact.contact_radius(0.0) == 0.0
    assert contact.pressure(0.0, 0.0) == 0.0


def recovering(t):
    """A "compliance" that falls."""
    return (1 + np.exp(-t)) / MODULUS


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: reference.lee_radok_step(0.0, RADIUS, *ZENER), "^force"),
        (lambda: reference.lee_radok_ramp(FORCE, -1.0, RADIUS, *ZENER), "^duration"),
        (lambda: reference.lee_radok_step(FORCE, RADIUS, *power_law(0.5)), "use lee_radok_ramp"),
        (
            lambda: reference.lee_radok_step(FORCE, RADIUS, ZENER[0], lambda t: 2 * ZENER[1](t)),
            r"J\(0\) M\(0\) = [12]\.",
        ),
        (
            lambda: reference.lee_radok_ramp(
                FORCE, 1.0, RADIUS, lambda t: -np.expm1(-t) / MODULUS, lambda t: MODULUS
            ),
            "impulse",
        ),
        (lambda: reference.lee_radok_step(FORCE, RADIUS, *ZENER).pressure(0.0, -1.0), "^t: "),
        (lambda: reference.lee_radok_step(FORCE, RADIUS, *ZENER).approach(math.nan), "^t: "),
        (
            lambda: reference.lee_radok_ramp(
                FORCE, 0.1, RADIUS, recovering, lambda t: MODULUS / 2
            ).pressure(0.0, 1.0),
            "shrinks before t = 1 s",
        ),
    ],
)
def test_unsuitable_arguments_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
