"""Round bodies on a layer: published values, limits of thick and thin layers, equilibrium."""

import numpy as np
import pytest

from closeness import close_to
from viscontact.reference import flat_punch, hertz_sphere, layer_punch, layer_sphere

SHEAR = 1e6


def modulus(nu):
    return 2 * SHEAR / (1 - nu)


def sphere(ratio, nu, **options):
    """A contact of 1 mm radius on a layer thinner by this ratio."""
    options = {"shear_modulus": SHEAR, "poisson_ratio": nu} | options
    return layer_sphere(1e-3, 0.1, 1e-3 / ratio, **options)


@pytest.mark.parametrize("bonded", [True, False])
@pytest.mark.parametrize("nu", [0.0, 0.38, 0.5])
def test_on_a_thick_layer_the_contact_is_hertz_and_boussinesq(nu, bonded):
    found = sphere(1e-4, nu, bonded=bonded)
    expected = hertz_sphere(found.force, 0.1, modulus(nu))
    # The base adds to the stiffness by the order of a/h.
    assert found.contact_radius == close_to(expected.contact_radius, rel=1e-4)
    assert found.approach == close_to(expected.approach, rel=3e-4)
    r = np.array([0.0, 0.3e-3, 0.8e-3, 1.2e-3])
    assert found.pressure(r) == close_to(expected.pressure(r), rel=3e-4)
    options = {"shear_modulus": SHEAR, "poisson_ratio": nu, "bonded": bonded}
    punch = layer_punch(1e-3, 1e-6, 10.0, **options)
    blunt = flat_punch(punch.force, 1e-3, modulus(nu))
    assert blunt.approach == close_to(1e-6, rel=3e-4)
    r = np.array([0.0, 0.5e-3, 0.999e-3])
    assert punch.pressure(r) == close_to(blunt.pressure(r), rel=3e-4)


def test_a_thick_layer_stiffens_a_punch_by_the_first_term_of_its_expansion():
    # F/(2 E* a) = 1 + (2/π) A a/h + ..., A = ∫ (1 - L) dw: the mean of M over the punch is M(0).
    w = np.linspace(1e-9, 40.0, 400001)
    excess = 1 - (np.cosh(w) - 1) / (np.sinh(w) + w)  # in 2w
    first = np.trapezoid(excess, w) / 2 * 2 / np.pi
    options = {"shear_modulus": SHEAR, "poisson_ratio": 0.3, "bonded": False}
    for ratio in (1e-2, 1e-3):
        punch = layer_punch(1.0, 1.0, 1 / ratio, **options)
        stiffer = punch.force / (2 * modulus(0.3)) - 1
        assert stiffer == close_to(first * ratio, rel=2 * first * ratio)


@pytest.mark.parametrize(("nu", "bonded"), [(0.3, True), (0.5, True), (0.5, False)])
def test_pressure_carries_the_force(nu, bonded):
    found = sphere(5.0, nu, bonded=bonded)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    s = (1 + nodes) / 2  # r = a sqrt(1 - s²) removes the root at the rim
    pressure = found.pressure(1e-3 * np.sqrt(1 - s**2))
    assert 1e-6 * np.pi * (weights * s * pressure).sum() == close_to(found.force, rel=1e-9)


def test_a_thin_compressible_layer_is_a_foundation_of_springs():
    # p = M_oed/h times the indentation: F = π/4 M a⁴/(R h), w = a²/(2 R) (Johnson 1985, sec. 5.8).
    constrained = modulus(0.3) * 0.7**2 / 0.4
    ratios = []
    for ratio in (8.0, 16.0):
        found = sphere(ratio, 0.3)
        foundation = np.pi / 4 * constrained * 1e-12 / (0.1 * 1e-3 / ratio)
        ratios.append([found.force / foundation - 1, found.approach / (1e-6 / 0.2) - 1])
    # The deviation at the rim falls as h/a.
    assert np.divide(*ratios) == close_to([2.0, 2.0], rel=0.06)
    assert ratios[1] == close_to([0.0310, 0.0158], abs=3e-4)


def test_a_thin_incompressible_layer_is_squeezed_out():
    # Lubrication: F = π G a⁶/(32 R h³), w = a²/(4 R) (Jaffar 1989, Int. J. Mech. Sci. 31, 229); the
    # deviations fall slowly.
    off = []
    for ratio in (8.0, 16.0, 32.0):
        found = sphere(ratio, 0.5)
        squeezed = np.pi * SHEAR * 1e-18 / (32 * 0.1 * (1e-3 / ratio) ** 3)
        off.append([found.force / squeezed - 1, found.approach / (1e-6 / 0.4) - 1])
    shrinks = np.divide(off[:-1], off[1:])
    assert ((shrinks > 1.8) & (shrinks < 2.5)).all()
    assert (np.array(off) > 0).all()


def test_wrong_arguments_are_refused():
    with pytest.raises(ValueError, match="thickness"):
        layer_sphere(1e-3, 0.1, 0.0, shear_modulus=1.0, poisson_ratio=0.3)
    with pytest.raises(ValueError, match=r"poisson_ratio must be above -1 and at most 0\.5"):
        layer_punch(1e-3, 1e-6, 1e-3, shear_modulus=1.0, poisson_ratio=0.6)
