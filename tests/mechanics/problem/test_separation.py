"""Separation of creeping layers against closed forms, in oscillation and in time."""

import numpy as np
import pytest
import scipy

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.problem.separation import separate, transformed
from viscontact.mechanics.problem.series_body import series_body, span_of

SHEAR = 1e6
OMEGA = np.geomspace(0.02, 400.0, 23)
Q = np.geomspace(20.0, 1e4, 29)  # of layers of 1 mm
THICKNESS = 1e-3


def zener(ratio=10.0, shear=SHEAR):
    """A law that relaxes to G/ratio, and its transform s L[Phi]."""
    delayed = shear / (ratio - 1)
    law = vc.Zener(shear, delayed, delayed * 1.0)

    def creep(s):
        return (1 + (ratio - 1) / (1 + s)) / (2 * shear)

    return law, creep


def coated(eps, nu1, nu2):
    """L of a layer on a half-space, eps = G1/G2 (O'Sullivan & King 1988, J. Tribol. 110, 235)."""
    w, t = Q * THICKNESS, np.exp(-2 * Q * THICKNESS)
    lam = 1 - 4 * (1 - nu1) / (1 + eps * (3 - 4 * nu2))
    kap = (eps - 1) / (eps + 3 - 4 * nu1)
    lower = 1 - (lam + kap + 4 * kap * w**2) * t + lam * kap * t**2
    return (1 + 4 * w * kap * t - lam * kap * t**2) / lower


def on_rigid(nu):
    """L of a layer bonded to a rigid base (Johnson 1985, Contact Mechanics, section 5.8)."""
    w, t, k = Q * THICKNESS, np.exp(-2 * Q * THICKNESS), 3 - 4 * nu
    return (k * (1 - t**2) - 4 * w * t) / (k * (1 + t**2) + (1 + k**2 + 4 * w**2) * t)


def cover(eps, nu, ratio=10.0):
    """A creeping layer on an elastic half-space, and its C(q, s)."""
    law, creep = zener(ratio)
    core = vc.Material(vc.Elastic(SHEAR / eps), poisson_ratio=0.3)
    body = vc.Layered([vc.Layer(THICKNESS, vc.Material(law, nu))], base=core)

    def wanted(s):
        phi = creep(s)
        return (1 - nu) * phi * coated(eps / (2 * SHEAR * phi), nu, 0.3)

    return body, wanted


def coating(eps, nu=0.3, ratio=10.0):
    """An elastic layer on a creeping half-space, and its C(q, s)."""
    law, creep = zener(ratio)
    layer = vc.Layer(THICKNESS, vc.Material(vc.Elastic(eps * SHEAR), nu))
    body = vc.Layered([layer], base=vc.Material(law, 0.45))

    def wanted(s):
        return (1 - nu) / (2 * eps * SHEAR) * coated(2 * eps * SHEAR * creep(s), nu, 0.45)

    return body, wanted


def terms(found):
    """Function s -> Σ b_m(s) L_m(q) of what was found."""
    kernels = [response.ratio(Q) for response in found.responses]
    pairs = list(zip(found.compliances, kernels, strict=True))
    return lambda s: sum(transformed(j, np.asarray(s)) * kernel for j, kernel in pairs)


def worst(found, wanted):
    """Largest relative error of the sum in the harmonic response."""
    summed = terms(found)
    return max(np.abs(summed(1j * omega) / wanted(1j * omega) - 1).max() for omega in OMEGA)


def in_time(transform, t, points=24):
    """Inverse of a Laplace transform (Abate & Valko 2004, Int. J. Numer. Meth. Eng. 60, 979)."""
    angle = np.arange(1, points) * np.pi / points
    cot = 1 / np.tan(angle)
    nodes = np.append(1.0, angle * (cot + 1j)) * (2 * points / 5)
    factors = np.append(0.5, 1 + 1j * (angle + (angle * cot - 1) * cot)) * np.exp(nodes)
    values = [factor * transform(s / t) for s, factor in zip(nodes, factors, strict=True)]
    return 2 / (5 * t) * np.real(sum(values))


