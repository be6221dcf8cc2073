"""Temperatures of the bodies over time."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.clock import ReducedTime
from viscontact.results.descriptions import describe, rebuild

DAY = vc.HarmonicTemperature(288.15, 10.0, 86400.0, 3, 0.4)
WLF, ARRHENIUS = vc.WLF(293.15, 8.86, 101.6), vc.Arrhenius(293.15, 80e3)


@pytest.mark.parametrize("shift", [WLF, ARRHENIUS], ids=["wlf", "arrhenius"])
def test_reduced_time_of_a_harmonic_temperature_is_its_integral(shift: vc.WLF) -> None:
    clock = ReducedTime(DAY, shift)
    for time in (1e3, 86400.0, 2.3 * 86400.0, 4 * 86400.0):
        marks = [each for each in DAY.kinks.tolist() if each < time]
        exact, _ = scipy.integrate.quad(
            lambda t: 1 / shift.factor(float(DAY.at(t))),
            *(0.0, time),
            points=marks,
            limit=200,
            epsabs=0.0,
            epsrel=1e-12,
        )
        assert float(clock.reduced(np.array(time))) == close_to(exact, rel=1e-10)


def test_harmonic_temperature_turns_at_its_kinks() -> None:
    low, high = DAY.range
    values = DAY.at(DAY.kinks)
    assert values.min() == close_to(low)
    assert values.max() == close_to(high)
    # Between two of them it rises or falls throughout.
    for begin, end in zip(DAY.kinks[:-1], DAY.kinks[1:], strict=True):
        steps = np.diff(DAY.at(np.linspace(begin, end, 20)))
        assert (steps > 0).all() or (steps < 0).all()
    assert DAY.at(1e9) == close_to(float(DAY.at(3 * 86400.0)))
    assert DAY.steepest == close_to(2 * np.pi * 10 / 86400)
    assert not DAY.is_constant


def test_harmonic_temperature_is_recorded_by_its_numbers() -> None:
    described = describe(DAY)
    assert set(described) == {"type", "mean", "amplitude", "period", "cycles", "phase"}
    assert rebuild(described) == DAY
    assert hash(rebuild(described)) == hash(DAY)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"amplitude": 300.0}, "amplitude must be less than the mean"),
        ({"mean": -1.0}, "mean must be a positive finite number"),
        ({"cycles": 1.5}, "cycles must be a whole number"),
        ({"period": 0.0}, "period must be a positive finite number"),
    ],
)
def test_harmonic_temperature_refuses(changes: dict[str, float], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        vc.HarmonicTemperature(
            **({"mean": 288.0, "amplitude": 9.0, "period": 1.0, "cycles": 1} | changes)
        )


def test_steepest_rate_of_a_history() -> None:
    assert vc.TemperatureHistory([0.0, 10.0, 30.0], [290.0, 300.0, 290.0]).steepest == 1.0
    assert vc.TemperatureHistory([0.0, 10.0, 10.0], [290.0, 290.0, 300.0]).steepest == np.inf
    assert vc.TemperatureHistory([0.0], 290.0).steepest == 0.0
