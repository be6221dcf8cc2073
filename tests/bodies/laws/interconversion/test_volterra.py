"""Numerical interconversion against closed pairs: error, estimate, order, and what it refuses."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.special import erfcx, gamma

from closeness import close_to
from viscontact.bodies.laws.interconversion import volterra
from viscontact.bodies.laws.interconversion.log_curve import mean_power
from viscontact.bodies.laws.interconversion.product_integration import march
from viscontact.bodies.laws.interconversion.series import mean_growth
from viscontact.bodies.laws.interconversion.volterra import invert, onset, respond
from viscontact.laws import CreepSeries, FractionalMaxwell, FractionalZener, PowerLaw, Zener

T = np.logspace(-6, 6, 121)


class Pair(NamedTuple):
    """A function, its mean over intervals, and its inverse in closed form."""

    function: object
    mean: object
    inverse: object


def of_law(law):
    """2 Phi and G of a law with a closed relaxation modulus."""
    return Pair(
        lambda t: 2 * law(t), lambda a, b: 2 * law.mean_creep(a, b), lambda t: law.relaxation(t)
    )


def power(n):
    """t^n and t^-n / (Γ(1+n) Γ(1-n))."""

    def function(t):
        with np.errstate(divide="ignore"):
            return t**n

    return Pair(
        function,
        lambda a, b: mean_power(n, a, b),
        lambda t: t**-n / (gamma(1 + n) * gamma(1 - n)),
    )


def of_relaxation(law):
    """G and 2 Phi of a series law."""
    series = law.relaxation_series()

    def mean(a, b):
        terms = zip(series.moduli, series.times, strict=True)
        return series.equilibrium + sum(
            G * np.exp(-a / tau) * (1 - mean_growth((b - a) / tau)) for G, tau in terms
        )

    return Pair(series.relaxation, mean, lambda t: 2 * law(t))


POLYMER = CreepSeries(0.2, np.logspace(-2, 3, 6), 10.0 ** np.arange(-3, 6, 1.5))
FLOWING = CreepSeries(0.2, np.logspace(-2, 3, 6), 10.0 ** np.arange(-3, 6, 1.5), 0.01)
PAIRS = {
    "Zener": of_law(Zener(3.0, 0.4, 7.0)),
    "solid of six times": of_law(POLYMER),
    "fluid of six times": of_law(FLOWING),
    "1 + t^1/2": Pair(
        lambda t: 1 + t**0.5,
        lambda a, b: 1 + mean_power(0.5, a, b),
        lambda t: erfcx(math.gamma(1.5) * t**0.5),
    ),
    **{f"t^{n}": power(n) for n in (0.1, 0.5, 0.9, -0.1, -0.5, -0.9)},
    "fractional Maxwell": of_law(FractionalMaxwell(2.0, 3.0, 0.5)),
    "two spring-pots": of_law(FractionalMaxwell(2.0, 3.0, 0.8, 0.3)),
    "fractional Zener": of_law(FractionalZener(2.0, 1.0, 3.0, 0.4)),
    "power law": of_law(PowerLaw(1.0, 0.3, 1.0, 0.01)),
    "relaxing solid": of_relaxation(POLYMER),
    "relaxing fluid": of_relaxation(FLOWING),
}
#: Powers of time, a fractional power law, a solid and a fluid remain.
SLOW = ("fractional Zener", "fractional Maxwell", "two spring-pots", "t^0.1", "t^-0.1")
each_pair = pytest.mark.parametrize(
    "pair",
    [
        pytest.param(pair, id=name, marks=[pytest.mark.slow] * (name in SLOW))
        for name, pair in PAIRS.items()
    ],
)


def scale(pair, t):
    """What errors are relative to: 1/f of an inverse that falls, the inverse itself if it grows."""
    grows = np.diff(pair.inverse(np.array([1.0, 10.0])))[0] > 0
    return pair.inverse(t) if grows else 1 / pair.function(t)


@each_pair
def test_inverse_over_twelve_decades_is_the_closed_form_within_its_estimate(pair):
    values, error = invert(pair.function, pair.mean, T)
    assert (np.abs(values - pair.inverse(T)) <= error * scale(pair, T)).all()
    assert 1e-8 < error < 1e-4


@each_pair
def test_inverse_keeps_its_direction_and_its_sign(pair):
    """Also long after everything has relaxed, where a line through each step would ring."""
    values, _ = invert(pair.function, pair.mean, np.logspace(-6, 6, 601))
    direction = np.sign(pair.inverse(T)[-1] - pair.inverse(T)[0])
    assert (values > 0).all()
    assert (direction * np.diff(values) >= 0).all()


@each_pair
def test_march_is_of_second_order_in_the_step_of_log_time(pair):
    """Two halvings, from nodes a hundred times longer than the fastest relaxation on."""
    errors = []
    for steps in (8, 16, 32):
        nodes = np.geomspace(1e-9, 1e5, 14 * steps + 1)
        values = march(pair.function, pair.mean, nodes, None)[1]
        nodes = nodes[: values.size]
        late = nodes > 1e-4
        error = np.abs(values - pair.inverse(nodes)) / scale(pair, nodes)
        errors.append(error[late].max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 1.6).all(), (errors, orders)


def test_limit_of_a_vanishing_step_is_better_than_any_step_and_gets_better(monkeypatch):
    pair, errors, estimates = PAIRS["solid of six times"], [], []
    for steps in (6, 12, 24):
        monkeypatch.setattr(volterra, "STEPS", steps)
        found = respond(pair.function, pair.mean, 1e6, first=1e-7)
        assert found.curve(T) == close_to(pair.inverse(T), rel=found.error(1e-6, 1e6) * 3)
        errors.append((np.abs(found.curve(T) - pair.inverse(T)) / scale(pair, T)).max())
        estimates.append(found.error(1e-6, 1e6))
    assert (np.array(errors) < estimates).all()
    assert (np.log2(np.array(errors[:-1]) / errors[1:]) > 1.8).all()


@pytest.mark.parametrize("steps", [2, 4])
def test_steps_far_longer_than_the_relaxation_time_do_not_ring(steps):
    """Maxwell, G = exp(-t): a trapezoidal rule would swing by its first error for ever."""
    nodes = np.geomspace(1e-3, 1e6, 9 * steps + 1)
    _, values = march(lambda t: 1 + t, lambda a, b: 1 + (a + b) / 2, nodes, None)
    late = nodes[: values.size] > 1e3
    assert np.abs(values[late]).max() < 1e-3


def test_values_do_not_depend_on_how_far_is_asked():
    pair = PAIRS["fluid of six times"]
    short = respond(pair.function, pair.mean, 1e2, first=1e-7).curve(T[T < 1e2])
    long = respond(pair.function, pair.mean, 1e5, first=1e-7).curve(T[T < 1e2])
    np.testing.assert_allclose(short, long, rtol=1e-9)


def test_one_instant_alone_is_as_good_as_many():
    for pair in (PAIRS["Zener"], PAIRS["t^0.5"], PAIRS["relaxing solid"]):
        [value], error = invert(pair.function, pair.mean, [3.0])
        [exact], [size] = pair.inverse(np.array([3.0])), scale(pair, np.array([3.0]))
        assert abs(value - exact) <= (error + 1e-6) * size


def test_instants_may_come_in_any_order_and_shape_and_include_none():
    pair = PAIRS["Zener"]
    values, _ = invert(pair.function, pair.mean, [[3.0, 0.0], [1e-3, 3.0]])
    assert values.shape == (2, 2)
    assert values[0, 1] == close_to(3.0)
    assert values[0, 0] == values[1, 1]
    values, error = invert(pair.function, pair.mean, np.zeros(2))
    assert values == close_to([3.0, 3.0])
    assert error == 0.0


def test_a_function_that_begins_like_a_dashpot_is_refused():
    with pytest.raises(ValueError, match=r"begins like t\^1 has no inverse without a Dirac"):
        invert(lambda t: t, lambda a, b: (a + b) / 2, [1.0])


def test_onset_is_where_a_function_begins_to_change():
    for shift in (1e-12, 1.0, 1e12):
        found = onset(lambda t, shift=shift: 1 + t / shift)
        assert 1e-6 * shift < found < 1.1e-5 * shift
    assert onset(np.ones_like) == 1.0
