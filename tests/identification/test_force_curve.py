"""Contact point and baseline of force curves: exact elastic curves with noise, creep, refusals."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

from closeness import close_to
from viscontact.identification import ForceCurve, find_contact, fit_indentation
from viscontact.indenters import Cone, FlatPunch, Paraboloid, Sphere

RADIUS, MODULUS, STIFFNESS, CONTACT = 5e-6, 2e4, 0.1, 3e-6
SPHERE = Sphere(RADIUS)
# Closed forms for a contact modulus of 1 Pa: Hertz (1882), Sneddon (1965), Boussinesq (1885).
FORCES = {
    SPHERE: lambda d: 4 / 3 * np.sqrt(RADIUS) * d**1.5,
    Cone(1.2): lambda d: 2 / np.pi * np.tan(1.2) * d**2,
    FlatPunch(1e-6): lambda d: 2e-6 * d,
}


@cache
def exact_deflection(indenter, rows, contact=CONTACT, modulus=MODULUS):
    """Bending over the position: k y = E* f(d) at z_0 + d + y."""
    depth = np.linspace(0.0, 2e-6, 200_001)
    bending = modulus * FORCES[indenter](depth) / STIFFNESS
    return np.interp(np.linspace(0.0, 4e-6, rows), contact + depth + bending, bending, left=0.0)


def elastic_curve(indenter=SPHERE, noise=0.0, rows=500, tilt=0.003, offset=2e-8, seed=0):
    """Exact curve on a tilted baseline, with scatter."""
    z = np.linspace(0.0, 4e-6, rows)
    deflection = exact_deflection(indenter, rows)
    scatter = noise * np.random.default_rng(seed).standard_normal(rows)
    return ForceCurve(z, z, offset + tilt * z + deflection + scatter, STIFFNESS)


@cache
def errors(noise, rows=300, seeds=40, reach=1.0):
    """Errors of contact point [m] and modulus [-], and the mean of the stated errors [m]."""
    found = [
        find_contact(elastic_curve(noise=noise, rows=rows, seed=seed), SPHERE, reach=reach)
        for seed in range(seeds)
    ]
    at = np.array([each.position - CONTACT for each in found])
    modulus = np.array([each.contact_modulus / MODULUS - 1 for each in found])
    return at, modulus, np.mean([each.position_error for each in found])


@pytest.mark.parametrize("reach", [0.3, 1.0])
@pytest.mark.parametrize("indenter", FORCES, ids=["sphere", "cone", "punch"])
def test_exact_elastic_curves_give_contact_point_baseline_and_modulus(indenter, reach):
    found = find_contact(elastic_curve(indenter), indenter, reach=reach)
    assert found.position == close_to(CONTACT, abs=1e-12)
    assert found.contact_modulus == close_to(MODULUS, rel=1e-5)
    assert found.slope == close_to(0.003, rel=1e-6)
    assert found.offset == close_to(2e-8, rel=1e-4)


@pytest.mark.parametrize("reach", [0.3, 1.0])
def test_the_stated_error_of_the_contact_point_is_that_of_repeated_curves(reach):
    at, _, stated = errors(1e-9, reach=reach)
    spread = np.sqrt(np.mean(at**2))
    # 40 curves give the spread within 11 % (one sigma).
    assert 0.7 < spread / stated < 1.35
    assert abs(at.mean()) < 4 * spread / np.sqrt(40)


@pytest.mark.parametrize("reach", [0.3, 1.0])
def test_the_stated_error_of_the_contact_point_is_the_least_of_any_unbiased_estimate(reach):
    """Cramér (1946): the noise times the root of the inverse of J'J, of the four unknowns."""
    rows, step = 300, 1e-3
    z, exact = np.linspace(0.0, 4e-6, rows), exact_deflection(SPHERE, rows)
    later = exact_deflection(SPHERE, rows, contact=CONTACT + step * 1e-6)
    stiffer = exact_deflection(SPHERE, rows, modulus=MODULUS * (1 + step))
    slopes = np.array([(later - exact) / (step * 1e-6), (stiffer - exact) / step, z**0, z])
    deflection = exact + 0.003 * z
    slopes = slopes[:, deflection <= reach * deflection.max()]
    size = np.abs(slopes).max(axis=1)
    slopes /= size[:, None]
    least = 1e-9 * np.sqrt(np.linalg.inv(slopes @ slopes.T)[0, 0]) / size[0]
    # The noise of 300 rows is known within 4 %, and that of 40 such curves within 1 %.
    assert errors(1e-9, reach=reach)[2] == close_to(least, rel=0.03)


def test_errors_are_proportional_to_the_noise_and_fall_with_the_root_of_the_rows():
    at, modulus, stated = errors(1e-10)
    more_at, more_modulus, more_stated = errors(1e-9, reach=1.0)
    assert more_stated / stated == close_to(10, rel=0.02)
    assert np.std(more_at) / np.std(at) == close_to(10, rel=0.02)
    assert np.std(more_modulus) / np.std(modulus) == close_to(10, rel=0.02)
    _, _, finer_stated = errors(1e-9, rows=1200, seeds=10)
    assert finer_stated / more_stated == close_to(0.5, rel=0.05)
    assert np.std(more_modulus) < 0.004