# Asked: 1e-6 of rubber on steel; a nearly incompressible cover of 1e-3 of the core's modulus more.
@pytest.mark.parametrize(
    ("eps", "nu", "allowed"),
    [(1e-5, 0.38, 1e-9), (1e-3, 0.38, 1e-6), (1e-4, 0.499, 1e-6), (1e-3, 0.499, 1e-5)],
)
def test_a_soft_cover_on_an_elastic_core_is_two_terms(eps, nu, allowed):
    body, wanted = cover(eps, nu)
    found = separate(body)
    assert len(found.compliances) == 2
    error = worst(found, wanted)
    assert error < allowed
    # What is stated holds where it was not measured.
    assert error < found.error + 1e-12


HARD = {
    "cover of a tenth of the core": (cover(0.1, 0.4), 3),
    "cover as stiff as the core": (cover(1.0, 0.4), 4),
    "the same, to a thousandth": (cover(1.0, 0.4, ratio=1000.0), 5),
    "creeping coating": (cover(10.0, 0.4, ratio=100.0), 8),
    "stiff creeping coating": (cover(1000.0, 0.4), 8),
    "coating of ten times the base": (coating(10.0), 8),
    "coating of a thousand times the base": (coating(1000.0), 8),
}


@pytest.mark.parametrize(("case", "most"), HARD.values(), ids=HARD)
def test_the_error_of_hard_layers_is_small_and_below_what_is_stated(case, most):
    body, wanted = case
    found = separate(body)
    assert len(found.compliances) <= most
    assert worst(found, wanted) < found.error < 1e-3


@pytest.mark.parametrize(
    "case", [cover(0.1, 0.4), cover(1.0, 0.4), cover(1000.0, 0.4), coating(10.0)]
)
def test_the_stated_error_holds_for_creep_and_relaxation_in_time(case):
    body, wanted = case
    found = separate(body)
    summed = terms(found)
    for t in np.geomspace(0.01, 30.0, 9):
        creep = sum(
            j(t) * response.ratio(Q)
            for j, response in zip(found.compliances, found.responses, strict=True)
        )
        assert creep == close_to(in_time(lambda s: wanted(s) / s, t), rel=found.error)
        relaxed = in_time(lambda s: 1 / (s * summed(s)), t)
        exact = in_time(lambda s: 1 / (s * wanted(s)), t)
        assert relaxed == close_to(exact, rel=found.error)


# In 0.01 to 30 s; a law without an instant compliance is replaced before 1e-5 s.
@pytest.mark.parametrize("instant", [0.2, 0.0])
@pytest.mark.parametrize(("eps", "terms", "allowed"), [(1e-4, 2, 1e-5), (0.1, 12, 3e-3)])
def test_power_laws_are_separated_within_the_stated_error(instant, eps, terms, allowed):
    exponent = 0.3
    law = vc.PowerLaw(1 / SHEAR, exponent, 1.0, instant=instant / SHEAR)
    core = vc.Material(vc.Elastic(SHEAR / eps), poisson_ratio=0.3)
    body = vc.Layered([vc.Layer(THICKNESS, vc.Material(law, 0.4))], base=core)

    def wanted(s):
        phi = (instant + scipy.special.gamma(1 + exponent) * s**-exponent) / SHEAR
        return 0.6 * phi * coated(eps / (2 * SHEAR * phi), 0.4, 0.3)

    found = separate(body, span_of([0.0, 10.0]))
    assert len(found.compliances) <= terms
    assert found.error < allowed
    for t in np.geomspace(0.01, 30.0, 5):
        kernels = zip(found.compliances, found.responses, strict=True)
        creep = sum(j(t) * response.ratio(Q) for j, response in kernels)
        exact = in_time(lambda s: wanted(s) / s, t)
        assert creep == close_to(exact, rel=found.error + 1e-9)


