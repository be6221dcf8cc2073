"""Periodic bodies in steady motion: a wave in full and in partial contact."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.reference import moving_wave_resistance

AMPLITUDE, LENGTH, TIME = 1e-4, 1.0, 10.0
WAVE = vc.Waviness(amplitude=AMPLITUDE, wavelength_x=LENGTH)
RUBBER = vc.Material(vc.CreepSeries(1 / 1000, [9 / 1000], [TIME]), poisson_ratio=0.5)
FLUID = vc.Material(vc.Maxwell(shear_modulus=500.0, viscosity=5000.0), poisson_ratio=0.5)


def grid(cells=64, periods=1):
    size = (periods * LENGTH, LENGTH)
    return vc.Grid((periods * cells, 16), size, periodic=True)


def loss_modulus(speed, *, flows=False):
    """Imaginary part of 1/J* at the frequency of the wave [Pa]."""
    omega = 2 * np.pi / LENGTH * speed
    delayed = 1 / (2000 * 1j * omega * TIME) if flows else 9 / 2000 / (1 + 1j * omega * TIME)
    return (1 / (1 / 2000 + delayed)).imag


@pytest.mark.parametrize("material", [RUBBER, FLUID], ids=["solid", "fluid"])
@pytest.mark.parametrize("speed", [0.003, 0.1, 1.0])
def test_a_wave_in_full_contact_has_the_exact_resistance(speed, material):
    ds = vc.steady(WAVE, material, vc.step(5.0), speed, along="x", grid=grid()).isel(speed=0)
    modulus = loss_modulus(speed, flows=material is FLUID)
    exact = moving_wave_resistance(AMPLITUDE, LENGTH, modulus)
    assert float(ds.contact_area) == close_to(LENGTH**2)
    assert float(ds.approach) == close_to(AMPLITUDE)
    assert abs(float(ds.resistance_x) - exact) < float(ds.resistance_x_error)
    assert float(ds.resistance_x) == close_to(exact, rel=5e-4)


def test_two_periods_of_a_wave_in_partial_contact_carry_twice_the_force_of_one():
    one = vc.steady(WAVE, RUBBER, vc.step(0.05), 0.1, along="x", grid=grid()).isel(speed=0)
    wide = grid(periods=2)
    two = vc.steady(WAVE, RUBBER, vc.step(0.1), 0.1, along="x", grid=wide).isel(speed=0)
    assert 0.1 < float(one.contact_area) < 0.5
    assert float(two.resistance_x) == close_to(2 * float(one.resistance_x), rel=1e-5)
    assert float(two.approach) == close_to(float(one.approach), rel=1e-5)


def test_a_turned_wave_moves_along_the_other_axis():
    turned = vc.Waviness(amplitude=AMPLITUDE, wavelength_y=LENGTH)
    cells = vc.Grid((16, 64), (LENGTH, LENGTH), periodic=True)
    x = vc.steady(WAVE, RUBBER, vc.step(0.05), 0.1, along="x", grid=grid())
    y = vc.steady(turned, RUBBER, vc.step(0.05), 0.1, along="y", grid=cells)
    assert float(y.resistance_y[0]) == close_to(float(x.resistance_x[0]), rel=1e-9)
