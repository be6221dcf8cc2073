"""Indentation by any history against Hertz, Lee and Radok, and Ting."""

import math

import numpy as np
import pytest

from closeness import close_to
from inverse_pairs import maxwell, power_law, series
from viscontact import reference

SPHERE, CONE = reference.SphereProfile(0.01), reference.ConeProfile(1.4)
PUNCH = reference.PunchProfile(0.002)
MAXWELL = maxwell(1.0)[0]
ZENER, ZENER_MODULUS = series(1 / 2e9, [1 / 1e9], [1.5])
BROAD, BROAD_MODULUS = series(1 / 2e9, [1 / 2e9, 1 / 1e9], [0.2, 3.0])


def elastic(t):
    return np.full_like(t, 1 / 2e9)


def worst(ours, exact):
    """Largest difference relative to the largest value."""
    return float(np.abs(ours - exact).max() / np.abs(exact).max())


def orders(errors):
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))


# The elastic limit.


@pytest.mark.parametrize("profile", [SPHERE, CONE], ids=["sphere", "cone"])
@pytest.mark.parametrize("control", ["force", "approach"])
def test_elastic_body_follows_hertz_and_sneddon_both_ways(profile, control):
    force = np.array([0.0, 2.0, 10.0, 7.0, 0.0, 3.0, 20.0])
    solved = [
        (reference.hertz_sphere(f, 0.01, 2e9) if profile is SPHERE else reference.cone(f, 1.4, 2e9))
        for f in force[force > 0]
    ]
    approach, radius = np.zeros(7), np.zeros(7)
    approach[force > 0] = [contact.approach for contact in solved]
    radius[force > 0] = [contact.contact_radius for contact in solved]
    load = {control: force if control == "force" else approach}
    contact = reference.press_axisymmetric(
        profile, np.arange(7.0), creep_compliance=elastic, elements=30, **load
    )
    np.testing.assert_allclose(contact.force, force, atol=1e-10)
    np.testing.assert_allclose(contact.approach, approach, atol=1e-16)
    np.testing.assert_allclose(contact.contact_radius, radius, atol=1e-13)
    r = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.01, 1.2]) * radius[2]
    np.testing.assert_allclose(contact.pressure(r, 2.0), solved[1].pressure(r), rtol=1e-9)


def test_elastic_surface_springs_back_to_that_of_the_lesser_force():
    """Around the contact u = [(2 a² - r²) asin(a/r) + a sqrt(r² - a²)]/(pi R), Johnson 3.42a."""
    contact = reference.press_axisymmetric(
        SPHERE, [0.0, 1.0, 2.0], force=[0.0, 10.0, 3.0], creep_compliance=elastic
    )
    a = reference.hertz_sphere(3.0, 0.01, 2e9).contact_radius
    r = a * np.array([0.0, 0.5, 0.99, 1.01, 1.2, 1.6, 4.0])
    angle, height = np.arcsin(a / np.maximum(r, a)), np.sqrt(np.maximum(r**2 - a**2, 0.0))
    outside = ((2 * a**2 - r**2) * angle + a * height) / (math.pi * 0.01)
    exact = np.where(r < a, a**2 / 0.01 - r**2 / 0.02, outside)
    np.testing.assert_allclose(contact.displacement(r, 2.0), exact, rtol=1e-7)


def test_work_of_a_jump_is_the_elastic_energy():
    """2/5 F w under a sphere, 1/3 under a cone, 1/2 under a punch, and none is left after."""
    for profile, part in [(SPHERE, 2 / 5), (CONE, 1 / 3), (PUNCH, 1 / 2)]:
        contact = reference.press_axisymmetric(
            profile, [0.0, 0.0], approach=[1e-5, 0.0], creep_compliance=elastic
        )
        energy = part * contact.force[0] * 1e-5
        assert contact.work[0] == close_to(energy, rel=1e-4)
        assert contact.work[1] == close_to(0.0, abs=1e-12 * energy)


# Growing contacts: Lee and Radok.


@pytest.mark.parametrize(
    "law", [maxwell(1.0), pytest.param(series(1 / 2e9, [1e-9], [1.5]), marks=pytest.mark.slow)]
)
def test_step_load_follows_lee_and_radok(law):
    t = reference.clustered_times([0.0, 6.0], 80)
    exact = reference.lee_radok_step(10.0, 0.01, *law)
    contact = reference.press_axisymmetric(
        SPHERE, t, force=np.full_like(t, 10.0), creep_compliance=law[0], elements=100
    )
    # Second order in 80 steps of three relaxation times' clustering: what is measured, doubled.
    assert worst(contact.approach, exact.approach(t)) < 2e-4
    assert worst(contact.contact_radius, exact.contact_radius(t)) < 2e-4
    r = np.array([0.0, 1e-4, 2e-4, 3.5e-4])
    assert worst(contact.pressure(r, 3.0), exact.pressure(r, 3.0)) < 1e-3