def test_a_law_in_place_of_one_without_an_instant_compliance_flows_and_slides_as_it_does():
    law = vc.CreepSeries(0.0, [1e-9], [1.0], 1e-11)
    rubber = vc.Material(law, 0.4)
    body = vc.Layered([vc.Layer(1e-3, rubber)] * 2, rubber, bonded=(True, False))
    found, deviation = series_body(body, (1e-2, 1e3))
    times = np.geomspace(1.0, 1e3, 16)
    for material in found.materials:
        assert material.law(0.0) > 0
        assert material.law(times) == close_to(law(times), rel=1.1 * deviation)
    assert deviation < 0.1
    assert found.bonded == (True, False)


def test_a_law_that_no_series_follows_is_refused():
    # Creep in steps: positive exponentials are smooth.
    times = np.repeat(np.geomspace(1e-2, 1e3, 12), 2) * np.tile([1.0, 1.0001], 12)
    law = vc.TabulatedCreep(times, np.repeat(np.geomspace(1.0, 1e3, 13), 2)[1:-1] / SHEAR)
    core = vc.Material(vc.Elastic(SHEAR), poisson_ratio=0.3)
    body = vc.Layered([vc.Layer(THICKNESS, vc.Material(law, 0.4))], base=core)
    with pytest.raises(ValueError, match=r"laws that are not Prony series.*fit_creep"):
        separate(body, span_of([0.0, 10.0]))


def test_an_elastic_bulk_modulus_is_separated():
    # A thin rubber cover is ruled by its bulk modulus: K/G from 100 to 1000.
    law, creep = zener()
    bulk = 100 * SHEAR
    body = vc.Layered([vc.Layer(THICKNESS, vc.Material(law, bulk_modulus=bulk))], base="rigid")
    found = separate(body)

    def wanted(s):
        shear = 1 / (2 * creep(s))
        nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
        return (1 - nu) * creep(s) * on_rigid(nu)

    assert worst(found, wanted) < found.error < 3e-4


def test_a_wide_spectrum_takes_no_more_terms():
    times = np.geomspace(1e-4, 1e4, 17)
    law = vc.RelaxationSeries(SHEAR, np.full(17, SHEAR), times)
    coat = vc.Layer(THICKNESS, vc.Material(vc.Elastic(1e9), 0.3))
    found = separate(vc.Layered([coat], base=vc.Material(law, 0.45)))
    assert len(found.compliances) <= 8
    assert found.error < 1e-3


@pytest.mark.parametrize(
    ("law", "transform", "bulk"),
    [
        # Until 0.1 s the Kelvin solid is stiffer than its bulk.
        (
            vc.CreepSeries(0.0, [2.0 / SHEAR], [100.0]),
            lambda s: 2.0 / SHEAR / (1 + 100.0 * s),
            400 * SHEAR,
        ),
        (
            vc.PowerLaw(0.5 / SHEAR, 0.3, 1.0),
            lambda s: 0.5 / SHEAR * scipy.special.gamma(1.3) * s**-0.3,
            1000 * SHEAR,
        ),
    ],
)
@pytest.mark.parametrize("first", [pytest.param(1e-2, marks=pytest.mark.slow), 1e-6])
def test_laws_without_an_instant_compliance_are_separated_from_the_first_step_on(
    law, transform, bulk, first
):
    body = vc.Layered([vc.Layer(THICKNESS, vc.Material(law, bulk_modulus=bulk))], base="rigid")

    def wanted(s):
        phi = transform(s)
        nu = (3 * bulk - 1 / phi) / (6 * bulk + 1 / phi)
        return (1 - nu) * phi * on_rigid(nu)

    found = separate(body, span_of(vc.log_times(first, 1.0, 6)))
    assert found.error < 0.01
    for t in np.geomspace(first, 1.0, 5):
        kernels = zip(found.compliances, found.responses, strict=True)
        creep = sum(j(t) * response.ratio(Q) for j, response in kernels)
        exact = in_time(lambda s: wanted(s) / s, t)
        assert creep == close_to(exact, rel=found.error)