@pytest.mark.parametrize(("tilt", "offset"), [(0.0, 0.0), (-0.02, 1e-6), (0.05, -3e-7)])
def test_tilt_and_offset_of_the_baseline_change_nothing_else(tilt, offset):
    one = find_contact(elastic_curve(noise=1e-9), SPHERE, reach=1.0)
    other = find_contact(elastic_curve(noise=1e-9, tilt=tilt, offset=offset), SPHERE, reach=1.0)
    # The tilted line is part of the model, so the fit is the same up to its tolerance.
    assert other.position == close_to(one.position, abs=0.02 * one.position_error)
    assert other.contact_modulus == close_to(one.contact_modulus, rel=1e-4)
    assert other.slope - one.slope == close_to(tilt - 0.003, abs=1e-5)


def test_a_falling_height_is_turned_over():
    curve = elastic_curve()
    height = ForceCurve(curve.times, 9e-6 - curve.position, curve.deflection, STIFFNESS)
    assert find_contact(height, SPHERE).position == close_to(CONTACT - 9e-6, abs=1e-12)


def maxwell_curve(modulus, tau, rate, rows=1200):
    """Curve of a Maxwell body indented at a constant rate, by quadrature of the superposition.

    F = (8/3) sqrt(R)/(1 - nu) times the integral of G exp(-(t - t')/tau) d(rate t')^1.5, nu = 1/2
    (Lee and Radok, 1960).
    """
    t = np.linspace(-1.0, 1.0, rows)

    def force(end):
        inside = quad(lambda u: np.exp(-(end - u * u) / tau) * 3 * u * u, 0.0, np.sqrt(end))[0]
        return 16 / 3 * np.sqrt(RADIUS) * modulus * rate**1.5 * inside

    bending = np.array([force(end) if end > 0 else 0.0 for end in t]) / STIFFNESS
    return t, rate * t, bending


def test_creep_during_loading_shifts_the_contact_point_less_with_a_smaller_reach():
    t, depth, bending = maxwell_curve(5000.0, 1.0, 1e-6)
    z = CONTACT + depth + bending
    curve = ForceCurve(t, z, bending + 0.003 * z, STIFFNESS)
    shifts = [
        abs(find_contact(curve, SPHERE, reach=reach).position - CONTACT)
        for reach in (1.0, 0.3, 0.1)
    ]
    assert shifts[0] > 2 * shifts[1] > 4 * shifts[2]
    assert shifts[1] < 0.02e-6  # of an indentation of 1 µm
    fit = fit_indentation(find_contact(curve, SPHERE).record(60), "maxwell", poisson_ratio=0.5)
    assert fit.parameters["shear_modulus"] == close_to(5000.0, rel=0.06)
    assert fit.parameters["viscosity"] == close_to(5000.0, rel=0.1)


def test_the_record_has_the_approach_without_the_bending_and_the_force():
    curve = elastic_curve(noise=1e-10)
    record = find_contact(curve, SPHERE).record(250)
    assert record.times.size == 250
    hertz = MODULUS * FORCES[SPHERE](np.maximum(record.approach, 0.0))
    np.testing.assert_allclose(record.force, hertz, atol=2e-3 * hertz.max())
    assert record.approach[0] == close_to(-CONTACT, rel=0.01)  # the baseline, too
    assert find_contact(curve, SPHERE).record().times.size == 500  # of 500 rows


def test_curves_without_a_contact_after_a_baseline_are_refused():
    z, rng = np.linspace(0.0, 1e-6, 200), np.random.default_rng(0)
    noise = 1e-9 * rng.standard_normal(z.size)
    for deflection in (noise, 0.01 * z + noise, -np.maximum(z - 5e-7, 0.0) + noise):
        with pytest.raises(ValueError, match="find_contact: no contact is found"):
            find_contact(ForceCurve(z, z, deflection, STIFFNESS), SPHERE)
    whole = elastic_curve(noise=1e-9)
    inside = slice(400, None)  # begins in contact
    with pytest.raises(ValueError, match="begin before contact"):
        find_contact(
            ForceCurve(*(c[inside] for c in (whole.times, whole.position, whole.deflection)), 0.1),
            SPHERE,
        )


@pytest.mark.parametrize("indenter", FORCES, ids=["sphere", "cone", "punch"])
def test_bending_of_ten_times_the_noise_is_a_contact_and_of_three_times_is_none(indenter):
    most = float(exact_deflection(indenter, 500).max())
    found = find_contact(elastic_curve(indenter, noise=most / 10), indenter, reach=1.0)
    assert found.position == close_to(CONTACT, abs=4 * found.position_error)
    with pytest.raises(ValueError, match="the bending is within the noise"):
        find_contact(elastic_curve(indenter, noise=most / 3), indenter, reach=1.0)


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"spring_constant": 0.0}, "spring_constant must be a positive finite number, got 0 N/m"),
        ({"times": np.zeros(19)}, "got 19 times, 20 position, 20 deflection"),
        ({"times": -np.arange(20.0)}, "times, row 1: must not be before the row above"),
        ({"deflection": np.full(20, np.nan)}, "ForceCurve: deflection, row 0: must be finite"),
    ],
)
def test_bad_curves_are_refused(change, why):
    good = {name: np.linspace(0.0, 1.0, 20) for name in ("times", "position", "deflection")}
    with pytest.raises(ValueError, match="ForceCurve") as caught:
        ForceCurve(**{**good, "spring_constant": 1.0, **change})
    assert why in str(caught.value)


def test_other_tips_and_a_reach_out_of_range_are_refused():
    with pytest.raises(ValueError, match="must be a Sphere, a Cone, a Pyramid with"):
        find_contact(elastic_curve(), Paraboloid(1e-6, 2e-6))
    with pytest.raises(ValueError, match=r"reach must lie between 0 and 1, got 1\.5"):
        find_contact(elastic_curve(), SPHERE, reach=1.5)
