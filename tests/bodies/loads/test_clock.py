"""Reduced time of materials, against quadrature of another library and closed forms."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import scipy
from hypothesis import given
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from viscontact.bodies.loads.clock import STEP_CHANGE, TIME, ReducedTime

WLF = vc.WLF(293.15, 8.86, 101.6)
WARM = vc.TemperatureHistory([0.0, 60.0, 60.0, 3600.0], [283.15, 313.15, 293.15, 273.15])
AGEING = vc.Ageing(3600.0, 0.8)
CLOCKS = {
    "temperature": ReducedTime(WARM, WLF),
    "ageing": ReducedTime(ageing=AGEING),
    "both": ReducedTime(WARM, WLF, AGEING),
}


def slowness(clock: ReducedTime, time: float) -> float:
    factor = 1.0
    if clock.temperature is not None and clock.shift is not None:
        factor = clock.shift.factor(float(clock.temperature.at(time)))
    return factor if clock.ageing is None else factor * float(clock.ageing.factor(time))


@pytest.mark.parametrize("name", CLOCKS)
@pytest.mark.parametrize("end", [1e-3, 30.0, 60.0, 1000.0, 1e5])
def test_reduced_time_is_the_integral_of_the_rate(name: str, end: float) -> None:
    clock = CLOCKS[name]
    marks = [0.0, *(mark for mark in (60.0, 3600.0) if mark < end), end]
    expected = sum(
        scipy.integrate.quad(lambda t: 1 / slowness(clock, t), a, b, epsabs=0, epsrel=1e-11)[0]
        for a, b in itertools.pairwise(marks)
    )
    assert clock.reduced(np.array(end)) == close_to(expected, rel=1e-9)


@pytest.mark.parametrize("name", CLOCKS)
@given(st.lists(st.floats(0.0, 1e6), min_size=3, max_size=3, unique=True))
def test_durations_add_up_and_times_come_back(name: str, times: list[float]) -> None:
    clock, (a, b, c) = CLOCKS[name], sorted(times)
    both = clock.passed(b, b - a) + clock.passed(c, c - b)
    assert both == close_to(clock.passed(c, c - a), rel=1e-9, abs=1e-12)
    reduced = clock.reduced(np.array(c))
    assert clock.time_at(float(reduced)) == close_to(c, rel=1e-9, abs=1e-30)


def test_short_steps_have_durations_that_do_not_cancel() -> None:
    clock = CLOCKS["both"]
    found = clock.passed(1e5 + 1e-6, (1e5 + 1e-6) - 1e5)
    assert found == close_to(((1e5 + 1e-6) - 1e5) * clock.rate(1e5), rel=1e-8)


@pytest.mark.parametrize(("begin", "end"), [(0.0, 60.0), (12.5, 60.0), (3.0, 4.0), (60.0, 60.5)])
def test_a_constant_temperature_divides_durations_by_its_shift_factor(
    begin: float, end: float
) -> None:
    held = vc.TemperatureHistory(
        [0.0, 60.0, 60.0, 100.0, 200.0], [303.15, 303.15, 313.15, 313.15, 283.15]
    )
    clock, kelvin = ReducedTime(held, WLF), 303.15 if end <= 60.0 else 313.15
    # a_T in closed form, WLF's equation (1955).
    above = kelvin - 293.15
    rate = 10 ** (8.86 * above / (101.6 + above))
    assert clock.passed(end, end - begin) == close_to(rate * (end - begin), rel=1e-13)
    assert clock.divisions(begin, end).size == 0
    if end <= 60.0:
        assert clock.time_at(rate * end) == close_to(end, rel=1e-13)


def test_ageing_has_struiks_effective_time_in_closed_form() -> None:
    # L. C. E. Struik 1978: at µ = 1 the effective time is t_e ln(1 + t/t_e).
    clock = ReducedTime(ageing=vc.Ageing(100.0, 1.0))
    assert clock.reduced(np.array(1e7)) == close_to(100 * math.log1p(1e5), rel=1e-12)


def test_a_table_that_is_passed_at_its_kinks_has_the_integral_of_its_exponentials() -> None:
    """While T and ln a_T over T are linear, 1/a_T is an exponential of time."""
    kelvin, factors = [273.15, 290.0, 297.0, 320.0], [200.0, 30.0, 1.0, 0.5]
    clock = ReducedTime(
        vc.TemperatureHistory([0.0, 100.0, 150.0], [274.0, 314.0, 294.0]),
        vc.TabulatedShift(kelvin, factors),
    )
    # Instants of 274, 290, 297, 314, 297 and 294 K.
    marks = np.array([0.0, 40.0, 57.5, 100.0, 142.5, 150.0])
    logs = -np.interp([274.0, 290.0, 297.0, 314.0, 297.0, 294.0], kelvin, np.log(factors))
    changes = np.diff(logs)
    pieces = np.diff(marks) * np.exp(logs[:-1]) * np.expm1(changes) / changes
    np.testing.assert_allclose(clock.reduced(marks[1:]), np.cumsum(pieces), rtol=1e-13)
    assert clock.passed(150.0, 145.0) == close_to(pieces.sum() - clock.reduced(np.array(5.0)))


def test_a_swing_over_the_kinks_of_a_table_is_integrated_exactly() -> None:
    day = vc.HarmonicTemperature(mean=293.15, amplitude=10.0, period=100.0, cycles=2, phase=0.3)
    clock = ReducedTime(day, vc.TabulatedShift([280.0, 291.0, 296.0, 305.0], [60.0, 9.0, 1.0, 0.9]))
    turns = [math.asin((kelvin - 293.15) / 10.0) for kelvin in (291.0, 296.0)]
    passages = [(way - 0.3) / (2 * math.pi) * 100.0 for s in turns for way in (s, math.pi - s)]
    marks = np.unique([0.0, 130.0, *(p + k * 100.0 for p in passages for k in (-1, 0, 1, 2))])
    marks = marks[(marks >= 0) & (marks <= 130.0)]
    expected = sum(
        scipy.integrate.quad(lambda t: 1 / slowness(clock, t), a, b, epsabs=0, epsrel=1e-12)[0]
        for a, b in itertools.pairwise(marks)
    )
    assert clock.reduced(np.array(130.0)) == close_to(expected, rel=1e-11)


@pytest.mark.parametrize("name", CLOCKS)
def test_steps_are_divided_where_the_rate_changes_by_more_than_two(name: str) -> None:
    clock = CLOCKS[name]
    ends = np.array([60.0, *clock.divisions(60.0, 3600.0), 3600.0])
    rates = np.log([slowness(clock, t + 1e-6) for t in ends])
    assert np.abs(np.diff(rates)).max() < 1.2 * STEP_CHANGE
    assert TIME.divisions(0.0, 1e9).size == 0


def test_equal_clocks_are_one() -> None:
    again = vc.TemperatureHistory(WARM.times.tolist(), WARM.temperature.tolist())
    assert ReducedTime(again, vc.WLF(293.15, 8.86, 101.6)) == CLOCKS["temperature"]
    assert hash(ReducedTime(again, WLF)) == hash(CLOCKS["temperature"])
    assert CLOCKS["both"] != CLOCKS["temperature"]


@pytest.mark.parametrize(
    ("times", "temperature", "message"),
    [
        ([0.0, 1.0], [290.0], "one value for each of the 2 times"),
        ([0.0, 1.0], [290.0, -1.0], "must be above 0 K, got -1 K"),
        ([0.0, 1.0], [20.0, math.nan], "temperature must be finite"),
        ([1.0, 0.0], [290.0, 300.0], "times must not decrease"),
    ],
)
def test_wrong_history_is_refused(times: list[float], temperature: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        vc.TemperatureHistory(times, temperature)


def test_jump_has_two_temperatures() -> None:
    assert WARM.at(60.0) == 293.15
    assert WARM.at(60.0, side="left") == 313.15
    assert WARM.jumps.tolist() == [60.0]
    assert WARM.kinks.tolist() == [0.0, 60.0, 3600.0]
