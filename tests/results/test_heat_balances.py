"""Balances of power and cooling: all of them, their stability, the runaway."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.laws import WLF, Arrhenius, TabulatedShift
from viscontact.results.heating.balances import (
    Sink,
    all_balances,
    balance_line,
    balances_at,
    reach_of,
    runaway,
)
from viscontact.results.heating.power_curve import PowerCurve

SPEEDS = np.geomspace(1e-4, 1e4, 49)
#: Loss of a single retardation time: R = 2 R_0 s/(1 + s²), with the maximum R_0 at s = 1.
PEAK = 40.0
STEEP = Arrhenius(340.0, 150e3)


def bell(scaled: np.ndarray) -> np.ndarray:
    return PEAK * 2 * scaled / (1 + scaled**2)


CURVE = PowerCurve(SPEEDS, bell(SPEEDS), np.zeros(49), STEEP)


def exact_excess(temperature: np.ndarray, speed: float, sink: Sink) -> np.ndarray:
    return speed * bell(speed * STEEP.factor(temperature)) - sink.power(temperature)


def scanned(values: np.ndarray, temperatures: np.ndarray) -> list[tuple[float, bool]]:
    """Zeros by the sign on a fine scan, with their stability."""
    at = np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))
    return [((temperatures[n] + temperatures[n + 1]) / 2, bool(values[n] > 0)) for n in at]


@pytest.mark.parametrize("count", [50, pytest.param(2000, marks=pytest.mark.slow)])
def test_all_balances_of_random_powers_are_found(count: int) -> None:
    """Sums of three bells over temperature against a scan in 20 000 steps; none is missed."""
    random, counts = np.random.default_rng(36), []
    for _ in range(count):
        centres, widths = random.uniform(290, 450, 3), random.uniform(2, 25, 3)
        heights, conductance = 10 ** random.uniform(-1, 2, 3), 10 ** random.uniform(-2, 1)

        def excess(t, centres=centres, widths=widths, heights=heights, conductance=conductance):
            bells = heights * np.exp(-(((t[:, None] - centres) / widths) ** 2))
            return bells.sum(axis=1) + 1e-3 - conductance * (t - 290.0)

        found = all_balances(excess, np.linspace(290.0, 500.0, 400))
        fine = np.linspace(290.0, 500.0, 20_001)
        expected = scanned(excess(fine), fine)
        assert [each.is_stable for each in found] == [stable for _, stable in expected]
        for each, (temperature, _) in zip(found, expected, strict=True):
            assert abs(each.temperature - temperature) < 0.011
        counts.append(len(found))
    assert {1, 3} <= set(counts)


@pytest.mark.parametrize("conductance", [0.05, 0.2, 0.8, 3.0])
@pytest.mark.parametrize("speed", [3e-3, 0.03, 0.3])
def test_balances_of_a_curve_are_those_of_its_formula(conductance: float, speed: float) -> None:
    sink = Sink(conductance, 300.0)
    reach = reach_of(CURVE, sink, speed)
    found = balances_at(CURVE, sink, speed, reach)
    fine = np.linspace(reach.low, reach.high, 100_001)
    expected = scanned(exact_excess(fine, speed, sink), fine)
    assert [each.is_stable for each in found] == [stable for _, stable in expected]
    for each, (temperature, _) in zip(found, expected, strict=True):
        assert each.temperature == close_to(temperature, abs=0.02)


def test_weaker_cooling_jumps_from_the_cold_to_the_hot_branch() -> None:
    """With the steep shift the temperature is no continuous function of the cooling: between two
    coefficients there are two stable balances, and one unstable between them."""
    counts, coldest = [], []
    for conductance in (0.2, 0.07, 0.05, 0.02):
        sink = Sink(conductance, 300.0)
        found = balances_at(CURVE, sink, 0.05, reach_of(CURVE, sink, 0.05))
        assert [each.is_stable for each in found] == [True, False, True][: len(found)]
        counts.append(len(found))
        coldest.append(found[0].temperature)
    assert counts == [1, 3, 3, 1]
    assert coldest[2] < 305
    assert coldest[3] > 330


def test_runaway_is_where_power_touches_cooling() -> None:
    """P = hA (T - T_0) and dP/dT = hA at once, of the formula of the curve."""
    sink = Sink(0.036, 300.0)
    found = runaway(CURVE, sink, balance_line(CURVE, sink, 1.0))
    assert found is not None
    speed, temperature = found
    near = temperature + np.array([-1e-3, 0.0, 1e-3])
    power = exact_excess(near, speed, sink) + sink.power(near)
    assert power[1] == close_to(float(sink.power(near)[1]), rel=1e-4)
    assert (power[2] - power[0]) / 2e-3 == close_to(0.036, rel=1e-3)
    for factor, is_cold in ((0.999, True), (1.001, False)):
        reach = reach_of(CURVE, sink, factor * speed)
        coldest = balances_at(CURVE, sink, factor * speed, reach)[0].temperature
        assert (coldest < temperature) is is_cold


def test_runaway_of_a_power_that_only_depends_on_temperature_is_that_of_semenov() -> None:
    """Semenov (1928), with P = P_0 exp(b (T - T_0)): the rise at the runaway is 1/b, and
    P_0 = hA/(e b).

    At R ~ 1/s, far above the maximum, P = V R(V a_T) = 2 R_0/a_T does not depend on the speed; just
    below it the runaway is approached."""
    slope, factors = 0.2, np.exp(-0.2 * np.arange(0.0, 80.0, 10.0))
    shift = TabulatedShift(300.0 + np.arange(0.0, 80.0, 10.0), factors)
    resistance = SPEEDS**-0.98  # nearly 1/s: P = V^0.02 a_T^-0.98
    curve = PowerCurve(SPEEDS, resistance, np.zeros(49), shift)
    rise = 1 / (0.98 * slope)
    speed = 1.7
    conductance = np.e / rise * speed**0.02
    found = runaway(
        curve, Sink(conductance, 300.0), balance_line(curve, Sink(conductance, 300.0), 5)
    )
    assert found is not None
    assert found[1] - 300.0 == close_to(rise, rel=1e-4)
    assert found[0] == close_to(speed, rel=1e-4)


def test_power_at_a_temperature_is_that_of_the_slowed_law_and_nan_beyond_the_curve() -> None:
    shift = WLF(300.0, 8.86, 101.6)
    curve = PowerCurve(SPEEDS, bell(SPEEDS), np.zeros(49), shift)
    temperature = np.array([290.0, 300.0, 320.0])
    exact = 2.0 * bell(2.0 * shift.factor(temperature))
    np.testing.assert_allclose(curve.power(temperature, 2.0), exact, rtol=2e-4)
    assert curve.interpolation_error < 1e-3
    assert np.isnan(curve.power(np.array([250.0]), 2.0)).all()  # V a_T = 4e9 m/s
    assert np.isnan(curve.power(np.array([300.0]), 9e-5)).all()
    # The ends belong to the curve.
    assert np.isfinite(curve.power(np.array([300.0]), SPEEDS[[0, -1]])).all()
