"""Persson's theory: full contact, conventions of the spectrum, its distance from computed runs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.special import erf

import viscontact as vc
from closeness import close_to
from viscontact.bodies.surfaces.height_spectrum import mean_square_waves
from viscontact.surfaces import persson_area, persson_sliding, topography_of

LENGTH = 1e-3
RUBBER = vc.Material(vc.CreepSeries(5e-10, [4.5e-9], [1.0]), poisson_ratio=0.0)
ELASTIC = vc.Material(vc.Elastic.from_uniaxial(0.75e7, 0.5), poisson_ratio=0.5)  # E* = 10 MPa
# Few points are enough here; that they are few is tested where it is meant.
pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")


def rough(count: int, seed: int, shape: tuple[int, int] | None = None) -> vc.Surface:
    """Random map of rms slope 0.1, with waves of up to a twelfth of the period."""
    nx, ny = shape or (count, count)
    random = np.random.default_rng(seed)
    k, m = np.fft.fftfreq(nx)[:, None] * nx, np.fft.fftfreq(ny)[None, :] * ny
    q = np.hypot(k, m)
    size = np.where((q >= 1) & (q <= 12), np.maximum(q, 3.0) ** -1.8, 0.0)
    height = np.fft.ifft2(size * np.exp(2j * np.pi * random.random((nx, ny)))).real
    waves = np.abs(np.fft.fft2(height)) ** 2 / height.size**2
    slope = math.sqrt(float(((2 * np.pi / LENGTH * q) ** 2 * waves).sum()))
    return vc.Surface(0.1 / slope * height, (LENGTH / nx, LENGTH / ny), periodic=True)


def straight_waves(amplitude: float) -> vc.Surface:
    phase = 2 * np.pi * np.arange(64) / 64
    return vc.Surface(amplitude * np.cos(phase) * np.ones((8, 1)), LENGTH / 64, periodic=True)


def test_waves_have_the_height_and_slope_of_surface_topography() -> None:
    surface = rough(48, 1, (48, 72))
    squares, along, across = mean_square_waves(surface)
    other = topography_of(surface)
    assert math.sqrt(squares.sum()) == close_to(float(other.rms_height_from_area()), rel=1e-10)
    # With its convention C = |dx dy Σ h exp(-iqx)|²/A the area is A w.
    q, density = other.power_spectrum_from_area()
    known = np.isfinite(density) & (q > 0) & (density > 0)
    whole = np.hypot(along[:, None], across)
    lowest = whole[whole > 0].min()
    ours = LENGTH**2 * squares[np.abs(whole / lowest - 1) < 1e-9].mean()
    assert density[known][np.abs(q[known] / lowest - 1).argmin()] == close_to(ours, rel=0.5)


def test_area_is_erf_of_the_pressure_over_modulus_and_slope() -> None:
    pressures = np.array([2e4, 1e5, 3e5])
    found = persson_area(rough(64, 2), ELASTIC, pressures)
    np.testing.assert_allclose(found, erf(math.sqrt(2) * pressures / (1e7 * 0.1)), rtol=1e-9)
    np.testing.assert_allclose(found, [0.0319, 0.1585, 0.4515], rtol=2e-3)


def test_held_pressure_has_the_area_of_the_relaxed_modulus() -> None:
    late = persson_area(rough(64, 2), RUBBER, 1e5, time=1e3)
    relaxed = vc.Material(vc.Elastic(1 / (2 * 5e-9)), poisson_ratio=0.0)
    assert late == close_to(persson_area(rough(64, 2), relaxed, 1e5), rel=1e-9)


@pytest.mark.parametrize("along", ["x", "y"])
def test_friction_is_exact_at_full_contact(along: Any) -> None:
    # Johnson 1985, section 9.4: the resistance of a wave is π² a²/λ² times the loss modulus M''.
    amplitude, speed, pressure = 1e-7, 5e-5, 1e8
    surface = straight_waves(amplitude)
    if along == "x":
        surface = vc.Surface(surface.heights.T, LENGTH / 64, periodic=True)
    omega = 2 * np.pi / LENGTH * speed
    loss = (1 / (5e-10 + 4.5e-9 / (1 + 1j * omega))).imag
    exact = vc.reference.moving_wave_resistance(amplitude, LENGTH, loss) / pressure
    found = persson_sliding(surface, RUBBER, pressure, speed, along)
    assert float(found.friction_coefficient[0]) == close_to(exact, rel=1e-9)
    assert float(found.area_fraction[0]) == 1.0
    other: Any = "y" if along == "x" else "x"
    still = persson_sliding(surface, RUBBER, pressure, speed, other)
    assert abs(float(still.friction_coefficient[0])) < 1e-12 * exact


def test_friction_of_a_single_wave_in_partial_contact_is_that_of_the_formula() -> None:
    amplitude, speed, pressure, gamma = 1e-6, 1e-4, 2e5, 0.5
    k, square = 2 * np.pi / LENGTH, amplitude**2 / 2
    modulus = 1 / (5e-10 + 4.5e-9 / (1 + 1j * k * speed))
    # Half of the wave counts where it comes into contact itself.
    energy = k**2 * abs(modulus) ** 2 * square / (8 * pressure**2) / 2
    share = erf(1 / (2 * math.sqrt(energy)))
    upper = k**2 * share * modulus.imag * square / (2 * pressure)
    found = persson_sliding(straight_waves(amplitude), RUBBER, pressure, speed, gamma=gamma)
    assert 0.2 < share < 0.9
    assert float(found.friction_coefficient_upper[0]) == close_to(upper, rel=1e-9)
    reduced = (gamma + (1 - gamma) * share**2) * upper
    assert float(found.friction_coefficient[0]) == close_to(reduced, rel=1e-9)


def test_steady_contact_has_the_friction_of_the_theory_at_full_contact() -> None:
    surface = rough(48, 4)
    grid = vc.Grid((48, 48), (LENGTH, LENGTH), periodic=True)
    pressure, speeds = 1e9, [1e-4, 1e-3]
    load = vc.step(pressure * grid.area, tilt_x=0.0, tilt_y=0.0)
    run = vc.steady(
        surface, RUBBER, load, speeds, grid=grid, fields="none", errors=False, tolerance=1e-9
    )
    theory = persson_sliding(surface, RUBBER, pressure, speeds)
    np.testing.assert_allclose(run.friction_coefficient, theory.friction_coefficient, rtol=1e-6)


@pytest.mark.parametrize("seed", [1, 2])
def test_partial_contact_is_within_the_band_that_the_manual_states(seed: int) -> None:
    grid = vc.Grid((96, 96), (LENGTH, LENGTH), periodic=True)
    surface = rough(96, seed)
    load = vc.step(1e5 * grid.area)
    run = vc.simulate(surface, ELASTIC, load, grid, [0.0], fields="none", errors=False)
    ratio = float(run.contact_area[0]) / grid.area / persson_area(surface, ELASTIC, 1e5)
    assert 1.2 < ratio < 1.5


def test_slow_and_fast_bodies_have_little_friction_between_which_is_a_maximum() -> None:
    speeds = np.geomspace(1e-8, 1e2, 21)
    found = persson_sliding(rough(64, 5), RUBBER, 1e6, speeds)
    friction = found.friction_coefficient.values
    assert 3 < int(friction.argmax()) < 17
    assert friction[0] < 1e-2 * friction.max()
    # ∝ v while slow, and ∝ 1/v while fast.
    assert friction[1] / friction[0] == close_to(speeds[1] / speeds[0], rel=0.01)
    assert friction[-1] / friction[-2] == close_to(speeds[0] / speeds[1], rel=0.01)
    assert (found.friction_coefficient_upper.values >= friction).all()
    # The slower, the softer.
    assert (np.diff(found.area_fraction.values) <= 1e-12).all()


SURFACE = rough(32, 6)
REFUSED: dict[str, tuple[Any, str]] = {
    "no surface": (lambda: persson_area(vc.Sphere(1.0), ELASTIC, 1e5), "surface must be"),
    "flat": (
        lambda: persson_area(vc.Surface(np.zeros((8, 8)), 1e-6), ELASTIC, 1e5),
        "its map is flat",
    ),
    "layers": (
        lambda: persson_area(SURFACE, vc.Layered([vc.Layer(1e-3, ELASTIC)], "rigid"), 1e5),
        "material must be",
    ),
    "bulk modulus": (
        lambda: persson_area(SURFACE, vc.Material(RUBBER.law, bulk_modulus=1e9), 1e5, 1.0),
        "Poisson's ratio varies",
    ),
    "no time": (lambda: persson_area(SURFACE, RUBBER, 1e5), "time: the material creeps"),
    "pressure": (lambda: persson_area(SURFACE, ELASTIC, [1e5, 0.0]), "pressure must be"),
    "speed": (lambda: persson_sliding(SURFACE, RUBBER, 1e5, [0.0]), "speed must be"),
    "along": (lambda: persson_sliding(SURFACE, RUBBER, 1e5, 1.0, "z"), "along must be"),
    "gamma": (lambda: persson_sliding(SURFACE, RUBBER, 1e5, 1.0, "y", 2.0), "gamma must"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused_by_name(name: str) -> None:
    call, message = REFUSED[name]
    with pytest.raises(ValueError, match=message):
        call()


def test_doubts_are_warned_of() -> None:
    with pytest.warns(vc.AccuracyWarning, match="a few peaks carry the load"):
        persson_area(SURFACE, ELASTIC, 10.0)
    noise = np.random.default_rng(1).normal(size=(32, 32)) * 1e-8
    with pytest.warns(vc.AccuracyWarning, match="points on its shortest waves"):
        persson_sliding(vc.Surface(noise, 1e-6, periodic=True), RUBBER, 1e8, 1.0)
