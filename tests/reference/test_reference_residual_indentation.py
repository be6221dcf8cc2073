"""Pressure, displacement and residual indentation of `press_axisymmetric`."""

import itertools
import math

import numpy as np
import pytest
from scipy.special import ellipkm1

from closeness import close_to
from inverse_pairs import maxwell, series
from viscontact import reference

SPHERE, CONE = reference.SphereProfile(0.01), reference.ConeProfile(1.4)
PUNCH = reference.PunchProfile(0.002)
MAXWELL = maxwell(1.0)[0]
ZENER = series(1 / 2e9, [1 / 1e9], [1.5])[0]
BROAD = series(1 / 2e9, [1 / 2e9, 1 / 1e9], [0.2, 3.0])[0]


# What no formula knows: the integral itself.


def test_pressures_of_two_cycles_give_the_displacement_by_superposition():
    """u = integral of J d(Kp): rings of the pressure, weighted by 4 r K(k)/(pi (r + rho)).

    Under the indenter it is w - f(r), outside it leaves the gap open; inside the first indentation
    it is the part that has not recovered yet.
    """
    t = np.linspace(0, 2.8, 141)
    load = 5 * np.maximum(np.sin(math.pi * t / 1.2), 0) * np.where(t > 1.2, 1.4, 1.0)
    contact = reference.press_axisymmetric(
        SPHERE, t, force=load, creep_compliance=BROAD, elements=150
    )
    nodes, weights = np.polynomial.legendre.leggauss(40)
    place, weights = (nodes + 1) / 2, weights / 2
    for rho in [0.4e-4, 1.7e-4, 4e-4]:
        elastic_path = np.zeros_like(t)
        for k in np.flatnonzero(contact.contact_radius):
            a = contact.contact_radius[k]
            # Quartic towards the ring's logarithm and the edge's root.
            corners = [0.0, rho, a] if rho < a else [0.0, a]
            for low, high in itertools.pairwise(corners):
                u = place**3 * (10 - 15 * place + 6 * place**2)
                r = low + (high - low) * u
                kernel = 4 * r * ellipkm1(((r - rho) / (r + rho)) ** 2) / (math.pi * (r + rho))
                slope = 30 * place**2 * (1 - place) ** 2 * (high - low)
                elastic_path[k] += np.sum(weights * slope * kernel * contact.pressure(r, t[k]))
        for k in [40, 55, 70, 124]:
            middles = t[k] - (t[1 : k + 1] + t[:k]) / 2
            exact = BROAD(middles) @ np.diff(elastic_path[: k + 1])
            ours = contact.displacement(rho, t[k])
            # Midpoints of 141 instants through a path with corners.
            assert ours == close_to(exact, abs=1e-3 * contact.approach.max())
            opening = ours + rho**2 / 0.02 - contact.approach[k]
            scale = 1e-6 * contact.approach.max()
            assert opening >= -scale
            if rho < contact.contact_radius[k]:
                assert opening <= scale


def test_pressure_integrates_to_the_force_after_a_hold_and_a_partial_release():
    t = reference.clustered_times([0.0, 1.0, 3.0, 3.5], 40)
    load = np.interp(t, [0, 1, 3, 3.5], [0, 1e-5, 1e-5, 7e-6])
    nodes, weights = np.polynomial.legendre.leggauss(200)
    for profile in [SPHERE, CONE]:
        contact = reference.press_axisymmetric(profile, t, approach=load, creep_compliance=ZENER)
        angle = (nodes + 1) * math.pi / 4
        r = contact.contact_radius[-1] * np.sin(angle)
        rings = 2 * math.pi * r * contact.pressure(r, 3.5) * contact.contact_radius[-1]
        total = np.sum(weights * math.pi / 4 * np.cos(angle) * rings)
        # The cone's pressure is infinite on the axis.
        assert total == close_to(contact.force[-1], rel=1e-4)


# The residual indentation.


@pytest.mark.parametrize("profile", [SPHERE, CONE, PUNCH], ids=["sphere", "cone", "punch"])
def test_residual_indentation_of_a_zener_body_fades_with_its_retardation_time(profile):
    t = np.append(np.linspace(0, 2, 81), [3.0, 5.0])
    load = np.interp(t, [0, 1, 2], [0, 1e-5, -1e-5])
    contact = reference.press_axisymmetric(profile, t, approach=load, creep_compliance=ZENER)
    assert contact.lost[0] < 2
    r = np.array([0.0, 1e-4, 3e-4, 1e-3, 5e-3])
    early, late = contact.displacement(r, 2.0), contact.displacement(r, 5.0)
    np.testing.assert_allclose(late, early * math.exp(-3 / 1.5), rtol=1e-9)
    assert np.all(early > 0)


def test_residual_indentation_of_a_maxwell_body_is_permanent():
    t = np.append(np.linspace(0, 2, 201), [3.0, 50.0])
    contact = reference.press_axisymmetric(
        SPHERE, t, approach=np.interp(t, [0, 1, 2], [0, 1e-5, 0]), creep_compliance=MAXWELL
    )
    r = np.linspace(0, 6e-4, 13)
    early, late = contact.displacement(r, 2.0), contact.displacement(r, 50.0)
    np.testing.assert_allclose(late, early, rtol=1e-9)
    # Where the indenter lost contact last it left its own depth.
    lost = float(np.interp(contact.lost[0], t, contact.approach))
    assert late[0] == close_to(lost, rel=1e-4)


def test_far_displacement_is_that_of_a_point_load():
    """pi r u = integral of J dF (Boussinesq)."""
    t = np.linspace(0, 3, 121)
    load = 5 * np.maximum(np.sin(math.pi * t / 2), 0)
    contact = reference.press_axisymmetric(SPHERE, t, force=load, creep_compliance=BROAD)
    middles = 3 - (t[1:] + t[:-1]) / 2
    crept = BROAD(middles) @ np.diff(load)
    assert math.pi * 2.0 * contact.displacement(2.0, 3.0) == close_to(crept, rel=1e-3)


def test_body_without_force_touches_the_deformed_surface():
    t = np.linspace(0, 4, 161)
    load = np.interp(t, [0, 1, 2, 3, 4], [0, 5, 0, 0, 8])
    contact = reference.press_axisymmetric(SPHERE, t, force=load, creep_compliance=ZENER)
    resting = (t >= 2) & (t <= 3)
    assert np.all(contact.force[resting] == 0)
    assert np.all(contact.contact_radius[resting] == 0)
    exact = contact.approach[t == 2] * np.exp(-(t[resting] - 2) / 1.5)
    np.testing.assert_allclose(contact.approach[resting], exact, rtol=1e-9)
    assert contact.lost.tolist() == [2.0]
    assert contact.touched.tolist() == [0.0, 3.0]