@pytest.mark.parametrize(
    ("exponent", "order", "finest", "bound"),
    [
        (0.5, 1.5, 100, 3e-4),
        pytest.param(0.2, 1.8, 200, 1e-4, marks=pytest.mark.slow),
        pytest.param(0.5, 1.5, 200, 1e-4, marks=pytest.mark.slow),
    ],
)
def test_power_law_rise_follows_lee_and_radok_with_order_2_less_n(exponent, order, finest, bound):
    """A body without instant compliance: J(0) = 0."""
    exact = reference.lee_radok_ramp(10.0, 1.0, 0.01, *power_law(exponent))
    errors = []
    for n in [finest // 4, finest // 2, finest]:
        t = reference.clustered_times([0.0, 1.0], n)
        contact = reference.press_axisymmetric(
            SPHERE, t, force=10 * t, creep_compliance=power_law(exponent)[0], elements=n
        )
        errors.append(worst(contact.approach, exact.approach(t)))
    assert errors[-1] < bound
    assert np.all(orders(errors) > order - 0.25)


# One rise and fall: Ting.


TO_MAXWELL, TO_ZENER = (MAXWELL, (0.0, [2e9], [1.0])), (ZENER, (2e9 / 3, [4e9 / 3], [0.5]))


@pytest.mark.parametrize(
    ("creep", "modulus", "profile"),
    [
        pytest.param(*TO_MAXWELL, CONE, id="maxwell-cone"),
        pytest.param(*TO_ZENER, SPHERE, id="zener-sphere"),
        pytest.param(*TO_MAXWELL, SPHERE, id="maxwell-sphere", marks=pytest.mark.slow),
        pytest.param(*TO_ZENER, CONE, id="zener-cone", marks=pytest.mark.slow),
    ],
)
def test_triangle_of_approach_follows_ting_with_second_order(profile, creep, modulus):
    exact = reference.ting_triangle(profile, 1e-5, 1.0, *modulus)
    errors = []
    for n in [50, 100, 200]:
        t = np.linspace(0, 2, n + 1)
        contact = reference.press_axisymmetric(
            profile, t, approach=exact.approach(t), creep_compliance=creep, elements=n
        )
        errors.append(worst(contact.force, exact.force(t)))
    assert errors[-1] < 1e-5
    assert np.all(orders(errors) > 1.8)
    assert contact.lost == close_to([exact.lost], rel=1e-5)
    assert contact.touched.tolist() == [0.0]
    # The radius falls like a root towards the loss, so that is where its error is.
    assert worst(contact.contact_radius, exact.contact_radius(t)) < 1e-4


@pytest.mark.parametrize(
    "law",
    [
        pytest.param((BROAD, BROAD_MODULUS), id="broad", marks=pytest.mark.slow),
        pytest.param(maxwell(1.0), id="maxwell"),
    ],
)
def test_haversine_of_approach_follows_ting_with_second_order(law):
    def haversine(t):
        return 1e-5 * np.sin(math.pi * t / 2) ** 2

    exact = reference.ting_hump(SPHERE, haversine, 1.0, 2.0, law[1])
    errors, instants = [], []
    for n in [50, 100, 200]:
        t = np.linspace(0, 2, n + 1)
        contact = reference.press_axisymmetric(
            SPHERE, t, approach=haversine(t), creep_compliance=law[0], elements=100
        )
        errors.append(worst(contact.force, exact.force(t)))
        instants.append(abs(contact.lost[0] - exact.lost))
    # The straight lines between the instants of the history are most of this.
    assert errors[-1] < 4e-5
    assert np.all(orders(errors) > 1.8)
    assert instants[-1] < 3e-5


@pytest.mark.parametrize(
    ("rise", "finest", "bound"),
    [
        (3.0, 60, 4e-4),
        pytest.param(1.0, 120, 1e-4, marks=pytest.mark.slow),
        pytest.param(3.0, 120, 1e-4, marks=pytest.mark.slow),
    ],
)
def test_triangle_of_force_follows_ting_with_second_order(rise, finest, bound):
    """With the slow one the contact still grows while the force falls."""
    exact = reference.ting_force_triangle(10.0, rise, 0.01, 2e9, 1.0)
    errors = []
    for n in [finest // 4, finest // 2, finest]:
        t = reference.clustered_times([0.0, rise, 2 * rise], n)
        contact = reference.press_axisymmetric(
            SPHERE, t, force=exact.force(t), creep_compliance=MAXWELL, elements=n
        )
        errors.append(worst(contact.approach, exact.approach(t)))
    assert errors[-1] < bound
    assert np.all(orders(errors) > 1.8)
    assert worst(contact.contact_radius, exact.contact_radius(t)) < bound
    assert contact.lost.tolist() == [2 * rise]


@pytest.mark.parametrize(
    "profile",
    [pytest.param(SPHERE, id="sphere"), pytest.param(CONE, id="cone", marks=pytest.mark.slow)],
)
def test_cycles_on_a_maxwell_body_follow_the_closed_form(profile):
    """Contact is lost three times, and made again on the residual indentation."""
    exact = reference.ting_cycles(profile, 1e-5, 1.0, 2e9, 1.0)
    errors = []
    for n in [20, 40, 80]:
        t = np.linspace(0, 6, 6 * n + 1)
        contact = reference.press_axisymmetric(
            profile, t, approach=exact.approach(t), creep_compliance=MAXWELL, elements=n
        )
        errors.append(worst(contact.force, exact.force(t)))
    assert errors[-1] < 4e-5
    assert np.all(orders(errors) > 1.8)
    cycles = range(3)
    np.testing.assert_allclose(contact.lost, [exact.lost(k) for k in cycles], rtol=3e-5)
    np.testing.assert_allclose(contact.touched, [exact.touched(k) for k in cycles], atol=3e-5)
