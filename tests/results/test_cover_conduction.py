"""Conduction through the cover of a roll: exact slabs, steady and over time."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from closeness import close_to
from viscontact.bodies.laws import Arrhenius
from viscontact.results.heating.balances import Reach
from viscontact.results.heating.cover import Cover
from viscontact.results.heating.heating import heating
from viscontact.results.heating.power_curve import PowerCurve

H, T, K, AMBIENT, SOURCE, CAPACITY = 12.0, 8e-3, 0.2, 296.0, 5e4, 2.07e6  # 2.07 MJ/(m³ K)
FLUX = SOURCE * T


def test_slab_on_an_insulated_core_has_the_exact_hot_spot() -> None:
    """k T'' = -g, T'(0) = 0, -k T'(t) = h (T(t) - T_a): T(0) - T_a = g t/h + g t²/(2k)."""
    cover = Cover(H, AMBIENT, T, K)
    modes = cover.steady(FLUX)
    z, found = cover.profile(modes)
    exact = AMBIENT + SOURCE * T / H + SOURCE * (T**2 - z**2) / (2 * K)
    np.testing.assert_allclose(found, exact, rtol=1e-12)
    rise = SOURCE * T / H + SOURCE * T**2 / (2 * K)
    assert cover.hottest(modes) - AMBIENT == close_to(rise, rel=1e-12)
    assert cover.resistance == close_to(1 / H + T / (3 * K), rel=1e-12)
    assert cover.mean(modes) == close_to(cover.idle + FLUX * cover.resistance, rel=1e-12)


def test_slab_on_a_core_at_a_temperature_is_exact_and_loses_what_arises() -> None:
    """T = T_c + b z - g z²/(2k) with b by the cooling; both ends carry off the whole source."""
    core = 330.0
    cover = Cover(H, AMBIENT, T, K, core)
    modes = cover.steady(FLUX)
    z, found = cover.profile(modes)
    b = (SOURCE * T + H * SOURCE * T**2 / (2 * K) - H * (core - AMBIENT)) / (K + H * T)
    np.testing.assert_allclose(found, core + b * z - SOURCE * z**2 / (2 * K), rtol=1e-12)
    lost = H * (cover.surface(modes) - AMBIENT) + K * b
    assert lost == close_to(FLUX, rel=1e-10)
    # The vertex of the parabola, if it is inside.
    assert cover.hottest(modes) == close_to(core + b**2 * K / (2 * SOURCE), rel=1e-6)


@pytest.mark.parametrize("core", [None, 330.0])
def test_cover_that_conducts_well_has_one_temperature(core: float | None) -> None:
    cover = Cover(H, AMBIENT, T, 1e6, core)
    expected = 1 / H if core is None else 0.0
    assert cover.resistance == close_to(expected, rel=1e-5, abs=1e-6)
    assert Cover(H, AMBIENT).resistance == close_to(1 / H, rel=1e-14)


def constant_power() -> PowerCurve:
    """A resistance that does not depend on the speed: the power is that of any temperature."""
    speeds = np.geomspace(1e-9, 1e9, 8)
    return PowerCurve(speeds, np.full(8, FLUX), np.zeros(8), Arrhenius(296.0, 1e3))


def heated(cover: Cover, times: np.ndarray) -> np.ndarray:
    return heating(cover, 1.0, constant_power(), 1.0, Reach(AMBIENT, 1e4, 1e4, False), times)


def test_heating_of_a_slab_is_the_series_of_carslaw_and_jaeger() -> None:
    """Conduction of Heat in Solids (1959): the steady slab of section 3.14 less the decay of its
    profile in the modes of section 3.11, cos(β z/t) with β tan β = h t/k."""
    cover = Cover(H, AMBIENT, T, K, capacity=CAPACITY)
    times = np.array([0.0, 20.0, 100.0, 400.0, 2000.0, 1e4])
    biot = H * T / K
    betas = [
        brentq(lambda b: b * np.sin(b) - biot * np.cos(b), n * np.pi, (n + 0.5) * np.pi)
        for n in range(200)
    ]
    z = np.linspace(0.0, T, 1001)
    exact = np.tile(SOURCE * T / H + SOURCE * (T**2 - z**2) / (2 * K), (times.size, 1))
    for beta in betas:
        # Coefficient of the steady profile, whose source g has this part of the mode.
        norm = T / 2 * (1 + np.sin(2 * beta) / (2 * beta))
        part = SOURCE * T * np.sin(beta) / beta / norm / (K * beta**2 / T**2)
        decay = np.exp(-K / CAPACITY * beta**2 / T**2 * times)
        exact -= part * np.outer(decay, np.cos(beta * z / T))
    found = cover.profile(heated(cover, times))[1] - AMBIENT
    np.testing.assert_allclose(found, exact, atol=2e-5 * exact.max())


def test_uniform_body_heats_up_exponentially() -> None:
    """m c dT/dt = P - hA (T - T_a) with constant P."""
    cover = Cover(H, AMBIENT, T, capacity=CAPACITY)
    times = np.linspace(0.0, 4000.0, 9)
    exact = AMBIENT + FLUX / H * (1 - np.exp(-H / (CAPACITY * T) * times))
    np.testing.assert_allclose(cover.mean(heated(cover, times)), exact, atol=1e-5 * FLUX / H)


def test_heat_that_arises_is_stored_or_given_off() -> None:
    """Energy balance over time, of the power of the mean temperature at each instant."""
    speeds = np.geomspace(1e-4, 1e2, 25)
    resistance = 900 * 2 * speeds / (1 + speeds**2)
    curve = PowerCurve(speeds, resistance, 0 * speeds, Arrhenius(296.0, 60e3))
    cover = Cover(H, AMBIENT, T, K, capacity=CAPACITY)
    times = np.linspace(0.0, 6000.0, 6001)
    modes = heating(cover, 1.0, curve, 0.5, Reach(AMBIENT, 380.0, 380.0, False), times)
    mean, surface = cover.mean(modes), cover.surface(modes)
    arisen = np.trapezoid(curve.power(mean, 0.5), times)
    given_off = np.trapezoid(H * (surface - AMBIENT), times)
    stored = CAPACITY * T * (mean[-1] - mean[0])
    assert arisen == close_to(given_off + stored, rel=1e-5)
    assert stored > 0.02 * arisen
