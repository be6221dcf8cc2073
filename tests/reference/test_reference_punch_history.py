"""Histories of a flat punch against Boltzmann's superposition."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from inverse_pairs import series
from viscontact import reference

PUNCH = reference.PunchProfile(0.002)
TERMS = (1 / 2e9, [1 / 2e9, 1 / 1e9], [0.2, 3.0])
BROAD = series(*TERMS)[0]


def test_punch_under_a_staircase_follows_superposition():
    instants, forces = np.array([0.0, 1.0, 2.5]), np.array([10.0, 3.0, 8.0])
    t = np.repeat([0.0, 0.7, 1.0, 1.8, 2.5, 4.0], [1, 1, 2, 1, 2, 1])
    load = np.array([10.0, 10.0, 10.0, 3.0, 3.0, 3.0, 8.0, 8.0])
    contact = reference.press_axisymmetric(PUNCH, t, force=load, creep_compliance=BROAD)
    exact = reference.punch_staircase(t, instants, forces, 0.002, BROAD)
    after = np.append(np.diff(t) > 0, True)
    np.testing.assert_allclose(contact.approach[after], exact[after], rtol=1e-12)
    np.testing.assert_array_equal(contact.contact_radius, 0.002)
    p = reference.flat_punch(8.0, 0.002, 2e9)
    assert contact.pressure(1e-3, 4.0) == close_to(p.pressure(1e-3), rel=1e-12)


@pytest.mark.slow
def test_punch_oscillates_under_a_force_by_its_complex_compliance():
    omega, cycles, n = 2 * math.pi / 1.3, 9, 60
    t = np.linspace(0, cycles * 1.3, cycles * n + 1)
    contact = reference.press_axisymmetric(
        PUNCH, t, force=10 + 4 * np.sin(omega * t), creep_compliance=BROAD
    )
    exact = reference.punch_harmonic_start(t, 10.0, 4.0, omega, 0.002, *TERMS)
    np.testing.assert_allclose(contact.approach, exact, atol=5e-4 * exact.max())
    steady = reference.punch_harmonic(
        0.002, reference.series_complex_compliance(omega, *TERMS), force_amplitude=4.0
    )
    # By the formula, a hundred retardation times later.
    late = 300 * 1.3 + t[:n]
    response = reference.punch_harmonic_start(late, 10.0, 4.0, omega, 0.002, *TERMS)
    turned = 2j / n * response @ np.exp(-1j * omega * late)
    assert abs(turned) == close_to(steady.approach_amplitude, rel=1e-12)
    assert -np.angle(turned) == close_to(steady.phase_lag, rel=1e-10)
    # By the march, when the creep has almost faded.
    loss = contact.work[-1] - contact.work[-n - 1]
    # The mean force works on what is left of the creep, so that is taken out.
    drift = 10.0 * (contact.approach[-1] - contact.approach[-n - 1])
    assert loss - drift == close_to(steady.loss_per_cycle, rel=3e-3)


def test_loss_is_the_area_of_the_loop_whichever_amplitude_is_given():
    compliance = reference.series_complex_compliance(2.0, *TERMS, fluidity=1e-10)
    steady = reference.punch_harmonic(0.002, compliance, force_amplitude=4.0)
    angle = np.linspace(0, 2 * math.pi, 100, endpoint=False)
    rate = steady.approach_amplitude * np.cos(angle - steady.phase_lag)
    area = 2 * math.pi * np.mean(4.0 * np.sin(angle) * rate)
    assert steady.loss_per_cycle == close_to(area, rel=1e-12)
    same = reference.punch_harmonic(0.002, compliance, approach_amplitude=steady.approach_amplitude)
    assert same.force_amplitude == close_to(4.0, rel=1e-14)
    assert same.loss_per_cycle == close_to(steady.loss_per_cycle, rel=1e-13)


@pytest.mark.parametrize("omega", [0.1, 2.0, 50.0])
def test_complex_compliance_is_the_transform_of_the_creep(omega):
    """J* = J(0) + integral of J'(t) exp(-i omega t), flow apart (Ferry 1980, chapter 3)."""
    rates = [a / tau for a, tau in zip(*TERMS[1:], strict=True)]

    def transform(part):
        def integrand(t):
            slope = sum(r * math.exp(-t / tau) for r, tau in zip(rates, TERMS[2], strict=True))
            return slope * part(omega * t)

        return sum(quad(integrand, a, a + 0.1, epsabs=0)[0] for a in np.arange(0, 100, 0.1))

    exact = TERMS[0] + transform(math.cos) - 1j * transform(math.sin)
    assert reference.series_complex_compliance(omega, *TERMS) == close_to(exact, rel=1e-9)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: reference.punch_harmonic(0.0, 1e-9, force_amplitude=1.0), "radius"),
        (lambda: reference.punch_harmonic(1.0, 1e-9 + 1e-9j, force_amplitude=1.0), "complex"),
        (lambda: reference.punch_harmonic(1.0, 1e-9), "punch_harmonic"),
        (lambda: reference.punch_harmonic(1.0, 1e-9, approach_amplitude=-1.0), "approach_amp"),
        (lambda: reference.series_complex_compliance(0.0, 1e-9), "angular_frequency"),
        (lambda: reference.punch_harmonic_start(1.0, 1.0, 1.0, -1.0, 1.0, 1.0), "angular_freq"),
        (lambda: reference.punch_staircase(0.0, [1.0, 0.0], [1.0, 1.0], 1.0, BROAD), "jump_times"),
        (lambda: reference.punch_staircase(0.0, [0.0], [-1.0], 1.0, BROAD), "forces"),
    ],
)
def test_bad_arguments_are_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}"):
        call()
